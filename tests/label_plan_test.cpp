// The plan: the resolution it states, and that nothing moves by more.

#include "vcg_ext/label_plan.h"

#include <gtest/gtest.h>

#include "label_check.h"

namespace {

using namespace label_check;

LabelPlan Plan(const test_mesh::Shape& shape, const Outline& outline, Precision precision, double height = 0)
{
	const LabelSpace space(FromAbove());
	Sheet sheet = CandidatesOf(shape, space, 40, 40);
	LabelOptions options;
	options.height = height;
	return LabelPlanner(space, sheet, precision, options).plan(outline);
}

// On a plane contour points project where they lie: none is further from the outline than the stated resolution.
TEST(Plan, KeepsItsResolution)
{
	const test_mesh::Shape shape = test_mesh::Slab(40, 30, 4, 20, 15);
	const double ulp = FloatUlp(shape);
	for (int n = 0; n < 20; ++n) {
		const Outline letters = Moved(ThreeLetters(), 1, 0.7 * n * ulp, 1.1 * n * ulp);
		const LabelSpace space(FromAbove());
		Sheet sheet = CandidatesOf(shape, space, 40, 40);
		const LabelPlan plan = LabelPlanner(space, sheet, {true}, {}).plan(letters);
		EXPECT_GE(plan.attempts, 1);
		EXPECT_GT(plan.resolution, 0);
		EXPECT_LT(plan.resolution, 100 * ulp);
		for (const ContourPiece& p : plan.cut.pieces)
			EXPECT_LE(ContourDistance(letters, plan.cut.points.at(sheet, p.from).plane), plan.resolution);
		EXPECT_NEAR(plan.surface.area, Area(letters), plan.resolution * 70);  // the letters' perimeter is 66
		EXPECT_EQ(plan.surface.stretch, 1);
	}
}

// Facets some hundred steps of the coordinates wide, and letters whose contours turn within them: what is cut off must not be so low
// that rounding turns it round.
TEST(Plan, TakesRoundLettersOnFineFacetsAtOnce)
{
	const Point3d place(93, 20, -33);
	const test_mesh::Shape shape =
		test_mesh::Cylinder(0.7, 1.4, 1000, 1).moved([&](const Point3d& p) { return p + place; });
	LabelFrame frame = FromAbove();
	frame.origin = place;
	LabelOptions options;
	options.height = 0.01;
	for (const double radius : {0.1, 0.2, 0.3, 0.4})
		for (int k = 0; k < 10; ++k) {
			const auto letter = RegularPolygon(0.013 * k - 0.05, 0.017 * k - 0.06, radius, 200 + 40 * k);
			test_mesh::FloatMesh m;
			test_mesh::Fill(m, shape);
			EXPECT_EQ(LabelMesh(m, Letters({letter}), frame, options).attempts, 1) << radius << ' ' << k;
		}
}

// Where coordinates are rounded to a grid that is far coarser than single precision, the label is right on both.
TEST(Plan, IsSoundAsAFileOfFewDigitsHasIt)
{
	const test_mesh::Shape shape = test_mesh::Slab(40, 30, 4, 20, 15);
	const LabelSpace space(FromAbove());
	int collapsed = 0;
	for (int n = 0; n < 30; ++n) {
		const Outline letters = Moved(ThreeLetters(), 1, 0.0031 * n, 0.0017 * n);
		const auto verdict = [&](const Sheet& sheet, const LabelPlan& plan, const Precision& as) {
			const auto round = [&](double x) { return as.round(x); };
			return CheckPatch(space, sheet, plan.patch, RoundedPositions(sheet, plan.patch, round)).fault;
		};
		for (const bool isDouble : {false, true})
			for (const double height : {0.0, 0.5, -0.5}) {
				LabelOptions options;
				options.height = height;
				const Precision file{true, isDouble, -2}, memory{!isDouble, isDouble};
				Sheet sheet = CandidatesOf(shape, space, 40, 40), same = sheet;
				const LabelPlan plan = LabelPlanner(space, sheet, file, options).plan(letters);
				EXPECT_EQ(plan.coordinateStep, 0.01);
				EXPECT_EQ(verdict(sheet, plan, file), PatchFault::Sound) << n;
				EXPECT_EQ(verdict(sheet, plan, memory), PatchFault::Sound) << n;
				const LabelPlan fine = LabelPlanner(space, same, memory, options).plan(letters);
				collapsed += verdict(same, fine, file) != PatchFault::Sound;
			}
	}
	EXPECT_GT(collapsed, 0) << "else the file's digits would not matter";
	LabelOptions options;
	options.height = 0.004;
	Sheet sheet = CandidatesOf(shape, space, 40, 40);
	EXPECT_THROW(LabelPlanner(space, sheet, {true, false, -2}, options).plan(ThreeLetters()), Error);
}

TEST(Plan, RefusesWhatTheCoordinatesDoNotCarry)
{
	const test_mesh::Shape shape = test_mesh::Slab(40, 30, 4, 20, 15);
	double finest = 1;
	for (double width = 1; width > 1e-8; width /= 2) {
		try {
			Plan(shape, Letters({Rectangle(0.3, -2, 0.3 + width, 2)}), {true});
			finest = width;
		} catch (const Error& e) {
			EXPECT_EQ(e.code, ErrorCode::TooFine);
			EXPECT_LT(e.value, e.limit);
			EXPECT_NEAR(e.value, width, 0.01 * width) << "the stroke is so wide";
			EXPECT_EQ(e.letter, 0);
			EXPECT_LT(e.limit, 2.1 * finest) << "and what is said to be needed is not more than what works";
			EXPECT_NO_THROW(Plan(shape, Letters({Rectangle(0.3, -2, 0.3 + width, 2)}), {false})) << "doubles carry it";
			break;
		}
	}
	EXPECT_LT(finest, 1000 * FloatUlp(shape));
}

// The label is laid the same way each time.
TEST(Plan, IsRepeatable)
{
	const test_mesh::Shape shape = test_mesh::Slab(40, 30, 4, 20, 15);
	const LabelPlan a = Plan(shape, ThreeLetters(), {true}, 1), b = Plan(shape, ThreeLetters(), {true}, 1);
	ASSERT_EQ(a.patch.vertices.size(), b.patch.vertices.size());
	for (size_t i = 0; i < a.patch.vertices.size(); ++i) EXPECT_EQ(a.patch.vertices[i].mesh, b.patch.vertices[i].mesh);
	ASSERT_EQ(a.patch.faces.size(), b.patch.faces.size());
	for (size_t i = 0; i < a.patch.faces.size(); ++i) EXPECT_EQ(a.patch.faces[i].vertex, b.patch.faces[i].vertex);
}

}  // namespace
