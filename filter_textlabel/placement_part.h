#pragma once
// The part as automatic placement sees it: the usable triangles, around the origin, with their area vectors.

#include "vcg_ext/vertex_point.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>
#include <vcg/space/box3.h>
#include <vcg/space/point3.h>

namespace textlabel {

using vcg::textlabel::IsFinite;

constexpr double sameSurface = 1e-7;  ///< of the part's diagonal: what is nearer behind is the same surface

struct Part {
	std::vector<vcg::Point3d> points;  ///< #V by 3, relative to center; those that no face uses are put on one that is
	std::vector<std::array<int, 3>> faces;  ///< #F by 3, only finite faces of positive area
	std::vector<vcg::Point3d> areas;        ///< #F by 3, area vectors: along the normal, as long as the face is large
	std::vector<std::uint32_t> paint;       ///< #F: colours that a text does not run across; or empty
	vcg::Point3d center{0, 0, 0};           ///< of the bounding box of the faces, mesh units
	double diagonal = 0;                    ///< of that box
};

/// Three perpendicular unit vectors of a look at the part; right = up x towards.
struct ViewAxes {
	vcg::Point3d right, up, towards;
};

/// Axes that look against `towards` with `up` as far up as it goes.
/// @pre up and towards are not parallel
inline ViewAxes AxesFrom(const vcg::Point3d& towards, const vcg::Point3d& up)
{
	ViewAxes axes;
	axes.towards = towards / towards.Norm();
	axes.right = up ^ axes.towards;
	axes.right /= axes.right.Norm();
	axes.up = axes.towards ^ axes.right;
	return axes;
}

/// The same look with the head tilted: the text reads from bottom to top, as on a technical drawing.
inline ViewAxes QuarterTurned(const ViewAxes& axes) { return {axes.up, -axes.right, axes.towards}; }

/// Keep what can be looked at: faces with three finite, existing corners and a positive, finite area.
/// @param[in] paint  #triangles, or empty
inline Part MakePart(const std::vector<vcg::Point3d>& positions, const std::vector<std::array<int, 3>>& triangles,
                     const std::vector<std::uint32_t>& paint = {})
{
	Part part;
	const int count = int(positions.size());
	const auto exists = [&](int v) { return v >= 0 && v < count && IsFinite(positions[size_t(v)]); };
	std::vector<char> isUsed(positions.size(), 0);
	vcg::Box3d box;
	for (size_t f = 0; f < triangles.size(); ++f) {
		const std::array<int, 3>& face = triangles[f];
		if (!exists(face[0]) || !exists(face[1]) || !exists(face[2])) continue;
		const vcg::Point3d& a = positions[size_t(face[0])];
		const vcg::Point3d area = ((positions[size_t(face[1])] - a) ^ (positions[size_t(face[2])] - a)) / 2;
		if (!IsFinite(area) || !(area.SquaredNorm() > 0)) continue;
		part.faces.push_back(face);
		part.areas.push_back(area);
		if (!paint.empty()) part.paint.push_back(paint[f]);
		for (int v : face) {
			isUsed[size_t(v)] = 1;
			box.Add(positions[size_t(v)]);
		}
	}
	if (part.faces.empty()) return part;
	part.center = box.Center();
	part.diagonal = box.Diag();
	part.points.assign(positions.size(), positions[size_t(part.faces[0][0])] - part.center);
	for (size_t v = 0; v < positions.size(); ++v)
		if (isUsed[v]) part.points[v] = positions[v] - part.center;
	return part;
}

}  // namespace textlabel
