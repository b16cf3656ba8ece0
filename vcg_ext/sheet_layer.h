#pragma once
// The layer: the candidates that hang together with the label, and where they lie over its box like one sheet of paper.
//
// Most labels stand on a surface that covers their box once. Then no two of its triangles overlap in the label plane, and what
// would be a search for pairs becomes one count. The proof: every triangle of the layer is counter-clockwise in the plane, so the
// number of triangles over a point changes only across the border of the layer; where no border edge enters the box, it is enough to
// count at one point. Where some do (the text nearly fills a round face, an edge of the part runs through the box), the box is
// divided into cells: those that border edges meet are left to the search, and of the others those that hang together with a
// contour's start are counted there. Where a part winds over itself nothing is claimed.

#include "plane_cells.h"
#include "sheet.h"

namespace vcg::textlabel {

struct SheetLayer {
	PlaneCells cells;          ///< over the sheet's box
	std::vector<char> single;  ///< #cells: 1 where the members cover the label plane exactly once; empty: nowhere
	std::vector<char> member;  ///< #T; of no account unless isSingle()

	/// Whether anything is claimed.
	bool isSingle() const { return !single.empty(); }
	bool has(int triangle) const { return isSingle() && member[size_t(triangle)] != 0; }
	/// Whether no two members overlap in a box of the label plane.
	bool holds(const PlaneBox& box) const
	{
		return isSingle() && cells.box().holds(box) && cells.allOf(box, [&](size_t cell) { return single[cell] != 0; });
	}
	/// Whether none do in the whole box of the sheet.
	bool isWhole() const { return isSingle() && cells.count() == 1; }
};

/// Find the layer of a label.
/// @param[in] outline  within the sheet's box
/// @param[in] seeds  #contours: facing triangles, those under the contours' first points
SheetLayer FindLayer(const Sheet& sheet, const Outline& outline, const std::vector<int>& seeds);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Whether a segment may have a point in a box; false only when it certainly has none.
inline bool MayEnter(const PlaneBox& box, const vcg::Point2d& a, const vcg::Point2d& b)
{
	for (int i = 0; i < 2; ++i)
		if (std::max(a[i], b[i]) < box.low[i] || std::min(a[i], b[i]) > box.high[i]) return false;
	const vcg::Point2d corner[4] = {box.low, {box.high[0], box.low[1]}, box.high, {box.low[0], box.high[1]}};
	int left = 0, right = 0;
	for (const vcg::Point2d& c : corner) {
		const int side = Orient2d(a, b, c);
		left += side > 0;
		right += side < 0;
	}
	return left < 4 && right < 4;
}

/// How many members of a layer hold p in their interior; -1 when it lies on the edge of one.
inline int CountCovers(const Sheet& sheet, const SheetLayer& layer, const vcg::Point2d& p)
{
	int covers = 0;
	for (size_t t = 0; t < sheet.triangles.size(); ++t) {
		if (!layer.member[t]) continue;
		const auto& v = sheet.triangles[t].vertex;
		const vcg::Point2d &a = sheet.plane(v[0]), &b = sheet.plane(v[1]), &c = sheet.plane(v[2]);
		if (std::max({a[0], b[0], c[0]}) < p[0] || std::min({a[0], b[0], c[0]}) > p[0]) continue;
		if (std::max({a[1], b[1], c[1]}) < p[1] || std::min({a[1], b[1], c[1]}) > p[1]) continue;
		const int least = std::min({Orient2d(a, b, p), Orient2d(b, c, p), Orient2d(c, a, p)});
		if (least == 0) return -1;
		covers += least > 0;
	}
	return covers;
}

/// Gather all that hangs together with a triangle over what faces the viewer.
/// @return the half-edges of its border that may enter the box
inline std::vector<int> GatherMembers(const Sheet& sheet, int seed, std::vector<char>& member)
{
	std::vector<int> border, stack(1, seed);
	member[size_t(seed)] = 1;
	while (!stack.empty()) {
		const int t = stack.back();
		stack.pop_back();
		for (int h = 3 * t; h < 3 * t + 3; ++h) {
			const int across = sheet.facingAcross(h);
			if (across < 0) {
				if (MayEnter(sheet.box, sheet.plane(sheet.from(h)), sheet.plane(sheet.to(h)))) border.push_back(h);
			} else if (!member[size_t(across)]) {
				member[size_t(across)] = 1;
				stack.push_back(across);
			}
		}
	}
	return border;
}

/// The cells that hang together with a cell over others for which isFree holds; they are free no longer.
inline std::vector<size_t> TakeConnected(const PlaneCells& cells, size_t first, std::vector<char>& isFree)
{
	const size_t side = size_t(cells.side());
	std::vector<size_t> taken(1, first);
	isFree[first] = 0;
	const auto take = [&](size_t cell) {
		if (std::exchange(isFree[cell], 0)) taken.push_back(cell);
	};
	for (size_t i = 0; i < taken.size(); ++i) {
		const size_t cell = taken[i], x = cell % side, y = cell / side;
		if (x > 0) take(cell - 1);
		if (x + 1 < side) take(cell + 1);
		if (y > 0) take(cell - side);
		if (y + 1 < side) take(cell + side);
	}
	return taken;
}

}  // namespace detail

inline SheetLayer FindLayer(const Sheet& sheet, const Outline& outline, const std::vector<int>& seeds)
{
	constexpr int fewestCells = 8, mostCells = 64;  // along a side
	constexpr int mostCounts = 8;                   // each looks at all candidates
	constexpr double around = 0.25;                 // of a cell: what rounding may move stays single
	SheetLayer layer;
	layer.member.assign(sheet.triangles.size(), 0);
	const std::vector<int> border = detail::GatherMembers(sheet, seeds[0], layer.member);
	const auto isMember = [&layer](int seed) { return layer.member[size_t(seed)] != 0; };
	if (!std::all_of(seeds.begin(), seeds.end(), isMember)) return layer;  // it stands on several surfaces
	const int members = int(std::count(layer.member.begin(), layer.member.end(), 1));
	const int side = border.empty() ? 1 : std::clamp(int(std::sqrt(double(members))), fewestCells, mostCells);
	layer.cells = PlaneCells(sheet.box, side);
	layer.single.assign(layer.cells.count(), 0);
	std::vector<char> isFree(layer.cells.count(), 1);
	const double reach = around * std::max(sheet.box.width(), sheet.box.height()) / side;
	for (const int h : border) {
		const vcg::Point2d &a = sheet.plane(sheet.from(h)), &b = sheet.plane(sheet.to(h));
		layer.cells.visit({a, b, b}, reach, [&](int x, int y) { isFree[layer.cells.number(x, y)] = 0; });
	}
	for (size_t i = 0, counts = 0; i < seeds.size() && counts < mostCounts; ++i) {
		const auto& v = sheet.triangles[size_t(seeds[i])].vertex;
		for (const vcg::Point2d& p :
		     {outline.contours[i].points[0], (sheet.plane(v[0]) + sheet.plane(v[1]) + sheet.plane(v[2])) / 3}) {
			if (!sheet.box.holds(p) || !isFree[layer.cells.numberAt(p)]) continue;
			++counts;
			const int covers = detail::CountCovers(sheet, layer, p);
			if (covers < 0) continue;  // on an edge there is no count
			for (const size_t cell : detail::TakeConnected(layer.cells, layer.cells.numberAt(p), isFree))
				layer.single[cell] = covers == 1;
		}
	}
	if (std::find(layer.single.begin(), layer.single.end(), 1) == layer.single.end()) layer.single.clear();
	return layer;
}

}  // namespace vcg::textlabel
