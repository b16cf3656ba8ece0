#include "ours.h"
#include "bench_mesh.h"
#include "vcg_ext/text_label.h"

#include <chrono>

namespace bench {
namespace {

class Clock {
public:
	double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

private:
	const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

struct Ours::Mesh {
	CMeshO mesh;
	std::vector<unsigned char> codes;  ///< #V, of the bare pass
	std::vector<char> copy;
};

Ours::Ours(const IndexedMesh& part, const Outline& outline, const LabelFrame& frame, double height)
	: part_(part), outline_(outline), frame_(frame), height_(height), mesh_(std::make_unique<Mesh>())
{
	labelWithoutRoom();  // tells how much is new
}

Ours::~Ours() = default;

void Ours::restore(bool room)
{
	const size_t vertices = part_.positions.size() + size_t(room ? newVertices_ : 0),
				 faces = part_.faces.size() + size_t(room ? newFaces_ : 0);
	CMeshO& m = mesh_->mesh;
	if (m.vert.capacity() != vertices || m.face.capacity() != faces) {
		mesh_ = nullptr;  // first, so that there are never two
		mesh_ = std::make_unique<Mesh>();
		ReserveMesh(mesh_->mesh, vertices, faces);
	}
	FillMesh(mesh_->mesh, part_);
}

double Ours::label(IndexedMesh* result)
{
	restore(true);
	vcg::textlabel::LabelOptions options;
	options.height = height_;
	const Clock clock;
	vcg::textlabel::LabelMesh(mesh_->mesh, outline_, frame_, options);
	const double seconds = clock.seconds();
	if (result) *result = vcg::textlabel::ToIndexedMesh(mesh_->mesh);
	return seconds;
}

double Ours::labelWithoutRoom()
{
	mesh_ = std::make_unique<Mesh>();
	restore(false);
	vcg::textlabel::LabelOptions options;
	options.height = height_;
	const Clock clock;
	const auto done = vcg::textlabel::LabelMesh(mesh_->mesh, outline_, frame_, options);
	const double seconds = clock.seconds();
	newVertices_ = done.newVertices;
	newFaces_ = done.newFaces;
	return seconds;
}

double Ours::pass()
{
	restore(true);
	const vcg::textlabel::LabelSpace space(frame_);
	vcg::textlabel::PlaneBox box;
	for (const auto& c : outline_.contours)
		for (const auto& p : c.points) box.add(p);
	mesh_->codes.resize(part_.positions.size());
	const Clock clock;
	underBox_ = BarePass(mesh_->mesh, space, box, mesh_->codes.data());
	return clock.seconds();
}

double Ours::copy()
{
	restore(true);
	const CMeshO& m = mesh_->mesh;
	const size_t vertices = m.vert.size() * sizeof m.vert[0], faces = m.face.size() * sizeof m.face[0];
	mesh_->copy.assign(vertices + faces, 1);
	const Clock clock;
	std::memcpy(mesh_->copy.data(), static_cast<const void*>(m.vert.data()), vertices);
	std::memcpy(mesh_->copy.data() + vertices, static_cast<const void*>(m.face.data()), faces);
	return clock.seconds();
}

double Ours::bytes() const
{
	const CMeshO& m = mesh_->mesh;
	return double(part_.positions.size() * sizeof m.vert[0] + part_.faces.size() * sizeof m.face[0]);
}

}  // namespace bench
