#pragma once
// What kind of surface a mesh is: closed or not, manifold, oriented, free of degenerate faces; its pieces, handles and volume.
//
// A file format may round coordinates to float32 and keep no vertices, only corners (STL): what counts then is the surface after
// rounding and merging equal points, which PrepareForReport makes. The report itself goes by indices.
//
// Edges are found by a counting sort of the half-edges by their smaller vertex; fans and components by one union-find over the
// corners of faces: first across edges, which leaves one set for each fan of faces around a vertex, then within faces, which
// leaves one for each component. Time is linear, and there is no allocation for each face or vertex.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "crossing_search.h"
#include "place_table.h"
#include "rounding.h"
#include "vertex_point.h"

namespace vcg::textlabel {

/// A triangle mesh as two arrays.
struct IndexedMesh {
	std::vector<vcg::Point3d> positions;  ///< #V
	std::vector<Face> faces;              ///< #F by 3 indices of positions
};

struct ReportOptions {
	bool asFloat32 = false;         ///< round coordinates to float32 first
	bool mergeEqualPoints = false;  ///< then make vertices of equal coordinates one vertex
};

/// Counts over a whole mesh. Faces with a repeated index are counted as such and then left out of everything else.
struct MeshReport {
	int faces = 0;     ///< without those of a repeated index
	int vertices = 0;  ///< that a face uses
	int edges = 0;
	int unusedVertices = 0;
	int notFinite = 0;            ///< vertices with a coordinate that is NaN or infinite
	int repeatedIndexFaces = 0;   ///< faces that use a vertex twice
	int collinearFaces = 0;       ///< faces of three vertices with exactly no area
	int duplicateFaces = 0;       ///< faces on the same three vertices as an earlier one, whichever way round
	int borderEdges = 0;          ///< edges of one face
	int borderLoops = 0;          ///< connected sets of border edges
	int nonManifoldEdges = 0;     ///< edges of more than two faces
	int nonManifoldVertices = 0;  ///< vertices whose faces don't all hang together by edges at the vertex
	int flippedEdges = 0;         ///< edges of two faces that run along it in the same direction
	int unbalancedEdges = 0;      ///< non-manifold edges with unequal numbers of faces in the two directions
	int components = 0;           ///< sets of faces that hang together by edges
	int eulerCharacteristic = 0;  ///< vertices - edges + faces
	std::optional<int> genus;     ///< handles of all components together; of an oriented manifold only, border allowed
	double area = 0;              ///< of the faces with finite corners
	double volume = 0;  ///< inside, positive when the faces look outwards; without meaning when open or unbalanced
};

/// The arrays of a VCG mesh, deleted elements left out; faces keep their order.
template <class MeshType>
IndexedMesh ToIndexedMesh(const MeshType& m);

/// The mesh as a file would hold it: rounded, merged, as asked for. Vertices keep the order of their first appearance.
IndexedMesh PrepareForReport(IndexedMesh mesh, const ReportOptions& options);

/// Count everything, in time linear in the mesh.
/// @pre every index of a face is one of `positions`
MeshReport MakeReport(const IndexedMesh& mesh);

/// The same for a VCG mesh.
template <class MeshType>
MeshReport MakeReport(const MeshType& m, const ReportOptions& options = {})
{
	return MakeReport(PrepareForReport(ToIndexedMesh(m), options));
}

/// All pairs of faces of a mesh that cross (crossing_search.h).
inline std::vector<FacePair> FindCrossings(const IndexedMesh& mesh, const CrossingOptions& options = {})
{
	return FindCrossings(mesh.positions, mesh.faces, {}, options);
}

inline bool IsClosed(const MeshReport& r) { return r.faces > 0 && r.borderEdges == 0; }
inline bool IsManifold(const MeshReport& r) { return r.nonManifoldEdges == 0 && r.nonManifoldVertices == 0; }
inline bool IsOriented(const MeshReport& r) { return r.flippedEdges == 0 && r.unbalancedEdges == 0; }
inline bool HasDegenerateFaces(const MeshReport& r)
{
	return r.repeatedIndexFaces + r.collinearFaces + r.duplicateFaces + r.notFinite > 0;
}

/// Whether a printer can take it, as far as can be told without looking for crossings.
inline bool IsSound(const MeshReport& r)
{
	return IsClosed(r) && IsManifold(r) && IsOriented(r) && !HasDegenerateFaces(r);
}

/// One line of key=value pairs; genus is left out where it has no meaning.
std::string ToText(const MeshReport& r);

namespace detail {

/// Sets of numbers 0 .. n-1; the least number of a set stands for it, so that the outcome does not depend on the order.
class DisjointSets {
public:
	explicit DisjointSets(size_t n) : parent(n)
	{
		for (size_t i = 0; i < n; ++i) parent[i] = static_cast<int>(i);
	}
	int find(int i)
	{
		while (at(i) != i) i = at(i) = at(at(i));
		return i;
	}
	void join(int i, int j)
	{
		const int a = find(i), b = find(j);
		at(std::max(a, b)) = std::min(a, b);
	}
	bool stands(int i) const { return parent[static_cast<size_t>(i)] == i; }

private:
	int& at(int i) { return parent[static_cast<size_t>(i)]; }
	std::vector<int> parent;
};

inline bool HasRepeatedIndex(const Face& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; }

/// Makes vertices of equal coordinates one; those that are not numbers equal none.
inline void MergeEqualPoints(IndexedMesh& mesh)
{
	PlaceTable table(mesh.positions, mesh.positions.size());
	std::vector<int> merged(mesh.positions.size());
	int kept = 0;
	for (size_t i = 0; i < mesh.positions.size(); ++i) {
		const vcg::Point3d p = mesh.positions[i];
		mesh.positions[static_cast<size_t>(kept)] = p;
		const int there = p == p ? table.add(kept) : -1;  // each that is no number would look at all before it
		merged[i] = there < 0 ? kept++ : there;
	}
	mesh.positions.resize(static_cast<size_t>(kept));
	for (Face& f : mesh.faces)
		for (int& v : f) v = merged[static_cast<size_t>(v)];
}

/// Builds a MeshReport step by step.
class ReportMaker {
public:
	explicit ReportMaker(const IndexedMesh& indexedMesh) : mesh(indexedMesh), corners(3 * indexedMesh.faces.size()) {}

	MeshReport run()
	{
		SortHalfEdges();
		CountEdges();
		CountFans();
		CountComponents();
		Measure();
		CountHandles();
		return r;
	}

private:
	/// One side of a face, filed under the smaller of its two vertices.
	struct HalfEdge {
		int other;   ///< the larger vertex
		int corner;  ///< 3 * face + the corner that it leaves
	};

	static int Next(int corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
	int vertexOf(int corner) const
	{
		return mesh.faces[static_cast<size_t>(corner / 3)][static_cast<size_t>(corner % 3)];
	}

	/// Half-edges by their smaller vertex: a counting sort.
	void SortHalfEdges()
	{
		start.assign(mesh.positions.size() + 1, 0);
		for (const Face& f : mesh.faces) {
			if (HasRepeatedIndex(f)) continue;
			++r.faces;
			for (size_t i = 0; i < 3; ++i) ++start[static_cast<size_t>(std::min(f[i], f[(i + 1) % 3]))];
		}
		r.repeatedIndexFaces = static_cast<int>(mesh.faces.size()) - r.faces;
		int sum = 0;
		for (int& s : start) sum += std::exchange(s, sum);
		halfEdges.resize(static_cast<size_t>(sum));
		// filling moves each start to its end, which is the next one's start
		int corner = 0;
		for (const Face& f : mesh.faces) {
			const bool skip = HasRepeatedIndex(f);
			for (size_t i = 0; i < 3; ++i, ++corner) {
				if (skip) continue;
				const auto [low, high] = std::minmax(f[i], f[(i + 1) % 3]);
				halfEdges[static_cast<size_t>(start[static_cast<size_t>(low)]++)] = {high, corner};
			}
		}
	}

	void CountEdges()
	{
		const auto byOther = [](const HalfEdge& a, const HalfEdge& b) { return a.other < b.other; };
		size_t from = 0;
		for (size_t v = 0; v < mesh.positions.size(); ++v) {
			const size_t to = static_cast<size_t>(start[v]);
			std::sort(halfEdges.begin() + static_cast<std::ptrdiff_t>(from),
			          halfEdges.begin() + static_cast<std::ptrdiff_t>(to), byOther);
			for (size_t end; from < to; from = end) {
				for (end = from + 1; end < to && halfEdges[end].other == halfEdges[from].other;) ++end;
				CountEdge(static_cast<int>(v), &halfEdges[from], &halfEdges[from] + (end - from));
			}
		}
		CountBorderLoops();
	}

	/// One edge, from vertex `low` to a larger one, with all of its half-edges.
	void CountEdge(int low, const HalfEdge* begin, const HalfEdge* end)
	{
		++r.edges;
		const auto count = end - begin;
		if (count == 1) border.push_back({low, begin->other});
		if (count > 2) ++r.nonManifoldEdges;
		std::ptrdiff_t forward = 0;
		for (const HalfEdge* h = begin; h != end; ++h) {
			const bool isForward = vertexOf(h->corner) == low;
			forward += isForward;
			if (h == begin) continue;
			const bool sameWay = isForward == (vertexOf(begin->corner) == low);
			corners.join(h->corner, sameWay ? begin->corner : Next(begin->corner));
			corners.join(Next(h->corner), sameWay ? Next(begin->corner) : begin->corner);
		}
		if (count == 2 && forward != 1) ++r.flippedEdges;
		if (count > 2 && 2 * forward != count) ++r.unbalancedEdges;
		if (count > 1) CountDuplicates(begin, end);
	}

	/// Faces on the same three vertices meet at each of their edges; they are counted at the edge of the two smallest.
	void CountDuplicates(const HalfEdge* begin, const HalfEdge* end)
	{
		apexes.clear();
		for (const HalfEdge* h = begin; h != end; ++h) {
			const int apex = vertexOf(Next(Next(h->corner)));
			if (apex > h->other) apexes.push_back(apex);
		}
		std::sort(apexes.begin(), apexes.end());
		r.duplicateFaces += static_cast<int>(apexes.end() - std::unique(apexes.begin(), apexes.end()));
	}

	void CountBorderLoops()
	{
		r.borderEdges = static_cast<int>(border.size());
		if (border.empty()) return;
		DisjointSets sets(mesh.positions.size());
		for (const auto& e : border) sets.join(e[0], e[1]);
		std::vector<int> loops;
		for (const auto& e : border) loops.push_back(sets.find(e[0]));
		std::sort(loops.begin(), loops.end());
		r.borderLoops = static_cast<int>(std::unique(loops.begin(), loops.end()) - loops.begin());
	}

	/// After joining across edges, the sets of corners at a vertex are its fans.
	void CountFans()
	{
		std::vector<std::uint8_t> fans(mesh.positions.size(), 0);
		ForEachUsedCorner([&](int corner) {
			std::uint8_t& n = fans[static_cast<size_t>(vertexOf(corner))];
			if (corners.stands(corner) && n < 2) ++n;
		});
		r.vertices = static_cast<int>(std::count_if(fans.begin(), fans.end(), [](auto n) { return n > 0; }));
		r.nonManifoldVertices = static_cast<int>(std::count(fans.begin(), fans.end(), 2));
		r.unusedVertices = static_cast<int>(mesh.positions.size()) - r.vertices;
	}

	void CountComponents()
	{
		ForEachUsedCorner([&](int corner) { corners.join(corner, corner - corner % 3); });
		ForEachUsedCorner([&](int corner) { r.components += corners.stands(corner); });
	}

	template <class Use>
	void ForEachUsedCorner(const Use& use)
	{
		for (size_t f = 0; f < mesh.faces.size(); ++f) {
			if (HasRepeatedIndex(mesh.faces[f])) continue;
			for (int i = 0; i < 3; ++i) use(3 * static_cast<int>(f) + i);
		}
	}

	/// Area, volume by cones from a point of the mesh (so that far-off parts lose no digits), faces without area.
	void Measure()
	{
		r.notFinite = static_cast<int>(
			std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const auto& p) { return !IsFinite(p); }));
		vcg::Point3d origin(0, 0, 0);
		bool hasOrigin = false;
		double sixVolumes = 0;
		for (const Face& f : mesh.faces) {
			const Corners t = {mesh.positions[static_cast<size_t>(f[0])], mesh.positions[static_cast<size_t>(f[1])],
			                   mesh.positions[static_cast<size_t>(f[2])]};
			if (HasRepeatedIndex(f)) continue;
			if (r.notFinite > 0 && !(IsFinite(t[0]) && IsFinite(t[1]) && IsFinite(t[2]))) continue;
			if (!std::exchange(hasOrigin, true)) origin = t[0];
			const vcg::Point3d cross = (t[1] - t[0]) ^ (t[2] - t[0]);
			r.area += cross.Norm() / 2;
			sixVolumes += cross * (t[0] - origin);
			r.collinearFaces += IsCollinear(t);
		}
		r.volume = sixVolumes / 6;
	}

	/// Euler's formula for oriented surfaces: V - E + F = 2 components - 2 handles - border loops.
	void CountHandles()
	{
		r.eulerCharacteristic = r.vertices - r.edges + r.faces;
		if (r.faces > 0 && IsManifold(r) && IsOriented(r))
			r.genus = (2 * r.components - r.borderLoops - r.eulerCharacteristic) / 2;
	}

	const IndexedMesh& mesh;
	MeshReport r;
	DisjointSets corners;
	std::vector<int> start;  ///< where the half-edges of a vertex start; after filling, where they end
	std::vector<HalfEdge> halfEdges;
	std::vector<std::array<int, 2>> border;
	std::vector<int> apexes;  ///< scratch
};

}  // namespace detail

template <class MeshType>
IndexedMesh ToIndexedMesh(const MeshType& m)
{
	IndexedMesh out;
	std::vector<int> index(m.vert.size(), -1);
	out.positions.reserve(m.vert.size());
	for (size_t i = 0; i < m.vert.size(); ++i) {
		if (m.vert[i].IsD()) continue;
		index[i] = static_cast<int>(out.positions.size());
		out.positions.push_back(PointOf(m.vert[i]));
	}
	out.faces.reserve(m.face.size());
	for (const auto& f : m.face) {
		if (f.IsD()) continue;
		Face g;
		for (int k = 0; k < 3; ++k) g[static_cast<size_t>(k)] = index[static_cast<size_t>(f.cV(k) - m.vert.data())];
		out.faces.push_back(g);
	}
	return out;
}

inline IndexedMesh PrepareForReport(IndexedMesh mesh, const ReportOptions& options)
{
	if (options.asFloat32)
		for (vcg::Point3d& p : mesh.positions)
			for (int k = 0; k < 3; ++k) p[k] = RoundToFloat(p[k]);
	if (options.mergeEqualPoints) detail::MergeEqualPoints(mesh);
	return mesh;
}

inline MeshReport MakeReport(const IndexedMesh& mesh) { return detail::ReportMaker(mesh).run(); }

inline std::string ToText(const MeshReport& r)
{
	std::ostringstream out;
	out.precision(9);
	out << "faces=" << r.faces << " vertices=" << r.vertices << " edges=" << r.edges << " components=" << r.components
		<< " euler=" << r.eulerCharacteristic;
	if (r.genus) out << " genus=" << *r.genus;
	out << " border_edges=" << r.borderEdges << " border_loops=" << r.borderLoops
		<< " nonmanifold_edges=" << r.nonManifoldEdges << " nonmanifold_vertices=" << r.nonManifoldVertices
		<< " flipped_edges=" << r.flippedEdges << " unbalanced_edges=" << r.unbalancedEdges
		<< " repeated_index=" << r.repeatedIndexFaces << " collinear=" << r.collinearFaces
		<< " duplicates=" << r.duplicateFaces << " not_finite=" << r.notFinite
		<< " unused_vertices=" << r.unusedVertices << " area=" << r.area << " volume=" << r.volume;
	return out.str();
}

}  // namespace vcg::textlabel
