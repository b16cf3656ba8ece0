// The layer of a label: single where the surface lies over the box like one sheet of paper, and nowhere else.

#include "vcg_ext/sheet_layer.h"

#include <gtest/gtest.h>

#include "label_check.h"
#include "vcg_ext/label_seed.h"
#include "vcg_ext/plane_grid.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

struct Layered {
	LabelSpace space;
	Sheet sheet;
	SheetLayer layer;

	Layered(const Shape& shape, double halfWidth, double halfHeight, const LabelFrame& frame = FromAbove())
		: space(frame), sheet(CandidatesOf(shape, space, halfWidth, halfHeight)),
		  layer(FindLayer(sheet, FindSeeds(space, sheet, Letters({Rectangle(-1, -1, 1, 1)}), 1e-6)))
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

TEST(PlaneGrid, FindsWhatTheBruteForceFinds)
{
	std::vector<PlaneBox> boxes;
	const auto box = [](double x, double y, double w, double h) {
		PlaneBox b;
		b.add({x, y});
		b.add({x + w, y + h});
		return b;
	};
	for (int i = 0; i < 400; ++i)
		boxes.push_back(box(7 * std::sin(1.1 * i), 5 * std::cos(2.3 * i), 0.02 * (i % 17), i % 40 == 0 ? 9 : 0.1));
	PlaneGrid grid(boxes);
	for (int q = 0; q < 300; ++q) {
		const PlaneBox around = box(9 * std::cos(0.7 * q), 8 * std::sin(1.9 * q), 0.05 * (q % 30), 0.1 * (q % 7));
		std::vector<int> found, expected;
		grid.query(around, [&](int i) { found.push_back(i); });
		for (int i = 0; i < int(boxes.size()); ++i)
			if (boxes[size_t(i)].meets(around)) expected.push_back(i);
		std::sort(found.begin(), found.end());
		EXPECT_EQ(found, expected) << q;
	}
}

TEST(PlaneGrid, HoldsBoxesThatAllMeet)
{
	PlaneBox whole;
	whole.add({-1, -1});
	whole.add({1, 1});
	constexpr size_t count = 60000;  // each in all of 244 x 244 cells: more than an int counts
	PlaneGrid grid(std::vector<PlaneBox>(count, whole));
	size_t found = 0;
	grid.query(whole, [&](int) { ++found; });
	EXPECT_EQ(found, count);
}

}  // namespace
