#pragma once
// A box of the label plane in rows and columns of cells, and the cells that a triangle meets.
//
// A triangle is followed row by row: the needles of a fan, whose boxes all overlap, share only the cells around its hub.

#include "plane_box.h"

#include <array>
#include <cmath>
#include <utility>

namespace vcg::textlabel {

/// Corners in the label plane, in either orientation.
using PlaneTriangle = std::array<vcg::Point2d, 3>;

inline PlaneBox BoxOfTriangle(const PlaneTriangle& corner)
{
	PlaneBox box;
	for (const vcg::Point2d& p : corner) box.add(p);
	return box;
}

class PlaneCells {
public:
	/// One cell over nothing.
	PlaneCells() = default;
	/// @param[in] all  what lies beyond belongs to the cells of its border
	/// @param[in] side  > 0, of cells in a row and in a column; the last of several holds the far border of the box alone
	PlaneCells(const PlaneBox& all, int side) : all_(all), side_(side)
	{
		for (const vcg::Point2d& p : {all.low, all.high}) margin_ = std::max(margin_, rounding(p));
	}

	const PlaneBox& box() const { return all_; }
	int side() const { return side_; }
	size_t count() const { return size_t(side_) * size_t(side_); }
	/// 0 .. count-1, row by row.
	size_t number(int x, int y) const { return size_t(y) * size_t(side_) + size_t(x); }
	size_t numberAt(const vcg::Point2d& p) const { return number(cellOf(p[0], 0), cellOf(p[1], 1)); }

	/// Where the points of the box lie that a cell holds, rounding included.
	PlaneBox boxOf(int x, int y) const
	{
		PlaneBox box;
		box.add({beginOf(x, 0), beginOf(y, 1)});
		box.add({beginOf(x + 1, 0), beginOf(y + 1, 1)});
		box.grow(margin_);
		return box;
	}

	/// Call use(x, y) for each cell that holds points of the box within `reach` of a triangle, along either axis; perhaps for a few more.
	template <class Use>
	void visit(const PlaneTriangle& t, double reach, Use&& use) const;

	/// Whether isGood(number) holds for each cell that a box meets.
	template <class IsGood>
	bool allOf(const PlaneBox& b, IsGood&& isGood) const
	{
		const int left = cellOf(b.low[0], 0), right = cellOf(b.high[0], 0), top = cellOf(b.high[1], 1);
		for (int y = cellOf(b.low[1], 1); y <= top; ++y)
			for (int x = left; x <= right; ++x)
				if (!isGood(number(x, y))) return false;
		return true;
	}

private:
	/// More than what computing with a point loses.
	static double rounding(const vcg::Point2d& p)
	{
		return 64 * std::numeric_limits<double>::epsilon() * std::max(std::abs(p[0]), std::abs(p[1]));
	}
	int cellOf(double x, int axis) const
	{
		const double size = axis == 0 ? all_.width() : all_.height();
		return size > 0 ? int(std::clamp((x - all_.low[axis]) / size, 0.0, 1.0) * (side_ - 1)) : 0;
	}
	/// Where the cells of a row or column begin.
	double beginOf(int cell, int axis) const
	{
		const double size = axis == 0 ? all_.width() : all_.height();
		return all_.low[axis] + size * cell / std::max(side_ - 1, 1);
	}

	PlaneBox all_;
	double margin_ = 0;  ///< label units: more than what is lost in finding a cell
	int side_ = 1;
};

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Along x: where a triangle has points between two heights; empty when it has none.
inline std::pair<double, double> ExtentBetween(const PlaneTriangle& t, double low, double high)
{
	std::pair<double, double> extent(std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity());
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point2d &p = t[k], &q = t[(k + 1) % 3];
		const double first = std::max(std::min(p[1], q[1]), low), last = std::min(std::max(p[1], q[1]), high);
		if (first > last) continue;
		const auto add = [&](double x) {
			extent.first = std::min(extent.first, x);
			extent.second = std::max(extent.second, x);
		};
		if (p[1] == q[1]) {
			add(p[0]);
			add(q[0]);
		} else {
			for (const double y : {first, last}) add(p[0] + (q[0] - p[0]) * ((y - p[1]) / (q[1] - p[1])));
		}
	}
	return extent;
}

}  // namespace detail

template <class Use>
void PlaneCells::visit(const PlaneTriangle& t, double reach, Use&& use) const
{
	PlaneBox box = BoxOfTriangle(t);
	box.grow(reach);
	const int left = cellOf(box.low[0], 0), right = cellOf(box.high[0], 0);
	const int bottom = cellOf(box.low[1], 1), top = cellOf(box.high[1], 1);
	const bool isNarrow = right - left < 2 || top - bottom < 2;  // all cells of its box, then
	const double around = reach + margin_ + std::max({rounding(t[0]), rounding(t[1]), rounding(t[2])});
	for (int y = bottom; y <= top; ++y) {
		int first = left, last = right;
		if (!isNarrow) {
			const auto [low, high] = detail::ExtentBetween(t, beginOf(y, 1) - around, beginOf(y + 1, 1) + around);
			if (low > high) continue;
			first = cellOf(low - around, 0);
			last = cellOf(high + around, 0);
		}
		for (int x = first; x <= last; ++x) use(x, y);
	}
}

}  // namespace vcg::textlabel
