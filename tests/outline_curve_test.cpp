// Curves: the box against dense samples, maps against their parts.

#include "outline_curve.h"

#include <gtest/gtest.h>
#include <random>

using namespace textlabel;
using vcg::Point2d;

namespace {

class Curves : public testing::Test {
protected:
	double number() { return std::uniform_real_distribution<double>(-1, 1)(m_random); }
	Point2d point() { return {number(), number()}; }
	CurvePiece piece(int degree)
	{
		if (degree == 1) return CurvePiece::Line(point(), point());
		if (degree == 2) return CurvePiece::Quadratic(point(), point(), point());
		return CurvePiece::Cubic(point(), point(), point(), point());
	}

private:
	std::mt19937 m_random{3};
};

TEST_F(Curves, BoxIsThatOfDenseSamples)
{
	for (int round = 0; round < 300; ++round) {
		const CurvePiece p = piece(1 + round % 3);
		const vcg::Box2d box = BoxOf({{p, CurvePiece::Line(p.end(), p.start())}});
		vcg::Box2d samples;
		for (int i = 0; i <= 2000; ++i) samples.Add(PointAt(p, i / 2000.0));
		for (int axis = 0; axis < 2; ++axis) {
			EXPECT_LE(box.min[axis], samples.min[axis]);
			EXPECT_GE(box.max[axis], samples.max[axis]);
			EXPECT_NEAR(box.min[axis], samples.min[axis], 1e-5);
			EXPECT_NEAR(box.max[axis], samples.max[axis], 1e-5);
		}
	}
	EXPECT_TRUE(BoxOf({}).IsNull());
}

TEST_F(Curves, PointsFollowBernstein)
{
	const CurvePiece p = piece(3);
	const double t = 0.37, s = 1 - t;
	const Point2d expected =
		p.p[0] * (s * s * s) + p.p[1] * (3 * s * s * t) + p.p[2] * (3 * s * t * t) + p.p[3] * (t * t * t);
	EXPECT_NEAR((PointAt(p, t) - expected).Norm(), 0, 1e-14);
	EXPECT_EQ(PointAt(p, 0), p.start());
	EXPECT_EQ(PointAt(p, 1), p.end());
}

TEST_F(Curves, MapsFollowEachOther)
{
	for (int round = 0; round < 50; ++round) {
		const Affine outer{number(), number(), number(), number(), number(), number()};
		const Affine inner{number(), number(), number(), number(), number(), number()};
		const Point2d q = point();
		EXPECT_NEAR((outer.after(inner)(q) - outer(inner(q))).Norm(), 0, 1e-14);
		const CurvePiece p = piece(3);
		EXPECT_NEAR((PointAt(Mapped({{p}}, outer)[0][0], 0.3) - outer(PointAt(p, 0.3))).Norm(), 0, 1e-14);
	}
}

}  // namespace
