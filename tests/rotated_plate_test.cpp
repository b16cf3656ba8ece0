// A flat CAD plate that was merely rotated, so that what was coplanar is coplanar only to an ulp: where mesh booleans fail.
//
// The plate has a fine grid of edges under the letters and holes elsewhere. It is turned by 100 random rotations and rounded to
// float32; each style of label must come out valid on each, and its volume right. The volume is worked out from the outline alone.

#include "filter_textlabel/label_service.h"

#include <gtest/gtest.h>
#include <random>

#include "label_check.h"
#include "placement_parts.h"
#include "test_mesh.h"

namespace {

using namespace label_check;
using test_mesh::FloatMesh;
using test_mesh::Shape;
using textlabel::LabelStyle;

#if defined(__SANITIZE_ADDRESS__)
constexpr int kRotations = 10;  // what memory errors there are, the first ones show
#else
constexpr int kRotations = 100;
#endif
constexpr double kWidth = 46, kHeight = 20, kThickness = 3, kDepth = 1;

/// Cells of 1 x 1 on both faces; square holes along the long sides, none where the letters are.
Shape Plate()
{
	const textlabel::test::BlockPart blocks{{int(kWidth), int(kHeight), 1}, [](int x, int y, int) {
												const bool nearSide = y < 4 || y >= int(kHeight) - 4;
												return !(nearSide && x % 10 >= 4 && x % 10 < 7 && y % 16 >= 1 &&
		                                                 y % 16 < 3);
											}};
	const textlabel::test::Triangles surface = textlabel::test::SurfaceOf(blocks);
	Shape s;
	for (const Point3d& p : surface.positions) s.add({p[0] - kWidth / 2, p[1] - kHeight / 2, (p[2] - 1) * kThickness});
	s.faces = surface.triangles;
	return s;
}

/// Orthonormal axes, uniform over all rotations: from a random quaternion.
struct Axes {
	Point3d u, v, w;

	explicit Axes(std::mt19937& random)
	{
		std::normal_distribution<double> normal;
		double q[4], length = 0;
		for (double& x : q) {
			x = normal(random);
			length += x * x;
		}
		for (double& x : q) x /= std::sqrt(length);
		const double a = q[0], b = q[1], c = q[2], d = q[3];
		u = {a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)};
		v = {2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b)};
		w = u ^ v;
	}
	Point3d operator()(const Point3d& p) const { return u * p[0] + v * p[1] + w * p[2]; }
};

struct Text {
	std::string utf8;
	double size;
};
const Text kTexts[] = {{"A43", 8}, {"SN-0123456789 gqy%&@", 2}};

Outline OutlineOf(const Text& text)
{
	textlabel::TextOptions options;
	options.size = text.size;
	return textlabel::MakeTextOutline(text.utf8, options).outline;
}

/// How the label looks at the plate.
enum class View { Parallel, Far, Camera };

/// The frame on the turned plate's top, the text turned in it by an angle.
LabelFrame FrameOn(const Axes& axes, View view, double angle)
{
	LabelFrame f;
	f.w = axes.w;
	f.u = axes.u * std::cos(angle) + axes.v * std::sin(angle);
	f.v = f.w ^ f.u;
	f.perspective = view != View::Parallel;
	f.center = f.w * (view == View::Far ? 1e6 : 90.0);
	return f;
}

/// Volume between a plane at distance z from C, and the same moved towards C by `height` along the rays, for each unit of area: where
/// a point is at distance d from C, the part 1 - (1 - height / d)^3 of its cone.
double ConeShare(double z, double d, double height) { return z * (1 - std::pow(1 - height / d, 3)) / 3; }

/// What the label must add: exactly, or between the shares of the nearest and the farthest point of the letters.
std::pair<double, double> ExpectedVolume(const Outline& outline, const LabelFrame& frame, double height)
{
	const double area = Area(outline);
	if (!frame.perspective) return {area * height, area * height};
	const double z = frame.center * frame.w;
	double farthest = z;
	for (const Contour& c : outline.contours)
		for (const Point2d& p : c.points) farthest = std::max(farthest, std::sqrt(z * z + p.SquaredNorm()));
	const double a = area * ConeShare(z, z, height), b = area * ConeShare(z, farthest, height);
	return {std::min(a, b), std::max(a, b)};
}

class RotatedPlate : public testing::TestWithParam<double> {
protected:
	void check(View view, int rotations)
	{
		const double height = GetParam();
		const Shape plate = Plate();
		std::mt19937 random(20);
		std::uniform_real_distribution<double> turn(-0.05, 0.05);
		for (int n = 0; n < rotations; ++n) {
			SCOPED_TRACE(testing::Message() << "rotation " << n);
			const Axes axes(random);
			FloatMesh m;
			test_mesh::Fill(m, plate.moved(axes));
			const Shape before = test_mesh::ToShape(m);
			const Outline outline = OutlineOf(kTexts[n % 2]);
			const LabelFrame frame = FrameOn(axes, view, n % 4 < 2 ? 0 : turn(random));
			LabelOptions options;
			options.height = height;
			Error error(ErrorCode::Cancelled);
			ASSERT_EQ(Refusal(m, outline, frame, options, &error), "no error") << "code " << int(error.code);
			ExpectSameKind(before, m);
			const double added = Volume(test_mesh::ToShape(m)) - Volume(before);
			const auto [least, most] = ExpectedVolume(outline, frame, height);
			EXPECT_GE(added, least - 1e-4 * Area(outline) * kDepth);
			EXPECT_LE(added, most + 1e-4 * Area(outline) * kDepth);
			if (HasFailure()) return;
		}
	}
};

TEST_P(RotatedPlate, SeenAlongItsNormal) { check(View::Parallel, kRotations); }
TEST_P(RotatedPlate, SeenFromFar) { check(View::Far, kRotations / 4); }
TEST_P(RotatedPlate, SeenByACamera) { check(View::Camera, kRotations / 4); }

// The way of a user who presses Apply: the filter finds the place, the size and the depth.
TEST_P(RotatedPlate, PlacedAutomatically)
{
	const Shape plate = Plate();
	std::mt19937 random(21);
	textlabel::LabelRequest request;
	request.style = GetParam() > 0 ? LabelStyle::Emboss : GetParam() < 0 ? LabelStyle::Engrave : LabelStyle::Flat;
	for (int n = 0; n < kRotations; ++n) {
		SCOPED_TRACE(testing::Message() << "rotation " << n);
		FloatMesh m;
		test_mesh::Fill(m, plate.moved(Axes(random)));
		const Shape before = test_mesh::ToShape(m);
		request.text = kTexts[n % 2].utf8;
		textlabel::ErrorContext context;
		const textlabel::ServiceHost host;
		textlabel::LabelJob<FloatMesh> job(m, LabelFrame::Identity(), host, context);
		try {
			const textlabel::LabelReport report = job.run(request);
			ExpectSameKind(before, m);
			EXPECT_EQ(report.depth > 0, GetParam() > 0);
			EXPECT_EQ(report.depth < 0, GetParam() < 0);
			const double area = Area(job.outline().outline), depth = GetParam() == 0 ? kDepth : std::abs(report.depth);
			EXPECT_NEAR(Volume(test_mesh::ToShape(m)) - Volume(before), area * report.depth, 1e-4 * area * depth);
		} catch (const Error& e) {
			FAIL() << textlabel::ErrorText(e, context);
		}
		if (HasFailure()) return;
	}
}

INSTANTIATE_TEST_SUITE_P(Label, RotatedPlate, testing::Values(kDepth, -kDepth, 0.0), [](const auto& height) {
	return height.param > 0 ? "Embossed" : height.param < 0 ? "Engraved" : "Flat";
});

}  // namespace
