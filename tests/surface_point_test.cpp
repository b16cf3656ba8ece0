// Points of the label plane on the surface, against the definitions.

#include "vcg_ext/surface_point.h"

#include <gtest/gtest.h>
#include <random>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

// The weights that mix the corners into a point must give back that point, from the definition.
TEST(SpaceWeights, GiveThePointUnderTheProjection)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> unit(0, 1);
	const Shape ball = test_mesh::Sphere(12, 20, 12);
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(30)}) {
		const LabelSpace space(frame);
		const Sheet sheet = CandidatesOf(ball, space, 8, 8);
		for (size_t t = 0; t < sheet.triangles.size(); ++t) {
			if (!sheet.triangles[t].facing) continue;
			double a = unit(random), b = unit(random);
			if (a + b > 1) a = 1 - a, b = 1 - b;
			const auto& v = sheet.triangles[t].vertex;
			const auto at = [&](size_t k) { return sheet.vertices[size_t(v[k])].label; };
			const Point3d q = at(0) * (1 - a - b) + at(1) * a + at(2) * b;
			const Point3d w = SpaceWeights(space, sheet, int(t), space.project(q));
			EXPECT_NEAR(w[0], 1 - a - b, 1e-9);
			EXPECT_NEAR(w[1], a, 1e-9);
			EXPECT_NEAR(w[2], b, 1e-9);
		}
	}
}

// A small circle of the label plane, carried to the surface along the lines of sight, is longest in the direction of the stretch.
TEST(StretchOf, IsTheMostThatASmallCircleGrows)
{
	constexpr double pi = 3.14159265358979323846, step = 1e-6;
	constexpr int directions = 720;
	std::mt19937 random(2);
	std::uniform_real_distribution<double> unit(-1, 1);
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(30)}) {
		const LabelSpace space(frame);
		for (int i = 0; i < 50; ++i) {
			const Point3d at(10 * unit(random), 10 * unit(random), 10 * unit(random));
			const Point3d normal(2 * unit(random), 2 * unit(random), 1);
			const Point3d eye = space.perspective() ? space.center() : at + Point3d(0, 0, 100);
			if (normal * (eye - at) <= 0) continue;
			const auto onSurface = [&](const Point2d& p) {
				const Point3d onPlane(p[0], p[1], 0);
				const Point3d ray = space.perspective() ? onPlane - eye : Point3d(0, 0, -1);
				return onPlane + ray * ((normal * (at - onPlane)) / (normal * ray));
			};
			const Point2d middle = space.project(at);
			double most = 0;
			for (int d = 0; d < directions; ++d) {
				const double angle = pi * d / directions;
				const Point2d way = Point2d(std::cos(angle), std::sin(angle)) * step;
				most = std::max(most, (onSurface(middle + way) - onSurface(middle - way)).Norm() / (2 * step));
			}
			const double stretch = StretchOf(space, at, normal);
			EXPECT_NEAR(stretch, most, 1e-4 * most) << i;
		}
	}
}

TEST(StretchOf, IsInfiniteWhereTheSurfaceTurnsItsBack)
{
	const LabelSpace space(FromAbove());
	EXPECT_EQ(StretchOf(space, {0, 0, 0}, {1, 0, -1}), std::numeric_limits<double>::infinity());
	EXPECT_EQ(StretchOf(space, {0, 0, 0}, {1, 0, 0}), std::numeric_limits<double>::infinity());
}

// Looked at from above, the box's top lies over its bottom.
TEST(SeenAt, IsOnTheNearestOfSeveralSurfaces)
{
	const Shape box = test_mesh::Box(20, 10, 2);
	double top = -1e9;
	for (const Point3d& p : box.points) top = std::max(top, p[2]);
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(30)}) {
		const LabelSpace space(frame);
		const Sheet sheet = CandidatesOf(box, space, 50, 50);
		const Point3d seen(3, 2, top);
		EXPECT_LE((SeenAt(space, sheet, space.project(seen)) - seen).Norm(), 1e-12);
		EXPECT_EQ(SeenAt(space, sheet, {40, 0}), Point3d(40, 0, 0));  // beside the box: on the label plane
	}
}

// Of two plates one over the other it is the upper one, whichever of them the mesh has first.
TEST(SeenAt, IsOnTheNearestOfTwoPartsInEitherOrder)
{
	const Shape upper = test_mesh::Box(20, 10, 2),
				lower = upper.moved([](const Point3d&p) { return p - Point3d(0, 0, 5); });
	for (const Shape& both : {upper.joined(lower), lower.joined(upper)})
		for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(30)}) {
			const LabelSpace space(frame);
			const Sheet sheet = CandidatesOf(both, space, 50, 50);
			const Point3d seen(3, 2, 0);
			EXPECT_LE((SeenAt(space, sheet, space.project(seen)) - seen).Norm(), 1e-12);
		}
}

/// Of one facet, four units high, of a prism or a pyramid round y under a label that is wrapped at `radius`.
/// @param[in] outer  of its corners from the axis, halfway up
/// @param[in] slant  how much nearer these are below, and further away above
double StretchOverFacet(int sides, double outer, double radius, double slant)
{
	const double half = M_PI / sides;
	Shape facet;
	for (const double side : {-1.0, 1.0})
		for (const double end : {-1.0, 1.0}) {
			const double r = outer + end * slant;
			facet.add({side * r * std::sin(half), 2 * end, r * std::cos(half)});
		}
	facet.quad(0, 2, 3, 1);
	LabelFrame frame;
	frame.origin = {0, 0, radius};
	frame.wrapRadius = radius;
	const LabelSpace space(frame);
	const Sheet sheet = CandidatesOf(facet, space, 0.1, 0.1);
	EXPECT_EQ(sheet.triangles.size(), 2u);
	double most = 0;
	for (const SheetTriangle& t : sheet.triangles) most = std::max(most, StretchOver(space, sheet, t));
	return most;
}

// A facet is as wide as the chord, its place in the label as the arc of the label's radius; along the axis nothing changes.
TEST(StretchOver, IsTheChordOverTheArcOfTheLabel)
{
	for (const int sides : {6, 24, 200}) {
		const double half = M_PI / sides, chord = std::sin(half) / half;
		EXPECT_NEAR(StretchOverFacet(sides, 10, 10, 0), 1, 1e-12) << "narrower, but as high";
		EXPECT_NEAR(StretchOverFacet(sides, 30, 10, 0), 3 * chord, 1e-9) << sides;
		EXPECT_NEAR(StretchOverFacet(sides, 5, 10, 0), 1, 1e-12) << "half as wide, and as high";
	}
}

// On a cone, the way along the facet is longer than that along the axis.
TEST(StretchOver, OfAConeIsItsSlant)
{
	const int sides = 400;
	for (const double slant : {0.5, 2.0, 6.0})
		EXPECT_NEAR(StretchOverFacet(sides, 10, 20, slant), std::hypot(1, slant / 2), 0.02);
}

}  // namespace
