#pragma once
// Beads: small bridges where two pieces of a boundary come too close.
//
// Where rings touch in a point, where a gap or a neck is narrower than the outline's own error, the text is welded: the
// stretch of the one edge that is too close to the other, widened to a capsule, is united with the text. A gap closes,
// a neck gets as wide as the capsule, all else stays as it is to the last digit.

#include "outline_grid.h"

namespace textlabel {

/// What touches itself more often is rubbish, which would take forever to unite.
constexpr std::size_t kMostBeads = 50000;

/// Capsules over all places where edges that are not neighbours come closer than `finest`.
/// @param[in] finest  grid units, >= 2
/// @return closed rings, counter-clockwise; none when all is well
/// @throws TextError{Unsound} for more than kMostBeads
Paths BeadsOf(const Paths& rings, double finest);

}  // namespace textlabel
