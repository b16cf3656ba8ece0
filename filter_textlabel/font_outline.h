#pragma once
// FreeType's outlines as curves.

#include <optional>
#include <vector>
#include <ft2build.h>
#include FT_OUTLINE_H
#include "outline_curve.h"

namespace textlabel {

/// The contours of an outline in 26.6 pixels, closed, in em.
/// @param[in] pixelsPerEm  > 0
/// @return nothing when FreeType finds the outline invalid
std::optional<std::vector<CurveContour>> CurvesOf(FT_Outline& outline, double pixelsPerEm);

}  // namespace textlabel
