// A shell that lies wholly within what a label sweeps along normals: found, with the depth that works; one beside it does no harm.

#include "vcg_ext/swept_volume.h"

#include <gtest/gtest.h>

#include "label_check.h"
#include "vcg_ext/rounding.h"

namespace {

using namespace label_check;
using detail::Whereabouts;
using test_mesh::FloatMesh;
using test_mesh::Shape;

Shape Plate() { return test_mesh::Slab(30, 20, 4, 15, 10); }

/// A closed tetrahedron that reaches from a corner along the axes.
Shape Speck(const Point3d& corner, double size)
{
	Shape s;
	s.points = {corner, corner + Point3d(size, 0, 0), corner + Point3d(0, size, 0), corner + Point3d(0, 0, size)};
	s.faces = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
	return s;
}

/// The same in a solid: its faces look at each other.
Shape Void(const Point3d& corner, double size)
{
	Shape s = Speck(corner, size);
	for (auto& f : s.faces) std::swap(f[1], f[2]);
	return s;
}

/// A label on a part and on something small beside it.
struct Scene {
	Shape part, shell;
	Outline letters;
	LabelFrame frame;
	ExtrudeAlong along;

	Shape whole() const { return part.joined(shell); }
	LabelOptions raisedBy(double height) const
	{
		LabelOptions options;
		options.height = height;
		options.along = along;
		return options;
	}
	Scene with(const Shape& other) const
	{
		Scene s = *this;
		s.shell = other;
		return s;
	}
};

void ExpectAccepted(const Scene& scene, double height)
{
	FloatMesh m;
	test_mesh::Fill(m, scene.whole());
	Error error(ErrorCode::OutOfMemory);
	EXPECT_EQ(Refusal(m, scene.letters, scene.frame, scene.raisedBy(height), &error), "no error") << height;
	ExpectSameKind(scene.whole(), m);
}

/// The label meets the shell; it doesn't when it is raised (or sunk) by less than `room`.
void ExpectRefused(const Scene& scene, double height, double room, double tolerance)
{
	FloatMesh m;
	test_mesh::Fill(m, scene.whole());
	const std::string bytes = test_mesh::Bytes(m);
	Error e(ErrorCode::OutOfMemory, "the label was not refused");
	Refusal(m, scene.letters, scene.frame, scene.raisedBy(height), &e);
	EXPECT_TRUE(test_mesh::Bytes(m) == bytes) << "the mesh was changed";
	ASSERT_EQ(int(e.code), int(ErrorCode::HitsSurface)) << e.what();
	EXPECT_GE(e.face, int(scene.part.faces.size())) << "the face that is met is one of the shell";
	ASSERT_TRUE(e.hasPlace);
	EXPECT_LT((e.place - scene.shell.points[0]).Norm(), 0.5);
	EXPECT_EQ(e.letter, 0);
	EXPECT_EQ(e.value, std::abs(height));
	EXPECT_LT(e.limit, e.value);
	EXPECT_NEAR(e.limit, room, tolerance);
	for (const double part : {0.9, 1.0}) ExpectAccepted(scene, std::copysign(part * e.limit, height));
}

/// A wide view from 10 above a plate: what stands over the letter at x from 6 to 8 is seen far beside it.
Scene WideAngle(const Shape& shell)
{
	return {Plate(), shell, Letters({Rectangle(6, -2, 8, 2), Rectangle(-8, -2, -6, 2)}), FromAbovePerspective(10),
	        ExtrudeAlong::LabelNormal};
}

// At (7, 0, 3) C sees the speck over x = 10 of the label plane.
TEST(SweptVolume, SpeckBesideTheLineOfSight)
{
	Scene scene = WideAngle(Speck({7, 0, 3}, 0.25));
	ExpectRefused(scene, 5, 3, 0.01);
	scene.along = ExtrudeAlong::SurfaceNormal;
	ExpectRefused(scene, 5, 3, 0.01);
	scene.along = ExtrudeAlong::Viewpoint;
	ExpectAccepted(scene, 5);
}

TEST(SweptVolume, SpeckOutsideDoesNoHarm)
{
	for (const Point3d& corner : {Point3d(8.25, 0, 3), Point3d(7, 2.5, 3), Point3d(7, 0, 5.25), Point3d(7, -2.5, 4)})
		ExpectAccepted(WideAngle(Speck(corner, 0.25)), 5);
}

// The box of the volume is no measure: here the speck stands in the hole of the letter.
TEST(SweptVolume, SpeckInTheHoleOfALetterDoesNoHarm)
{
	Scene scene = WideAngle(Speck({7, 0, 3}, 0.25));
	scene.letters = Letters({Rectangle(5, -3, 9.5, 3), Hole(Rectangle(6, -2, 8.5, 2))});
	ExpectAccepted(scene, 5);
	ExpectRefused(scene.with(Speck({8.75, 0, 3}, 0.25)), 5, 3, 0.01);
}

TEST(SweptVolume, FindsOneAmongMany)
{
	Shape shells = Speck({8.25, 0, 3}, 0.25).joined(Speck({7, 2.5, 3}, 0.25)).joined(Speck({-12, 5, -2}, 0.25));
	Scene scene = WideAngle(shells);
	ExpectAccepted(scene, 5);
	scene.part = scene.part.joined(shells);
	ExpectRefused(scene.with(Speck({7.5, -1, 4}, 0.25)), 5, 4, 0.01);
}

// The one at x = 1.2 is seen within the label's box, the one at x = 10 far beside it: the depth that is stated counts both.
TEST(SweptVolume, StatedDepthCountsWhatIsSeenBeside)
{
	Scene scene = WideAngle(Speck({1.2, 0, 5}, 0.25).joined(Speck({10, 0, 4.9}, 0.25)));
	scene.letters = Letters({Rectangle(0.8, -1, 1.6, 1), Rectangle(9, -1, 11, 1)});
	FloatMesh m;
	test_mesh::Fill(m, scene.whole());
	Error e(ErrorCode::OutOfMemory, "the label was not refused");
	Refusal(m, scene.letters, scene.frame, scene.raisedBy(8), &e);
	ASSERT_EQ(int(e.code), int(ErrorCode::HitsSurface)) << e.what();
	EXPECT_NEAR(e.limit, 4.9, 0.01);
	ExpectAccepted(scene, e.limit);
}

/// Part of a tube about the y axis, its top at z = radius, an open sheet that is seen from above.
Shape HalfTube(double radius)
{
	return test_mesh::Sheet(100, 10, [&](int i, int j) {
		const double a = M_PI * (i / 100.0 - 0.5);
		return Point3d(radius * std::sin(a), 3.0 * (j - 5), radius * std::cos(a));
	});
}

// Along the normals of a tube of radius 10 the letter at x from 3 to 6 leans out: at a height of 2 it reaches x = 7.2.
TEST(SweptVolume, SpeckOverACurvedSheet)
{
	const double angle = 33 * M_PI / 180, height = 2;
	const Point3d corner((10 + height) * std::sin(angle), 0, (10 + height) * std::cos(angle));
	ASSERT_GT(corner[0], 6);
	const Scene scene{HalfTube(10), Speck(corner, 0.1), Letters({Rectangle(3, -2, 6, 2)}), FromAbove(),
	                  ExtrudeAlong::SurfaceNormal};
	ExpectRefused(scene, 3, height, 0.05);
	ExpectAccepted(scene.with(Speck(corner + Point3d(2, 0, 0), 0.1)), 3);
	ExpectAccepted(scene.with(Speck(corner + Point3d(0, 2.1, 0), 0.1)), 3);
}

TEST(SweptVolume, VoidUnderASunkLetter)
{
	Scene scene = WideAngle(Void({7, 0, -2.25}, 0.25));
	ExpectRefused(scene, -3, 2, 0.01);
	scene.along = ExtrudeAlong::SurfaceNormal;
	ExpectRefused(scene, -3, 2, 0.01);
	scene.frame = FromAbove();
	ExpectRefused(scene, -3, 2, 0.01);
	ExpectAccepted(scene.with(Void({8.25, 0, -2.25}, 0.25)), -3);
	ExpectAccepted(scene.with(Void({7, 0, -3.5}, 0.25)), -3);
}

TEST(SweptVolume, VoidUnderACurvedSurface)
{
	const double angle = 27 * M_PI / 180, radius = 8.5, size = 0.1;
	const Point3d corner(radius * std::sin(angle), 0, radius * std::cos(angle));
	const double nearest = std::max(std::hypot(corner[0] + size, corner[2]), std::hypot(corner[0], corner[2] + size));
	const Scene scene{test_mesh::Cylinder(10, 30, 200, 15), Void(corner, size), Letters({Rectangle(3, -2, 6, 2)}),
	                  FromAbove(), ExtrudeAlong::SurfaceNormal};
	ExpectRefused(scene, -3, 10 - nearest, 0.05);
	ExpectAccepted(scene.with(Void(corner + Point3d(0, 2.1, 0), size)), -3);
}

/// What the letters of a scene on a plate sweep.
struct SweptExample {
	CutExample cut;
	LabelPatch patch;
	detail::SweptVolume volume;

	SweptExample(const Scene& scene, double height)
		: cut(scene.whole(), scene.letters, scene.frame),
		  patch(RaiseLabel(cut.space, cut.sheet, cut.cut, height, scene.along)),
		  volume(cut.sheet, patch, RoundedPositions(cut.sheet, patch, RoundToFloat))
	{}
};

Point3d FirstDirection()
{
	const auto& d = detail::SweptVolume::directions[0];
	return {d[0], d[1], d[2]};
}

// The way to the first far point leads exactly through a corner of the top, or along an edge between walls.
TEST(SweptVolume, SpeckOnTheWayThroughACorner)
{
	const Point3d direction = FirstDirection();
	for (const double step : {1.0 / 8, 1.0 / 16}) {
		const Point3d corner = Point3d(8, 2, 4) - direction * step;
		const Scene scene = WideAngle(Speck(corner, 0.125));
		SweptExample swept(scene, 4);
		EXPECT_EQ(swept.volume.findAlong(corner, 0), Whereabouts::Unclear);
		EXPECT_EQ(swept.volume.find(corner), Whereabouts::Inside);
		ExpectRefused(scene, 4, corner[2], 0.01);
		const Point3d outside = Point3d(6, -2, 0.5) - direction * step;  // through an edge of two walls, from outside
		EXPECT_EQ(swept.volume.findAlong(outside, 0), Whereabouts::Unclear);
		EXPECT_EQ(swept.volume.find(outside), Whereabouts::Outside);
	}
}

/// An L, in perspective.
Scene AnL(const Shape& shell)
{
	Scene scene = WideAngle(shell);
	scene.letters = Letters({{{5, -3}, {9, -3}, {9, -1}, {7, -1}, {7, 3}, {5, 3}}});
	return scene;
}

// In the planes of two walls of an L, and right over the corner at which these meet.
TEST(SweptVolume, SpeckInThePlaneOfAWall)
{
	ExpectRefused(AnL(Speck({7, -2, 3}, 0.25)), 4, 3, 0.01);
	ExpectRefused(AnL(Speck({6.5, -1, 3}, 0.25)), 4, 3, 0.01);
	ExpectAccepted(AnL(Speck({9.5, -1, 3}, 0.25)), 4);
	ExpectAccepted(AnL(Speck({7, 3.5, 3}, 0.25)), 4);
	ExpectAccepted(AnL(Speck({7, -1, 4.25}, 0.25)), 4);
}

// Every point of a grid whose planes are those of tops, floors, walls and the part's own edges.
TEST(SweptVolume, TellsEveryPointOfAGrid)
{
	for (const double height : {4.0, -2.0}) {
		const Scene scene = AnL(Shape());
		SweptExample swept(scene, height);
		const double low = std::min(height, 0.0), high = std::max(height, 0.0);
		int unclearAtFirst = 0, inside = 0;
		for (double x = 5; x <= 9; x += 0.25)
			for (double y = -3; y <= 3; y += 0.25)
				for (double z = low; z <= high; z += 0.25) {
					const Point2d p(x, y);
					const bool isOnContour = ContourDistance(scene.letters, p) == 0;
					const bool isWithin = !isOnContour && Winding(scene.letters, p) == 1;
					const Whereabouts expected = isOnContour || (isWithin && (z == low || z == high))
					                                 ? Whereabouts::Unclear
					                             : isWithin ? Whereabouts::Inside
					                                        : Whereabouts::Outside;
					ASSERT_TRUE(swept.volume.mayHold({x, y, z}));
					ASSERT_EQ(int(swept.volume.find({x, y, z})), int(expected)) << x << ' ' << y << ' ' << z;
					for (size_t way = 0; way < detail::SweptVolume::directions.size(); ++way) {
						const Whereabouts found = swept.volume.findAlong({x, y, z}, way);
						if (found != Whereabouts::Unclear) { ASSERT_EQ(int(found), int(expected)) << way; }
					}
					const Whereabouts first = swept.volume.findAlong({x, y, z}, 0);
					unclearAtFirst += first == Whereabouts::Unclear && expected != first;
					inside += expected == Whereabouts::Inside;
				}
		EXPECT_GT(unclearAtFirst, 10);
		EXPECT_GT(inside, 500);
	}
}

// A fin within the volume that hangs on the part by a vertex of the contour: no face crosses another, yet it would be in the letter.
TEST(SweptVolume, ShellThatHangsOnTheContour)
{
	Scene scene = WideAngle(Shape());
	scene.letters = Letters({Rectangle(5, -2, 7, 2)});
	const Point3d shared(7, 2, 0);
	int foot = 0;
	for (size_t i = 0; i < scene.part.points.size(); ++i)
		if ((scene.part.points[i] - shared).Norm() < 1e-9) foot = int(i);
	ASSERT_GT(foot, 0);
	Shape& s = scene.part;
	const int a = s.add({6.75, 1.875, 1}), b = s.add({6.5, 1.875, 1.25}), c = s.add({6.625, 1.625, 1.25});
	for (const auto& f : {std::array<int, 3>{foot, a, b}, {foot, b, c}, {foot, c, a}, {c, b, a}}) s.faces.push_back(f);
	FloatMesh m;
	test_mesh::Fill(m, scene.whole());
	const std::string bytes = test_mesh::Bytes(m);
	Error error(ErrorCode::OutOfMemory);
	EXPECT_NE(Refusal(m, scene.letters, scene.frame, scene.raisedBy(3), &error), "no error");
	EXPECT_TRUE(test_mesh::Bytes(m) == bytes);
	EXPECT_EQ(int(error.code), int(ErrorCode::NonManifold)) << error.what();
}

}  // namespace
