// How much a surface stretches a label, and where that is too much: the words, the numbers that work, and the mesh as it was.

#include "refusal_case.h"

namespace {

using namespace refusal_case;
using test_mesh::Shape;

// Seen in perspective from the side, a plane that is parallel to the label's is as long as in the label.
TEST(Refusal, NoStretchOnAPlaneThatIsParallel)
{
	FloatMesh m;
	test_mesh::Fill(m, test_mesh::Slab(60, 60, 2, 10, 10));
	LabelFrame frame = FromAbovePerspective(10);
	LabelOptions options;
	options.maxStretch = 1.001;
	EXPECT_NEAR(LabelMesh(m, Letters({Rectangle(20, -1, 24, 1)}), frame, options).stretch, 1, 1e-9);
}

// Two slopes, the steeper one behind the other in the order of the faces: what is told is what max_stretch must allow.
TEST(Refusal, SteepestOfSeveralPlanes)
{
	const Shape roof = test_mesh::Slab(20, 20, 200, 4, 4).moved([](const Point3d& p) {
		return p + Point3d(0, 0, p[0] < 0 ? 10 * p[0] : 20 * p[0]);
	});
	const Error e = Refused(roof, ThreeLetters());
	EXPECT_CODE(e, Grazing);
	EXPECT_NEAR(e.value, std::sqrt(401.0), 1e-4);
	FloatMesh m;
	test_mesh::Fill(m, roof);
	LabelOptions options;
	options.maxStretch = e.value;
	EXPECT_EQ(LabelMesh(m, ThreeLetters(), FromAbove(), options).stretch, e.value);
}

TEST(Refusal, SteepPlane)
{
	const Shape steep =
		test_mesh::Slab(20, 20, 200, 4, 4).moved([](const Point3d& p) { return p + Point3d(0, 0, 10 * p[0]); });
	const Error e = Refused(steep, ThreeLetters());
	EXPECT_CODE(e, Grazing);
	EXPECT_NEAR(e.value, std::sqrt(101.0), 1e-4);
	EXPECT_EQ(e.limit, LabelOptions().maxStretch);
	EXPECT_GE(e.letter, 0);
	EXPECT_GE(e.face, 0);
	FloatMesh m;
	test_mesh::Fill(m, steep);
	LabelOptions options;
	options.maxStretch = 10.1;
	EXPECT_NEAR(LabelMesh(m, ThreeLetters(), FromAbove(), options).stretch, std::sqrt(101.0), 1e-4);
}

// A wall that leans over is seen from the front in a wide view; upwards, there, is into it.
TEST(Refusal, RaisedIntoAWallThatLeansOver)
{
	const Shape wall = test_mesh::Thickened(
		test_mesh::Sheet(6, 6, [](int i, int j) { return Point3d(20 - 0.6 * (i - 3), 3 * (j - 3), 2 * (i - 3)); }), 6,
		6, {6, 0, 0});
	const Outline letter = Letters({Rectangle(18, -1.5, 23, 1.5)});
	for (const double height : {0.5, -0.5}) {
		const Error e = Refused(wall, letter, FromAbovePerspective(10), height, ExtrudeAlong::LabelNormal);
		EXPECT_CODE(e, Grazing);
		EXPECT_EQ(e.value, std::numeric_limits<double>::infinity());
		EXPECT_GE(e.face, 0);
		for (const ExtrudeAlong along : {ExtrudeAlong::Viewpoint, ExtrudeAlong::SurfaceNormal}) {
			FloatMesh m;
			test_mesh::Fill(m, wall);
			LabelOptions options;
			options.height = height;
			options.along = along;
			EXPECT_NO_THROW(LabelMesh(m, letter, FromAbovePerspective(10), options)) << height << ' ' << int(along);
		}
	}
}

}  // namespace
