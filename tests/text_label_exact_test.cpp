// Exact coincidences: contours that run along edges, through vertices and diagonals, as they do on every CAD part.

#include "vcg_ext/text_label.h"

#include <gtest/gtest.h>

#include "label_check.h"
#include "test_mesh.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

struct Case {
	std::string name;
	Shape shape;
	Outline outline;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A slab of 10 x 10 squares of side 2, the diagonals from lower left to upper right.
Shape Grid() { return test_mesh::Slab(20, 20, 4, 10, 10); }

std::vector<Point2d> LetterL(double u, double v, double size, double stem)
{
	return {{u, v}, {u + size, v}, {u + size, v + stem}, {u + stem, v + stem}, {u + stem, v + size}, {u, v + size}};
}

/// Ten squares with a hole each, in two rows, inside (-7, -3) .. (7, 3).
Outline TenLetters()
{
	std::vector<std::vector<Point2d>> contours;
	for (int row = 0; row < 2; ++row)
		for (int i = 0; i < 5; ++i) {
			const double u = -7 + 2.9 * i, v = -3 + 3.2 * row;
			contours.push_back(Rectangle(u, v, u + 2.4, v + 2.8));
			contours.push_back(Hole(Rectangle(u + 0.6, v + 0.6, u + 1.8, v + 2.2)));
		}
	return Letters(contours);
}

std::vector<Case> Cases()
{
	const Shape fan = test_mesh::Fan(50, 15, 4);
	return {
		{"StemsAlongGridLines", Grid(), Letters({LetterL(-4, -4, 8, 2)})},
		{"SquareOfWholeCells", Grid(), Letters({Rectangle(-4, -4, 4, 4)})},
		{"FrameOfWholeCells", Grid(), Letters({Rectangle(-6, -6, 6, 6), Hole(Rectangle(-4, -4, 4, 4))})},
		{"CornersOnDiagonals", Grid(), Letters({Rectangle(-3, -3, 3, 3)})},
		{"CornersOnOtherDiagonalsEnds", Grid(), Letters({Rectangle(-3.5, -3, 3.5, 3)})},
		{"CornersOnVerticesOnly", Grid(), Letters({{{-4, -2}, {2, -4}, {4, 2}, {-2, 4}}})},
		{"RhombusThroughVertices", Grid(), Letters({{{0, -6}, {6, 0}, {0, 6}, {-6, 0}}})},
		{"AlongDiagonals", Grid(), Letters({{{-6, -6}, {-2, -6}, {6, 2}, {6, 6}}})},
		{"CellsThatTouchAlongNoEdge", Grid(),
	     Letters({Rectangle(-4, -4, -2, -2), Rectangle(0, 0, 2, 2), Rectangle(4, -4, 6, -2)})},
		{"HalfCells", Grid(), Letters({Rectangle(-1, -1, 1, 1), Rectangle(3, 3, 5, 5), Rectangle(-7, 2, -5, 7)})},
		{"BoxDiagonal", test_mesh::Box(20, 20, 4), Letters({Rectangle(-5, -5, 5, 5)})},
		{"BoxDiagonalInsideStem", test_mesh::Box(20, 20, 4),
	     Letters({{{-6, -6}, {-4, -6}, {6, 4}, {6, 6}, {4, 6}, {-6, -4}}})},
		{"BoxEdgeOfTheDiagonal", test_mesh::Box(20, 20, 4), Letters({{{-6, -6}, {6, 6}, {-6, 6}}})},
		{"LetterInOneTriangle", test_mesh::Box(40, 40, 4), Moved(Letters({LetterL(-3, -3, 6, 2)}), 1, 10, -10)},
		{"DotAndStemInTwoTriangles", test_mesh::Box(40, 40, 4),
	     Letters({Rectangle(4, -8, 6, -3), Rectangle(-6, 3, -4, 5)})},
		{"TriangleUnderTenLetters", test_mesh::Box(60, 60, 4), Moved(TenLetters(), 1, 14, -14)},
		{"DiagonalUnderTenLetters", test_mesh::Box(60, 60, 4), TenLetters()},
		{"CoversValence50", fan, Letters({Rectangle(-4, -3, 4, 3)})},
		{"RingAroundValence50", fan, Letters({Rectangle(-4, -3, 4, 3), Hole(Rectangle(-2, -1, 2, 1))})},
		{"CornerOnValence50", fan, Letters({Rectangle(0, 0, 5, 4)})},
		{"SideThroughValence50", fan, Letters({Rectangle(-4, 0, 4, 3)})},
		{"SpikeToValence50", fan, Letters({{{0, 0}, {5, -1}, {5, 1}}})},
		{"RoundLetterOnFan", fan, Letters({RegularPolygon(0, 0, 5, 50), Hole(RegularPolygon(0, 0, 3, 50))})},
		{"RoundLetterTurnedOnFan", fan,
	     Letters({RegularPolygon(0, 0, 5, 100, M_PI / 100), Hole(RegularPolygon(0, 0, 3, 25))})},
	};
}

class Exact : public testing::TestWithParam<Case> {
protected:
	template <class MeshType>
	void check(const LabelFrame& frame, double height, double area)
	{
		MeshType m;
		test_mesh::Fill(m, GetParam().shape);
		const Shape before = test_mesh::ToShape(m);
		LabelOptions options;
		options.height = height;
		Error error(ErrorCode::Cancelled);
		ASSERT_EQ(Refusal(m, GetParam().outline, frame, options, &error), "no error") << "code " << int(error.code);
		const Shape after = test_mesh::ToShape(m);
		ExpectSameKind(before, m);
		if (height == 0) { EXPECT_NEAR(SurfaceArea(after), SurfaceArea(before), 1e-6 * SurfaceArea(before)); }
		if (!frame.perspective) {
			EXPECT_NEAR(Volume(after) - Volume(before), area * height,
			            1e-5 * area * std::abs(height) + 1e-7 * Volume(before));
		}
		for (size_t i = 0; i < before.points.size(); ++i) {  // no vertex moves but those of the letters
			const Point3d &a = before.points[i], &b = after.points[i];
			if (a == b) continue;
			EXPECT_EQ(Winding(GetParam().outline, {a[0], a[1]}), 1) << "vertex " << i << " moved";
			EXPECT_GT(ContourDistance(GetParam().outline, {a[0], a[1]}), 1e-9) << "vertex " << i << " moved";
		}
	}
};

TEST_P(Exact, Parallel)
{
	const double area = Area(GetParam().outline);
	for (const double height : {1.5, -1.5, 0.0}) {
		check<test_mesh::FloatMesh>(FromAbove(), height, area);
		check<test_mesh::DoubleMesh>(FromAbove(), height, area);
	}
}

TEST_P(Exact, Perspective)
{
	const double area = Area(GetParam().outline);
	for (const double height : {1.5, -1.5, 0.0}) check<test_mesh::FloatMesh>(FromAbovePerspective(60), height, area);
}

// The same a hair beside the coincidence: by an ulp of float32, a few, a hundred.
TEST_P(Exact, AlmostExactly)
{
	const double ulp = FloatUlp(GetParam().shape);
	for (const double off : {0.3, 1.0, 4.0, 5.0, 17.0, 100.0})
		for (const Point2d& direction : {Point2d(1, 0), Point2d(-0.6, 0.8), Point2d(0.7, -0.7)})
			for (const double height : {1.5, -1.5}) {
				SCOPED_TRACE(testing::Message() << off << " ulp towards " << direction[0] << ' ' << direction[1]);
				test_mesh::FloatMesh m;
				test_mesh::Fill(m, GetParam().shape);
				const Shape before = test_mesh::ToShape(m);
				LabelOptions options;
				options.height = height;
				const Point2d shift = direction * (off * ulp);
				Error error(ErrorCode::Cancelled);
				ASSERT_EQ(Refusal(m, Moved(GetParam().outline, 1, shift[0], shift[1]), FromAbove(), options, &error),
				          "no error")
					<< "code " << int(error.code);
				ExpectSameKind(before, m);
				const double expected = Area(GetParam().outline) * height;
				EXPECT_NEAR(Volume(test_mesh::ToShape(m)) - Volume(before), expected, 1e-4 * std::abs(expected));
			}
}

INSTANTIATE_TEST_SUITE_P(Label, Exact, testing::ValuesIn(Cases()), [](const auto& p) { return p.param.name; });

// ---- a box's outer edges ----

// A letter whose stem lies along the outer edge of a box: its wall goes on from the side of the box.
TEST(OuterEdge, RaisedLetterStandsOnTheSide)
{
	const Outline letter = Letters({{{-10, -10}, {0, -10}, {0, -8}, {-8, -8}, {-8, 0}, {-10, 0}}});
	for (const Shape& shape : {test_mesh::Box(20, 20, 4), Grid()})
		for (const double height : {1.5, 0.0}) {
			test_mesh::FloatMesh m;
			test_mesh::Fill(m, shape);
			const Shape before = test_mesh::ToShape(m);
			LabelOptions options;
			options.height = height;
			Error error(ErrorCode::Cancelled);
			ASSERT_EQ(Refusal(m, letter, FromAbove(), options, &error), "no error") << "code " << int(error.code);
			ExpectSameKind(before, m);
			EXPECT_NEAR(Volume(test_mesh::ToShape(m)) - Volume(before), Area(letter) * height, 1e-4);
		}
}

// Sunk, there would be a wall of no thickness between the floor and the side: refused.
TEST(OuterEdge, SunkLetterWouldOpenTheSide)
{
	const Outline letter = Letters({{{-10, -10}, {0, -10}, {0, -8}, {-8, -8}, {-8, 0}, {-10, 0}}});
	for (const Shape& shape : {test_mesh::Box(20, 20, 4), Grid()}) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, shape);
		const std::string bytes = test_mesh::Bytes(m);
		LabelOptions options;
		options.height = -1.5;
		EXPECT_THROW(LabelMesh(m, letter, FromAbove(), options), Error);
		EXPECT_TRUE(test_mesh::Bytes(m) == bytes);
	}
}

// The letter is the whole top of the box.
TEST(OuterEdge, WholeFace)
{
	for (const double height : {1.5, 0.0}) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, Grid());
		const Shape before = test_mesh::ToShape(m);
		LabelOptions options;
		options.height = height;
		Error error(ErrorCode::Cancelled);
		ASSERT_EQ(Refusal(m, Letters({Rectangle(-10, -10, 10, 10)}), FromAbove(), options, &error), "no error")
			<< "code " << int(error.code);
		ExpectSameKind(before, m);
		EXPECT_NEAR(Volume(test_mesh::ToShape(m)), Volume(before) + 400 * height, 1e-3);
	}
}

// At 1e6 float32 goes in steps of 1/16: a contour beside an edge of the grid is laid on it, and that edge has two faces.
TEST(CoarseCoordinates, MoveAContourToAnEdge)
{
	const Shape far =
		test_mesh::Slab(120, 60, 8, 120, 60).moved([](const Point3d& p) { return p + Point3d(1e6, 1e6, 0); });
	LabelFrame frame;
	frame.origin = {1e6, 1e6, 0};
	for (const double beside : {0.12, 0.15, 0.2, 0.24}) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, far);
		LabelOptions options;
		options.height = 2;
		const Outline letter = Letters({Rectangle(-30 + beside, -10.4, 30 - beside, 10.4)});
		EXPECT_NO_THROW(LabelMesh(m, letter, frame, options)) << beside;
	}
}

}  // namespace
