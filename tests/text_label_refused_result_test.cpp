// Every error of what would come out: letters too fine, too deep or too high, and the mesh as it was.

#include "refusal_case.h"

namespace {

using namespace refusal_case;
using test_mesh::Shape;

TEST(Refusal, LettersFinerThanTheCoordinates)
{
	// at 1e6 float32 goes in steps of 1/16
	const Shape far = Plate().moved([](const Point3d& p) { return p + Point3d(1e6, 1e6, 0); });
	LabelFrame frame;
	frame.origin = {1e6, 1e6, 0};
	const Error e = Refused(far, Letters({Rectangle(-5, -2, -3, 2), Rectangle(0, -1, 0.25, 1)}), frame, 1);
	EXPECT_CODE(e, TooFine);
	EXPECT_GT(e.limit, e.value);
	EXPECT_GE(e.letter, 0);
}

TEST(Refusal, DeeperThanTheWall)
{
	const Shape thin = test_mesh::Slab(30, 20, 1.25, 15, 10);
	for (const ExtrudeAlong along : {ExtrudeAlong::Viewpoint, ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal})
		for (const double height : {-1.25, -1.3, -4.0}) {
			const Error e = Refused(thin, ThreeLetters(), {}, height, along);
			EXPECT_CODE(e, HitsSurface);
			EXPECT_EQ(e.value, -height);
			EXPECT_NEAR(e.limit, 1.25, 0.01) << "height " << height << " along " << int(along);
			EXPECT_GE(e.letter, 0);
		}
}

// A floor that would leave less of the wall than the coordinates carry comes out behind, too.
TEST(Refusal, DeeperThanWhatMustStayOfTheWall)
{
	const Shape thin = test_mesh::Slab(30, 20, 1.25, 15, 10);
	for (const ExtrudeAlong along : {ExtrudeAlong::Viewpoint, ExtrudeAlong::LabelNormal}) {
		const Error e = Refused(thin, ThreeLetters(), {}, -1.249998, along);
		EXPECT_CODE(e, HitsSurface);
		EXPECT_LT(e.limit, e.value);
		EXPECT_NEAR(e.limit, 1.25, 1e-4);
	}
}

// The limit that is told leaves of the wall what must stay.
TEST(Refusal, TheDepthThatIsToldWorks)
{
	for (const double offset : {0.0, 4000.0}) {
		const Shape thin = test_mesh::Slab(30, 20, 1.25, 15, 10).moved([&](const Point3d& p) {
			return p + Point3d(offset, offset, 0);
		});
		LabelFrame frame;
		frame.origin = {offset, offset, 0};
		const Error e = Refused(thin, ThreeLetters(), frame, -1.25);
		EXPECT_CODE(e, HitsSurface);
		FloatMesh m;
		test_mesh::Fill(m, thin);
		LabelOptions options;
		options.height = -e.limit;
		EXPECT_NO_THROW(LabelMesh(m, ThreeLetters(), frame, options)) << e.limit;
	}
}

// A shelf above the plate, at z from 2 to 3 over y from 9 to 15; seen slantwise the letter at y from 9.5 to 10.6 lies in under it.
TEST(Refusal, IntoTheCeiling)
{
	const Shape shelf = test_mesh::Box(30, 6, 1).moved([](const Point3d& p) { return p + Point3d(0, 12, 3); });
	const Shape both = test_mesh::Box(30, 30, 4).joined(shelf);
	const LabelFrame slanted = FrameFromDirection({0, 5, 0}, {0, -1, 1}, {0, 1, 0});
	const Outline letter = Letters({Rectangle(-3, 3.2, 3, 3.95)});
	for (const double height : {2.0, 2.5, 8.0}) {
		const Error e = Refused(both, letter, slanted, height, ExtrudeAlong::SurfaceNormal);
		EXPECT_CODE(e, HitsSurface);
		EXPECT_EQ(e.value, height);
		EXPECT_NEAR(e.limit, 2, 0.01);
		EXPECT_EQ(e.letter, 0);
		EXPECT_GE(e.face, 12) << "the face that is met is one of the shelf";
	}
	FloatMesh m;
	test_mesh::Fill(m, both);
	const Shape before = test_mesh::ToShape(m);
	LabelOptions options;
	options.height = 1.99;
	options.along = ExtrudeAlong::SurfaceNormal;
	LabelMesh(m, letter, slanted, options);
	ExpectSameKind(before, m);
}

// A box is sunk into a slab, neither knows of the other. Letters stand on the slab and on the box; the one on the box, sunk deeper
// than the slab's top, would cross it.
TEST(Refusal, OverTwoShells)
{
	const Shape slab = test_mesh::Slab(30, 20, 4, 60, 40),
				box = test_mesh::Slab(4, 6, 2, 8, 12).moved([](const Point3d&p) { return p + Point3d(5, 0, 1); });
	const Outline letters = Letters({Rectangle(-1.75, -1.75, 1.75, 1.75), Rectangle(4.25, -1.75, 5.75, 1.75),
	                                 Rectangle(-7.75, -4.75, -3.25, 4.75), Rectangle(8.25, -4.75, 9.75, 4.75)});
	for (const auto& both : {slab.joined(box), box.joined(slab)}) {
		const Error e = Refused(both, letters, {}, -1.5);
		EXPECT_CODE(e, HitsSurface);
		EXPECT_NEAR(e.limit, 1, 0.01);
	}
}

TEST(Refusal, ADepthFinerThanTheCoordinates)
{
	const Error e = Refused(Plate().moved([](const Point3d& p) { return p + Point3d(0, 0, 100); }), ThreeLetters(),
	                        FrameFromDirection({0, 0, 100}, {0, 0, 1}, {0, 1, 0}), 1e-6);
	EXPECT_CODE(e, BadHeight);
	EXPECT_EQ(e.value, 1e-6);
	EXPECT_GT(e.limit, 1e-6);
}

// Towards C only so far as C is away: from the vertices of the plate under the letter that is 10.05 and more.
TEST(Refusal, RaisedPastTheCamera)
{
	for (const double height : {10.5, 12.0, 25.0}) {
		const Error e = Refused(Plate(), Letters({Rectangle(-3, -3, 3, 3)}), FromAbovePerspective(10), height);
		EXPECT_CODE(e, BehindCamera);
		EXPECT_EQ(e.value, height);  // the height is what is wrong
	}
}

// Raised along the label's normal towards a wide-angle camera, the top leaves the cone of sight: at (7, 8) it is seen where the
// label plane has 35. There its wall meets a box that hovers far from the letter's outline as C sees it.
TEST(Refusal, RaisedIntoWhatIsSeenElsewhere)
{
	const Shape hovering = test_mesh::Box(1, 1, 0.5).moved([](const Point3d& p) { return p + Point3d(8, 0, 7.5); });
	const Shape both = Plate().joined(hovering);
	for (const ExtrudeAlong along : {ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal}) {
		const Error e = Refused(both, Letters({Rectangle(6, -2, 8, 2)}), FromAbovePerspective(10), 8, along);
		EXPECT_CODE(e, HitsSurface);
		EXPECT_NEAR(e.limit, 7, 0.02);
		EXPECT_GE(e.face, int(Plate().faces.size()));
	}
}

TEST(Refusal, FoldsInAGroove)
{
	const Shape groove = test_mesh::Groove();
	const Outline letter = Letters({Rectangle(-3.3, -4, 3.1, 4)});
	const Error e = Refused(groove, letter, {}, 7, ExtrudeAlong::SurfaceNormal);
	EXPECT_TRUE(e.code == ErrorCode::HitsItself || e.code == ErrorCode::HitsSurface) << int(e.code) << ' ' << e.what();
	EXPECT_EQ(e.value, 7);
	EXPECT_GT(e.limit, 2);
	EXPECT_LT(e.limit, 5.1);
	// what is said to work does work
	FloatMesh m;
	test_mesh::Fill(m, groove);
	const Shape before = test_mesh::ToShape(m);
	LabelOptions options;
	options.height = e.limit;
	options.along = ExtrudeAlong::SurfaceNormal;
	EXPECT_NO_THROW(LabelMesh(m, letter, FromAbove(), options));
	ExpectSameKind(before, m);
}

/// A plate with one more triangle, which belongs to nothing.
Shape WithTriangle(Shape s, const Point3d& a, const Point3d& b, const Point3d& c)
{
	const int first = s.add(a), second = s.add(b), third = s.add(c);
	s.faces.push_back({first, second, third});
	return s;
}

// Seen edge-on a sheet hides nothing and has no thickness behind it; the letters may run into it all the same.
TEST(Refusal, IntoASheetThatIsSeenEdgeOn)
{
	const Outline letter = Letters({Rectangle(-3.2, -3.1, 3.3, 3.4)});
	for (const double height : {2.0, -2.0}) {
		const double near = std::copysign(0.75, height), far = std::copysign(3.0, height);
		const Shape sheet = WithTriangle(Plate(), {0.3, -1.2, near}, {0.3, 1.1, near}, {0.3, 0.2, far});
		for (const ExtrudeAlong along :
		     {ExtrudeAlong::Viewpoint, ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal}) {
			const Error e = Refused(sheet, letter, {}, height, along);
			EXPECT_CODE(e, HitsSurface);
			EXPECT_EQ(e.face, int(sheet.faces.size()) - 1);
			EXPECT_NEAR(e.limit, 0.75, 0.01) << "height " << height << " along " << int(along);
		}
		FloatMesh m;
		test_mesh::Fill(m, sheet);
		LabelOptions options;
		options.height = height / 4;
		EXPECT_NO_THROW(LabelMesh(m, letter, FromAbove(), options)) << height;
	}
}

// The same where the sheet lies in a plane through C and reaches behind it.
TEST(Refusal, IntoASheetThatIsSeenEdgeOnAndReachesBehindTheCamera)
{
	const Shape sheet = WithTriangle(Plate(), {0.5, 0, 0.25}, {1, 0, 0.25}, {0.7, 0, 30});
	const Outline letter = Letters({Rectangle(-1.6, -1.7, 1.5, 1.4)});
	const Error e = Refused(sheet, letter, FromAbovePerspective(20), 0.5);
	EXPECT_CODE(e, HitsSurface);
	EXPECT_EQ(e.face, int(sheet.faces.size()) - 1);
	EXPECT_NEAR(e.limit, 0.25, 0.01);
	FloatMesh m;
	test_mesh::Fill(m, sheet);
	LabelOptions options;
	options.height = 0.2;
	EXPECT_NO_THROW(LabelMesh(m, letter, FromAbovePerspective(20), options));
}

// A pillar that sticks through the plate beside the letter was wrong before; that it leans into the letter's way is not.
TEST(Refusal, IntoWhatCrossedThePartElsewhere)
{
	const Shape both =
		WithTriangle(test_mesh::Box(60, 60, 4).moved([](const Point3d& p) { return p + Point3d(0, -20, 0); }),
	                 {9, -0.5, -1}, {9, 0.5, -1}, {7.5, 0, 9});
	const Outline letter = Letters({Rectangle(6, -2, 8, 2)});
	const Error e = Refused(both, letter, FromAbovePerspective(10), 8, ExtrudeAlong::LabelNormal);
	EXPECT_CODE(e, HitsSurface);
	EXPECT_EQ(e.face, int(both.faces.size()) - 1);
	EXPECT_NEAR(e.limit, -1 + 10 * (9 - 8) / 1.5, 0.1);  // where it is at x = 8
}

}  // namespace
