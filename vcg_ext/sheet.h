#pragma once
// The sheet: the triangles that a label could touch, and how they hang together.
//
// One linear pass over the mesh finds the triangles whose projection meets the label's box; nothing else in the library looks at
// the whole mesh. Adjacency is built among these candidates only, from their vertex indices. A candidate's half-edge h = 3 t + k
// runs from corner k to corner k+1 of triangle t:
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
#include <cstdint>
#include <utility>
#include <vcg/complex/complex.h>
#include <vector>

namespace vcg::textlabel {

struct SheetVertex {
	vcg::Point3d mesh;   ///< mesh coordinates
	vcg::Point3d label;  ///< label space
	vcg::Point2d plane;  ///< projected to the label plane
	int index = -1;      ///< index in the mesh
};

struct SheetTriangle {
	std::array<int, 3> vertex;  ///< indices into Sheet::vertices
	int face = -1;              ///< index in the mesh
	bool facing = false;        ///< counter-clockwise in the label plane (exact)
};

enum HalfEdgeKind : int { BorderEdge = -1, NonManifoldEdge = -2 };

/// The candidates of a label. Half-edge h = 3 t + k.
struct Sheet {
	std::vector<SheetVertex> vertices;
	std::vector<SheetTriangle> triangles;
	std::vector<int> twin;                    ///< #T*3: the half-edge on the other side, or a HalfEdgeKind
	std::vector<int> vertexStart, vertexFan;  ///< CSR: candidates around each vertex
	bool mayFlip = true;                      ///< false when faces carry attributes that a flipped edge would smear
	std::vector<int> flipped;                 ///< triangles changed by FlipCaps (cut_repair.h), ascending
	double largestCoordinate = 0;             ///< of the candidates' mesh coordinates, in absolute value
	double extent = 0;                        ///< world units: diagonal of the box of all finite vertices of the mesh
	bool isEmpty = true;                      ///< no face of the mesh has three finite vertices
	std::vector<std::array<vcg::Point3d, 3>>
		straddling;  ///< label space: triangles that reach behind the centre of projection

	static int Next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
	static int Previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
	int from(int h) const { return triangles[size_t(h / 3)].vertex[size_t(h % 3)]; }
	int to(int h) const { return from(Next(h)); }
	const vcg::Point2d& plane(int v) const { return vertices[size_t(v)].plane; }
	int canonical(int h) const { return twin[size_t(h)] >= 0 && twin[size_t(h)] < h ? twin[size_t(h)] : h; }
	/// The triangle across h when it is there and faces the viewer, else -1.
	int facingAcross(int h) const
	{
		const int other = twin[size_t(h)];
		return other >= 0 && triangles[size_t(other / 3)].facing ? other / 3 : -1;
	}
};

/// An axis-parallel box in the label plane.
struct PlaneBox {
	vcg::Point2d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
	vcg::Point2d high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

	void add(const vcg::Point2d& p)
	{
		for (int i = 0; i < 2; ++i) {
			low[i] = std::min(low[i], p[i]);
			high[i] = std::max(high[i], p[i]);
		}
	}
	void grow(double margin)
	{
		low -= vcg::Point2d(margin, margin);
		high += vcg::Point2d(margin, margin);
	}
	bool holds(const PlaneBox& b) const
	{
		return b.low[0] >= low[0] && b.low[1] >= low[1] && b.high[0] <= high[0] && b.high[1] <= high[1];
	}
	double width() const { return high[0] - low[0]; }
	double height() const { return high[1] - low[1]; }
};

namespace detail {

enum OutCode : std::uint8_t { Left = 1, Right = 2, Below = 4, Above = 8, Unusable = 16, BehindCamera = 32 };

/// Where a finite point of label space is seen, against a box.
inline std::uint8_t OutCodeOf(const LabelSpace& space, const PlaneBox& box, const vcg::Point3d& q)
{
	if (!space.isInFront(q)) return Unusable | BehindCamera;
	const vcg::Point2d p = space.project(q);
	return std::uint8_t((p[0] < box.low[0]    ? Left
	                     : p[0] > box.high[0] ? Right
	                                          : 0) |
	                    (p[1] < box.low[1]    ? Below
	                     : p[1] > box.high[1] ? Above
	                                          : 0));
}

/// Pair the half-edges of the candidates: two that run against each other are twins, one alone is a border, the rest is
/// non-manifold. Sorting keeps it O(n log n) in the candidates and independent of hashing.
inline void PairHalfEdges(Sheet& sheet)
{
	struct Key {
		int low, high, halfEdge;
	};
	const int count = int(sheet.triangles.size()) * 3;
	std::vector<Key> keys;
	keys.reserve(size_t(count));
	for (int h = 0; h < count; ++h) {
		const int a = sheet.from(h), b = sheet.to(h);
		keys.push_back({std::min(a, b), std::max(a, b), h});
	}
	std::sort(keys.begin(), keys.end(), [](const Key& x, const Key& y) {
		return x.low != y.low ? x.low < y.low : x.high != y.high ? x.high < y.high : x.halfEdge < y.halfEdge;
	});
	sheet.twin.assign(size_t(count), BorderEdge);
	for (size_t i = 0, j; i < keys.size(); i = j) {
		for (j = i; j < keys.size() && keys[j].low == keys[i].low && keys[j].high == keys[i].high;) ++j;
		const int h = keys[i].halfEdge, other = keys[j - 1].halfEdge;
		if (j - i == 1) continue;
		const bool opposite = j - i == 2 && sheet.from(h) == sheet.to(other) && sheet.from(h) != sheet.to(h);
		for (size_t k = i; k < j; ++k) sheet.twin[size_t(keys[k].halfEdge)] = NonManifoldEdge;
		if (!opposite) continue;
		sheet.twin[size_t(h)] = other;
		sheet.twin[size_t(other)] = h;
	}
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

}  // namespace detail

namespace detail {

template <class MeshType>
vcg::Point3d PointOf(const MeshType& m, size_t vertex)
{
	const auto& p = m.vert[vertex].cP();
	return {double(p[0]), double(p[1]), double(p[2])};
}

/// One pass over the vertices: where each is seen, and the extent of them all.
template <class MeshType>
std::vector<std::uint8_t> CodeVertices(const MeshType& m, const LabelSpace& space, const PlaneBox& box, Sheet& sheet)
{
	std::vector<std::uint8_t> code(m.vert.size(), Unusable);
	vcg::Point3d low(0, 0, 0), high(0, 0, 0);
	bool any = false;
	for (size_t v = 0; v < m.vert.size(); ++v) {
		if (m.vert[v].IsD()) continue;
		const vcg::Point3d q = space.toLabel(PointOf(m, v));
		if (!IsFinite(q)) continue;
		code[v] = OutCodeOf(space, box, q);
		if (!std::exchange(any, true)) low = high = q;
		for (int i = 0; i < 3; ++i) {
			low[i] = std::min(low[i], q[i]);
			high[i] = std::max(high[i], q[i]);
		}
	}
	sheet.extent = (high - low).Norm();
	return code;
}

template <class MeshType>
void AddStraddling(const MeshType& m, const LabelSpace& space, const std::array<int, 3>& v, Sheet& sheet)
{
	std::array<vcg::Point3d, 3> q;
	for (size_t k = 0; k < 3; ++k) q[k] = space.toLabel(PointOf(m, size_t(v[k])));
	if (IsFinite(q[0]) && IsFinite(q[1]) && IsFinite(q[2])) sheet.straddling.push_back(q);
}

/// One pass over the faces: those that may meet the box, with their mesh indices as corners.
template <class MeshType>
void CollectTriangles(const MeshType& m, const LabelSpace& space, const std::vector<std::uint8_t>& code, Sheet& sheet)
{
	const auto* first = m.vert.data();
	for (size_t f = 0; f < m.face.size(); ++f) {
		if (m.face[f].IsD()) continue;
		std::array<int, 3> v;
		for (int k = 0; k < 3; ++k) v[size_t(k)] = int(m.face[f].cV(k) - first);
		const std::uint8_t a = code[size_t(v[0])], b = code[size_t(v[1])], c = code[size_t(v[2])];
		const auto isFinite = [](std::uint8_t x) { return !(x & Unusable) || (x & BehindCamera); };
		sheet.isEmpty = sheet.isEmpty && !(isFinite(a) && isFinite(b) && isFinite(c));
		if ((a | b | c) & Unusable) {
			if (((a | b | c) & BehindCamera) && !(a & b & c & BehindCamera)) AddStraddling(m, space, v, sheet);
			continue;
		}
		if (a & b & c) continue;
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;  // a line: its edges pair with each other
		if (space.mirrors()) std::swap(v[1], v[2]);
		sheet.triangles.push_back({v, int(f), false});
	}
}

/// The vertices of the candidates, numbered anew in the order of the mesh.
template <class MeshType>
void CollectVertices(const MeshType& m, const LabelSpace& space, Sheet& sheet)
{
	std::vector<int> used;
	used.reserve(sheet.triangles.size() * 3);
	for (const SheetTriangle& t : sheet.triangles) used.insert(used.end(), t.vertex.begin(), t.vertex.end());
	std::sort(used.begin(), used.end());
	used.erase(std::unique(used.begin(), used.end()), used.end());
	sheet.vertices.reserve(used.size());
	for (const int index : used) {
		const vcg::Point3d p = PointOf(m, size_t(index)), q = space.toLabel(p);
		sheet.vertices.push_back({p, q, space.project(q), index});
		for (int i = 0; i < 3; ++i) sheet.largestCoordinate = std::max(sheet.largestCoordinate, std::abs(p[i]));
	}
	for (SheetTriangle& t : sheet.triangles) {
		for (int& v : t.vertex) v = int(std::lower_bound(used.begin(), used.end(), v) - used.begin());
		t.facing = Orient2d(sheet.plane(t.vertex[0]), sheet.plane(t.vertex[1]), sheet.plane(t.vertex[2])) > 0;
	}
}

}  // namespace detail

/// Collect the triangles whose projection meets a box of the label plane; one linear pass over vertices and faces.
/// @return candidates in order of their face index; triangles with a vertex that is not finite or lies behind the centre
///         of projection are left out
template <class MeshType>
Sheet CollectSheet(const MeshType& m, const LabelSpace& space, const PlaneBox& box)
{
	Sheet sheet;
	sheet.mayFlip = !vcg::tri::HasPerWedgeTexCoord(m) && !vcg::tri::HasPerFaceColor(m);
	const std::vector<std::uint8_t> code = detail::CodeVertices(m, space, box, sheet);
	detail::CollectTriangles(m, space, code, sheet);
	detail::CollectVertices(m, space, sheet);
	detail::PairHalfEdges(sheet);
	detail::BuildVertexFans(sheet);
	return sheet;
}

/// Perspective-correct weights of a triangle's corners for a point of the label plane.
/// @return weights in space, summing to 1; negative outside the triangle
inline vcg::Point3d SpaceWeights(const LabelSpace& space, const Sheet& sheet, int triangle, const vcg::Point2d& p)
{
	const auto& v = sheet.triangles[size_t(triangle)].vertex;
	vcg::Point3d weight;
	for (int k = 0; k < 3; ++k) {
		const vcg::Point2d a = sheet.plane(v[size_t((k + 1) % 3)]) - p, b = sheet.plane(v[size_t((k + 2) % 3)]) - p;
		weight[k] = (a ^ b) * space.magnification(sheet.vertices[size_t(v[size_t(k)])].label);
	}
	return weight / (weight[0] + weight[1] + weight[2]);
}

}  // namespace vcg::textlabel
