#pragma once
// The linear pass: the candidates of a label, collected from the mesh into a sheet.
//
// The triangles whose projection meets the label's box are taken, but for those that show their backs deeper than the label may reach;
// those beside the box are noted. No other step of a label looks at the whole mesh, but for growing its arrays (grow_mesh.h), for what
// is left of polygons (faux_edges.h), and where large triangles reach far out of the box (overhang.h).

#include "sheet.h"
#include "vertex_codes.h"

#include <cstring>
#include <vcg/complex/complex.h>

namespace vcg::textlabel {

namespace detail {

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
		std::min(triangles * space.scale() * detail::UsualEdge(m), ofBox * std::max(box.width(), box.height())));
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
