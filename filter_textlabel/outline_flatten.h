#pragma once
// Curves to polylines with as few points as the chord error allows.
//
// A curve is first sampled so densely that the samples stand for it (Wang's bound on the distance of a Bézier curve
// from its chords: d (d-1) / 8 · max |second difference| / n²). Then each chord reaches as far as the tolerance lets
// it, across the joints of the font's own pieces, and at last the chords of a stretch are evened out: the least error
// with that many chords. Corners and the ends of straight lines stay where the font has them.

#include <vector>
#include "outline_curve.h"

namespace textlabel {

using Ring = std::vector<vcg::Point2d>;  ///< a closed polyline; the last point is joined to the first

/// Most samples that Flatten makes of one contour.
constexpr std::size_t kMostSamples = 2000000;

/// Flatten one closed contour.
/// @param[in] tolerance  largest distance between curve and polyline, in the units of the points; > 0
/// @return #P points of the curve, none repeated; empty when the contour has no area
/// @throws TextError{BadTolerance} when more than kMostSamples are needed, TextError{Unsound} when the contour has too many pieces
Ring Flatten(const CurveContour& contour, double tolerance);

}  // namespace textlabel
