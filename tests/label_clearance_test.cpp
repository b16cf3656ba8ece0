// The room behind a label and what hides it, on parts whose walls are known.

#include "vcg_ext/label_clearance.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "label_check.h"
#include "vcg_ext/label_seed.h"
#include "vcg_ext/patch_suspects.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

Clearance RoomOf(const CutExample& e) { return MeasureClearance(e.space, e.sheet, e.cut, 1e-6); }

TEST(Clearance, IsTheThicknessAlongTheRay)
{
	const Shape slab = test_mesh::Slab(60, 40, 2.5, 15, 10);
	const Clearance c = RoomOf(CutExample(slab, ThreeLetters(), FromAbove()));
	EXPECT_NEAR(c.behind, 2.5, 1e-9);
	ASSERT_GE(c.face, 0);
	for (const int v : slab.faces[size_t(c.face)]) EXPECT_EQ(slab.points[size_t(v)][2], -2.5);
	EXPECT_NEAR(c.place[2], 0, 1e-9);
	// seen at 45 degrees the wall is longer by the root of 2
	const LabelFrame slanted = FrameFromDirection({0, 0, 0}, {0, -1, 1}, {0, 1, 0});
	EXPECT_NEAR(RoomOf(CutExample(slab, ThreeLetters(), slanted)).behind, 2.5 * std::sqrt(2.0), 1e-6);
	// in perspective the rays are longest at the rim and shortest under the camera: where the letters come next to it
	const Outline aside = Letters({Rectangle(3, -2, 7, 2)});
	const double nearest = std::sqrt(1 + 9.0 / (50 * 50));
	EXPECT_NEAR(RoomOf(CutExample(slab, aside, FromAbovePerspective(50))).behind, 2.5 * nearest, 1e-3);
}

// A wedge: the least thickness under the letters is at their thin end, and not at a vertex of the mesh.
TEST(Clearance, IsTheLeastUnderTheLetters)
{
	const Shape wedge =
		test_mesh::Box(60, 40, 4).moved([](const Point3d& p) { return p[2] < 0 ? p + Point3d(0, 0, p[0] / 10) : p; });
	const Outline letter = Letters({Rectangle(-5, -3, 7, 3), Hole(Rectangle(5, -2, 6, 2))});
	EXPECT_NEAR(RoomOf(CutExample(wedge, letter, FromAbove())).behind, 4 - 0.7, 1e-5);
}

TEST(Clearance, IsInfiniteBehindASheet)
{
	const Shape sheet = test_mesh::Sheet(4, 4, [](int i, int j) { return Point3d(10 * (i - 2), 10 * (j - 2), 0); });
	const Clearance c = RoomOf(CutExample(sheet, ThreeLetters(), FromAbove()));
	EXPECT_EQ(c.behind, std::numeric_limits<double>::infinity());
	EXPECT_EQ(c.face, -1);
}

TEST(Clearance, NamesWhatIsInFront)
{
	const Shape slab = test_mesh::Slab(30, 20, 4, 15, 10);
	const auto with = [&](double x) {
		return slab.joined(test_mesh::Box(0.5, 0.5, 0.5).moved([x](const Point3d& p) { return p + Point3d(x, 0, 3); }));
	};
	const Outline letter = Letters({Rectangle(-4, -4, 4, 4), Hole(Rectangle(-2, -2, 2, 2))});
	try {
		RoomOf(CutExample(with(3), letter, FromAbove()));
		FAIL() << "a box hovers over the letter";
	} catch (const Error& e) {
		EXPECT_EQ(e.code, ErrorCode::Occluded);
		EXPECT_GE(e.face, int(slab.faces.size()));
		EXPECT_NEAR(e.place[0], 3, 0.5);
	}
	EXPECT_NEAR(RoomOf(CutExample(with(0), letter, FromAbove())).behind, 4, 1e-9) << "over the hole it hides nothing";
	EXPECT_NEAR(RoomOf(CutExample(with(4.26), letter, FromAbove())).behind, 4, 1e-9) << "beside the letter, too";
}

// A surface that cuts through that of the letters hides them where it is in front, though another part of it is behind.
TEST(Clearance, NamesWhatIsInFrontInPart)
{
	const Shape box = test_mesh::Box(80, 80, 4).moved([](const Point3d& p) { return p - Point3d(0, 15, 0); });
	for (const double front : {2.0, 3.0, 5.0}) {  // at x = 10; at x = -10 it is behind by 1
		Shape both = box;
		const double tip = -1 + (front + 1) * 2;
		both.faces.push_back({both.add({-10, -15, -1}), both.add({30, 0, tip}), both.add({-10, 15, -1})});
		try {
			RoomOf(CutExample(both, Letters({Rectangle(-9, -1, 9, 1)}), FromAbove()));
			ADD_FAILURE() << "it is in front of most of the letter";
		} catch (const Error& e) {
			EXPECT_EQ(e.code, ErrorCode::Occluded);
			EXPECT_EQ(e.face, int(box.faces.size()));
		}
	}
}

// What is no further apart than the resolution is in one place.
TEST(Clearance, TellsSurfacesApartByTheResolution)
{
	const auto behind = [](double gap) {
		const Shape sheet = test_mesh::Sheet(4, 4, [](int i, int j) { return Point3d(10 * (i - 2), 10 * (j - 2), 0); });
		return RoomOf(CutExample(sheet.joined(sheet.moved([=](const Point3d& p) { return p - Point3d(0, 0, gap); })),
		                         ThreeLetters(), FromAbove()));
	};
	for (const double gap : {0.0, 0.5e-6}) {
		try {
			behind(gap);
			ADD_FAILURE() << gap;
		} catch (const Error& e) {
			EXPECT_EQ(e.code, ErrorCode::Occluded);
		}
	}
	EXPECT_NEAR(behind(2e-6).behind, 2e-6, 1e-12);
}

// On spirals that wind over themselves in a part of the label's box: what the layer says need not be compared has nothing to find.
TEST(Clearance, ALayerChangesNothing)
{
	std::mt19937 random(9);
	const auto pick = [&](double low, double high) {
		return std::uniform_real_distribution<double>(low, high)(random);
	};
	int partial = 0, hidden = 0;
	for (int round = 0; round < 200; ++round) {
		const double turns = pick(0.9, 1.9), angle = pick(0, 6.28), r = pick(6, 18), wide = pick(8, 25),
					 high = pick(6, 25);
		const Shape screw = test_mesh::Helicoid(pick(1, 4), pick(20, 45), pick(2, 9), turns, 30 + int(pick(0, 150)),
		                                        1 + int(pick(0, 4)));
		const LabelSpace space(FrameFromDirection({r * std::cos(angle), r * std::sin(angle), 20},
		                                          {pick(-0.2, 0.2), pick(-0.2, 0.2), 1}, {0, 1, 0}));
		const Sheet sheet = CandidatesOf(screw, space, wide, high);
		const Outline outline = Moved(ThreeLetters(), pick(0.1, 0.5), pick(0, 6), 0.1, 0.05);
		try {
			const std::vector<int> seeds = FindSeeds(space, sheet, outline, 1e-6);
			const CutLabel cut = LabelCutter(space, sheet, 1e-6).cut(outline, seeds);
			const SheetLayer layer = FindLayer(sheet, outline, seeds);
			partial += layer.isSingle() && !layer.isWhole();
			const auto room = [&](const SheetLayer& known) {
				try {
					return MeasureClearance(space, sheet, cut, 1e-6, known).behind;
				} catch (const Error& e) {
					EXPECT_EQ(e.code, ErrorCode::Occluded);
					return -1.0;
				}
			};
			const double without = room({});
			hidden += without < 0;
			EXPECT_EQ(room(layer), without) << round;
			std::vector<int> changed = cut.touched;
			changed.insert(changed.end(), cut.within.begin(), cut.within.end());
			std::set<std::array<int, 2>> found;
			for (const auto& pair : detail::FindNearPairs(sheet, layer, changed, 5, 1e-6)) found.insert(pair);
			for (const auto& pair : detail::FindNearPairs(sheet, {}, changed, 5, 1e-6)) {
				const PlaneTriangle a = detail::CornersInPlane(sheet, pair[0]),
									b = detail::CornersInPlane(sheet, pair[1]);
				const bool overlap = !detail::AreApart(a, b, 1e-7) && !detail::AreApart(b, a, 1e-7);
				EXPECT_TRUE(!overlap || found.count(pair)) << round << ": " << pair[0] << ", " << pair[1];
			}
		} catch (const Error&) {  // beside the screw
		} catch (const PlacementConflict&) {}
	}
	EXPECT_GT(partial, 30);
	EXPECT_GT(hidden, 3);
}

}  // namespace
