#pragma once
// Triangles of the label plane in the cells that they meet, to find those near another one.

#include "plane_cells.h"

#include <vector>

namespace vcg::textlabel {

class PlaneGrid {
public:
	/// @param[in] triangles  #T, finite
	explicit PlaneGrid(const std::vector<PlaneTriangle>& triangles);

	/// Call use(i) once for each triangle that comes as near as `reach` to `around`, touching included, in no order that matters;
	/// perhaps for more, of those whose boxes do.
	/// @param[in] reach  label units, along either axis
	template <class Use>
	void query(const PlaneTriangle& around, double reach, Use&& use)
	{
		query(around, reach, use, [](const PlaneBox&) { return false; });
	}
	/// @param[in] without  triangles that are as near only in boxes for which without(box) holds may be left out
	template <class Use, class Without>
	void query(const PlaneTriangle& around, double reach, Use&& use, Without&& without);

private:
	static size_t cellsOfAll(const PlaneCells& cells, const std::vector<PlaneTriangle>& triangles);

	std::vector<PlaneBox> boxes_;
	PlaneBox all_;
	PlaneCells cells_;
	std::vector<int> start_, member_;  ///< CSR: the triangles in each cell
	std::vector<int> seen_;            ///< #T: the last query that met it
	int round_ = 0;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline size_t PlaneGrid::cellsOfAll(const PlaneCells& cells, const std::vector<PlaneTriangle>& triangles)
{
	size_t count = 0;
	for (const PlaneTriangle& t : triangles) cells.visit(t, 0, [&](int, int) { ++count; });
	return count;
}

inline PlaneGrid::PlaneGrid(const std::vector<PlaneTriangle>& triangles) : seen_(triangles.size(), 0)
{
	constexpr int mostCells = 256;      // along a side
	constexpr size_t mostMembers = 32;  // for each triangle: large ones that all overlap would be in nearly all cells
	boxes_.reserve(triangles.size());
	for (const PlaneTriangle& t : triangles) {
		boxes_.push_back(BoxOfTriangle(t));
		all_.add(boxes_.back().low);
		all_.add(boxes_.back().high);
	}
	cells_ = PlaneCells(all_, std::clamp(int(std::sqrt(double(triangles.size()))), 1, mostCells));
	while (cells_.side() > 1 && cellsOfAll(cells_, triangles) > mostMembers * triangles.size())
		cells_ = PlaneCells(all_, cells_.side() / 2);
	start_.assign(cells_.count() + 1, 0);
	for (const PlaneTriangle& t : triangles)
		cells_.visit(t, 0, [&](int x, int y) { ++start_[cells_.number(x, y) + 1]; });
	for (size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
	member_.resize(size_t(start_.back()));
	std::vector<int> next(start_.begin(), start_.end() - 1);
	for (size_t i = 0; i < triangles.size(); ++i)
		cells_.visit(triangles[i], 0, [&](int x, int y) { member_[size_t(next[cells_.number(x, y)]++)] = int(i); });
}

template <class Use, class Without>
void PlaneGrid::query(const PlaneTriangle& around, double reach, Use&& use, Without&& without)
{
	PlaneBox box = BoxOfTriangle(around);
	box.grow(reach);
	if (!all_.meets(box)) return;
	++round_;
	cells_.visit(around, reach, [&](int x, int y) {
		if (without(cells_.boxOf(x, y))) return;
		const size_t cell = cells_.number(x, y);
		for (int i = start_[cell]; i < start_[cell + 1]; ++i) {
			const size_t member = size_t(member_[size_t(i)]);
			if (std::exchange(seen_[member], round_) != round_ && boxes_[member].meets(box)) use(int(member));
		}
	});
}

}  // namespace vcg::textlabel
