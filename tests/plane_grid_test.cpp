// The grid of triangles in the label plane: no pair that meets is missed, and needles are no load.

#include "vcg_ext/plane_grid.h"

#include <gtest/gtest.h>

#include "vcg_ext/predicates.h"

namespace {

using namespace vcg::textlabel;

/// Small ones, needles and large ones, some without area.
std::vector<PlaneTriangle> MixedTriangles(int count, double spread)
{
	std::vector<PlaneTriangle> triangles;
	for (int i = 0; i < count; ++i) {
		const vcg::Point2d p(spread * std::sin(1.1 * i), spread * std::cos(2.3 * i));
		const double length = i % 40 == 0 ? 9 : i % 5 == 0 ? 3 : 0.2, width = i % 40 == 0 ? 4 : i % 7 == 0 ? 0 : 0.02;
		const vcg::Point2d along(std::cos(0.3 * i), std::sin(0.3 * i));
		triangles.push_back({p, p + along * length, p + vcg::Point2d(-along[1], along[0]) * width});
	}
	return triangles;
}

/// Whether two triangles have a point in common, by exact signs.
bool Meet(const PlaneTriangle& s, const PlaneTriangle& t)
{
	const auto keepsOut = [](const PlaneTriangle& a, const PlaneTriangle& b) {
		const int turn = Orient2d(a[0], a[1], a[2]);
		for (size_t k = 0; k < 3; ++k) {
			int left = 0, right = 0;
			for (const vcg::Point2d& p : b) {
				const int side = Orient2d(a[k], a[(k + 1) % 3], p);
				left += side > 0;
				right += side < 0;
			}
			if ((turn <= 0 && left == 3) || (turn >= 0 && right == 3)) return true;
		}
		return false;
	};
	return !keepsOut(s, t) && !keepsOut(t, s) && BoxOfTriangle(s).meets(BoxOfTriangle(t));
}

void ExpectAllFound(const std::vector<PlaneTriangle>& triangles, const std::vector<PlaneTriangle>& around)
{
	PlaneGrid grid(triangles);
	for (const PlaneTriangle& q : around) {
		std::vector<int> found;
		grid.query(q, 0, [&](int i) { found.push_back(i); });
		std::sort(found.begin(), found.end());
		EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
		for (int i = 0; i < int(triangles.size()); ++i)
			if (Meet(triangles[size_t(i)], q)) { EXPECT_TRUE(std::binary_search(found.begin(), found.end(), i)) << i; }
		for (const int i : found) EXPECT_TRUE(BoxOfTriangle(triangles[size_t(i)]).meets(BoxOfTriangle(q)));
	}
}

TEST(PlaneGrid, FindsAllThatMeet) { ExpectAllFound(MixedTriangles(400, 7), MixedTriangles(300, 9)); }

TEST(PlaneGrid, FindsAllThatMeetFarFromTheOrigin)
{
	const auto moved = [](std::vector<PlaneTriangle> triangles) {
		for (PlaneTriangle& t : triangles)
			for (vcg::Point2d& p : t) p += vcg::Point2d(1e9, -3e9);
		return triangles;
	};
	ExpectAllFound(moved(MixedTriangles(300, 7)), moved(MixedTriangles(200, 9)));
}

TEST(PlaneGrid, FindsWhatIsInReach)
{
	const std::vector<PlaneTriangle> triangles = MixedTriangles(300, 7);
	PlaneGrid grid(triangles);
	const double reach = 0.8;
	for (const PlaneTriangle& q : MixedTriangles(200, 9)) {
		std::vector<char> found(triangles.size(), 0);
		grid.query(q, reach, [&](int i) { found[size_t(i)] = 1; });
		for (const double x : {-0.79, 0.0, 0.79})
			for (const double y : {-0.79, 0.0, 0.79}) {
				PlaneTriangle beside = q;
				for (vcg::Point2d& p : beside) p += vcg::Point2d(x, y);
				for (size_t i = 0; i < triangles.size(); ++i) EXPECT_TRUE(found[i] || !Meet(triangles[i], beside)) << i;
			}
	}
}

// What meets beyond a box is found; a fan's needles, which meet at its hub, are not when that lies in the box.
TEST(PlaneGrid, LeavesOutWhatMeetsWithinABox)
{
	constexpr int count = 2000;
	constexpr double step = 2 * M_PI / count;
	std::vector<PlaneTriangle> fan;
	for (int i = 0; i < count; ++i) {
		const auto rim = [](double angle) { return vcg::Point2d(20 * std::cos(angle), 20 * std::sin(angle)); };
		fan.push_back({vcg::Point2d(0.1, 0.2), rim(step * i), rim(step * (i + 1))});
	}
	PlaneBox hub;
	hub.add({-5, -5});
	hub.add({5, 5});
	PlaneGrid grid(fan);
	size_t found = 0;
	for (int i = 0; i < count; ++i) {
		bool isNextFound = false;
		grid.query(
			fan[size_t(i)], 0,
			[&](int k) {
				++found;
				isNextFound = isNextFound || k == (i + 1) % count;
			},
			[&](const PlaneBox& cell) { return hub.holds(cell); });
		EXPECT_TRUE(isNextFound) << i;
	}
	EXPECT_LT(found, size_t(count) * count / 10);
}

// Two triangles that meet in the box and just beyond it, in a cell that the box's border crosses.
TEST(PlaneGrid, FindsWhatMeetsInAStripBesideTheBox)
{
	for (const double border : {1.0, 3.7, 5.0, 6.2, 8.99}) {
		std::vector<PlaneTriangle> triangles = MixedTriangles(400, 5);  // so that there are many cells
		const vcg::Point2d corner(border + 1e-3, 0.3);
		triangles.push_back({vcg::Point2d(0, 0), corner, vcg::Point2d(0, 0.6)});
		const PlaneTriangle around = {vcg::Point2d(0, 0.1), corner, vcg::Point2d(0, 0.5)};
		PlaneBox box;
		box.add({-20, -20});
		box.add({border, 20});
		PlaneGrid grid(triangles);
		bool isFound = false;
		grid.query(
			around, 0, [&](int i) { isFound = isFound || i == int(triangles.size()) - 1; },
			[&](const PlaneBox& cell) { return box.holds(cell); });
		EXPECT_TRUE(isFound) << border;
	}
}

// Tips that meet on the border between two rows of cells, or a rounding beside it: no row may lose either of them.
TEST(PlaneGrid, FindsTipsThatMeetOnTheBorderOfACell)
{
	constexpr int cells = 19;  // along a side: of 400 triangles
	for (const double size : {7.3, 1.1, 0.37, 113.7})
		for (const double low : {-3.1, 0.7, 1e3}) {
			std::vector<PlaneTriangle> below, above;
			for (int row = 3; row + 3 < cells; ++row) {
				double y = low + size * row / cells;
				for (int n = 0; n < 4; ++n) y = std::nextafter(y, -1e9);
				for (int n = -4; n <= 4; ++n, y = std::nextafter(y, 1e9)) {
					const vcg::Point2d tip(low + size * 0.49, y);
					const double wide = size * 0.2, high = size * 0.15;
					below.push_back({tip, tip + vcg::Point2d(-wide, -high), tip + vcg::Point2d(wide, -high)});
					above.push_back({tip, tip + vcg::Point2d(wide, high), tip + vcg::Point2d(-wide, high)});
				}
			}
			const size_t count = below.size();
			below.push_back({vcg::Point2d(low, low), vcg::Point2d(low + size, low), vcg::Point2d(low, low + size)});
			below.push_back({vcg::Point2d(low + size, low + size), below.back()[1], below.back()[2]});
			while (below.size() < (cells + 1) * (cells + 1)) below.push_back({below[0][0], below[0][0], below[0][0]});
			PlaneGrid grid(below);
			for (size_t i = 0; i < count; ++i) {
				bool isFound = false;
				grid.query(above[i], 0, [&](int k) { isFound = isFound || k == int(i); });
				EXPECT_TRUE(isFound) << "size " << size << " low " << low << " at " << above[i][0][1];
			}
		}
}

TEST(PlaneGrid, HoldsTrianglesThatAllMeet)
{
	constexpr size_t count = 60000;  // each in half of 244 x 244 cells: more than an int counts
	const PlaneTriangle half = {vcg::Point2d(-1, -1), vcg::Point2d(1, -1), vcg::Point2d(-1, 1)};
	PlaneGrid grid(std::vector<PlaneTriangle>(count, half));
	size_t found = 0;
	grid.query(half, 0, [&](int) { ++found; });
	EXPECT_EQ(found, count);
}

}  // namespace
