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

/// Samples that Flatten makes of a contour, which its time goes with.
double SamplesNeeded(const CurveContour& contour, double tolerance);

/// Flatten one closed contour.
/// @param[in] tolerance  largest distance between curve and polyline, in the units of the points; > 0
/// @return #P points of the curve, none repeated; empty when the contour has no area
/// @throws TextError{BadTolerance} when more than kMostSamples are needed, TextError{Unsound} when the contour has too many pieces
Ring Flatten(const CurveContour& contour, double tolerance);

/// Flatten curves that need not be closed, simply: each by chords of its own.
/// @return #P points from the start to the end
/// @throws TextError{BadTolerance} when more than kMostSamples are needed
Ring FlattenOpen(const CurveContour& curves, double tolerance);

/// A tolerance that suits what is so large.
/// @param[in] asked  0: one is chosen
/// @param[in] size  height of capital letters, or of the whole
/// @param[in] fineness  size over the one that is chosen
/// @throws TextError{BadTolerance}
double CheckedTolerance(double asked, double size, double fineness);

}  // namespace textlabel
