#pragma once
// The sheet: the triangles that a label could touch, and how they hang together.
//
// One linear pass over the mesh finds the triangles whose projection meets the label's box, but for those that show their backs
// deeper than the label may reach; those beside the box are noted. No other step of a label looks at the whole mesh, but for growing
// its arrays (grow_mesh.h), for what is left of polygons (faux_edges.h), and where large triangles reach far out of the box
// (overhang.h).
// Adjacency is built among these candidates only, from their vertex indices. A candidate's half-edge h = 3 t + k runs from corner
// k to corner k+1 of triangle t:
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
#include "vertex_codes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vcg/complex/complex.h>
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

/// A triangle that may meet the box.
struct FoundTriangle {
	double nearest;  ///< label space: the largest z of its corners; not finite when one of them is too large for it
	int face;
	bool facing;
};

/// What a pass over some of the faces finds.
struct FoundTriangles {
	std::vector<FoundTriangle> triangles;
	std::vector<int> straddling, besides;                       ///< faces
	std::vector<int> besideNoPoint;                             ///< vertices
	double farthest = std::numeric_limits<double>::infinity();  ///< label space: the least z of what faces the viewer
	bool isEmpty = true;
};

/// The mesh indices of a face's corners.
template <class MeshType>
std::array<int, 3> CornersOfFace(const MeshType& m, const LabelSpace& space, int face)
{
	const auto& f = m.face[size_t(face)];
	const auto index = [&](int k) { return int(f.cV(k) - m.vert.data()); };
	return {index(0), index(space.mirrors() ? 2 : 1), index(space.mirrors() ? 1 : 2)};
}

/// Where a triangle lies on the way round the axis.
enum class Wrapping {
	Whole,   ///< in one piece, as its unrolled corners have it
	Beyond,  ///< over the cut opposite to the label, and beside the label
	Torn     ///< the axis goes through it, or it lies over the cut and reaches to the label
};

/// @param[in] corner  unrolled, all off the axis
/// @pre space.wraps()
inline Wrapping WrappingOf(const LabelSpace& space, const PlaneBox& unrolledBox,
                           const std::array<vcg::Point3d, 3>& corner)
{
	if (space.isInOnePiece(corner)) return Wrapping::Whole;
	// the widest gap between two corners is where it is not; it must be more than half of the way
	std::array<double, 3> at = {corner[0][0], corner[1][0], corner[2][0]};
	std::sort(at.begin(), at.end());
	const double first = at[1] - at[0], second = at[2] - at[1];
	if (std::max(first, second) <= space.circumference() / 2) return Wrapping::Torn;
	const double before = first > second ? at[0] : at[1], after = first > second ? at[1] : at[2];
	return before < unrolledBox.low[0] && after > unrolledBox.high[0] ? Wrapping::Beyond : Wrapping::Torn;
}

/// Depth and facing of a triangle.
/// @param[in] corner  label space
inline FoundTriangle SeeTriangle(const LabelSpace& space, int face, const std::array<vcg::Point3d, 3>& corner,
                                 double& farthest)
{
	const std::array<double, 3> z = {corner[0][2], corner[1][2], corner[2][2]};
	const double sum = z[0] + z[1] + z[2];
	if (!std::isfinite(sum)) return {sum, face, false};
	const bool facing = Orient2d(space.project(corner[0]), space.project(corner[1]), space.project(corner[2])) > 0;
	if (facing) farthest = std::min({farthest, z[0], z[1], z[2]});
	return {std::max({z[0], z[1], z[2]}), face, facing};
}

/// One pass over some of the faces: those that may meet the box, and those beside it that may meet the one that the codes are for.
template <class MeshType>
FoundTriangles FindTriangles(const MeshType& m, const LabelSpace& space, const PlaneBox& box,
                             const std::vector<std::uint8_t>& codes, size_t begin, size_t end)
{
	FoundTriangles found;
	constexpr std::uint8_t beside = Left | Right | Below | Above;
	const LabelSpace here = space;  // copies that nothing else can change stay in registers
	const PlaneBox unrolledBox = space.wraps() ? space.unrolledBox(box) : box;
	const bool wraps = space.wraps(), perspective = space.perspective();
	const auto isFinite = [](std::uint8_t x) { return !(x & Unusable) || (x & BehindCamera); };
	const auto areFinite = [&](std::uint8_t x, std::uint8_t y, std::uint8_t z) {
		return isFinite(x) && isFinite(y) && isFinite(z);
	};
	const auto view = [&](const vcg::Point3d& p) { return wraps ? here.unrolled(p) : here.inFrame(p); };
	const auto codeIn = [&](std::uint8_t around, const vcg::Point3d& q) {
		return (around & (Unusable | BehindCamera)) == Unusable ? std::uint8_t(Unusable)
		       : wraps                                          ? OutCodeOfUnrolled(here, unrolledBox, q)
		       : perspective                                    ? OutCodeOf(here, box, q)
		                                                        : OutCodeOf(unrolledBox, {q[0], q[1]});
	};
	const auto* const first = m.vert.data();
	const std::uint8_t* const code = codes.data();
	bool anyBeside = false;
	for (size_t f = begin; f < end; ++f) {
		const auto& face = m.face[f];
		if (face.IsD()) continue;
		const std::ptrdiff_t i = face.cV(0) - first, j = face.cV(1) - first, k = face.cV(2) - first;
		const std::uint8_t a = code[i], b = code[j], c = code[k];
		if (a & b & c & beside) {  // nearly all, with all corners finite
			anyBeside = true;
			continue;
		}
		const auto isTaken = [&] {
			const std::array<int, 3> v = CornersOfFace(m, space, int(f));
			std::array<vcg::Point3d, 3> corner;
			std::uint8_t common = beside;
			for (size_t n = 0; n < 3; ++n) {
				corner[n] = view(PointOf(m.vert[size_t(v[n])]));
				common &= codeIn(code[v[n]], corner[n]);
			}
			if (common) {
				anyBeside = true;
				return false;
			}
			found.isEmpty = found.isEmpty && !areFinite(a, b, c);
			if ((a | b | c) & Unusable) {
				if (!areFinite(a, b, c)) found.besideNoPoint.insert(found.besideNoPoint.end(), v.begin(), v.end());
				const bool isMet = wraps || !(a & b & c & BehindCamera);  // the axis is met from all sides
				if (!((a | b | c) & BehindCamera) || !isMet) return false;
				found.straddling.push_back(int(f));
				return true;
			}
			if (i == j || j == k || k == i) return false;  // a line: its edges pair with each other
			if (wraps) {
				const Wrapping wrapping = WrappingOf(here, unrolledBox, corner);
				if (wrapping == Wrapping::Torn) found.straddling.push_back(int(f));
				if (wrapping != Wrapping::Whole) return wrapping == Wrapping::Torn;
				for (vcg::Point3d& q : corner) q = here.turned(q);
			}
			const FoundTriangle seen = SeeTriangle(here, int(f), corner, found.farthest);
			if (!std::isfinite(seen.nearest)) return false;
			found.triangles.push_back(seen);
			return true;
		};
		if (!isTaken()) found.besides.push_back(int(f));
	}
	found.isEmpty = found.isEmpty && !anyBeside;
	return found;
}

/// One pass over the faces: the candidates, with their mesh indices as corners; marks these as Used, and those of straddling triangles.
template <class MeshType>
void CollectTriangles(const MeshType& m, const LabelSpace& space, double depth, std::vector<std::uint8_t>& code,
                      Sheet& sheet)
{
	constexpr double infinity = std::numeric_limits<double>::infinity();
	std::vector<FoundTriangles> found(ChunkCount(m.face.size()));
	EachChunk(m.face.size(), found.size(), [&](size_t chunk, size_t first, size_t last) {
		found[chunk] = FindTriangles(m, space, sheet.box, code, first, last);
	});
	double farthest = infinity;
	for (const FoundTriangles& part : found) farthest = std::min(farthest, part.farthest);
	const double deepest = farthest < infinity ? farthest - depth : -infinity;
	const auto isCandidate = [&](const FoundTriangle& t) { return t.facing || t.nearest >= deepest; };
	std::ptrdiff_t count = 0;
	for (const FoundTriangles& part : found)
		count += std::count_if(part.triangles.begin(), part.triangles.end(), isCandidate);
	sheet.triangles.reserve(size_t(count));
	for (const FoundTriangles& part : found) {
		sheet.isEmpty = sheet.isEmpty && part.isEmpty;
		sheet.besides.insert(sheet.besides.end(), part.besides.begin(), part.besides.end());
		sheet.besideNoPoint.insert(sheet.besideNoPoint.end(), part.besideNoPoint.begin(), part.besideNoPoint.end());
		for (const int face : part.straddling) {
			StraddlingTriangle s;
			s.face = face;
			s.vertex = CornersOfFace(m, space, face);
			for (size_t k = 0; k < 3; ++k) {
				s.mesh[k] = PointOf(m.vert[size_t(s.vertex[k])]);
				s.label[k] = space.toLabel(s.mesh[k]);
			}
			if (!IsFinite(s.label[0]) || !IsFinite(s.label[1]) || !IsFinite(s.label[2])) continue;
			sheet.straddling.push_back(s);
			for (const int v : s.vertex) code[size_t(v)] |= Used;
		}
		for (const FoundTriangle& t : part.triangles) {
			if (!isCandidate(t)) {
				sheet.isShallow = true;
				continue;
			}
			sheet.triangles.push_back({CornersOfFace(m, space, t.face), t.face, t.facing});
			for (const int v : sheet.triangles.back().vertex) code[size_t(v)] |= Used;
		}
	}
}

/// The vertices of the candidates and of straddling triangles, numbered anew in the order of the mesh.
template <class MeshType>
void CollectVertices(const MeshType& m, const LabelSpace& space, const std::vector<std::uint8_t>& code, Sheet& sheet)
{
	const auto block = [&](size_t i) {
		CodeBlock codes;
		std::memcpy(&codes, code.data() + i * kCodeBlock, kCodeBlock);
		return codes;
	};
	std::vector<int> before(code.size() / kCodeBlock);  // how many are used in earlier blocks
	int count = 0;
	for (size_t i = 0; i < before.size(); ++i) {
		before[i] = count;
		count += CountUsed(block(i));
	}
	sheet.vertices.reserve(size_t(count));
	for (size_t i = 0; i < before.size(); ++i) {
		if (!CountUsed(block(i))) continue;
		for (size_t v = i * kCodeBlock; v < (i + 1) * kCodeBlock; ++v) {
			if (!(code[v] & Used)) continue;
			const vcg::Point3d p = PointOf(m.vert[v]), q = space.toLabel(p);
			sheet.vertices.push_back({{p, q, space.project(q)}, int(v)});
			for (int k = 0; k < 3; ++k) sheet.largestCoordinate = std::max(sheet.largestCoordinate, std::abs(p[k]));
		}
	}
	const auto renumber = [&](int& v) {
		const size_t index = size_t(v), first = index / kCodeBlock * kCodeBlock;
		v = before[index / kCodeBlock];
		for (size_t i = first; i < index; ++i) v += code[i] / Used;
	};
	for (SheetTriangle& t : sheet.triangles)
		for (int& v : t.vertex) renumber(v);
	for (StraddlingTriangle& t : sheet.straddling) {
		t.inSheet = t.vertex;
		for (int& v : t.inSheet) renumber(v);
	}
}

/// Mesh units: the median of the longest sides of some faces, spread evenly over the mesh; 0 without faces.
template <class MeshType>
double UsualEdge(const MeshType& m)
{
	constexpr size_t most = 64;
	std::array<double, most> longest;
	size_t count = 0;
	for (size_t i = 0; i < most && i < m.face.size(); ++i) {
		const auto& f = m.face[m.face.size() * i / std::min(most, m.face.size())];
		if (f.IsD()) continue;
		const vcg::Point3d a = PointOf(*f.cV(0)), b = PointOf(*f.cV(1)), c = PointOf(*f.cV(2));
		const double length = std::max({(b - a).Norm(), (c - b).Norm(), (a - c).Norm()});
		if (std::isfinite(length)) longest[count++] = length;
	}
	if (count == 0) return 0;
	const auto median = longest.begin() + std::ptrdiff_t(count / 2);
	std::nth_element(longest.begin(), median, longest.begin() + std::ptrdiff_t(count));
	return *median;
}

}  // namespace detail

/// Collect the triangles whose projection meets a box of the label plane; one linear pass over vertices and faces.
/// @param[in] depth  world units: of those that show their backs, what lies whole further behind all that face the viewer is left
///                   out; the underside of a part is of no interest to a label on its top
/// @return candidates in order of their face index; triangles with a vertex that is not finite or lies behind the centre
///         of projection are left out, of a wrapped label those that can't be unrolled whole
template <class MeshType>
Sheet CollectSheet(const MeshType& m, const LabelSpace& space, const PlaneBox& box,
                   double depth = std::numeric_limits<double>::infinity())
{
	constexpr double triangles = 2, ofBox = 0.5;  // how much wider: more than most triangles reach out of the box
	Sheet sheet;
	sheet.box = sheet.around = box;
	sheet.around.grow(
		std::min(triangles * space.scale() * detail::UsualEdge(m), ofBox * std::min(box.width(), box.height())));
	if (space.wraps()) {  // what lies over the cut has no side
		const PlaneBox way = space.unrolledBox(sheet.around);
		if (!(way.low[0] > space.cutAt(-1) && way.high[0] < space.cutAt(1))) sheet.around = box;
	}
	sheet.mayFlip = !vcg::tri::HasPerWedgeTexCoord(m);
	std::vector<std::uint8_t> code = detail::CodeVertices(m, space, sheet.around);
	detail::CollectTriangles(m, space, depth, code, sheet);
	detail::CollectVertices(m, space, code, sheet);
	detail::LinkTriangles(sheet);
	return sheet;
}

/// Whether a length is larger than the part: than the diagonal of the box of all its finite vertices, along the label's axes.
/// That of the candidates decides for all lengths that make sense; only what exceeds it costs a pass over the mesh.
/// @param[in] length  world units
/// @param[out] diagonal  world units, when true
template <class MeshType>
bool ExceedsPart(const MeshType& m, const LabelSpace& space, const Sheet& sheet, double length, double& diagonal)
{
	vcg::Box3d box;
	for (const SheetVertex& v : sheet.vertices) box.Add(v.label);
	if (!box.IsNull() && length <= box.Diag()) return false;
	for (size_t v = 0; v < m.vert.size(); ++v) {
		const vcg::Point3d q = space.toLabel(PointOf(m.vert[v]));
		if (!m.vert[v].IsD() && IsFinite(q)) box.Add(q);
	}
	diagonal = box.IsNull() ? 0 : box.Diag();
	return length > diagonal;
}

}  // namespace vcg::textlabel
