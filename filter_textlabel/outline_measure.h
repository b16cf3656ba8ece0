#pragma once
// How thin is the thinnest stroke, how narrow the narrowest gap?
//
// A stroke is where two pieces of the boundary face each other across the inside, a gap where they do across the
// outside. Faces: their normals are opposite within kFacing. So the sides of a stem count, those of a corner do not.
// Nor does the point in which a stroke or a gap tapers off: it has no width of its own, and prints as a stroke or a gap
// that is a bit shorter. As the sides need not be quite parallel, the width of a round is measured up to 3 percent
// short.

#include <vector>
#include "vcg_ext/contour.h"

namespace textlabel {

/// Sides that converge at less than this face each other, radians (20 degrees).
constexpr double kFacing = 0.35;

/// Widths of one letter, label units; 0 = there is none.
struct LetterWidths {
	double stroke = 0, gap = 0;
};

/// The narrowest places of each letter; a gap between two letters counts for both.
/// @param[in] reach  widest width looked for, label units
/// @return #letters
std::vector<LetterWidths> MeasureWidths(const vcg::textlabel::Outline& outline, int letterCount, double reach);

}  // namespace textlabel
