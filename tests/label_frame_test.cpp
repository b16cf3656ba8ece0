// The frame: projections against the plain geometry of lines and planes, and every frame that must be refused.

#include "vcg_ext/label_frame.h"

#include <functional>
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace vcg::textlabel;
using vcg::Point2d;
using vcg::Point3d;

vcg::Matrix44d Layer(const Point3d& x, const Point3d& y, const Point3d& z, const Point3d& shift)
{
	vcg::Matrix44d m = LabelFrame::Identity();
	for (int i = 0; i < 3; ++i) {
		m.ElementAt(i, 0) = x[i];
		m.ElementAt(i, 1) = y[i];
		m.ElementAt(i, 2) = z[i];
		m.ElementAt(i, 3) = shift[i];
	}
	return m;
}

Point3d RandomPoint(std::mt19937& random, double size)
{
	std::uniform_real_distribution<double> x(-size, size);
	const double a = x(random), b = x(random);
	return {a, b, x(random)};
}

/// A frame with everything askew: slanted axes, a layer that scales, shears and, when asked, mirrors.
LabelFrame Askew(bool mirror)
{
	LabelFrame f = FrameFromDirection({3, -2, 5}, {1, 2, 3}, {0.2, 1, -0.1});
	f.perspective = true;
	f.center = f.origin + f.w * 20 + f.u * 3 - f.v;
	f.toWorld = Layer({2, 0.1, 0}, {0, 1.5, 0.3}, {0.2, 0, mirror ? -1.0 : 1.0}, {10, -20, 30});
	return f;
}

bool IsRefused(const std::function<void()>& f)
{
	try {
		f();
	} catch (const Error& e) {
		return e.code == ErrorCode::BadFrame;
	}
	return false;
}

TEST(FrameFromDirection, IsOrthonormalAndUpright)
{
	std::mt19937 random(1);
	for (int n = 0; n < 1000; ++n) {
		const Point3d w = RandomPoint(random, 1), up = RandomPoint(random, 1), origin = RandomPoint(random, 100);
		const LabelFrame f = FrameFromDirection(origin, w, up);
		EXPECT_EQ(f.origin, origin);
		EXPECT_NEAR((f.w - w / w.Norm()).Norm(), 0, 1e-15);
		for (const Point3d& axis : {f.u, f.v, f.w}) EXPECT_NEAR(axis.Norm(), 1, 1e-15);
		EXPECT_NEAR(((f.u ^ f.v) - f.w).Norm(), 0, 1e-15);
		EXPECT_GT(f.v * up, 0);
		EXPECT_NEAR(f.u * up, 0, 1e-15) << "reading direction is level";
		EXPECT_NO_THROW(LabelSpace space(f));
	}
}

TEST(FrameFromDirection, LengthsDoNotMatter)
{
	const LabelFrame unit = FrameFromDirection({0, 0, 0}, {1, 2, 3}, {0, 0, 1});
	for (const double scale : {1e-300, 1e-20, 1e20, 1e300}) {
		const LabelFrame f = FrameFromDirection({0, 0, 0}, Point3d(1, 2, 3) * scale, Point3d(0, 0, 1) / scale);
		EXPECT_NEAR((f.u - unit.u).Norm() + (f.v - unit.v).Norm() + (f.w - unit.w).Norm(), 0, 1e-15);
	}
}

TEST(FrameFromDirection, RefusesWhatGivesNoFrame)
{
	const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
	const Point3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
	EXPECT_TRUE(IsRefused([&] { FrameFromDirection(o, o, y); }));
	EXPECT_TRUE(IsRefused([&] { FrameFromDirection(o, x, o); }));
	EXPECT_TRUE(IsRefused([&] { FrameFromDirection(o, x, x * 3); }));
	EXPECT_TRUE(IsRefused([&] { FrameFromDirection(o, x, x * -1e9 + y); })) << "as good as parallel";
	for (const Point3d& bad : {Point3d(nan, 0, 0), Point3d(0, infinity, 0)}) {
		EXPECT_TRUE(IsRefused([&] { FrameFromDirection(bad, x, y); }));
		EXPECT_TRUE(IsRefused([&] { FrameFromDirection(o, bad, y); }));
		EXPECT_TRUE(IsRefused([&] { FrameFromDirection(o, x, bad); }));
	}
}

TEST(LabelSpace, AgreesWithTheMatrixWrittenOut)
{
	std::mt19937 random(2);
	for (const bool mirror : {false, true}) {
		const LabelFrame f = Askew(mirror);
		const LabelSpace space(f);
		EXPECT_EQ(space.mirrors(), mirror);
		for (int n = 0; n < 200; ++n) {
			const Point3d p = RandomPoint(random, 10);
			Point3d world;
			for (int i = 0; i < 3; ++i)
				world[i] = f.toWorld.ElementAt(i, 0) * p[0] + f.toWorld.ElementAt(i, 1) * p[1] +
				           f.toWorld.ElementAt(i, 2) * p[2] + f.toWorld.ElementAt(i, 3);
			const Point3d d = world - f.origin, expected(f.u * d, f.v * d, f.w * d), q = space.toLabel(p);
			EXPECT_NEAR((q - expected).Norm(), 0, 1e-12);
			EXPECT_NEAR((space.toMesh(q) - p).Norm(), 0, 1e-12);
			EXPECT_NEAR(
				(space.vectorToMesh(space.toMesh({0, 0, 0}), q) - (space.toMesh(q) - space.toMesh({0, 0, 0}))).Norm(),
				0, 1e-12);
		}
	}
}

// In front of C the projection of q is where the line from C through q meets z = 0.
TEST(LabelSpace, PerspectiveProjectsAlongLinesThroughC)
{
	std::mt19937 random(3);
	const LabelFrame f = Askew(false);
	const LabelSpace space(f);
	const Point3d c = space.center();
	EXPECT_NEAR((c - Point3d(3, -1, 20)).Norm(), 0, 1e-12);
	for (int n = 0; n < 200; ++n) {
		const Point3d q = RandomPoint(random, 15);
		ASSERT_TRUE(space.isInFront(q));
		const Point2d p = space.project(q);
		const Point3d foot(p[0], p[1], 0);
		EXPECT_NEAR(((foot - c) ^ (q - c)).Norm() / (foot - c).Norm(), 0, 1e-12) << "not on one line";
		EXPECT_NEAR(space.magnification(q), (foot - c).Norm() / (q - c).Norm(), 1e-12);
		const Point3d towards = space.towardsViewer(q);
		EXPECT_NEAR(towards.Norm(), 1, 1e-14);
		EXPECT_NEAR((towards ^ (c - q)).Norm(), 0, 1e-12);
		EXPECT_GT(towards * (c - q), 0);
	}
	EXPECT_FALSE(space.isInFront(c));
	EXPECT_FALSE(space.isInFront(c + Point3d(1, 2, 3)));
	EXPECT_TRUE(space.isInFront({100, 100, -1e6}));
}

// Points of the label plane stay where they are, and midpoints weighted by magnification project onto midpoints.
TEST(LabelSpace, PerspectiveKeepsLinesStraight)
{
	std::mt19937 random(4);
	const LabelSpace space(Askew(false));
	for (int n = 0; n < 200; ++n) {
		const Point3d a = RandomPoint(random, 10), b = RandomPoint(random, 10);
		EXPECT_NEAR((space.project({a[0], a[1], 0}) - Point2d(a[0], a[1])).Norm(), 0, 1e-12);
		const Point2d pa = space.project(a), pb = space.project(b);
		const double ka = space.magnification(a), kb = space.magnification(b);
		const Point3d between = (a * ka + b * kb) / (ka + kb);
		EXPECT_NEAR((space.project(between) - (pa + pb) / 2).Norm(), 0, 1e-10);
	}
}

TEST(LabelSpace, ParallelProjectionDropsTheDepth)
{
	LabelFrame f = Askew(false);
	f.perspective = false;
	const LabelSpace space(f);
	const Point3d q(3, 4, -5);
	EXPECT_EQ(space.project(q), Point2d(3, 4));
	EXPECT_EQ(space.magnification(q), 1);
	EXPECT_EQ(space.towardsViewer(q), Point3d(0, 0, 1));
	EXPECT_TRUE(space.isInFront({0, 0, 1e300}));
}

// Differences are taken before anything is multiplied: far from the origin nothing is lost.
TEST(LabelSpace, KeepsDigitsFarAway)
{
	LabelFrame f = FrameFromDirection({500000, 4000000, 100}, {0, 0, 1}, {0, 1, 0});
	const LabelSpace space(f);
	const Point3d step(std::ldexp(1, -20), std::ldexp(3, -20), std::ldexp(5, -20));
	EXPECT_EQ(space.toLabel(f.origin + step), step);
	EXPECT_EQ(space.toMesh(step), f.origin + step);
}

TEST(LabelSpace, ScaleBoundsTheLongestStretch)
{
	std::mt19937 random(5);
	EXPECT_EQ(LabelSpace(LabelFrame()).scale(), 1);
	const LabelFrame f = Askew(true);
	const LabelSpace space(f);
	for (int n = 0; n < 200; ++n) {
		const Point3d a = RandomPoint(random, 10), b = RandomPoint(random, 10);
		EXPECT_LE((space.toLabel(a) - space.toLabel(b)).Norm(), space.scale() * (a - b).Norm());
	}
	EXPECT_LE(space.scale(), 2 * std::sqrt(3.0) * 1.01) << "no more than the Frobenius norm";
	LabelFrame long1;  // of determinant 1, but no rigid layer
	long1.toWorld.ElementAt(0, 0) = 64;
	long1.toWorld.ElementAt(1, 1) = 1.0 / 64;
	EXPECT_GE(LabelSpace(long1).scale(), 64);
	LabelFrame mirrored;
	mirrored.toWorld.ElementAt(0, 0) = -1;
	EXPECT_EQ(LabelSpace(mirrored).scale(), 1);
}

TEST(LabelSpace, RefusesWhatIsNoFrame)
{
	const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
	const std::vector<std::function<void(LabelFrame&)>> spoil = {
		[&](LabelFrame& f) { f.origin[2] = nan; },
		[&](LabelFrame& f) { f.u[0] = infinity; },
		[&](LabelFrame& f) { f.u = f.u * 1.001; },
		[&](LabelFrame& f) { f.w = f.w * -1.0; },
		[&](LabelFrame& f) { f.v = f.u; },
		[&](LabelFrame& f) {
			f.u = {0, 0, 0};
		},
		[&](LabelFrame& f) { f.center = f.origin; },
		[&](LabelFrame& f) { f.center = f.origin - f.w; },
		[&](LabelFrame& f) { f.center = f.origin + f.u * 5; },
		[&](LabelFrame& f) { f.center[0] = nan; },
		[&](LabelFrame& f) {
			f.toWorld = Layer({1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 0});
		},
		[&](LabelFrame& f) {
			f.toWorld = Layer({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
		},
		[&](LabelFrame& f) {
			f.toWorld = Layer({1, 0, 0}, {0, nan, 0}, {0, 0, 1}, {0, 0, 0});
		},
		[&](LabelFrame& f) {
			f.toWorld = Layer({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, infinity, 0});
		},
		[&](LabelFrame& f) { f.toWorld.ElementAt(3, 3) = 2; },
		[&](LabelFrame& f) { f.toWorld.ElementAt(3, 0) = 0.1; },
	};
	for (size_t i = 0; i < spoil.size(); ++i) {
		LabelFrame f;
		f.perspective = true;
		f.center = {0, 0, 5};
		EXPECT_NO_THROW(LabelSpace space(f));
		spoil[i](f);
		EXPECT_TRUE(IsRefused([&] { LabelSpace space(f); })) << "case " << i;
	}
}

}  // namespace
