// The axis that a wrapped label runs round: on turned parts whose axis is known, seen from anywhere, and where there is none.

#include "filter_textlabel/request_error.h"
#include "filter_textlabel/wrap_axis.h"
#include "test_mesh.h"

#include <gtest/gtest.h>

using namespace textlabel;
using test_mesh::Shape, test_mesh::Turned;
using vcg::Point3d;
using vcg::textlabel::LabelFrame;

namespace {

/// Looking at a point from a direction, the head held as `up` says.
LabelFrame At(const Point3d& place, const Point3d& towards, const Point3d& up = {0, 1, 0})
{
	return vcg::textlabel::FrameFromDirection(place, towards, up);
}

LabelFrame WrappedOn(const Shape& shape, const LabelFrame& frame)
{
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, shape);
	vcg::Box3d box;
	for (const Point3d& p : shape.points) box.Add(p);
	const SurfaceAround surface = [&](const LabelFrame& f, double halfSide) { return CollectSurface(m, f, halfSide); };
	return WrappedFrame(frame, box.Diag(), surface);
}

void ExpectAxis(const LabelFrame& f, const Point3d& axis, double radius, double tolerance = 1e-6)
{
	EXPECT_NEAR(std::abs(f.wrapAxis * axis), 1, tolerance);
	EXPECT_NEAR(f.wrapRadius, radius, tolerance * std::abs(radius));
	EXPECT_NEAR(f.w * f.wrapAxis, 0, 1e-12);
	EXPECT_NEAR((f.u ^ f.v) * f.w, 1, 1e-12);
	EXPECT_FALSE(f.perspective);
}

void ExpectUp(const LabelFrame& f, const Point3d& up) { EXPECT_GT(f.v * up, 1 - 1e-6) << f.v[0] << ' ' << f.v[1]; }

bool HasNoAxis(const Shape& shape, const LabelFrame& frame)
{
	try {
		WrappedOn(shape, frame);
	} catch (const RequestError& error) {
		return error.problem == RequestProblem::NoAxis;
	}
	return false;
}

TEST(WrapAxis, CylindersFromCoarseToFine)
{
	for (const int sides : {6, 8, 12, 64, 500})
		for (const double turn : {0.0, 0.3, 1.0}) {  // in the middle of a facet and beside
			const double a = turn * M_PI / sides, facet = std::cos(M_PI / sides);
			const double r = 10 * facet / std::cos(std::remainder(a - M_PI / sides, 2 * M_PI / sides));
			const LabelFrame f = WrappedOn(Turned({10, 10}, sides, 20),
			                               At({r * std::sin(a), 3, r * std::cos(a)}, {std::sin(a), 0, std::cos(a)}));
			ExpectAxis(f, {0, 1, 0}, r);
			ExpectUp(f, {0, 1, 0});
		}
}

// A view by hand is never straight: the label is.
TEST(WrapAxis, SeenAslant)
{
	const Shape shape = Turned({10, 10, 10, 10, 10}, 48, 8);
	const Point3d place(0, 0, 10);
	for (const Point3d& towards : {Point3d(0.2, 0.1, 1), Point3d(-0.3, 0.3, 1), Point3d(0, -0.4, 1)})
		for (const Point3d& up : {Point3d(0.1, 1, 0), Point3d(-0.3, 1, 0.2)}) {
			const LabelFrame f = WrappedOn(shape, At(place, towards, up));
			ExpectAxis(f, {0, 1, 0}, 10);
			ExpectUp(f, {0, 1, 0});
			EXPECT_NEAR(f.w[2], 1, 1e-9);
			ExpectUp(WrappedOn(shape, At(place, towards, -up)), {0, -1, 0});
		}
	ExpectUp(WrappedOn(shape, At(place, {0.2, 0.1, 1}, {1, 0.3, 0})), {1, 0, 0});  // read along the axis
	for (const double above : {0.7, 1.0, 1.7, -1.0, -1.7}) {                       // up to 60 degrees
		const LabelFrame f = WrappedOn(shape, At(place, {0.1, above, 1}));
		ExpectAxis(f, {0, 1, 0}, 10);
		ExpectUp(f, {0, 1, 0});
	}
}

// On which side of its surface a label is read, the surface tells: seen from the tip of a cone, the place is on this side of the axis and
// the view comes from beyond it.
TEST(WrapAxis, TapersSeenFromAbove)
{
	const std::vector<double> radii = {20, 17.5, 15, 12.5, 10};
	const Shape cone = Turned(radii, 64, 5);
	Shape funnel = Turned({radii.rbegin(), radii.rend()}, 64, 5);
	for (auto& f : funnel.faces) std::swap(f[1], f[2]);
	const double a = M_PI / 64, r = 15 * std::cos(a);
	for (const double across : {-0.15, 0.1, 0.3, 1.0}) {
		const LabelFrame outside = WrappedOn(cone, At({r * std::sin(a), 0, r * std::cos(a)}, {0.05, 1, across}));
		ExpectAxis(outside, {0, 1, 0}, r, 1e-4);
		const LabelFrame inside = WrappedOn(funnel, At({r * std::sin(a), 0, r * std::cos(a)}, {0.05, 1, -across}));
		ExpectAxis(inside, {0, 1, 0}, -r, 1e-4);
	}
}

// A single row of facets, as CAD programs write it: all that tells of the axis are the folds between them.
TEST(WrapAxis, SingleRowsSeenAslant)
{
	for (const double slope : {0.0, 0.035, 0.18, 0.36, 1.0})  // of a cylinder, and of cones up to 45 degrees
		for (const int sides : {24, 72, 360})
			for (const double height : {4.0, 16.0}) {
				const Shape shape = Turned({20 - slope * height / 2, 20 + slope * height / 2}, sides, height);
				const double a = M_PI / sides, r = 20 * std::cos(a);  // in the middle of a facet
				for (const double tilt : {-0.3, -0.1, 0.0, 0.2}) {
					const Point3d towards(std::sin(a), tilt, std::cos(a)), place(r * std::sin(a), 0, r * std::cos(a));
					const LabelFrame f = WrappedOn(shape, At(place, towards));
					ExpectAxis(f, {0, 1, 0}, r);
					ExpectUp(f, {0, 1, 0});
				}
			}
}

// Files with few decimals, and parts far from the origin: rounding turns the normals of narrow facets round the axis, and bends the
// facets along their diagonals.
TEST(WrapAxis, RoundedCoordinates)
{
	const auto turned = [](const Point3d& p) {  // aslant: no coordinate is round by itself
		const double a = 0.7, b = 0.4;
		const Point3d q(p[0] * std::cos(a) - p[1] * std::sin(a), p[0] * std::sin(a) + p[1] * std::cos(a), p[2]);
		return Point3d(q[0], q[1] * std::cos(b) - q[2] * std::sin(b), q[1] * std::sin(b) + q[2] * std::cos(b));
	};
	for (const double step : {1e-4, 1e-3})
		for (const double slope : {0.0, 0.2})
			for (const int sides : {24, 64, 128, 256})
				for (const double height : {12.0, 30.0}) {
					const auto rounded = [&](Point3d p) {
						for (int k = 0; k < 3; ++k) p[k] = std::round(p[k] / step) * step;
						return p;
					};
					const Shape shape = Turned({10 - slope * height / 2, 10 + slope * height / 2}, sides, height)
					                        .moved([&](const Point3d& p) { return rounded(turned(p)); });
					const double a = M_PI / sides, r = 10 * std::cos(a);
					const Point3d towards(std::sin(a), 0.1, std::cos(a)), place(r * std::sin(a), 0, r * std::cos(a));
					const LabelFrame f = WrappedOn(shape, At(turned(place), turned(towards), turned({0.1, 1, 0})));
					EXPECT_GT(std::abs(f.wrapAxis * turned({0, 1, 0})), std::cos(0.02)) << sides << ' ' << slope;
					EXPECT_NEAR(f.wrapRadius, r, 0.02 * r) << sides << ' ' << slope;
				}
}

// A shaft with a flat: round it runs a label beside the flat, but not one on it, although the edges of the flat bend.
TEST(WrapAxis, BesideAFlatAndNotOnIt)
{
	constexpr int sides = 48;
	Shape shaft = Turned({10, 10}, sides, 30);
	for (Point3d& p : shaft.points)
		if (p[2] > 8) p = Point3d(p[0] * 8 / p[2], p[1], 8);
	for (const double degrees : {63.0, 110.0, 180.0, 285.0}) {
		const double a = degrees * M_PI / 180, facet = M_PI / sides;
		const double r = 10 * std::cos(facet) / std::cos(std::remainder(a - facet, 2 * facet));
		const Point3d towards(std::sin(a), 0, std::cos(a));
		ExpectAxis(WrappedOn(shaft, At(towards * r, towards)), {0, 1, 0}, r);
	}
	for (const double x : {0.0, 1.5, 3.0, 4.0}) EXPECT_TRUE(HasNoAxis(shaft, At({x, 0, 8}, {0, 0, 1}))) << x;
}

// A T: in a larger square the branch comes into sight, whose own axis all that is seen then fits nearly as well.
TEST(WrapAxis, BesideABranch)
{
	for (const int sides : {24, 48}) {
		test_mesh::DoubleMesh run, branch;
		test_mesh::Fill(run, Turned({10, 10}, sides, 30));
		test_mesh::Fill(
			branch, Turned({6, 6}, 32, 15).moved([](const Point3d& p) { return Point3d(17.5 + p[1], -p[0], p[2]); }));
		const double a = M_PI / sides, r = 10 * std::cos(a);
		const Point3d towards(std::sin(a), 0, std::cos(a));
		bool isSeen = false;
		const SurfaceAround surface = [&](const LabelFrame& f, double halfSide) {
			SurfacePatch patch = CollectSurface(run, f, halfSide);
			if (halfSide < 8) return patch;
			isSeen = true;
			const SurfacePatch more = CollectSurface(branch, At({17.5, 0, 6}, {0, 0, 1}), halfSide);
			patch.folds.insert(patch.folds.end(), more.folds.begin(), more.folds.end());
			return patch;
		};
		ExpectAxis(WrappedFrame(At(towards * r + Point3d(0, 11, 0), towards), 40, surface), {0, 1, 0}, r);
		EXPECT_TRUE(isSeen) << sides;
	}
}

TEST(WrapAxis, InPerspective)
{
	LabelFrame frame = At({0, 0, 10}, {0.1, 0.1, 1});
	frame.perspective = true;
	frame.center = {4, 3, 90};
	ExpectAxis(WrappedOn(Turned({10, 10, 10, 10, 10}, 48, 8), frame), {0, 1, 0}, 10);
}

TEST(WrapAxis, InsideAPipe)
{
	Shape pipe = Turned({10, 10, 10, 10}, 48, 8);
	for (auto& f : pipe.faces) std::swap(f[1], f[2]);  // its inside is what is seen
	const LabelFrame f = WrappedOn(pipe, At({0, 0, -10}, {0.1, 0.2, 1}));
	ExpectAxis(f, {0, 1, 0}, -10);
	EXPECT_NEAR(f.w[2], 1, 1e-9);
}

TEST(WrapAxis, ConesBarrelsAndRings)
{
	std::vector<double> cone, barrel, ring;
	for (int i = 0; i <= 20; ++i) {
		cone.push_back(6 + 0.4 * i);
		barrel.push_back(10 - 0.02 * (i - 10) * (i - 10));
		ring.push_back(10 + std::sqrt(16 - 0.14 * (i - 10) * (i - 10)));
	}
	ExpectAxis(WrappedOn(Turned(cone, 72), At({0, 0, 10}, {0, -0.4, 1})), {0, 1, 0}, 10, 2e-3);
	ExpectAxis(WrappedOn(Turned(barrel, 72), At({0, 0, 10}, {0.1, 0.1, 1})), {0, 1, 0}, 10, 2e-3);
	ExpectAxis(WrappedOn(Turned(ring, 72, 0.35), At({0, 0, 14}, {0, 0, 1})), {0, 1, 0}, 14, 2e-3);
}

// A narrow rim between chamfers, whose normals tell of the same axis.
TEST(WrapAxis, RimWithChamfers)
{
	const Shape rim = Turned({20, 35, 36, 36, 36, 35, 20}, 72, 1);
	for (const Point3d& up : {Point3d(0, 1, 0), Point3d(1, 0, 0)})
		ExpectAxis(WrappedOn(rim, At({0, 0, 36}, {0, 0, 1}, up)), {0, 1, 0}, 36);
}

// A scan: its normals tell nothing, its points do.
TEST(WrapAxis, Noisy)
{
	int i = 0;
	const Shape scan = Turned(std::vector<double>(81, 10.0), 240, 0.25).moved([&](const Point3d& p) {
		++i;
		return p * (1 + 0.003 * std::sin(0.37 * i * i));
	});
	for (const Point3d& towards : {Point3d(0, 0, 1), Point3d(0.3, 0, 1)})
		ExpectAxis(WrappedOn(scan, At({0, 0, 10}, towards)), {0, 1, 0}, 10, 3e-2);
}

TEST(WrapAxis, OnASphereTheLabelsUp)
{
	const LabelFrame f =
		WrappedOn(test_mesh::Sphere(10, 48, 24).moved([](const Point3d& p) { return Point3d(p[0], p[2], -p[1]); }),
	              At({0, 0, 10}, {0, 0, 1}));
	ExpectAxis(f, {0, 1, 0}, 10, 1e-2);
	ExpectUp(f, {0, 1, 0});
}

TEST(WrapAxis, NoneOnWhatIsFlat)
{
	EXPECT_TRUE(HasNoAxis(test_mesh::Slab(30, 20, 4, 15, 10), At({0.1, 0.2, 0}, {0, 0, 1})));
	EXPECT_TRUE(HasNoAxis(test_mesh::Box(10, 20, 30), At({0.1, 0.2, 0}, {0, 0, 1})));
	EXPECT_TRUE(HasNoAxis(test_mesh::Slab(30, 20, 4, 15, 10).moved([](Point3d p) {
		p[2] += 1e-6 * std::sin(7 * p[0] + 5 * p[1]);
		return p;
	}),
	                      At({0.1, 0.2, 0}, {0, 0, 1})));
}

// ---- through a request

}  // namespace
