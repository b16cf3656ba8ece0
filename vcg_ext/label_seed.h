#pragma once
// Seeds: on which triangle a contour starts.
//
// The surface that takes a letter is the first one that the viewer sees at the start of its contour. One pass over the candidates
// finds it for all contours at once.

#include "surface_point.h"

namespace vcg::textlabel {

/// Find the first facing triangle under the first point of each contour.
/// @param[in] snap  label units: a triangle that comes this close holds the point
/// @return #contours sheet triangles
/// @throws Error{OffSurface, FacesAway, BehindCamera} with the letter and the place
std::vector<int> FindSeeds(const LabelSpace& space, const Sheet& sheet, const Outline& outline, double snap);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// The best hits of the ray through one contour point.
struct SeedHits {
	double facingDepth = -std::numeric_limits<double>::infinity(), backDepth = facingDepth;
	int facing = -1, back = -1;
};

/// How far p lies inside a triangle, in label units: its distance to the nearest side, negative outside. `turn` -1 when clockwise.
inline double Depth(const Sheet& sheet, const SheetTriangle& t, const vcg::Point2d& p, int turn)
{
	double least = std::numeric_limits<double>::infinity();
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point2d &a = sheet.plane(t.vertex[k]), d = sheet.plane(t.vertex[(k + 1) % 3]) - a;
		least = std::min(least, turn * (d ^ (p - a)) / d.Norm());
	}
	return least;
}

/// z in label space of a triangle's point under p, p drawn into the triangle.
inline double HeightUnder(const LabelSpace& space, const Sheet& sheet, int triangle, const vcg::Point2d& p)
{
	vcg::Point3d w = SpaceWeights(space, sheet, triangle, p);
	for (int k = 0; k < 3; ++k) w[k] = std::max(w[k], 0.0);
	w /= w[0] + w[1] + w[2];
	return MixCorners(sheet, triangle, w)[2];
}

inline void HitSeed(const LabelSpace& space, const Sheet& sheet, int triangle, const vcg::Point2d& p, double snap,
                    SeedHits& hits)
{
	const SheetTriangle& t = sheet.triangles[size_t(triangle)];
	const double depth = Depth(sheet, t, p, t.facing ? 1 : -1);
	if (!(depth >= (t.facing ? -snap : snap)))
		return;  // a back counts only when hit for certain; of one without area, its height is NaN
	const double z = HeightUnder(space, sheet, triangle, p);
	double& best = t.facing ? hits.facingDepth : hits.backDepth;
	if (!(z > best)) return;
	best = z;
	(t.facing ? hits.facing : hits.back) = triangle;
}

/// Whether a triangle that can't be unrolled crosses the axis, or the cut opposite to the label, at the height of p.
inline bool IsBesideTorn(const LabelSpace& space, const Sheet& sheet, const vcg::Point2d& p)
{
	const double height = space.alongAxis({p[0], p[1], 0});
	return std::any_of(sheet.straddling.begin(), sheet.straddling.end(), [&](const StraddlingTriangle& t) {
		const auto z = [&](size_t k) { return space.unrolled(t.mesh[k])[1]; };
		const auto [low, high] = std::minmax({z(0), z(1), z(2)});
		return low <= height && height <= high;
	});
}

/// Whether the ray through p meets a triangle that is left out because it reaches behind the centre of projection.
inline bool IsOnStraddling(const LabelSpace& space, const Sheet& sheet, const vcg::Point2d& p)
{
	if (space.wraps()) return IsBesideTorn(space, sheet, p);
	const vcg::Point3d c = space.center(), ray = vcg::Point3d(p[0], p[1], 0) - c;
	for (const StraddlingTriangle& t : sheet.straddling) {
		const auto& q = t.label;
		const double a = ray * ((q[0] - c) ^ (q[1] - c)), b = ray * ((q[1] - c) ^ (q[2] - c)),
					 d = ray * ((q[2] - c) ^ (q[0] - c));
		const bool through = (a >= 0 && b >= 0 && d >= 0) || (a <= 0 && b <= 0 && d <= 0);
		const vcg::Point3d normal = (q[1] - q[0]) ^ (q[2] - q[0]);
		if (through && (normal * (q[0] - c)) * (normal * ray) > 0) return true;
	}
	return false;
}

}  // namespace detail

inline std::vector<int> FindSeeds(const LabelSpace& space, const Sheet& sheet, const Outline& outline, double snap)
{
	struct Probe {
		vcg::Point2d p;
		int contour;
	};
	std::vector<Probe> probes;
	for (size_t c = 0; c < outline.contours.size(); ++c) probes.push_back({outline.contours[c].points[0], int(c)});
	std::sort(probes.begin(), probes.end(), [](const Probe& a, const Probe& b) { return a.p[0] < b.p[0]; });
	std::vector<detail::SeedHits> hits(probes.size());
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		PlaneBox box;
		for (const int v : sheet.triangles[size_t(t)].vertex) box.add(sheet.plane(v));
		box.grow(snap);
		const auto before = [](const Probe& a, double x) { return a.p[0] < x; };
		for (auto i = std::lower_bound(probes.begin(), probes.end(), box.low[0], before);
		     i != probes.end() && i->p[0] <= box.high[0]; ++i)
			if (i->p[1] >= box.low[1] && i->p[1] <= box.high[1])
				detail::HitSeed(space, sheet, t, i->p, snap, hits[size_t(i - probes.begin())]);
	}
	std::vector<int> seeds(probes.size(), -1);
	for (size_t i = 0; i < probes.size(); ++i) {
		const detail::SeedHits& hit = hits[i];
		const int letter = outline.contours[size_t(probes[i].contour)].letter;
		const vcg::Point2d& p = probes[i].p;
		const auto place = [&](double z) {
			const vcg::Point3d onPlane(p[0], p[1], 0);
			if (!space.perspective()) return space.toMesh({p[0], p[1], z});
			return space.toMesh(onPlane + (space.center() - onPlane) * (z / space.center()[2]));
		};
		if (hit.back >= 0 && !(hit.facingDepth >= hit.backDepth - snap))
			throw Error(ErrorCode::FacesAway, "the first surface shows its back")
				.atFace(sheet.triangles[size_t(hit.back)].face)
				.atLetter(letter)
				.atPlace(place(hit.backDepth));
		if (hit.facing < 0)
			throw Error(detail::IsOnStraddling(space, sheet, p) ? ErrorCode::BehindCamera : ErrorCode::OffSurface,
			            "nothing under a contour")
				.atLetter(letter)
				.atPlace(place(0));
		seeds[size_t(probes[i].contour)] = hit.facing;
	}
	return seeds;
}

}  // namespace vcg::textlabel
