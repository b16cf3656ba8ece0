#pragma once
// A line of some width as the region that it covers.
//
// Each straight piece is a rectangle, each joint and each end a polygon of its own; their union is the line. So SVG's rules for joints
// and ends hold to the letter (SVG 1.1, 11.4), also where a line turns back or crosses itself.

#include <vector>
#include "drawing_shape.h"
#include "outline_flatten.h"

namespace textlabel {

/// @param[in] line  #P points, straight between them; of a closed one, the last is joined to the first
/// @param[in] tolerance  of round joints and ends, in the units of the line; > 0
/// @return polygons, counter-clockwise, whose union it is; none when nothing is drawn
std::vector<Ring> StrokeRings(const Ring& line, bool isClosed, const LineStyle& style, double tolerance);

}  // namespace textlabel
