#pragma once
// What the pieces of a cut triangle could meet beside the box that the candidates were collected for.
//
// A triangle that a contour cuts may reach far out of that box. Its pieces do as well, and as their corners are rounded they leave its
// plane by a step of the coordinates. Where the part comes as close to itself as that, a fold that is nearly shut or another piece
// that lies on this one, a piece may cross a face that is no candidate. So these are looked for: among the faces beside the box that
// the pass over the mesh has noted, or, where a triangle reaches further, in one more pass.

#include "patch_check.h"

#include <functional>

namespace vcg::textlabel {

/// A face of the mesh that is no candidate, and a triangle that reaches out of the box to it.
struct DistantFace {
	int face;      ///< index in the mesh
	int triangle;  ///< in the sheet
	Corners mesh;  ///< the face's corners, mesh coordinates
};

/// The triangles of a patch that reach out of the sheet's box.
class Overhang {
public:
	/// @param[in] precision  on which coordinates the patch is checked
	Overhang(const Sheet& sheet, const LabelPatch& patch, const Precision& precision);

	bool isEmpty() const { return box_.isEmpty(); }
	/// Whether they stay within a box of the label plane.
	bool isWithin(const PlaneBox& box) const { return box.holds(plane_); }
	/// Call use(triangle) for each of them to which a face may come as close as coordinates are apart, once or twice.
	template <class Use>
	void eachNear(const Corners& face, Use&& use) const;

private:
	struct Triangle {
		int number;  ///< in the sheet
		SearchBox box;
		Corners corner;
		vcg::Point3d normal,
			outward[3];  ///< unit vectors: across the plane; in it, across the side from corner k to k+1
		double bend;     ///< how far rounding leads them astray, of a length
	};
	struct Side {
		SearchBox box;                    ///< of all
		std::vector<Triangle> triangles;  ///< in the order in which they begin along the axis
		size_t axis = 0;                  ///< along which the box is longest
		double length = 0;                ///< of the longest triangle along it
	};
	static double LargestIn(const SearchBox& box)
	{
		double largest = 0;
		for (size_t k = 0; k < 3; ++k) largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
		return largest;
	}
	double slackAt(double largest) const
	{
		constexpr double steps = 4;
		return std::max(steps * precision_.ulp(largest), kFarAboveRounding * largest);
	}

	Precision precision_;
	std::array<Side, 4> sides_;  ///< those that reach out to the left, the right, below, above
	PlaneBox plane_;             ///< of all, in the label plane
	SearchBox box_;              ///< of all
	double slack_ = 0;           ///< mesh units: more than a piece leaves its triangle
};

/// Finds the faces of a mesh that are no candidates and near an overhang.
using FindDistant = std::function<std::vector<DistantFace>(const Overhang&)>;

/// What FindDistant is for a mesh and the candidates collected from it: ascending.
template <class MeshType>
std::vector<DistantFace> FacesNear(const MeshType& m, const Sheet& sheet, const Overhang& overhang);

/// Check the pieces that reach out of the box against faces that are no candidates.
/// @param[in] position  as RoundedPositions gives them
/// @return Sound, or CrossesPart
PatchVerdict CheckOverhang(const Sheet& sheet, const LabelPatch& patch, const std::vector<vcg::Point3d>& position,
                           const Precision& precision, const FindDistant& find);

// ---------------------------------------------------------------------------------------------------------------------------

inline Overhang::Overhang(const Sheet& sheet, const LabelPatch& patch, const Precision& precision)
	: precision_(precision)
{
	double largest = 0;
	for (const int t : patch.removed) {
		const auto& v = sheet.triangles[size_t(t)].vertex;
		PlaneBox seen;
		for (const int i : v) seen.add(sheet.plane(i));
		if (sheet.box.holds(seen)) continue;
		const auto at = [&](size_t k) { return sheet.vertices[size_t(v[k])].mesh; };
		Triangle triangle{t, {}, {at(0), at(1), at(2)}, {}, {}, 0};
		triangle.box = detail::BoxOf(triangle.corner);
		const auto side = [&](size_t k) { return at((k + 1) % 3) - at(k); };
		const vcg::Point3d normal = side(0) ^ side(1);
		const double longest = std::max({side(0).SquaredNorm(), side(1).SquaredNorm(), side(2).SquaredNorm()});
		triangle.normal = normal / normal.Norm();
		triangle.bend = kFarAboveRounding * longest / normal.Norm();
		for (size_t k = 0; k < 3; ++k) {
			const vcg::Point3d outward = side(k) ^ triangle.normal;
			triangle.outward[k] = outward / outward.Norm();
		}
		plane_.add(seen.low);
		plane_.add(seen.high);
		const bool isBeside[] = {seen.low[0]<sheet.box.low[0], seen.high[0]> sheet.box.high[0],
		                         seen.low[1]<sheet.box.low[1], seen.high[1]> sheet.box.high[1]};
		for (size_t i = 0; i < sides_.size(); ++i) {
			if (!isBeside[i]) continue;
			sides_[i].box.add(triangle.box);
			sides_[i].triangles.push_back(triangle);
		}
		largest = std::max(largest, LargestIn(triangle.box));
	}
	for (Side& side : sides_) {
		const auto extent = [](const SearchBox& box, size_t k) { return box.high[k] - box.low[k]; };
		for (size_t k = 1; k < 3; ++k)
			if (extent(side.box, k) > extent(side.box, side.axis)) side.axis = k;
		std::sort(side.triangles.begin(), side.triangles.end(),
		          [&](const Triangle& a, const Triangle& b) { return a.box.low[side.axis] < b.box.low[side.axis]; });
		for (const Triangle& t : side.triangles) side.length = std::max(side.length, extent(t.box, side.axis));
	}
	slack_ = slackAt(largest);
	for (const Side& side : sides_) box_.add(side.box);
}

template <class Use>
void Overhang::eachNear(const Corners& face, Use&& use) const
{
	const SearchBox stored = detail::BoxOf(face);
	if (stored.isEmpty()) return;
	// a face that is no candidate moves only where the file's coordinates are coarser than the mesh's
	const double slack = precision_.keepsStored() ? slack_ : std::max(slack_, slackAt(LargestIn(stored)));
	SearchBox box = stored;
	box.grow(slack);
	if (!box_.meets(box)) return;
	const auto isNear = [&](const Triangle& t) {
		if (!t.box.meets(box)) return false;
		const auto isBeyond = [&](const vcg::Point3d& corner, const vcg::Point3d& direction) {
			return std::all_of(face.begin(), face.end(), [&](const vcg::Point3d& p) {
				const vcg::Point3d d = p - corner;
				return d * direction > slack + d.Norm() * t.bend;  // false also where a triangle without area has none
			});
		};
		bool isApart = isBeyond(t.corner[0], t.normal) || isBeyond(t.corner[0], -t.normal);
		for (size_t k = 0; k < 3; ++k) isApart = isApart || isBeyond(t.corner[k], t.outward[k]);
		return !isApart;
	};
	for (const Side& side : sides_) {
		if (!side.box.meets(box)) continue;
		const auto begins = [&](const Triangle& t, double at) { return t.box.low[side.axis] < at; };
		auto t =
			std::lower_bound(side.triangles.begin(), side.triangles.end(), box.low[side.axis] - side.length, begins);
		for (; t != side.triangles.end() && t->box.low[side.axis] <= box.high[side.axis]; ++t)
			if (isNear(*t)) use(t->number);
	}
}

template <class MeshType>
std::vector<DistantFace> FacesNear(const MeshType& m, const Sheet& sheet, const Overhang& overhang)
{
	const auto look = [&](size_t f, std::vector<DistantFace>& found) {
		const Corners corners = {PointOf(*m.face[f].cV(0)), PointOf(*m.face[f].cV(1)), PointOf(*m.face[f].cV(2))};
		overhang.eachNear(corners, [&](int triangle) { found.push_back({int(f), triangle, corners}); });
	};
	std::vector<DistantFace> all;
	if (overhang.isWithin(sheet.around)) {
		for (const int f : sheet.besides) look(size_t(f), all);
		return all;
	}
	std::vector<std::vector<DistantFace>> found(ChunkCount(m.face.size()));
	EachChunk(m.face.size(), found.size(), [&](size_t chunk, size_t first, size_t last) {
		const auto isBefore = [](const SheetTriangle& t, size_t face) { return size_t(t.face) < face; };
		auto candidate = std::lower_bound(sheet.triangles.begin(), sheet.triangles.end(), first, isBefore);
		for (size_t f = first; f < last; ++f) {
			const bool isCandidate = candidate != sheet.triangles.end() && size_t(candidate->face) == f;
			if (isCandidate) ++candidate;
			else if (!m.face[f].IsD()) look(f, found[chunk]);
		}
	});
	for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
	return all;
}

inline PatchVerdict CheckOverhang(const Sheet& sheet, const LabelPatch& patch,
                                  const std::vector<vcg::Point3d>& position, const Precision& precision,
                                  const FindDistant& find)
{
	const Overhang overhang(sheet, patch, precision);
	if (overhang.isEmpty()) return {};
	const std::vector<DistantFace> distant = find(overhang);
	if (distant.empty()) return {};
	std::vector<int> listOf(sheet.triangles.size(), -1);  // of the triangles that come near a face
	std::vector<std::vector<Corners>> pieces;
	for (const DistantFace& f : distant)
		if (int& list = listOf[size_t(f.triangle)]; list < 0) {
			list = int(pieces.size());
			pieces.emplace_back();
		}
	const auto isOutside = [&](int v) { return v < int(sheet.vertices.size()) && !sheet.box.holds(sheet.plane(v)); };
	for (const PatchFace& f : patch.faces)
		if (const int list = listOf[size_t(f.parent)];
		    list >= 0 && std::any_of(f.vertex.begin(), f.vertex.end(), isOutside))
			pieces[size_t(list)].push_back(detail::CornersOf(position, f.vertex));
	for (const DistantFace& f : distant) {
		Corners face = f.mesh;
		for (vcg::Point3d& p : face)
			for (int k = 0; k < 3; ++k) p[k] = precision.round(p[k]);
		const auto& v = sheet.triangles[size_t(f.triangle)].vertex;
		const auto before = [&](size_t k) { return sheet.vertices[size_t(v[k])].mesh; };
		for (const Corners& piece : pieces[size_t(listOf[size_t(f.triangle)])]) {
			if (!IsCrossing(ContactOf(piece, face))) continue;
			if (IsCrossing(ContactOf({before(0), before(1), before(2)}, f.mesh))) break;  // not the label's fault
			return {PatchFault::CrossesPart, piece[0], f.face};
		}
	}
	return {};
}

}  // namespace vcg::textlabel
