// The plan: the resolution it states, and that nothing moves by more.

#include "vcg_ext/label_plan.h"

#include <gtest/gtest.h>
#include <random>

#include "label_check.h"

namespace {

using namespace label_check;

TEST(Precision, UlpIsTheStepBetweenNumbers)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> exponent(-30, 30);
	for (int n = 0; n < 1000; ++n) {
		const double x = std::exp(exponent(random));
		const float f =
			std::nextafter(static_cast<float>(x), 0.0f);  // not above x: float may round up to the next power of two
		EXPECT_EQ((Precision{true}.ulp(double(f))), double(std::nextafter(f, 1e38f)) - double(f)) << f;
		EXPECT_EQ((Precision{false}.ulp(x)), std::nextafter(x, 1e300) - x);
		EXPECT_EQ((Precision{true}.round(x)), double(static_cast<float>(x)));
		EXPECT_EQ((Precision{false}.round(x)), x);
	}
	EXPECT_GT(Precision{true}.ulp(0), 0);
}

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
		EXPECT_NEAR(plan.surfaceArea, Area(letters), plan.resolution * 70);  // the letters' perimeter is 66
		EXPECT_EQ(plan.stretch, 1);
	}
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
