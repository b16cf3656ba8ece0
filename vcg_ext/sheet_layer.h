#pragma once
// The layer: the candidates that hang together with the label, when they lie over its box like one sheet of paper.
//
// Most labels stand on a surface that covers their box once. Then no two of its triangles overlap in the label plane, and what
// would be a search for pairs becomes one count. The proof: every triangle of the layer is counter-clockwise in the plane and no
// border edge of the layer enters the box, so each point of the box is covered equally often; it is enough to count at one.
// Where that does not hold (an edge of the part runs through the box, the part winds over itself) nothing is claimed.

#include "sheet.h"

namespace vcg::textlabel {

struct SheetLayer {
	/// Over `box` the members cover the label plane exactly once; false claims nothing.
	bool isSingle = false;
	PlaneBox box;
	std::vector<char> member;  ///< #T; of no account unless isSingle

	/// Two members that meet within the box can't overlap in the label plane.
	bool has(int triangle) const { return isSingle && member[size_t(triangle)] != 0; }
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

}  // namespace detail

inline SheetLayer FindLayer(const Sheet& sheet, const Outline& outline, const std::vector<int>& seeds)
{
	SheetLayer layer;
	layer.box = sheet.box;
	layer.member.assign(sheet.triangles.size(), 0);
	std::vector<int> stack(1, seeds[0]);
	layer.member[size_t(seeds[0])] = 1;
	bool isOpen = false;
	while (!stack.empty() && !isOpen) {
		const int t = stack.back();
		stack.pop_back();
		for (int h = 3 * t; h < 3 * t + 3; ++h) {
			const int across = sheet.facingAcross(h);
			if (across < 0) {
				isOpen = isOpen || detail::MayEnter(layer.box, sheet.plane(sheet.from(h)), sheet.plane(sheet.to(h)));
			} else if (!layer.member[size_t(across)]) {
				layer.member[size_t(across)] = 1;
				stack.push_back(across);
			}
		}
	}
	const auto isMember = [&layer](int seed) { return layer.member[size_t(seed)] != 0; };
	if (isOpen || !std::all_of(seeds.begin(), seeds.end(), isMember)) return layer;  // or it stands on several surfaces
	for (size_t i = 0; i < seeds.size(); ++i) {
		const auto& v = sheet.triangles[size_t(seeds[i])].vertex;
		for (const vcg::Point2d& p :
		     {outline.contours[i].points[0], (sheet.plane(v[0]) + sheet.plane(v[1]) + sheet.plane(v[2])) / 3}) {
			const int covers = layer.box.holds(p) ? detail::CountCovers(sheet, layer, p) : -1;
			if (covers < 0) continue;  // on an edge there is no count
			layer.isSingle = covers == 1;
			return layer;
		}
	}
	return layer;
}

}  // namespace vcg::textlabel
