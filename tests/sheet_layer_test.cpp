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

TEST(Layer, TheTopOfASlabIsSingle)
{
	const Layered l(test_mesh::Slab(30, 20, 4, 15, 10), 8, 6);
	EXPECT_TRUE(l.layer.isSingle);
	for (size_t t = 0; t < l.sheet.triangles.size(); ++t) EXPECT_EQ(l.layer.has(int(t)), l.sheet.triangles[t].facing);
	EXPECT_GT(l.members(), 0);
}

// The middle of a needle under a letter lies far beyond the letter.
TEST(Layer, ATopOfNeedlesIsSingle) { EXPECT_TRUE(Layered(test_mesh::Fan(300, 40, 4), 8, 6).layer.isSingle); }

TEST(Layer, AnEdgeOfThePartInTheBoxIsNot)
{
	EXPECT_FALSE(Layered(test_mesh::Slab(30, 20, 4, 15, 10), 16, 6).layer.isSingle);
	EXPECT_TRUE(Layered(test_mesh::Slab(30, 20, 4, 15, 10), 14.9, 9.9).layer.isSingle);
}

// A screw surface is one piece that covers its box once for each turn.
TEST(Layer, AWindingSurfaceIsNot)
{
	const Shape screw = test_mesh::Helicoid(3, 40, 5, 3, 200, 4);
	const LabelFrame frame = FrameFromDirection({20, 0, 50}, {0, 0, 1}, {0, 1, 0});
	EXPECT_FALSE(Layered(screw, 6, 5, frame).layer.isSingle);
}

TEST(Layer, AnotherShellBelowIsNoMember)
{
	const Shape upper = test_mesh::Slab(30, 20, 1, 15, 10);
	const Shape both = upper.joined(upper.moved([](const Point3d& p) { return p + Point3d(0.3, 0.2, -6); }));
	const Layered l(both, 8, 6);
	EXPECT_TRUE(l.layer.isSingle);
	EXPECT_EQ(l.members(), Layered(upper, 8, 6).members());
}

// Where it is not single it is of no account which triangles were reached.
TEST(Layer, HasNoMembersUnlessItIsSingle)
{
	const Layered l(test_mesh::Slab(30, 20, 4, 15, 10), 16, 6);
	ASSERT_FALSE(l.layer.isSingle);
	EXPECT_GT(l.members(), 0);
	for (int t = 0; t < int(l.sheet.triangles.size()); ++t) EXPECT_FALSE(l.layer.has(t));
}

}  // namespace
