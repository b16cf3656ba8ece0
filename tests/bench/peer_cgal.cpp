// CGAL as a peer (corefinement) and as a judge (self-intersections).

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>
#include <chrono>

#include "peer.h"

namespace bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh ToCgal(const IndexedMesh& mesh)
{
	Mesh out;
	out.reserve(Mesh::size_type(mesh.positions.size()), Mesh::size_type(mesh.faces.size() * 3 / 2),
	            Mesh::size_type(mesh.faces.size()));
	for (const auto& p : mesh.positions) out.add_vertex({p[0], p[1], p[2]});
	const auto vertex = [](int v) { return Mesh::Vertex_index(Mesh::size_type(v)); };
	for (const auto& f : mesh.faces) out.add_face(vertex(f[0]), vertex(f[1]), vertex(f[2]));
	return out;
}

IndexedMesh FromCgal(Mesh& mesh)
{
	mesh.collect_garbage();
	IndexedMesh out;
	for (const auto v : mesh.vertices()) {
		const auto& p = mesh.point(v);
		out.positions.emplace_back(p.x(), p.y(), p.z());
	}
	for (const auto f : mesh.faces()) {
		vcg::textlabel::Face face;
		size_t k = 0;
		for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) face[k++] = int(v.idx());
		out.faces.push_back(face);
	}
	return out;
}

using Clock = std::chrono::steady_clock;

/// The result is in `part`.
bool Boolean(Operation operation, Mesh& part, Mesh& prism)
{
	return operation == Operation::Union ? PMP::corefine_and_compute_union(part, prism, part)
	                                     : PMP::corefine_and_compute_difference(part, prism, part);
}

class Cgal : public Peer {
public:
	std::string about() const override { return "CGAL " CGAL_VERSION_STR " corefinement, 1 thread"; }
	void load(const IndexedMesh& part, const IndexedMesh& prism) override
	{
		partArrays_ = part;
		prismArrays_ = prism;
		part_ = ToCgal(part);
		prism_ = ToCgal(prism);
	}
	double runAlone(Operation operation, IndexedMesh* result) override
	{
		Mesh part = part_, prism = prism_;  // it works on its input
		const auto start = Clock::now();
		const bool done = Boolean(operation, part, prism);
		const std::chrono::duration<double> time = Clock::now() - start;
		if (result) *result = FromCgal(part);
		return done ? time.count() : -1;
	}
	double run(Operation operation) override
	{
		const auto start = Clock::now();
		Mesh part = ToCgal(partArrays_), prism = ToCgal(prismArrays_);
		const bool done = Boolean(operation, part, prism);
		const IndexedMesh result = FromCgal(part);
		const std::chrono::duration<double> time = Clock::now() - start;
		return done && !result.faces.empty() ? time.count() : -1;
	}

private:
	IndexedMesh partArrays_, prismArrays_;
	Mesh part_, prism_;
};

}  // namespace

std::unique_ptr<Peer> MakeCgal() { return std::make_unique<Cgal>(); }

int CountCrossings(const IndexedMesh& mesh)
{
	std::vector<std::array<size_t, 3>> faces;
	std::vector<Kernel::Point_3> points;
	for (const auto& f : mesh.faces)
		if (f[0] != f[1] && f[1] != f[2] && f[2] != f[0]) faces.push_back({size_t(f[0]), size_t(f[1]), size_t(f[2])});
	for (const auto& p : mesh.positions) points.emplace_back(p[0], p[1], p[2]);
	if (!PMP::is_polygon_soup_a_polygon_mesh(faces)) return -1;
	Mesh surface;
	PMP::polygon_soup_to_polygon_mesh(points, faces, surface);
	std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
	PMP::self_intersections(surface, std::back_inserter(pairs));
	return int(pairs.size());
}

}  // namespace bench
