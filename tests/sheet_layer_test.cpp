// The layer of a label: single where the surface lies over the box like one sheet of paper, and nowhere else.

#include "vcg_ext/sheet_layer.h"

#include <gtest/gtest.h>

#include "label_check.h"
#include "vcg_ext/label_seed.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

struct Layered {
	LabelSpace space;
	Sheet sheet;
	SheetLayer layer;

	Layered(const Shape& shape, double halfWidth, double halfHeight, const LabelFrame& frame = FromAbove())
		: space(frame), sheet(CandidatesOf(shape, space, halfWidth, halfHeight)),
		  layer(FindLayer(sheet, Letters({Rectangle(-1, -1, 1, 1)}),
	                      FindSeeds(space, sheet, Letters({Rectangle(-1, -1, 1, 1)}), 1e-6)))
	{}
	int members() const { return int(std::count(layer.member.begin(), layer.member.end(), 1)); }
};

PlaneBox Between(const Point2d& low, const Point2d& high)
{
	PlaneBox box;
	box.add(low);
	box.add(high);
	return box;
}

TEST(Layer, TheTopOfASlabIsSingle)
{
	const Layered l(test_mesh::Slab(30, 20, 4, 15, 10), 8, 6);
	EXPECT_TRUE(l.layer.isWhole());
	for (size_t t = 0; t < l.sheet.triangles.size(); ++t) EXPECT_EQ(l.layer.has(int(t)), l.sheet.triangles[t].facing);
	EXPECT_GT(l.members(), 0);
}

// The middle of a needle under a letter lies far beyond the letter.
TEST(Layer, ATopOfNeedlesIsSingle) { EXPECT_TRUE(Layered(test_mesh::Fan(300, 40, 4), 8, 6).layer.isWhole()); }

TEST(Layer, IsNotSingleAtAnEdgeOfThePart)
{
	EXPECT_TRUE(Layered(test_mesh::Slab(30, 20, 4, 15, 10), 14.9, 9.9).layer.isWhole());
	const SheetLayer over = Layered(test_mesh::Slab(30, 20, 4, 15, 10), 16, 6).layer;
	EXPECT_TRUE(over.isSingle());
	EXPECT_FALSE(over.isWhole());
	EXPECT_TRUE(over.holds(Between({-11, -5}, {11, 5})));
	EXPECT_FALSE(over.holds(Between({0, 0}, {15.5, 1})));  // over the edge
	EXPECT_FALSE(over.holds(Between({0, 0}, {1, 7})));     // out of the box
	EXPECT_FALSE(over.holds(Between({15.5, 0}, {16, 1})));
}

// A text that nearly fills a round face has corners beyond its rim.
TEST(Layer, IsSingleInTheMiddleOfARoundFace)
{
	const SheetLayer layer = Layered(test_mesh::Fan(300, 20, 4), 16, 16).layer;
	EXPECT_FALSE(layer.isWhole());
	EXPECT_TRUE(layer.holds(Between({-11, -11}, {11, 11})));
	EXPECT_FALSE(layer.holds(Between({13, 13}, {15, 15})));
}

// Where a spiral covers its box once it is single, where it covers it twice it is not: seen for each cell by exact signs.
TEST(Layer, APartThatWindsOverItselfSomewhereIsSingleElsewhere)
{
	for (const double turns : {0.8, 1.2, 1.6, 2.3}) {
		const Shape screw = test_mesh::Helicoid(3, 40, 5, turns, 200, 4);
		const Layered l(screw, 30, 30, FrameFromDirection({0, -20, 50}, {0, 0, 1}, {0, 1, 0}));
		int single = 0;
		for (double x = -29; x < 29; x += 0.7)
			for (double y = -29; y < 29; y += 0.7) {
				const Point2d p(x + 0.01 * std::sin(y), y);
				const bool isHeld = l.layer.holds(Between(p, p));
				single += isHeld;
				if (isHeld) {
					EXPECT_EQ(detail::CountCovers(l.sheet, l.layer, p), 1) << turns << ": " << p[0] << ", " << p[1];
				}
			}
		if (turns < 2) {
			EXPECT_GT(single, 400) << turns;
		} else EXPECT_EQ(single, 0);
	}
}

// A screw surface is one piece that covers its box once for each turn.
TEST(Layer, AWindingSurfaceIsNot)
{
	const Shape screw = test_mesh::Helicoid(3, 40, 5, 3, 200, 4);
	const LabelFrame frame = FrameFromDirection({20, 0, 50}, {0, 0, 1}, {0, 1, 0});
	EXPECT_FALSE(Layered(screw, 30, 30, frame).layer.isSingle());
}

TEST(Layer, AnotherShellBelowIsNoMember)
{
	const Shape upper = test_mesh::Slab(30, 20, 1, 15, 10);
	const Shape both = upper.joined(upper.moved([](const Point3d& p) { return p + Point3d(0.3, 0.2, -6); }));
	const Layered l(both, 8, 6);
	EXPECT_TRUE(l.layer.isWhole());
	EXPECT_EQ(l.members(), Layered(upper, 8, 6).members());
}

// Where it is not single it is of no account which triangles were reached.
TEST(Layer, HasNoMembersUnlessItIsSingle)
{
	const Shape screw = test_mesh::Helicoid(3, 40, 5, 3, 200, 4);
	const Layered l(screw, 30, 30, FrameFromDirection({20, 0, 50}, {0, 0, 1}, {0, 1, 0}));
	ASSERT_FALSE(l.layer.isSingle());
	EXPECT_GT(l.members(), 0);
	for (int t = 0; t < int(l.sheet.triangles.size()); ++t) EXPECT_FALSE(l.layer.has(t));
}

}  // namespace
