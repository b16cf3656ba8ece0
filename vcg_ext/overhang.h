#pragma once
// What the pieces of a cut triangle could meet beside the box that the candidates were collected for.
//
// A triangle that a contour cuts may reach far out of that box. Its pieces do as well, and as their corners are rounded they leave its
// plane by a step of the coordinates. Where the part comes as close to itself as that, a fold that is nearly shut or another piece
// that lies on this one, a piece may cross a face that is no candidate. So these are looked for: among the faces around the box that
// the pass over the mesh has noted, or, where a triangle reaches further, in one more pass. It is made again only when other triangles
// are cut; neither the height nor a shift by some steps changes what is near.

#include "parallel_chunks.h"
#include "patch_check.h"

#include <functional>

namespace vcg::textlabel {

/// A face of the mesh that is no candidate.
struct DistantFace {
	int face;      ///< index in the mesh
	Corners mesh;  ///< mesh coordinates
};

/// The triangles of a patch that reach out of the sheet's box.
class Overhang {
public:
	/// @param[in] removed  sheet triangles, ascending
	/// @param[in] precision  the coarsest coordinates on which the patch is checked
	/// @param[in] margin  label units: what is nearer to the border of a box than that counts as beyond it
	Overhang(const Sheet& sheet, const std::vector<int>& removed, const Precision& precision, double margin);

	/// Which they are, in the sheet; ascending.
	const std::vector<int>& triangles() const { return numbers_; }
	/// Whether a point of the label plane is beyond the sheet's box.
	bool isBeyond(const vcg::Point2d& p) const { return !inside_.holds(p); }
	/// Whether they all stay within another box.
	bool isWithin(PlaneBox box) const
	{
		box.grow(-margin_);
		return box.holds(plane_);
	}
	/// Whether a face may come as close to one of them as coordinates are apart.
	bool isNear(const Corners& face) const;

private:
	struct Triangle {
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
	/// A few steps of coordinates up to this one; asked for each face, so without a look at its digits.
	double slackAt(double largest) const { return leastSlack_ + relativeSlack_ * largest; }
	static Triangle Measured(const Corners& corner);

	double leastSlack_, relativeSlack_;
	bool keepsStored_;
	double margin_;
	PlaneBox inside_;  ///< the sheet's box without the margin
	std::vector<int> numbers_;
	std::array<Side, 4> sides_;  ///< those that reach out to the left, the right, below, above
	PlaneBox plane_;             ///< of all, in the label plane
	SearchBox box_;              ///< of all
	double slack_ = 0;           ///< mesh units: more than a piece leaves its triangle
};

/// Gives the faces of a mesh that are no candidates and near an overhang, ascending.
using FindDistant = std::function<const std::vector<DistantFace>&(const Overhang&)>;

/// FindDistant for a mesh and the candidates collected from it.
template <class MeshType>
class DistantFinder {
public:
	/// @param[in] m, sheet  kept by reference
	DistantFinder(const MeshType& m, const Sheet& sheet) : m_(m), sheet_(sheet) {}

	const std::vector<DistantFace>& operator()(const Overhang& overhang)
	{
		if (triangles_ != overhang.triangles() || flips_ != sheet_.flipped.size()) {
			faces_ = overhang.isWithin(sheet_.around) ? among(sheet_.besides, overhang) : amongAll(overhang);
			triangles_ = overhang.triangles();
			flips_ = sheet_.flipped.size();
		}
		return faces_;
	}

private:
	void look(size_t face, const Overhang& overhang, std::vector<DistantFace>& found) const
	{
		const auto at = [&](int k) { return PointOf(*m_.face[face].cV(k)); };
		const Corners corners = {at(0), at(1), at(2)};
		if (overhang.isNear(corners)) found.push_back({int(face), corners});
	}
	std::vector<DistantFace> among(const std::vector<int>& faces, const Overhang& overhang) const
	{
		std::vector<DistantFace> found;
		for (const int f : faces) look(size_t(f), overhang, found);
		return found;
	}
	std::vector<DistantFace> amongAll(const Overhang& overhang) const;

	const MeshType& m_;
	const Sheet& sheet_;
	std::vector<int> triangles_;      ///< the overhang that was asked for last
	size_t flips_ = 0;                ///< and how many triangles had been flipped then
	std::vector<DistantFace> faces_;  ///< near that
};

/// Check the pieces that reach out of the box against faces that are no candidates.
/// @param[in] position  as RoundedPositions gives them
/// @param[in] precision  how they were rounded
/// @return Sound, or SpoilsBeside
PatchVerdict CheckOverhang(const Sheet& sheet, const LabelPatch& patch, const std::vector<vcg::Point3d>& position,
                           const Precision& precision, const Overhang& overhang,
                           const std::vector<DistantFace>& distant);

// ---------------------------------------------------------------------------------------------------------------------------

inline Overhang::Triangle Overhang::Measured(const Corners& corner)
{
	Triangle t{detail::BoxOf(corner), corner, {}, {}, 0};
	const auto side = [&](size_t k) { return corner[(k + 1) % 3] - corner[k]; };
	const vcg::Point3d normal = side(0) ^ side(1);
	t.normal = normal / normal.Norm();
	t.bend = kFarAboveRounding * std::max({side(0).SquaredNorm(), side(1).SquaredNorm(), side(2).SquaredNorm()}) /
	         normal.Norm();
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point3d outward = side(k) ^ t.normal;
		t.outward[k] = outward / outward.Norm();
	}
	return t;
}

inline Overhang::Overhang(const Sheet& sheet, const std::vector<int>& removed, const Precision& precision,
                          double margin)
	: keepsStored_(precision.keepsStored()), margin_(margin), inside_(sheet.box)
{
	constexpr double steps = 16;
	const bool hasDecimals = precision.fileDigits < 0;  // the same step for numbers of all sizes
	const Precision relative{precision.isFloat, precision.storesDouble, hasDecimals ? 0 : precision.fileDigits};
	leastSlack_ = steps * precision.ulp(0);
	relativeSlack_ = std::max(steps * relative.ulp(1), kFarAboveRounding);
	slack_ = slackAt(sheet.largestCoordinate);
	inside_.grow(-margin);
	for (const int t : removed) {
		const auto& v = sheet.triangles[size_t(t)].vertex;
		PlaneBox seen;
		for (const int i : v) seen.add(sheet.plane(i));
		if (inside_.holds(seen)) continue;
		const auto at = [&](size_t k) { return sheet.vertices[size_t(v[k])].mesh; };
		const Triangle triangle = Measured({at(0), at(1), at(2)});
		const bool reachesOut[] = {(seen.low[0] < inside_.low[0]), (seen.high[0] > inside_.high[0]),
		                           (seen.low[1] < inside_.low[1]), (seen.high[1] > inside_.high[1])};
		for (size_t i = 0; i < sides_.size(); ++i) {
			if (!reachesOut[i]) continue;
			sides_[i].box.add(triangle.box);
			sides_[i].triangles.push_back(triangle);
		}
		numbers_.push_back(t);
		plane_.add(seen.low);
		plane_.add(seen.high);
		box_.add(triangle.box);
	}
	for (Side& side : sides_) {
		const auto extent = [](const SearchBox& box, size_t k) { return box.high[k] - box.low[k]; };
		for (size_t k = 1; k < 3; ++k)
			if (extent(side.box, k) > extent(side.box, side.axis)) side.axis = k;
		std::sort(side.triangles.begin(), side.triangles.end(),
		          [&](const Triangle& a, const Triangle& b) { return a.box.low[side.axis] < b.box.low[side.axis]; });
		for (const Triangle& t : side.triangles) side.length = std::max(side.length, extent(t.box, side.axis));
	}
}

inline bool Overhang::isNear(const Corners& face) const
{
	SearchBox box = detail::BoxOf(face);
	if (box.isEmpty()) return false;
	double slack = slack_;
	for (size_t k = 0; k < 3 && !keepsStored_; ++k)  // then, faces move too when they are rounded
		slack = std::max({slack, slackAt(std::abs(box.low[k])), slackAt(std::abs(box.high[k]))});
	box.grow(slack);
	if (!box_.meets(box)) return false;
	const auto isNearTo = [&](const Triangle& t) {
		if (!t.box.meets(box)) return false;
		const auto areAllBeyond = [&](const vcg::Point3d& corner, const vcg::Point3d& direction) {
			return std::all_of(face.begin(), face.end(), [&](const vcg::Point3d& p) {
				const vcg::Point3d d = p - corner;
				return d * direction > slack + d.Norm() * t.bend;  // false also where a triangle without area has none
			});
		};
		bool isApart = areAllBeyond(t.corner[0], t.normal) || areAllBeyond(t.corner[0], -t.normal);
		for (size_t k = 0; k < 3; ++k) isApart = isApart || areAllBeyond(t.corner[k], t.outward[k]);
		return !isApart;
	};
	for (const Side& side : sides_) {
		if (!side.box.meets(box)) continue;
		const auto beginsBefore = [&](const Triangle& t, double at) { return t.box.low[side.axis] < at; };
		auto t = std::lower_bound(side.triangles.begin(), side.triangles.end(), box.low[side.axis] - side.length,
		                          beginsBefore);
		for (; t != side.triangles.end() && t->box.low[side.axis] <= box.high[side.axis]; ++t)
			if (isNearTo(*t)) return true;
	}
	return false;
}

template <class MeshType>
std::vector<DistantFace> DistantFinder<MeshType>::amongAll(const Overhang& overhang) const
{
	std::vector<std::vector<DistantFace>> found(ChunkCount(m_.face.size()));
	EachChunk(m_.face.size(), found.size(), [&](size_t chunk, size_t first, size_t last) {
		const auto isBefore = [](const SheetTriangle& t, size_t face) { return size_t(t.face) < face; };
		auto candidate = std::lower_bound(sheet_.triangles.begin(), sheet_.triangles.end(), first, isBefore);
		for (size_t f = first; f < last; ++f) {
			const bool isCandidate = candidate != sheet_.triangles.end() && size_t(candidate->face) == f;
			if (isCandidate) ++candidate;
			else if (!m_.face[f].IsD()) look(f, overhang, found[chunk]);
		}
	});
	std::vector<DistantFace> all;
	for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
	return all;
}

inline PatchVerdict CheckOverhang(const Sheet& sheet, const LabelPatch& patch,
                                  const std::vector<vcg::Point3d>& position, const Precision& precision,
                                  const Overhang& overhang, const std::vector<DistantFace>& distant)
{
	if (distant.empty()) return {};
	std::vector<Corners> faces, pieces;
	for (const DistantFace& f : distant) {
		faces.push_back(f.mesh);
		for (vcg::Point3d& p : faces.back())
			for (int k = 0; k < 3; ++k) p[k] = precision.round(p[k]);
	}
	std::vector<char> reachesOut(sheet.triangles.size(), 0);
	for (const int t : overhang.triangles()) reachesOut[size_t(t)] = 1;
	const auto isBeyond = [&](int v) {  // new vertices are not
		return v < int(sheet.vertices.size()) && overhang.isBeyond(sheet.plane(v));
	};
	std::vector<int> parents;
	for (const PatchFace& f : patch.faces) {
		if (!reachesOut[size_t(f.parent)] || std::none_of(f.vertex.begin(), f.vertex.end(), isBeyond)) continue;
		pieces.push_back(detail::CornersOf(position, f.vertex));
		parents.push_back(f.parent);
	}
	CrossingOptions options;
	options.stopAtFirst = true;
	options.amongFaces = false;
	options.ignore = [&](int face, int piece, bool) {  // what crossed before is not the label's fault
		return sheet.anyBefore(parents[size_t(piece)], [&](const Corners& before) {
			return IsCrossing(ContactOf(before, distant[size_t(face)].mesh));
		});
	};
	for (const FacePair& pair : FindCrossings(faces, pieces, options))
		return {PatchFault::SpoilsBeside, pieces[size_t(pair.second)][0], distant[size_t(pair.first)].face};
	return {};
}

}  // namespace vcg::textlabel
