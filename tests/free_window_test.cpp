// Free windows and depth images against counting pixel by pixel and against closed forms.

#include "filter_textlabel/free_window.h"

#include <gtest/gtest.h>
#include <random>

namespace textlabel::test {
namespace {

using vcg::Point3d;

const ViewAxes fromAbove{Point3d(1, 0, 0), Point3d(0, 1, 0), Point3d(0, 0, 1)};

PixelGrid UnitGrid(int width, int height)
{
	PixelGrid grid;
	grid.width = width;
	grid.height = height;
	return grid;
}

FreeArea RandomArea(int width, int height, double blockedShare, unsigned seed)
{
	std::mt19937 random(seed);
	FreeArea area(width, height);
	for (int y = 0; y < height; ++y)
		for (int x = 0; x < width; ++x)
			if (double(random()) < blockedShare * double(std::mt19937::max())) area.block(x, y);
	area.sumUp();
	return area;
}

bool IsFreeByCounting(const FreeArea& area, int x0, int y0, int x1, int y1)
{
	for (int y = y0; y <= y1; ++y)
		for (int x = x0; x <= x1; ++x)
			if (x < 0 || y < 0 || x >= area.width() || y >= area.height() || !area.isFree(x, y)) return false;
	return true;
}

TEST(FreeWindow, SumsAgreeWithCounting)
{
	const FreeArea area = RandomArea(17, 11, 0.05, 1);
	for (int y0 = -1; y0 < 12; ++y0)
		for (int x0 = -1; x0 < 18; ++x0)
			for (int y1 = y0; y1 < 12; ++y1)
				for (int x1 = x0; x1 < 18; ++x1)
					ASSERT_EQ(area.isWindowFree(x0, y0, x1, y1), IsFreeByCounting(area, x0, y0, x1, y1));
}

TEST(FreeWindow, NoneIsLargerThanTheOneFound)
{
	constexpr double width = 3, height = 1, slack = 0.1;
	for (unsigned seed = 0; seed < 40; ++seed) {
		const FreeArea area = RandomArea(60, 40, 0.01, seed);
		const std::optional<FreeWindow> found = LargestFreeWindow(area, width, height, slack, 1);
		ASSERT_TRUE(found);
		const auto fits = [&](int x, int y, double scale) {  // every pixel that the window touches
			const double dx = scale * width / 2, dy = scale * height / 2;
			return IsFreeByCounting(area, int(std::ceil(x - dx - 0.5)), int(std::ceil(y - dy - 0.5)),
			                        int(std::floor(x + dx + 0.5)), int(std::floor(y + dy + 0.5)));
		};
		EXPECT_TRUE(fits(found->x, found->y, found->scale)) << "seed " << seed;
		const double given = std::max(found->scale / (1 - slack), found->scale + 1 / height);
		for (int y = 0; y < area.height(); ++y)
			for (int x = 0; x < area.width(); ++x) ASSERT_FALSE(fits(x, y, given + 1)) << "seed " << seed;
	}
}

TEST(FreeWindow, LiesInTheMiddleOfWhereItCanSlide)
{
	FreeArea area(101, 31);
	area.sumUp();
	const std::optional<FreeWindow> found = LargestFreeWindow(area, 2, 1, 0.03, 1);
	ASSERT_TRUE(found);
	EXPECT_EQ(found->x, 50);
	EXPECT_EQ(found->y, 15);
}

/// Two triangles that share a diagonal through many pixel centres, turned in all ways.
TEST(DepthImage, NoPixelFallsBetweenTwoTriangles)
{
	for (const double tilt : {0.0, 0.3, 7.0}) {
		const auto corner = [&](double x, double y) { return Point3d(x, y, tilt * x - y); };
		const std::vector<Point3d> square{corner(0, 0), corner(30, 0), corner(30, 30), corner(0, 30)};
		for (const bool otherDiagonal : {false, true}) {
			using Faces = std::vector<std::array<int, 3>>;
			const Faces faces = otherDiagonal ? Faces{{0, 1, 3}, {1, 2, 3}} : Faces{{0, 1, 2}, {0, 2, 3}};
			const Part part = MakePart(square, faces);
			PixelGrid grid = UnitGrid(31, 31);
			grid.left = grid.bottom = -15;
			const DepthImage image = Look(part, fromAbove, grid);
			for (int y = 0; y <= 30; ++y)
				for (int x = 0; x <= 30; ++x) {
					ASSERT_GE(image.face[grid.at(x, y)], 0) << x << " " << y;
					EXPECT_NEAR(image.depth[grid.at(x, y)] + part.center[2], corner(x, y)[2], 1e-9);
				}
		}
	}
}

/// The covered pixels of any triangle are those whose centre is inside by the signs of three areas.
TEST(DepthImage, CoversWhatIsInside)
{
	std::mt19937 random(7);
	std::uniform_real_distribution<double> place(-10, 50);
	const PixelGrid grid = UnitGrid(40, 30);
	for (int round = 0; round < 500; ++round) {
		const Point3d a(place(random), place(random), 1), b(place(random), place(random), 1),
			c(place(random), place(random), 1);
		std::vector<int> covered(40 * 30, 0);
		detail::CoverTriangle(grid, a, b, c, [&](size_t at, double) { ++covered[at]; });
		const auto side = [](const Point3d& p, const Point3d& q, double x, double y) {
			return (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) > 0;
		};
		for (int y = 0; y < 30; ++y)
			for (int x = 0; x < 40; ++x) {
				const bool left = side(a, b, x, y), isInside = left == side(b, c, x, y) && left == side(c, a, x, y);
				ASSERT_EQ(covered[grid.at(x, y)], isInside ? 1 : 0) << "round " << round << " at " << x << " " << y;
			}
	}
}

/// A square at z = 0, and beside it one that starts at the same height or 4 higher, and ends at z = 4.
FreeArea AreaOfTwoSquares(double startsAt)
{
	const std::vector<Point3d> points{Point3d(0, 0, 0),   Point3d(10, 0, 0),        Point3d(10, 20, 0),
	                                  Point3d(0, 20, 0),  Point3d(10, 0, startsAt), Point3d(20, 0, 4),
	                                  Point3d(20, 20, 4), Point3d(10, 20, startsAt)};
	const Part part = MakePart(points, {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}});
	PixelGrid grid = UnitGrid(20, 20);
	grid.left = grid.bottom = -9.5;
	return FindFreeArea(part, Look(part, fromAbove, grid), {1, 0.1, true});
}

TEST(FreeArea, AStepBlocksBothItsSidesAndACreaseNone)
{
	EXPECT_TRUE(AreaOfTwoSquares(0).isWindowFree(0, 0, 19, 19));
	const FreeArea step = AreaOfTwoSquares(4);
	for (int y = 0; y < 20; ++y)
		for (int x = 0; x < 20; ++x) EXPECT_EQ(step.isFree(x, y), x != 9 && x != 10) << x << " " << y;
}

TEST(FreeArea, ABackIsNotFree)
{
	const std::vector<Point3d> square{Point3d(0, 0, 0), Point3d(8, 0, 0), Point3d(8, 8, 0), Point3d(0, 8, 0)};
	for (const bool isFront : {true, false}) {
		const Part part = isFront ? MakePart(square, {{0, 1, 2}, {0, 2, 3}}) : MakePart(square, {{0, 2, 1}, {0, 3, 2}});
		PixelGrid grid = UnitGrid(7, 7);
		grid.left = grid.bottom = -3;
		const DepthImage image = Look(part, fromAbove, grid);
		for (const bool trustNormals : {true, false})
			EXPECT_EQ(FindFreeArea(part, image, {1, 0.1, trustNormals}).isWindowFree(3, 3, 3, 3), isFront);
	}
}

}  // namespace
}  // namespace textlabel::test
