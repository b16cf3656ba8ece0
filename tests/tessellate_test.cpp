// Regions to triangles: areas add up, no point is added, every edge is where it belongs, flat needles only where nothing else is.

#include "vcg_ext/contour_check.h"
#include "vcg_ext/tessellate.h"

#include <gtest/gtest.h>
#include <map>
#include <random>

namespace {

using namespace vcg::textlabel;
using vcg::Point2d;
using vcg::Point3d;

struct Region {
	std::vector<Point2d> points;
	PolylineSet rings;

	Region& ring(const std::vector<Point2d>& ring)
	{
		for (const Point2d& p : ring) {
			rings.add(int(points.size()));
			points.push_back(p);
		}
		rings.close();
		return *this;
	}
	std::vector<Point3d> inSpace(double slope = 0) const
	{
		std::vector<Point3d> space;
		for (const Point2d& p : points) space.emplace_back(p[0], p[1], slope * p[0]);
		return space;
	}
};

double TwiceArea(const Region& r)
{
	double sum = 0;
	for (int i = 0; i < r.rings.size(); ++i) {
		std::vector<Point2d> ring;
		for (const int* p = r.rings.begin(i); p != r.rings.end(i); ++p) ring.push_back(r.points[size_t(*p)]);
		sum += TwiceSignedArea(ring);
	}
	return sum;
}

std::vector<IndexTriangle> Triangulate(const Region& r, double slope = 0, double finest = 0)
{
	std::vector<IndexTriangle> triangles;
	Tessellator(finest).triangulate(r.points, r.inSpace(slope), r.rings, 0, r.rings.size(), triangles);
	return triangles;
}

/// Positive triangles that tile the region; the edges of the rings are there once, in their direction, all others twice.
void ExpectTriangulation(const Region& r, const std::vector<IndexTriangle>& triangles)
{
	EXPECT_EQ(int(triangles.size()), int(r.rings.ids.size()) + 2 * (r.rings.size() - 1) - 2);
	double sum = 0;
	std::map<std::pair<int, int>, int> edges;
	for (const IndexTriangle& t : triangles) {
		const Point2d &a = r.points[size_t(t[0])], &b = r.points[size_t(t[1])], &c = r.points[size_t(t[2])];
		EXPECT_GT(Orient2d(a, b, c), 0);
		sum += (b - a) ^ (c - a);
		for (size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
	}
	EXPECT_NEAR(sum, TwiceArea(r), 1e-12 * std::abs(TwiceArea(r)));
	int border = 0;
	for (int i = 0; i < r.rings.size(); ++i)
		for (const int *a = r.rings.end(i) - 1, *b = r.rings.begin(i); b != r.rings.end(i); a = b++, ++border) {
			EXPECT_EQ((edges[{*a, *b}]), 1) << "border edge";
			EXPECT_EQ((edges[{*b, *a}]), 0) << "border edge from the wrong side";
		}
	int inner = 0;
	for (const auto& [edge, count] : edges) {
		EXPECT_LE(count, 1);
		const auto back = edges.find({edge.second, edge.first});
		if (count == 1 && back != edges.end() && back->second == 1) ++inner;
	}
	EXPECT_EQ(int(triangles.size()) * 3, border + inner);
}

std::vector<Point2d> Polygon(int n, double radius, double turn = 0)
{
	std::vector<Point2d> p;
	for (int i = 0; i < n; ++i)
		p.emplace_back(radius * std::cos(turn + 2 * M_PI * i / n), radius * std::sin(turn + 2 * M_PI * i / n));
	return p;
}

std::vector<Point2d> Reversed(std::vector<Point2d> p)
{
	std::reverse(p.begin(), p.end());
	return p;
}

TEST(Tessellate, ConvexConcaveAndHoled)
{
	const std::vector<Point2d> comb = {{0, 0}, {9, 0}, {9, 5}, {8, 1}, {7, 5}, {6, 1},
	                                   {5, 5}, {4, 1}, {3, 5}, {2, 1}, {1, 5}, {0.5, 1}};
	for (const Region& r : {Region().ring(Polygon(3, 1)), Region().ring(Polygon(4, 1)), Region().ring(Polygon(100, 1)),
	                        Region().ring(comb), Region().ring(Polygon(30, 5)).ring(Reversed(Polygon(17, 2, 0.1))),
	                        Region()
	                            .ring({{0, 0}, {20, 0}, {20, 10}, {0, 10}})
	                            .ring(Reversed({{2, 2}, {4, 2}, {4, 4}, {2, 4}}))
	                            .ring(Reversed({{6, 2}, {8, 2}, {8, 8}, {6, 8}}))})
		for (const double slope : {0.0, 7.0}) ExpectTriangulation(r, Triangulate(r, slope));
}

// Points that lie on one straight edge, as neighbours' contours leave them: no triangle may be flat.
TEST(Tessellate, CollinearBorderPoints)
{
	std::vector<Point2d> border;
	for (int i = 0; i < 40; ++i) border.emplace_back(i, 0);
	for (int i = 0; i < 40; ++i) border.emplace_back(40 - i, i);
	for (int i = 40; i > 0; --i) border.emplace_back(0, i);
	ExpectTriangulation(Region().ring(border), Triangulate(Region().ring(border)));
	const Region holed = Region().ring(border).ring(Reversed({{5, 5}, {8, 5}, {8, 8}, {5, 8}}));
	ExpectTriangulation(holed, Triangulate(holed));
}

TEST(Tessellate, RandomStars)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> radius(0.2, 1);
	for (int n = 0; n < 300; ++n) {
		Region r;
		std::vector<Point2d> star = Polygon(5 + n % 60, 1, 0.01 * n);
		for (Point2d& p : star) p *= radius(random);
		r.ring(star);
		if (n % 2 == 0) r.ring(Reversed(Polygon(3 + n % 7, 0.1)));
		ExpectTriangulation(r, Triangulate(r));
	}
}

// A region that meets itself in a corner, as a contour that touches the border from within leaves it.
TEST(Tessellate, RegionThatTouchesItself)
{
	Region r;
	r.points = {{0, 0}, {4, 0}, {12, 0}, {0, 12}, {5, 2}, {4, 4}, {3, 2}};
	for (const int id : {0, 1, 6, 5, 4, 1, 2, 3}) r.rings.add(id);
	r.rings.close();
	std::vector<IndexTriangle> triangles;
	Tessellator().triangulate(r.points, r.inSpace(), r.rings, 0, 1, triangles);
	EXPECT_EQ(triangles.size(), 6u);
	double sum = 0;
	for (const IndexTriangle& t : triangles) {
		const Point2d& a = r.points[size_t(t[0])];
		const double area = (r.points[size_t(t[1])] - a) ^ (r.points[size_t(t[2])] - a);
		EXPECT_GT(area, 0);
		sum += area;
	}
	EXPECT_NEAR(sum, 2 * 68, 1e-12);
}

TEST(Tessellate, RefusesWhatCrossesItself)
{
	const Region bow = Region().ring({{0, 0}, {4, 4}, {4, 0}, {0, 3}});
	EXPECT_THROW(Triangulate(bow), WalkConflict);
	const Region crossed =
		Region().ring({{0, 0}, {9, 0}, {9, 9}, {0, 9}}).ring(Reversed({{5, 5}, {12, 5}, {12, 6}, {5, 6}}));
	EXPECT_THROW(Triangulate(crossed), WalkConflict);
	EXPECT_THROW(Triangulate(Region().ring({{0, 0}, {4, 4}})), WalkConflict) << "there and back";
	EXPECT_THROW(Triangulate(Region().ring({{0, 0}})), WalkConflict);
}

// Flipping makes the worst triangle of a long strip better than a fan would.
TEST(Tessellate, FlipsNeedlesAway)
{
	std::vector<Point2d> strip;
	constexpr int n = 30;
	for (int i = 0; i <= n; ++i) strip.emplace_back(i, 0);
	for (int i = n; i >= 0; --i) strip.emplace_back(i, 1);
	const Region r = Region().ring(strip);
	double worst = 2;
	for (const IndexTriangle& t : Triangulate(r)) worst = std::min(worst, Quality(r.inSpace(), t, 0));
	EXPECT_GT(worst, 1.09) << "half a square has 1.25";
}

// A contour that turns a little just before it leaves a long triangle: the corner there is a better-shaped ear than the needle to the
// far end of the region, but one that rounding can turn round.
TEST(Tessellate, LeavesNothingTooFine)
{
	constexpr double finest = 0.01;
	for (const int farPoints : {1, 2, 6, 40}) {  // by a quad's diagonal, by ears, by GLU
		std::vector<Point2d> ring = {{0, 0}, {2, 0}, {2.13, 0.003}};
		const Point2d middle(-48, 36), outward(-0.8, 0.6), across(-0.6, -0.8);
		for (int i = 1; i <= farPoints; ++i) {
			const double turn = M_PI * i / (farPoints + 1);
			ring.push_back(middle + outward * (4 * std::sin(turn)) - across * (4 * std::cos(turn)));
		}
		const Region r = Region().ring(ring);
		const auto lowest = [&](const std::vector<IndexTriangle>& triangles) {
			ExpectTriangulation(r, triangles);
			double least = 1;
			for (const IndexTriangle& t : triangles) least = std::min(least, Quality(r.inSpace(), t, finest));
			return least;
		};
		if (farPoints <= 2) { EXPECT_LT(lowest(Triangulate(r)), 1) << farPoints; }
		EXPECT_GE(lowest(Triangulate(r, 0, finest)), 1) << farPoints;
	}
}

bool IsGood(const std::vector<Point2d>& ring)
{
	Outline outline;
	outline.partCount = 1;
	outline.contours.push_back({ring, 0, 0});
	try {
		RequireGoodOutline(outline);
	} catch (const Error&) {
		return false;
	}
	return true;
}

// Whatever the ring: ears and GLU alike tile it with counter-clockwise triangles, also where corners are straight. Of points
// thrown on a coarse grid, those orders count that make a simple ring.
TEST(Tessellate, SmallRingsByEars)
{
	std::mt19937 random(7);
	std::uniform_int_distribution<int> corners(4, 9), place(0, 5);
	int made = 0;
	for (int i = 0; i < 60000; ++i) {
		std::vector<Point2d> ring;
		for (int k = corners(random); k > 0; --k) ring.emplace_back(place(random), place(random));
		if (TwiceSignedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
		if (!IsGood(ring)) continue;
		++made;
		const Region r = Region().ring(ring);
		ExpectTriangulation(r, Triangulate(r));
	}
	EXPECT_GT(made, 5000);
}

TEST(Quality, IsSquareOfHeightOverLongestEdge)
{
	const std::vector<Point3d> q = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(3.0) / 2, 0}, {0.25, 0, 0}};
	EXPECT_NEAR(Quality(q, {0, 1, 2}, 0), 1.75, 1e-15);
	EXPECT_NEAR(Quality(q, {2, 0, 1}, 0.5), 1.75, 1e-15);
	EXPECT_EQ(Quality(q, {0, 1, 3}, 0.5), 0);
	EXPECT_EQ(Quality(q, {1, 1, 1}, 0), 0);
	EXPECT_NEAR(Quality(q, {0, 1, 2}, std::sqrt(3.0)), 0.25, 1e-15) << "half as high as the finest";
}

}  // namespace
