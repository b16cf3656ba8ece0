#pragma once
// Buckets of boxes over the label plane, to find those that meet a box.

#include "sheet.h"

#include <utility>

namespace vcg::textlabel {

class PlaneGrid {
public:
	/// @param[in] boxes  #B, finite
	explicit PlaneGrid(std::vector<PlaneBox> boxes);

	/// Call use(i) once for each box that meets `box`, touching included, in no order that matters.
	template <class Use>
	void query(const PlaneBox& box, Use&& use);

private:
	int cellOf(double x, int axis) const
	{
		const double size = axis == 0 ? all_.width() : all_.height();
		return size > 0 ? int(std::clamp((x - all_.low[axis]) / size, 0.0, 1.0) * (side_ - 1)) : 0;
	}
	/// How many cells the boxes meet, each for itself.
	size_t cellsOfAll() const
	{
		size_t count = 0;
		for (const PlaneBox& box : boxes_)
			count += size_t(cellOf(box.high[0], 0) - cellOf(box.low[0], 0) + 1) *
			         size_t(cellOf(box.high[1], 1) - cellOf(box.low[1], 1) + 1);
		return count;
	}
	template <class Use>
	void visitCells(const PlaneBox& box, Use&& use) const
	{
		const int left = cellOf(box.low[0], 0), right = cellOf(box.high[0], 0), top = cellOf(box.high[1], 1);
		for (int y = cellOf(box.low[1], 1); y <= top; ++y)
			for (int x = left; x <= right; ++x) use(y * side_ + x);
	}

	std::vector<PlaneBox> boxes_;
	PlaneBox all_;
	int side_ = 1;
	std::vector<int> start_, member_;  ///< CSR: the boxes in each cell
	std::vector<int> seen_;            ///< #B: the last query that met it
	int round_ = 0;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline PlaneGrid::PlaneGrid(std::vector<PlaneBox> boxes) : boxes_(std::move(boxes)), seen_(boxes_.size(), 0)
{
	constexpr int mostCells = 256;      // along a side
	constexpr size_t mostMembers = 32;  // for each box: long ones that lie askew would be in nearly all cells
	for (const PlaneBox& box : boxes_) {
		all_.add(box.low);
		all_.add(box.high);
	}
	side_ = std::clamp(int(std::sqrt(double(boxes_.size()))), 1, mostCells);
	while (side_ > 1 && cellsOfAll() > mostMembers * boxes_.size()) side_ /= 2;
	start_.assign(size_t(side_) * size_t(side_) + 1, 0);
	for (const PlaneBox& box : boxes_) visitCells(box, [&](int cell) { ++start_[size_t(cell) + 1]; });
	for (size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
	member_.resize(size_t(start_.back()));
	std::vector<int> next(start_.begin(), start_.end() - 1);
	for (int i = 0; i < int(boxes_.size()); ++i)
		visitCells(boxes_[size_t(i)], [&](int cell) { member_[size_t(next[size_t(cell)]++)] = i; });
}

template <class Use>
void PlaneGrid::query(const PlaneBox& box, Use&& use)
{
	if (!all_.meets(box)) return;
	++round_;
	visitCells(box, [&](int cell) {
		for (int i = start_[size_t(cell)]; i < start_[size_t(cell) + 1]; ++i) {
			const size_t member = size_t(member_[size_t(i)]);
			if (std::exchange(seen_[member], round_) != round_ && boxes_[member].meets(box)) use(int(member));
		}
	});
}

}  // namespace vcg::textlabel
