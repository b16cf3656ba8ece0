#pragma once
// Clipper's union by the non-zero rule, checked.
//
// Clipper's sweep takes a wrong turn once in some ten thousand tangles where many edges meet in one point or run along
// one another, and does not say so. It hardly ever does when x and y change places: so the sweep is run both ways, and
// when the areas differ, again with every point moved by a random trifle, until they agree.

#include "outline_grid.h"

namespace textlabel {

/// The region that the rings wind around, as rings: outer ones counter-clockwise, holes clockwise.
/// They may touch in points, as far as the grid's rounding goes; they may lie within a rounding of each other.
/// @param[in] trifle  how far points may be moved if need be, grid units
/// @throws TextError{Unsound} when no two ways agree
Paths CheckedUnion(const Paths& rings, double trifle);

}  // namespace textlabel
