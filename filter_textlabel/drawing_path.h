#pragma once
// SVG's paths and basic shapes as curves.
//
// Source: W3C, "Scalable Vector Graphics (SVG) 1.1", chapters 8 (paths), 9 (basic shapes) and F.6 (arcs). Arcs of ellipses become cubic
// curves, of 45 degrees at most: these are off by less than 5e-6 of the radius.

#include <optional>
#include <string>
#include "drawing_shape.h"

namespace textlabel {

/// The data of a path.
/// @return nothing for data that is not as the grammar has it
std::optional<std::vector<DrawnPath>> ParsePath(const std::string& data);

/// A list of points: "0,0 10,0 10,10".
std::optional<std::vector<DrawnPath>> ParsePolyline(const std::string& points, bool isClosed);

/// @param[in] radii  of the corners; more than half a side is that half
DrawnPath RectanglePath(const vcg::Point2d& low, const vcg::Point2d& size, vcg::Point2d radii);

DrawnPath EllipsePath(const vcg::Point2d& center, const vcg::Point2d& radii);

}  // namespace textlabel
