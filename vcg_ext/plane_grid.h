#pragma once
// Triangles of the label plane in the cells that they meet, to find those near another one.
//
// A triangle is entered row by row, in the cells that it meets and no others: the needles of a fan, whose boxes all overlap, share
// only the cells around its hub.

#include "plane_box.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace vcg::textlabel {

/// Corners in the label plane, in either orientation.
using PlaneTriangle = std::array<vcg::Point2d, 3>;

inline PlaneBox BoxOfTriangle(const PlaneTriangle& corner)
{
	PlaneBox box;
	for (const vcg::Point2d& p : corner) box.add(p);
	return box;
}

class PlaneGrid {
public:
	/// @param[in] triangles  #T, finite
	explicit PlaneGrid(const std::vector<PlaneTriangle>& triangles);

	/// Call use(i) once for each triangle that comes as near as `reach` to `around`, touching included, in no order that matters;
	/// perhaps for more, of those whose boxes do.
	/// @param[in] reach  label units, along either axis
	/// @param[in] without  those that are as near only within this box may be left out
	template <class Use>
	void query(const PlaneTriangle& around, double reach, Use&& use, const PlaneBox& without = {});

private:
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
	bool isWithin(const PlaneBox& box, int x, int y) const
	{
		return beginOf(x, 0) - margin_ >= box.low[0] && beginOf(x + 1, 0) + margin_ <= box.high[0] &&
		       beginOf(y, 1) - margin_ >= box.low[1] && beginOf(y + 1, 1) + margin_ <= box.high[1];
	}
	template <class Use>
	void visitCells(const PlaneTriangle& t, double reach, Use&& use) const;
	size_t cellsOfAll(const std::vector<PlaneTriangle>& triangles) const;

	std::vector<PlaneBox> boxes_;
	PlaneBox all_;
	double margin_ = 0;  ///< label units: more than what is lost in finding a cell
	int side_ = 1;
	std::vector<int> start_, member_;  ///< CSR: the triangles in each cell
	std::vector<int> seen_;            ///< #T: the last query that met it
	int round_ = 0;
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

/// The cells that points within `reach` of a triangle lie in.
template <class Use>
void PlaneGrid::visitCells(const PlaneTriangle& t, double reach, Use&& use) const
{
	PlaneBox box = BoxOfTriangle(t);
	box.grow(reach);
	const int left = cellOf(box.low[0], 0), right = cellOf(box.high[0], 0);
	const int bottom = cellOf(box.low[1], 1), top = cellOf(box.high[1], 1);
	const bool isNarrow = right - left < 2 || top - bottom < 2;  // all cells of its box, then
	const double around = reach + margin_;
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

inline size_t PlaneGrid::cellsOfAll(const std::vector<PlaneTriangle>& triangles) const
{
	size_t count = 0;
	for (const PlaneTriangle& t : triangles) visitCells(t, 0, [&](int, int) { ++count; });
	return count;
}

inline PlaneGrid::PlaneGrid(const std::vector<PlaneTriangle>& triangles) : seen_(triangles.size(), 0)
{
	constexpr int mostCells = 256;      // along a side
	constexpr size_t mostMembers = 32;  // for each triangle: large ones that all overlap would be in nearly all cells
	constexpr double roundings = 64 * std::numeric_limits<double>::epsilon();
	boxes_.reserve(triangles.size());
	for (const PlaneTriangle& t : triangles) {
		boxes_.push_back(BoxOfTriangle(t));
		all_.add(boxes_.back().low);
		all_.add(boxes_.back().high);
	}
	for (const vcg::Point2d& p : {all_.low, all_.high})
		margin_ = std::max({margin_, roundings * std::abs(p[0]), roundings * std::abs(p[1])});
	side_ = std::clamp(int(std::sqrt(double(triangles.size()))), 1, mostCells);
	while (side_ > 1 && cellsOfAll(triangles) > mostMembers * triangles.size()) side_ /= 2;
	start_.assign(size_t(side_) * size_t(side_) + 1, 0);
	const auto cell = [&](int x, int y) { return size_t(y * side_ + x); };
	for (const PlaneTriangle& t : triangles) visitCells(t, 0, [&](int x, int y) { ++start_[cell(x, y) + 1]; });
	for (size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
	member_.resize(size_t(start_.back()));
	std::vector<int> next(start_.begin(), start_.end() - 1);
	for (size_t i = 0; i < triangles.size(); ++i)
		visitCells(triangles[i], 0, [&](int x, int y) { member_[size_t(next[cell(x, y)]++)] = int(i); });
}

template <class Use>
void PlaneGrid::query(const PlaneTriangle& around, double reach, Use&& use, const PlaneBox& without)
{
	PlaneBox box = BoxOfTriangle(around);
	box.grow(reach);
	if (!all_.meets(box)) return;
	++round_;
	visitCells(around, reach, [&](int x, int y) {
		if (isWithin(without, x, y)) return;
		const size_t cell = size_t(y * side_ + x);
		for (int i = start_[cell]; i < start_[cell + 1]; ++i) {
			const size_t member = size_t(member_[size_t(i)]);
			if (std::exchange(seen_[member], round_) != round_ && boxes_[member].meets(box)) use(int(member));
		}
	});
}

}  // namespace vcg::textlabel
