#pragma once
// An axis-parallel box in the label plane.

#include <algorithm>
#include <limits>
#include <vcg/space/point2.h>

namespace vcg::textlabel {

/// Empty at first: it holds and meets nothing.
struct PlaneBox {
	vcg::Point2d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
	vcg::Point2d high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

	void add(const vcg::Point2d& p)
	{
		for (int i = 0; i < 2; ++i) {
			low[i] = std::min(low[i], p[i]);
			high[i] = std::max(high[i], p[i]);
		}
	}
	void grow(double margin)
	{
		low -= vcg::Point2d(margin, margin);
		high += vcg::Point2d(margin, margin);
	}
	bool holds(const PlaneBox& b) const
	{
		return b.low[0] >= low[0] && b.low[1] >= low[1] && b.high[0] <= high[0] && b.high[1] <= high[1];
	}
	bool holds(const vcg::Point2d& p) const
	{
		return p[0] >= low[0] && p[1] >= low[1] && p[0] <= high[0] && p[1] <= high[1];
	}
	bool meets(const PlaneBox& b) const
	{
		return b.low[0] <= high[0] && b.low[1] <= high[1] && b.high[0] >= low[0] && b.high[1] >= low[1];
	}
	double width() const { return high[0] - low[0]; }
	double height() const { return high[1] - low[1]; }
};

}  // namespace vcg::textlabel
