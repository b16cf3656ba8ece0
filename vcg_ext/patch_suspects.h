#pragma once
// Which faces of a patch could cross anything once rounded, told without looking at pairs.
//
// A label that is flat, or raised along the rays, is simple when seen from its viewpoint: its faces in the surface and its tops are
// the triangles of a planar map, its walls are the map's contours. Put the viewpoint at infinity (a projective map, which keeps
// planes planes) and write p for the place in the label plane, z for the height. Let `lean` bound how far rounding has moved a
// raised vertex in p from the one it stands over, `rise` the least height of a wall, and `slope` that of the faces. Then two faces
// can't meet in more than they share when
//  - every face of the map is counter-clockwise, on the ground and raised: with an unchanged border it overlaps nothing in p;
//  - its altitudes exceed 8 lean: what shares no vertex with a contour is further from it than any wall leans;
//  - slope * lean is small against rise, and no angle so small that a wall could lean over a neighbour before it is higher.
// Faces for which one of these fails are *suspects*, together with all that share a vertex with them; so are the walls on a contour
// vertex that is a vertex of the mesh, whose neighbours are not all in the patch. Suspects go to the exact search, the rest needs
// none. For the surface around the patch the same is known from its layer (sheet_layer.h), or pair by pair.
// Of a label raised otherwise, or that rises too little, the map of the ground still tells that what stays in the surface does not
// cross itself; all walls and tops are suspects then.

#include "label_clearance.h"
#include "label_raise.h"
#include "rounding.h"

#include <numeric>

namespace vcg::textlabel {

/// What an exact search must look at.
struct Suspects {
	bool all = true;                        ///< nothing can be told: every face, every pair
	std::vector<char> face;                 ///< #LabelPatch::faces: 1 when suspect
	std::vector<std::array<int, 2>> pairs;  ///< changed sheet triangle, other sheet triangle that may meet its pieces

	bool none() const { return !all && pairs.empty() && std::count(face.begin(), face.end(), 1) == 0; }
};

/// Find what could cross in a patch.
/// @pre the label is not wrapped
/// @param[in] onRays  whatever is raised stays on its ray
/// @param[in] position  mesh coordinates as they will be read back: the sheet's vertices, then the patch's
/// @param[in] height  world units
/// @param[in] resolution  world units: more than a coordinate moves when it is rounded
Suspects FindSuspects(const LabelSpace& space, const Sheet& sheet, const SheetLayer& layer, const LabelPatch& patch,
                      const std::vector<vcg::Point3d>& position, bool onRays, double height, double resolution);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// A patch seen from infinity: each vertex of the ground, and where it was raised to.
class PlanarMap {
public:
	/// @param[in] rises  false: of the ground alone, as if nothing was raised over it
	PlanarMap(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch,
	          const std::vector<vcg::Point3d>& position, bool rises, double slack);

	/// Whether every face is counter-clockwise, and walls rise enough to say anything.
	bool isSound() const { return isSound_; }
	/// #faces: 1 for each suspect.
	std::vector<char> suspects() const;

private:
	/// (p, z): label plane and height.
	vcg::Point3d seen(const vcg::Point3d& mesh) const
	{
		const vcg::Point3d q = space_.toLabel(mesh);
		return withHeight(space_.project(q), q);
	}
	vcg::Point3d withHeight(const vcg::Point2d& p, const vcg::Point3d& q) const
	{
		return {p[0], p[1], q[2] * space_.magnification(q)};
	}
	int groundOf(int vertex) const
	{
		if (vertex < old_) return vertex;
		const int ground = patch_.vertices[size_t(vertex - old_)].ground;
		return ground < 0 ? vertex : ground;
	}
	const vcg::Point3d& raised(size_t ground) const { return place_[size_t(raisedTo_[ground])]; }
	void measureRise();
	void measureFaces();

	struct Measure {
		// a margin covers their rounding
		float altitude, sine, slope;  ///< least altitude, sine of the least angle, steepness
	};

	const LabelSpace& space_;
	const LabelPatch& patch_;
	bool rises_;
	int old_;
	double slack_, lean_ = 0, rise_ = std::numeric_limits<double>::infinity();
	bool isSound_ = true;
	std::vector<vcg::Point3d>
		place_;  ///< #vertices as in PatchFace, of the moved ones the ground; then where these were moved to
	std::vector<int> raisedTo_;        ///< #vertices: index into place_ of what stands over it, or its own
	std::vector<char> isMeshContour_;  ///< #vertices
	std::vector<Measure> measure_;     ///< of the faces that are no walls, in their order
};

inline PlanarMap::PlanarMap(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch,
                            const std::vector<vcg::Point3d>& position, bool rises, double slack)
	: space_(space), patch_(patch), rises_(rises && !patch.isFlat), old_(int(sheet.vertices.size())), slack_(slack),
	  raisedTo_(position.size()), isMeshContour_(position.size(), 0)
{
	place_.reserve(position.size() + patch.moved.size());
	for (const SheetVertex& v : sheet.vertices) place_.push_back(withHeight(v.plane, v.label));
	for (size_t v = size_t(old_); v < position.size(); ++v) place_.push_back(seen(position[v]));
	std::iota(raisedTo_.begin(), raisedTo_.end(), 0);
	for (const auto& moved : patch.moved) {
		if (!rises_) break;
		raisedTo_[size_t(moved.first)] = int(place_.size());
		place_.push_back(seen(position[size_t(moved.first)]));
	}
	for (size_t v = size_t(old_); v < position.size(); ++v) {
		const int ground = patch.vertices[v - size_t(old_)].ground;
		if (ground < 0 || !rises_) continue;
		raisedTo_[size_t(ground)] = int(v);
		isMeshContour_[size_t(ground)] = ground < old_;
	}
	for (const vcg::Point3d& p : place_)  // far from the origin of the plane, doubles are coarser
		slack_ = std::max(slack_, kFarAboveRounding * std::max(std::abs(p[0]), std::abs(p[1])));
	measureRise();
	measureFaces();
}

inline void PlanarMap::measureRise()
{
	for (size_t v = 0; v < raisedTo_.size(); ++v) {
		if (raisedTo_[v] == int(v)) continue;
		const vcg::Point3d d = raised(v) - place_[v];
		lean_ = std::max({lean_, std::abs(d[0]), std::abs(d[1])});
		rise_ = std::min(rise_, std::abs(d[2]));
	}
	lean_ = 2 * lean_ + slack_;  // of the two axes together, and of the arithmetic
	constexpr double leastRatio = 64;
	if (rises_) isSound_ = rise_ > leastRatio * lean_;
}

inline void PlanarMap::measureFaces()
{
	const auto isNoWall = [](const PatchFace& face) { return face.kind != FaceKind::Wall; };
	measure_.reserve(size_t(std::count_if(patch_.faces.begin(), patch_.faces.end(), isNoWall)));
	const auto area = [](const vcg::Point3d& a, const vcg::Point3d& b, const vcg::Point3d& c) {
		return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
	};
	for (size_t f = 0; f < patch_.faces.size() && isSound_; ++f) {
		const PatchFace& face = patch_.faces[f];
		if (!isNoWall(face)) continue;
		size_t v[3];
		for (size_t k = 0; k < 3; ++k) v[k] = size_t(groundOf(face.vertex[k]));
		const vcg::Point3d &a = place_[v[0]], &b = place_[v[1]], &c = place_[v[2]];
		const vcg::Point3d &ra = raised(v[0]), &rb = raised(v[1]), &rc = raised(v[2]);
		const vcg::Point3d ab = b - a, bc = c - b, ca = a - c;
		const auto squared = [](const vcg::Point3d& d) { return d[0] * d[0] + d[1] * d[1]; };
		const double x = squared(ab), y = squared(bc), z = squared(ca), xy = std::max(x, y);
		const double longest = std::sqrt(std::max(xy, z)),
					 middle = std::sqrt(std::max(std::min(x, y), std::min(xy, z)));
		const double twice = area(a, b, c), above = area(ra, rb, rc);
		const double error = slack_ * longest;
		isSound_ = twice > error && above > error;
		const vcg::Point3d n = face.kind == FaceKind::Top ? (rb - ra) ^ (rc - ra) : ab ^ (c - a);
		measure_.push_back({float(twice / longest), float(twice / (longest * middle)),
		                    float(std::max(std::abs(n[0]), std::abs(n[1])) * 2 / std::abs(n[2]))});
	}
}

inline std::vector<char> PlanarMap::suspects() const
{
	constexpr double apart = 8, sharp = 8;  // of the bounds above, a little more than the proof needs
	const double ratio = rises_ ? rise_ / lean_ : 1, steepest = std::sqrt(ratio) / apart;
	double slope = 0;
	for (const Measure& m : measure_) slope = std::max(slope, double(m.slope));
	slope = std::min(slope, steepest);
	std::vector<char> suspect(patch_.faces.size(), 0), loose(isMeshContour_);
	if (!rises_ && !patch_.isFlat)
		for (size_t f = 0; f < suspect.size(); ++f) suspect[f] = patch_.faces[f].kind != FaceKind::Outside;
	bool any = std::count(loose.begin(), loose.end(), 1) > 0;
	auto measure = measure_.begin();
	for (size_t f = 0; f < suspect.size(); ++f) {
		if (patch_.faces[f].kind == FaceKind::Wall) continue;
		const Measure& m = *measure++;
		const bool isGood = m.altitude > apart * (rises_ ? lean_ : slack_) &&
		                    (!rises_ || (m.slope <= steepest && m.sine * ratio > sharp * slope));
		if (isGood) continue;
		any = true;
		for (const int v : patch_.faces[f].vertex) loose[size_t(groundOf(v))] = 1;
	}
	if (!any) return suspect;
	for (size_t f = 0; f < suspect.size(); ++f)
		for (const int v : patch_.faces[f].vertex)
			if (loose[size_t(groundOf(v))]) suspect[f] = 1;
	return suspect;
}

/// Whether two candidates have no more in common in the label plane than corners that they share, for certain.
/// @param[in] slack  label units: what rounding may move; apart is what is further apart
inline bool ArePlainlyApart(const Sheet& sheet, int first, int second, double slack)
{
	const auto keepsOut = [&](int s, int t) {
		const SheetTriangle &a = sheet.triangles[size_t(s)], &b = sheet.triangles[size_t(t)];
		for (size_t k = 0; k < 3; ++k) {
			const int from = a.vertex[k], to = a.vertex[(k + 1) % 3];
			const vcg::Point2d &start = sheet.plane(from), &end = sheet.plane(to), edge = end - start;
			const double least = slack * edge.Norm();
			const auto isBeyond = [&](int v) {
				const vcg::Point2d& p = sheet.plane(v);
				return v == from || v == to ||
				       (Orient2d(start, end, p) * (a.facing ? 1 : -1) < 0 && std::abs(edge ^ (p - start)) > least);
			};
			if (std::all_of(b.vertex.begin(), b.vertex.end(), isBeyond)) return true;
		}
		return false;
	};
	return keepsOut(first, second) || keepsOut(second, first);
}

/// Some candidates, to be searched by place.
struct TriangleGroup {
	std::vector<int> triangle;
	std::unique_ptr<PlaneGrid> grid;  // most labels need none

	template <class Use>
	void query(const Sheet& sheet, const PlaneTriangle& around, double reach, Use&& use,
	           const SheetLayer* without = nullptr)
	{
		if (triangle.empty()) return;
		if (!grid) {
			std::vector<PlaneTriangle> corners;
			corners.reserve(triangle.size());
			for (const int t : triangle) corners.push_back(CornersInPlane(sheet, t));
			grid = std::make_unique<PlaneGrid>(corners);
		}
		grid->query(
			around, reach, [&](int i) { use(triangle[size_t(i)]); },
			[&](const PlaneBox& box) { return without && without->holds(box); });
	}
};

/// Pairs of a changed triangle and another candidate that neither the layer, nor their depth, nor the plane keeps apart.
inline std::vector<std::array<int, 2>> FindNearPairs(const Sheet& sheet, const SheetLayer& layer,
                                                     const std::vector<int>& changed, double sunk, double slack)
{
	TriangleGroup inside, rim;  // members; inside are those that the layer keeps apart from all members
	TriangleGroup strangers;
	const auto farthest = [&](int t) {
		const auto& v = sheet.triangles[size_t(t)].vertex;
		const auto z = [&](size_t k) { return sheet.vertices[size_t(v[k])].label[2]; };
		return std::min({z(0), z(1), z(2)}) - sunk - slack;
	};
	double deepest = std::numeric_limits<double>::infinity();
	for (const int t : changed) {
		const bool isInside = layer.has(t) && layer.holds(BoxOfTriangle(CornersInPlane(sheet, t)));
		(isInside ? inside : layer.has(t) ? rim : strangers).triangle.push_back(t);
		deepest = std::min(deepest, farthest(t));
	}
	std::vector<std::array<int, 2>> pairs;
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		const double nearest = NearestZ(sheet, t);
		if (nearest < deepest) continue;
		const PlaneTriangle corners = CornersInPlane(sheet, t);
		const auto judge = [&](int other) {
			if (other == t || nearest < farthest(other)) return;
			if (!ArePlainlyApart(sheet, other, t, slack)) pairs.push_back({other, t});
		};
		strangers.query(sheet, corners, slack, judge);
		if (!layer.has(t)) {
			rim.query(sheet, corners, slack, judge);
			inside.query(sheet, corners, slack, judge);
		} else if (!layer.holds(BoxOfTriangle(corners))) {
			rim.query(sheet, corners, slack, judge, &layer);
		}
	}
	return pairs;
}

}  // namespace detail

inline Suspects FindSuspects(const LabelSpace& space, const Sheet& sheet, const SheetLayer& layer,
                             const LabelPatch& patch, const std::vector<vcg::Point3d>& position, bool onRays,
                             double height, double resolution)
{
	constexpr double arithmetic = 1e-3;  // of the resolution: far more than what doubles lose
	Suspects suspects;
	if (!sheet.straddling.empty()) return suspects;  // not seen as a whole
	for (const int t : patch.removed)
		if (!sheet.triangles[size_t(t)].facing) return suspects;
	for (const bool rises : {true, false}) {
		if (rises ? !onRays : onRays && patch.isFlat) continue;  // the map of what is flat is that of the ground
		const detail::PlanarMap map(space, sheet, patch, position, rises, arithmetic * resolution);
		if (!map.isSound()) continue;
		const double sunk = rises ? std::max(-height, 0.0) : 0;
		auto pairs = detail::FindNearPairs(sheet, layer, patch.removed, sunk, resolution);
		if (pairs.size() > patch.faces.size()) continue;
		suspects.pairs = std::move(pairs);
		suspects.face = map.suspects();
		suspects.all = false;
		break;
	}
	return suspects;
}

}  // namespace vcg::textlabel
