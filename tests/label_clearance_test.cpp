// The room behind a label and what hides it, on parts whose walls are known.

#include "vcg_ext/label_clearance.h"

#include <gtest/gtest.h>

#include "label_check.h"

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

}  // namespace
