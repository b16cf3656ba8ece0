#pragma once
// Rings on Clipper's integer grid, and what can be decided exactly there.
//
// Coordinates stay below 2^28, so that a cross product of two differences is exact in 64 bits.

#include <clipper.hpp>
#include <cmath>
#include <vcg/space/point2.h>
#include <vector>
#include "outline_tree.h"

namespace textlabel {

using ClipperLib::cInt;
using ClipperLib::IntPoint;
using ClipperLib::Path;
using ClipperLib::Paths;

constexpr cInt kGridReach = cInt(1) << 28;  ///< largest coordinate, either sign

/// The grid: coordinate = integer * step, step a power of two, so that the way back is exact.
struct Grid {
	double step = 1;

	/// The finest one that holds coordinates up to `reach`.
	static Grid Holding(double reach)
	{
		return {std::exp2(std::ceil(std::log2(reach / static_cast<double>(kGridReach))))};
	}
	IntPoint operator()(const vcg::Point2d& p) const { return {std::llround(p[0] / step), std::llround(p[1] / step)}; }
	vcg::Point2d back(const IntPoint& p) const
	{
		return {static_cast<double>(p.X) * step, static_cast<double>(p.Y) * step};
	}
};

/// Twice the area of abc, exact; positive when counter-clockwise.
inline cInt Cross(const IntPoint& a, const IntPoint& b, const IntPoint& c)
{
	return (b.X - a.X) * (c.Y - a.Y) - (b.Y - a.Y) * (c.X - a.X);
}

/// An edge of a set of rings: from point i of the ring to the next.
struct GridEdge {
	std::size_t ring, i;
	IntPoint a, b;
};

/// The edges of all rings, in order.
std::vector<GridEdge> EdgesOf(const Paths& rings);

/// The tree over the edges' boxes.
BoxTree<cInt> TreeOf(const std::vector<GridEdge>& edges);

FlatBox<cInt> BoxOf(const GridEdge& edge, cInt margin = 0);

/// Do the closed segments have a point in common? Exact.
bool Meet(const GridEdge& e, const GridEdge& f);

/// Are f and e neighbours in their ring, with `e` first?
bool Follows(const GridEdge& e, const GridEdge& f, const Paths& rings);

/// Are the rings simple, without repeated or collinear points, and without a point in common? Exact.
bool AreSound(const Paths& rings);

/// Pairs of edges that meet without being neighbours, counted up to `most`.
std::size_t CountCrossings(const Paths& rings, std::size_t most);

/// Parent of each ring: the smallest ring around it, or -1.
/// @pre AreSound(rings)
std::vector<int> ParentsOf(const Paths& rings);

}  // namespace textlabel
