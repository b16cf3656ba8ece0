#pragma once
// The sheet: the triangles that a label could touch, and how they hang together.
//
// One linear pass over the mesh collects these candidates (collect_sheet.h). Adjacency is built among them only, from their vertex
// indices. A candidate's half-edge h = 3 t + k runs from corner k to corner k+1 of triangle t:
//
//            2
//           / \            corners counter-clockwise in the label plane when the triangle faces the viewer;
//    2 = h %3  \ 1         a mirroring layer matrix is undone here, so that this holds for it too
//         /     \.
//        0 ----- 1
//            0

#include "contour.h"
#include "label_frame.h"
#include "predicates.h"

#include <array>
#include <limits>
#include <utility>
#include <vcg/space/box3.h>
#include <vector>

namespace vcg::textlabel {

/// A point of the surface.
struct SheetPoint {
	vcg::Point3d mesh;   ///< mesh coordinates, of a new point not yet rounded
	vcg::Point3d label;  ///< label space
	vcg::Point2d plane;  ///< projected to the label plane
};

struct SheetVertex : SheetPoint {
	int index = -1;  ///< index in the mesh
};

struct SheetTriangle {
	std::array<int, 3> vertex;  ///< indices into Sheet::vertices
	int face = -1;              ///< index in the mesh
	bool facing = false;        ///< counter-clockwise in the label plane (exact)
	int birth = -1;             ///< index of the face whose attributes it has, when that is another one

	int birthFace() const { return birth < 0 ? face : birth; }
};

/// What is across a half-edge when that is no candidate.
enum HalfEdgeKind : int { BorderEdge = -1, NonManifoldEdge = -2, BehindCameraEdge = -3 };

/// Why a contour or the inside of a letter can't go on over an edge.
inline ErrorCode CodeOfEdge(int twin)
{
	return twin == BorderEdge         ? ErrorCode::Border
	       : twin == NonManifoldEdge  ? ErrorCode::NonManifold
	       : twin == BehindCameraEdge ? ErrorCode::BehindCamera
	                                  : ErrorCode::Silhouette;
}

/// A triangle that reaches behind the centre of projection, or one that the axis of a wrapped label or the cut opposite to it goes
/// through: it can't be seen whole, but it can be met.
struct StraddlingTriangle {
	std::array<vcg::Point3d, 3> mesh, label;  ///< corners in mesh coordinates and in label space
	std::array<int, 3> vertex;                ///< indices in the mesh
	std::array<int, 3> inSheet{};             ///< indices into Sheet::vertices
	int face = -1;                            ///< index in the mesh
};

/// The candidates of a label. Half-edge h = 3 t + k.
struct Sheet {
	std::vector<SheetVertex> vertices;  ///< of candidates and of straddling triangles
	std::vector<SheetTriangle> triangles;
	std::vector<int> twin;                    ///< #T*3: the half-edge on the other side, or a HalfEdgeKind
	std::vector<int> vertexStart, vertexFan;  ///< CSR: candidates around each vertex
	PlaneBox box;              ///< what they were collected for: nothing else of the mesh meets it, but for isShallow
	PlaneBox around;           ///< a wider one
	std::vector<int> besides;  ///< other faces of the mesh that may meet the wider one, but for isShallow; ascending
	bool mayFlip = true;       ///< false when faces carry a texture, which a flipped edge would smear
	std::vector<int> flipped;  ///< triangles changed by FlipCaps (cut_repair.h), ascending
	std::vector<std::array<int, 3>> unflipped;  ///< #flipped: what their vertices were
	double capReach = 0;  ///< label units: how much further FlipCaps wants candidates, to know a cap's neighbours
	double largestCoordinate = 0;  ///< of the candidates' mesh coordinates, in absolute value
	bool isEmpty = true;           ///< no face of the mesh has three finite vertices
	bool isShallow = false;        ///< some that show their backs were left out: the label can't reach so deep
	std::vector<StraddlingTriangle> straddling;
	std::vector<int> besideNoPoint;  ///< vertices of the mesh in faces that have a corner which is not finite

	static int Next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
	static int Previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
	int from(int h) const { return triangles[size_t(h / 3)].vertex[size_t(h % 3)]; }
	int to(int h) const { return from(Next(h)); }
	const vcg::Point2d& plane(int v) const { return vertices[size_t(v)].plane; }
	/// Whether `holds` is true for the corners, in mesh coordinates, of what lay in a triangle's place before anything was flipped:
	/// itself, or any of those that were.
	template <class Holds>
	bool anyBefore(int t, const Holds& holds) const
	{
		const auto holdsAt = [&](const std::array<int, 3>& v) {
			const auto at = [&](size_t k) { return vertices[size_t(v[k])].mesh; };
			return holds(std::array<vcg::Point3d, 3>{at(0), at(1), at(2)});
		};
		return std::binary_search(flipped.begin(), flipped.end(), t)
		           ? std::any_of(unflipped.begin(), unflipped.end(), holdsAt)
		           : holdsAt(triangles[size_t(t)].vertex);
	}
	int canonical(int h) const { return twin[size_t(h)] >= 0 && twin[size_t(h)] < h ? twin[size_t(h)] : h; }
	/// The triangle across h when it is there and faces the viewer, else -1.
	int facingAcross(int h) const
	{
		const int other = twin[size_t(h)];
		return other >= 0 && triangles[size_t(other / 3)].facing ? other / 3 : -1;
	}
};

namespace detail {

/// Pair the half-edges of the candidates: two that run against each other are twins, one alone is a border, the rest is
/// non-manifold. Those of an edge meet in the bucket of its lower vertex; the order of hashing or threads plays no part.
inline void PairHalfEdges(Sheet& sheet)
{
	struct Key {
		int high, halfEdge;
	};
	const int count = int(sheet.triangles.size()) * 3;
	std::vector<int> start(sheet.vertices.size() + 2, 0);
	const auto low = [&](int h) { return size_t(std::min(sheet.from(h), sheet.to(h))); };
	for (int h = 0; h < count; ++h) ++start[low(h) + 2];
	for (size_t i = 2; i < start.size(); ++i) start[i] += start[i - 1];
	std::vector<Key> keys(static_cast<size_t>(count));
	for (int h = 0; h < count; ++h) keys[size_t(start[low(h) + 1]++)] = {std::max(sheet.from(h), sheet.to(h)), h};
	sheet.twin.assign(size_t(count), BorderEdge);
	for (size_t v = 0; v + 1 < start.size(); ++v) {
		Key *const begin = keys.data() + start[v], *const end = keys.data() + start[v + 1];
		std::sort(begin, end, [](const Key& x, const Key& y) {
			return x.high != y.high ? x.high < y.high : x.halfEdge < y.halfEdge;
		});
		for (Key *i = begin, *j; i != end; i = j) {
			for (j = i; j != end && j->high == i->high;) ++j;
			if (j - i == 1) continue;
			const int h = i->halfEdge, other = j[-1].halfEdge;
			const bool opposite = j - i == 2 && sheet.from(h) == sheet.to(other);
			for (const Key* k = i; k != j; ++k) sheet.twin[size_t(k->halfEdge)] = NonManifoldEdge;
			if (!opposite) continue;
			sheet.twin[size_t(h)] = other;
			sheet.twin[size_t(other)] = h;
		}
	}
}

/// What lies beyond an edge of a straddling triangle can't be seen: no contour may cross it.
inline void MarkStraddlingEdges(Sheet& sheet)
{
	if (sheet.straddling.empty()) return;
	std::vector<std::pair<int, int>> edges;
	for (const StraddlingTriangle& s : sheet.straddling)
		for (size_t k = 0; k < 3; ++k) edges.push_back(std::minmax({s.vertex[k], s.vertex[(k + 1) % 3]}));
	std::sort(edges.begin(), edges.end());
	const auto index = [&](int v) { return sheet.vertices[size_t(v)].index; };
	for (int h = 0; h < int(sheet.twin.size()); ++h)
		if (std::binary_search(edges.begin(), edges.end(),
		                       std::pair<int, int>(std::minmax({index(sheet.from(h)), index(sheet.to(h))}))))
			sheet.twin[size_t(h)] = BehindCameraEdge;
}

inline void BuildVertexFans(Sheet& sheet)
{
	sheet.vertexStart.assign(sheet.vertices.size() + 1, 0);
	for (const SheetTriangle& t : sheet.triangles)
		for (const int v : t.vertex) ++sheet.vertexStart[size_t(v) + 1];
	for (size_t i = 1; i < sheet.vertexStart.size(); ++i) sheet.vertexStart[i] += sheet.vertexStart[i - 1];
	sheet.vertexFan.resize(sheet.triangles.size() * 3);
	std::vector<int> next(sheet.vertexStart.begin(), sheet.vertexStart.end() - 1);
	for (size_t t = 0; t < sheet.triangles.size(); ++t)
		for (const int v : sheet.triangles[t].vertex) sheet.vertexFan[size_t(next[size_t(v)]++)] = int(t);
}

/// Half-edges and fans, from the triangles' vertices; again after these have changed.
inline void LinkTriangles(Sheet& sheet)
{
	PairHalfEdges(sheet);
	MarkStraddlingEdges(sheet);
	BuildVertexFans(sheet);
}

}  // namespace detail

}  // namespace vcg::textlabel
