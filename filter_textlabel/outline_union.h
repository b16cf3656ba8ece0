#pragma once
// Clipper's union, intersection and difference, checked.
//
// Clipper's sweep takes a wrong turn once in some ten thousand tangles where many edges meet in one point or run along
// one another, and does not say so. It hardly ever does when x and y change places: so the sweep is run both ways, and
// when the areas differ, again with every point moved by a random trifle, until they agree.

#include "outline_grid.h"

namespace textlabel {

/// What a set of rings has inside.
enum class FillRule { NonZero, EvenOdd };

/// What crosses itself more often than this is rubbish, which would take forever to unite.
constexpr std::size_t kMostCrossings = 100000;

/// @throws TextError{Unsound} where edges cross more often than kMostCrossings
void RequireFewCrossings(const Paths& rings);

/// The region that the rings wind around, as rings: outer ones counter-clockwise, holes clockwise.
/// They may touch in points, as far as the grid's rounding goes; they may lie within a rounding of each other.
/// @param[in] trifle  how far points may be moved if need be, grid units
/// @throws TextError{Unsound} when no two ways agree
Paths CheckedUnion(const Paths& rings, double trifle, FillRule rule = FillRule::NonZero);

/// What two regions have in common, or the first without the second; all else as CheckedUnion.
/// @param[in] one, other  as CheckedUnion gives them
Paths CheckedIntersection(const Paths& one, const Paths& other, double trifle);
Paths CheckedDifference(const Paths& one, const Paths& other, double trifle);

}  // namespace textlabel
