#pragma once
// The commit: write a finished patch into the mesh.
//
// All that can fail (memory) happens first; then slots of removed faces are taken by the new ones, the rest is appended. Faces that
// the label does not touch keep index, vertices and attributes bit for bit; the old vertices keep theirs, but for those within a
// raised letter, which move with it. Attributes of new vertices are mixed from the corners of the triangle in which they lie, new
// faces take those of their birth face, but for its faux edges; polygons end where the label begins (faux_edges.h).

#include "faux_edges.h"
#include "grow_mesh.h"

namespace vcg::textlabel {

/// Where the faces of a patch went.
struct CommitResult {
	std::vector<int> faces;  ///< #LabelPatch::faces: index in the mesh
	int firstNewVertex = 0;  ///< LabelPatch::vertices[i] is vertex firstNewVertex + i
};

/// Write a patch into a mesh.
/// @throws Error{OutOfMemory}, std::bad_alloc, and what the assignment of a custom attribute throws; the mesh is as it was
template <class MeshType>
CommitResult CommitPatch(MeshType& m, const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

template <class Value>
auto Mix(const Value& a, const Value& b, const Value& c, const std::array<double, 3>& w)
{
	return double(a) * w[0] + double(b) * w[1] + double(c) * w[2];
}

/// Custom attributes of an element, as they are in another one. VCGlib leaves those of what it appends as they come from the memory.
/// @param[in] attributes  of the vertices, or of the faces
/// @throws what their assignment throws
template <class Attributes>
void CopyCustom(const Attributes& attributes, size_t to, size_t from)
{
	for (const auto& a : attributes) a._handle->CopyValue(to, from, a._handle);
}

/// The same where nothing may fail: what can't be assigned stays as it is.
template <class Attributes>
void CopyCustomIfPossible(const Attributes& attributes, size_t to, size_t from) noexcept
{
	try {
		CopyCustom(attributes, to, from);
	} catch (...) {}
}

/// Index in the mesh of the corner that weighs most in a new vertex.
inline size_t HeaviestParent(const Sheet& sheet, const Mixture& mixture)
{
	const auto& weight = mixture.weight;
	const size_t heaviest = size_t(std::max_element(weight.begin(), weight.end()) - weight.begin());
	return size_t(sheet.vertices[size_t(mixture.parent[heaviest])].index);
}

/// Attributes of a new vertex from the three it lies between; what can't be mixed is as in the one that weighs most.
template <class MeshType>
void MixVertex(MeshType& m, const Sheet& sheet, const PatchVertex& from, typename MeshType::VertexType& to)
{
	const auto parent = [&](size_t i) ->
		typename MeshType::VertexType& { return m.vert[size_t(sheet.vertices[size_t(from.mixture.parent[i])].index)]; };
	const auto& weight = from.mixture.weight;
	auto &a = parent(0), &b = parent(1), &c = parent(2);
	to.ImportData(m.vert[HeaviestParent(sheet, from.mixture)]);
	using Scalar = typename MeshType::ScalarType;
	to.P() = {Scalar(from.mesh[0]), Scalar(from.mesh[1]), Scalar(from.mesh[2])};
	if (vcg::tri::HasPerVertexColor(m))
		for (int i = 0; i < 4; ++i)
			to.C()[i] =
				static_cast<unsigned char>(std::clamp(Mix(a.cC()[i], b.cC()[i], c.cC()[i], weight), 0.0, 255.0) + 0.5);
	if (vcg::tri::HasPerVertexQuality(m))
		to.Q() = static_cast<typename MeshType::VertexType::QualityType>(Mix(a.cQ(), b.cQ(), c.cQ(), weight));
	if (vcg::tri::HasPerVertexRadius(m))
		to.R() = static_cast<typename MeshType::VertexType::RadiusType>(Mix(a.cR(), b.cR(), c.cR(), weight));
	if (vcg::tri::HasPerVertexTexCoord(m)) {
		using Coordinate = typename MeshType::VertexType::TexCoordType::ScalarType;
		to.T().u() = Coordinate(Mix(a.cT().u(), b.cT().u(), c.cT().u(), weight));
		to.T().v() = Coordinate(Mix(a.cT().v(), b.cT().v(), c.cT().v(), weight));
	}
}

/// Barycentric coordinates of a point near a triangle, none negative.
inline std::array<double, 3> NearestWeights(const std::array<vcg::Point3d, 3>& corner, const vcg::Point3d& p)
{
	const vcg::Point3d normal = (corner[1] - corner[0]) ^ (corner[2] - corner[0]);
	std::array<double, 3> w;
	for (size_t k = 0; k < 3; ++k)
		w[k] = std::max(((corner[(k + 1) % 3] - p) ^ (corner[(k + 2) % 3] - p)) * normal, 0.0);
	const double sum = w[0] + w[1] + w[2];
	if (!(sum > 0)) return {1, 0, 0};
	for (double& x : w) x /= sum;
	return w;
}

/// How much of each corner of sheet triangle `parent` there is in a point of the patch.
inline std::array<double, 3> CornerWeights(const Sheet& sheet, const LabelPatch& patch, int point, int parent)
{
	std::array<double, 3> w = {0, 0, 0};
	const auto& corner = sheet.triangles[size_t(parent)].vertex;
	const int old = int(sheet.vertices.size());
	for (size_t k = 0; k < 3; ++k) {
		if (point < old) {
			w[k] = corner[k] == point ? 1 : 0;
			continue;
		}
		const Mixture& mixture = patch.vertices[size_t(point - old)].mixture;
		for (size_t i = 0; i < 3; ++i)
			if (mixture.parent[i] == corner[k]) w[k] += mixture.weight[i];
	}
	constexpr double rounding = 1e-9;
	if (std::abs(w[0] + w[1] + w[2] - 1) <= rounding) return w;
	// a short edge was collapsed (cut_repair.h): the point lies in a neighbour, or beside the triangle by less than the resolution
	const auto at = [&](size_t k) { return sheet.vertices[size_t(corner[k])].mesh; };
	const int ground = point < old ? -1 : patch.vertices[size_t(point - old)].ground, on = ground < 0 ? point : ground;
	return NearestWeights({at(0), at(1), at(2)},
	                      on < old ? sheet.vertices[size_t(on)].mesh : patch.vertices[size_t(on - old)].mesh);
}

/// The texture coordinates of a face's corners in their stored order.
template <class FaceType>
std::array<typename FaceType::TexCoordType, 3> WedgesOf(const FaceType& f)
{
	return {f.cWT(0), f.cWT(1), f.cWT(2)};
}

}  // namespace detail

template <class MeshType>
CommitResult CommitPatch(MeshType& m, const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch)
{
	using Scalar = typename MeshType::ScalarType;
	using FaceType = typename MeshType::FaceType;
	CommitResult result;
	result.firstNewVertex = int(m.vert.size());
	const int old = int(sheet.vertices.size());
	const size_t firstNewFace = m.face.size();
	result.faces.resize(patch.faces.size());

	// slots: the first piece of each removed face takes its place; a face of which no piece is left (a sliver below the
	// resolution) gives its place to a piece of another
	std::vector<char> taken(sheet.triangles.size(), 0);
	std::vector<size_t> owners, guests;
	for (size_t i = 0; i < patch.faces.size(); ++i) {
		const PatchFace& f = patch.faces[i];
		const bool first = f.kind != FaceKind::Wall && !std::exchange(taken[size_t(f.parent)], 1);
		(first ? owners : guests).push_back(i);
		if (first) result.faces[i] = sheet.triangles[size_t(f.parent)].face;
	}
	size_t guest = 0;
	for (const int t : patch.removed)
		if (!taken[size_t(t)]) result.faces[guests[guest++]] = sheet.triangles[size_t(t)].face;
	const int appended = int(guests.size() - guest);
	for (int i = 0; guest < guests.size(); ++i) result.faces[guests[guest++]] = int(firstNewFace) + i;
	guests.insert(guests.end(), owners.begin(), owners.end());  // owners overwrite their birth face, so they go last
	const std::vector<FaceEdge> fauxEdges = FauxEdgesAround(m, sheet, patch);
	const auto birthOf = [&](size_t i) { return size_t(sheet.triangles[size_t(patch.faces[i].parent)].birthFace()); };
	GrowMesh(m, patch.vertices.size(), size_t(appended), [&] {
		for (size_t i = 0; i < patch.vertices.size(); ++i)
			detail::CopyCustom(m.vert_attr, size_t(result.firstNewVertex) + i,
			                   detail::HeaviestParent(sheet, patch.vertices[i].mixture));
		for (const size_t i : guests)
			if (size_t(result.faces[i]) >= firstNewFace)
				detail::CopyCustom(m.face_attr, size_t(result.faces[i]), birthOf(i));
	});  // nothing below can fail

	for (size_t i = 0; i < patch.vertices.size(); ++i)
		detail::MixVertex(m, sheet, patch.vertices[i], m.vert[size_t(result.firstNewVertex) + i]);
	for (const auto& [v, p] : patch.moved)
		m.vert[size_t(sheet.vertices[size_t(v)].index)].P() = {Scalar(p[0]), Scalar(p[1]), Scalar(p[2])};

	for (const FaceEdge& e : fauxEdges) m.face[size_t(e.face)].ClearF(e.edge);

	const bool wedges = vcg::tri::HasPerWedgeTexCoord(m);
	for (const size_t i : guests) {
		const PatchFace& f = patch.faces[i];
		const FaceType& birth = m.face[birthOf(i)];
		FaceType& to = m.face[size_t(result.faces[i])];
		if (&to != &birth) {
			to.ImportData(birth);
			if (size_t(result.faces[i]) < firstNewFace)
				detail::CopyCustomIfPossible(m.face_attr, size_t(result.faces[i]), birthOf(i));
		}
		to.ClearAllF();
		const auto wedge = wedges ? detail::WedgesOf(birth) : decltype(detail::WedgesOf(birth)){};
		const auto corner = [&](int k) { return space.mirrors() && k > 0 ? 3 - k : k; };
		for (int k = 0; k < 3; ++k) {
			const int point = f.vertex[size_t(k)];
			const size_t index =
				point < old ? size_t(sheet.vertices[size_t(point)].index) : size_t(result.firstNewVertex + point - old);
			to.V(corner(k)) = &m.vert[index];
			if (!wedges) continue;
			const std::array<double, 3> w = detail::CornerWeights(sheet, patch, point, f.parent);
			auto& uv = to.WT(corner(k));
			uv = wedge[0];
			using Coordinate = std::decay_t<decltype(uv.u())>;
			const auto &a = wedge[0], &b = wedge[size_t(corner(1))], &c = wedge[size_t(corner(2))];
			uv.u() = Coordinate(detail::Mix(a.u(), b.u(), c.u(), w));
			uv.v() = Coordinate(detail::Mix(a.v(), b.v(), c.v(), w));
		}
	}
	return result;
}

}  // namespace vcg::textlabel
