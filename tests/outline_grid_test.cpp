// The tree against looking at everything, and the exact tests on rings whose answers are plain to see.

#include "outline_grid.h"

#include <gtest/gtest.h>
#include <random>
#include <set>
#include "outline_bead.h"
#include "outline_union.h"

using namespace textlabel;

namespace {

Path Square(cInt x, cInt y, cInt size) { return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}; }

TEST(BoxTree, FindsWhatLookingAtEverythingFinds)
{
	std::mt19937 random(1);
	const auto number = [&random](int n) { return static_cast<cInt>(random() % static_cast<unsigned>(n)); };
	for (const int count : {0, 1, 4, 5, 300}) {
		std::vector<FlatBox<cInt>> boxes;
		for (int i = 0; i < count; ++i) {
			const cInt x = number(1000), y = i % 2 ? 0 : number(10);
			boxes.push_back({x, y, x + number(50), y + number(50)});
		}
		const BoxTree<cInt> tree(boxes);
		for (int k = 0; k < 100; ++k) {
			const cInt x = number(1000), y = number(60);
			const FlatBox<cInt> query{x, y, x + number(100), y + number(5)};
			std::set<std::size_t> expected, found;
			for (std::size_t i = 0; i < boxes.size(); ++i) {
				if (boxes[i].meets(query)) expected.insert(i);
			}
			tree.search(query, [&](std::size_t i) { EXPECT_TRUE(found.insert(i).second) << "each once"; });
			EXPECT_EQ(found, expected);
		}
	}
}

TEST(Grid, SoundRings)
{
	const Path a = Square(0, 0, 100), inside = Square(10, 10, 20), beside = Square(101, 0, 50);
	EXPECT_TRUE(AreSound({a, inside, beside}));
	EXPECT_FALSE(AreSound({a, Square(100, 0, 50)})) << "along an edge";
	EXPECT_FALSE(AreSound({a, Square(100, 100, 50)})) << "in a corner";
	EXPECT_FALSE(AreSound({a, Square(50, 50, 100)})) << "crossing";
	EXPECT_FALSE(AreSound({{{0, 0}, {50, 0}, {100, 0}, {100, 100}}})) << "a point on a straight line";
	EXPECT_FALSE(AreSound({{{0, 0}, {100, 0}, {50, 0}, {50, 100}}})) << "a spike";
	EXPECT_FALSE(AreSound({{{0, 0}, {100, 100}, {100, 0}, {0, 100}}})) << "crossing itself";
	EXPECT_FALSE(AreSound({{{0, 0}, {100, 0}, {100, 100}, {50, 0}, {0, 100}}})) << "touching itself";
	EXPECT_FALSE(AreSound({{{0, 0}, {100, 0}}}));
}

TEST(Grid, TheLargestCoordinatesAreExact)
{
	const cInt m = kGridReach;
	EXPECT_EQ(Cross({-m, -m}, {m, m}, {m, m - 1}), -2 * m);
	EXPECT_EQ(Cross({-m, -m}, {m, m}, {0, 0}), 0);
	EXPECT_EQ(Cross({-m, -m}, {m, -m}, {m, m}), 4 * m * m);
}

TEST(Grid, ParentsAreTheSmallestRingsAround)
{
	const Paths rings{Square(10, 10, 20), Square(0, 0, 100), Square(15, 15, 5), Square(50, 50, 10), Square(200, 0, 5)};
	EXPECT_EQ(ParentsOf(rings), (std::vector<int>{1, -1, 0, 1, -1}));
}

TEST(Beads, OnlyWhereItIsTooClose)
{
	EXPECT_TRUE(BeadsOf({Square(0, 0, 1000), Square(1020, 0, 1000)}, 10).empty());
	const Paths gap = BeadsOf({Square(0, 0, 1000), Square(1005, 0, 1000)}, 10);
	ASSERT_FALSE(gap.empty());
	for (const Path& bead : gap) {
		EXPECT_TRUE(ClipperLib::Orientation(bead));
		for (const IntPoint& p : bead) {
			EXPECT_NEAR(static_cast<double>(p.X), 1002.5, 13) << "on the gap";
			EXPECT_GE(p.Y, -11);
			EXPECT_LE(p.Y, 1011);
		}
	}
}

TEST(Beads, CloseTheWholeGap)
{
	// slanted, so that it does not lie on the grid; 5 units wide and 3000 long
	Paths rings{{{0, 0}, {3000, 1000}, {3000, 2000}, {0, 1000}}, {{0, -5}, {0, -1005}, {3000, -5}, {3000, 995}}};
	const Paths beads = BeadsOf(rings, 10);
	rings.insert(rings.end(), beads.begin(), beads.end());
	EXPECT_EQ(CheckedUnion(rings, 1).size(), 1u);
}

TEST(CheckedUnion, AgreesWithCountingWindings)
{
	std::mt19937 random(9);
	const auto number = [&random] { return static_cast<cInt>(random() % 1000000); };
	for (int round = 0; round < 50; ++round) {
		Path ring;
		for (int i = 0; i < 9; ++i) ring.push_back({number(), number()});
		const Paths united = CheckedUnion({ring}, 1);
		for (int k = 0; k < 50; ++k) {
			const IntPoint q(number(), number());
			int winding = 0, inside = 0;
			for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
				if (ring[j].Y <= q.Y && ring[i].Y > q.Y && Cross(ring[j], ring[i], q) > 0) ++winding;
				if (ring[j].Y > q.Y && ring[i].Y <= q.Y && Cross(ring[j], ring[i], q) < 0) --winding;
			}
			for (const Path& path : united) inside += ClipperLib::PointInPolygon(q, path) != 0;
			EXPECT_EQ(inside % 2 == 1, winding != 0) << "round " << round;
		}
	}
}

}  // namespace
