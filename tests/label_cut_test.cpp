// The cut: what the letters cover, against the outline itself.

#include "vcg_ext/label_cut.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

Shape Ball()
{
	return test_mesh::Sphere(12, 40, 24).moved([](const Point3d& p) { return p - Point3d(0, 0, 12); });
}

const Point2d& PlaneOf(const CutExample& e, int point) { return e.cut.points.at(e.sheet, point).plane; }

double PlaneArea(const CutExample& e, const IndexTriangle& t)
{
	const Point2d& a = PlaneOf(e, t[0]);
	return ((PlaneOf(e, t[1]) - a) ^ (PlaneOf(e, t[2]) - a)) / 2;
}

Point2d Middle(const CutExample& e, const IndexTriangle& t)
{
	return (PlaneOf(e, t[0]) + PlaneOf(e, t[1]) + PlaneOf(e, t[2])) / 3;
}

void ExpectCutAlongOutline(const CutExample& e, const Outline& outline)
{
	std::map<int, double> areaOf;
	double inside = 0;
	std::map<std::pair<int, int>, Side> edges;
	for (const CutTriangle& t : e.cut.triangles) {
		const double area = PlaneArea(e, t.point);
		EXPECT_GT(area, 0);
		areaOf[t.parent] += area;
		if (t.side == Side::Inside) inside += area;
		if (ContourDistance(outline, Middle(e, t.point)) > 1e-5) {
			EXPECT_EQ(Winding(outline, Middle(e, t.point)), t.side == Side::Inside ? 1 : 0);
		}
		for (size_t k = 0; k < 3; ++k)
			EXPECT_TRUE(edges.emplace(std::make_pair(t.point[k], t.point[(k + 1) % 3]), t.side).second);
	}
	for (const int t : e.cut.within) {
		const auto& v = e.sheet.triangles[size_t(t)].vertex;
		inside += PlaneArea(e, v);
		EXPECT_EQ(Winding(outline, Middle(e, v)), 1);
		for (size_t k = 0; k < 3; ++k)
			EXPECT_TRUE(edges.emplace(std::make_pair(v[k], v[(k + 1) % 3]), Side::Inside).second);
	}
	EXPECT_NEAR(inside, Area(outline), 1e-4);
	EXPECT_NEAR(e.cut.insideArea, inside, 1e-9);
	ASSERT_EQ(areaOf.size(), e.cut.touched.size());
	for (const int t : e.cut.touched)
		if (e.sheet.triangles[size_t(t)].facing) {
			const double whole = PlaneArea(e, e.sheet.triangles[size_t(t)].vertex);
			EXPECT_NEAR(areaOf[t], whole, 1e-9 * whole);
		}
	// the contours are closed and have the letter on their left, the rest on their right
	std::map<int, int> balance;
	for (const ContourPiece& p : e.cut.pieces) {
		++balance[p.from];
		--balance[p.to];
		ASSERT_EQ(edges.count({p.from, p.to}), 1u);
		EXPECT_EQ((edges[{p.from, p.to}]), Side::Inside);
		const auto right = edges.find({p.to, p.from});
		if (right != edges.end()) { EXPECT_EQ(right->second, Side::Outside); }
	}
	for (const auto& [point, count] : balance) EXPECT_EQ(count, 0) << "point " << point;
}

TEST(Cut, FollowsTheOutline)
{
	const Shape slab = test_mesh::Slab(30, 20, 4, 15, 10), box = test_mesh::Box(40, 40, 4);
	for (const Shape& shape : {slab, box, Ball(), test_mesh::Fan(50, 15, 4)})
		for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(60)})
			for (const Outline& outline :
			     {ThreeLetters(), Moved(ThreeLetters(), 0.8, 0.1, 0.2, 0.7), Letters({Rectangle(-4, -4, 4, 4)})})
				ExpectCutAlongOutline(CutExample(shape, outline, frame), outline);
}

// New points are mixtures of corners that project to where they are said to lie, on the surface.
TEST(Cut, PointsAreMixedFromCorners)
{
	const CutExample e(Ball(), ThreeLetters(), FromAbovePerspective(60));
	ASSERT_FALSE(e.cut.points.added.empty());
	for (const CutPoint& p : e.cut.points.added) {
		const auto& [parent, weight] = p.mixture;
		Point3d mesh(0, 0, 0);
		double sum = 0;
		for (size_t i = 0; i < 3; ++i) {
			mesh += e.sheet.vertices[size_t(parent[i])].mesh * weight[i];
			sum += weight[i];
			EXPECT_GE(weight[i], -1e-9);
		}
		EXPECT_NEAR(sum, 1, 1e-12);
		EXPECT_NEAR((mesh - p.mesh).Norm(), 0, 1e-12);
		EXPECT_NEAR((e.space.project(p.label) - p.plane).Norm(), 0, 1e-9);
		EXPECT_NEAR((e.space.toMesh(p.label) - p.mesh).Norm(), 0, 1e-12);
	}
}

// Two letters that share a side cannot be told apart there.
TEST(Cut, LettersThatTouchAreAConflict)
{
	EXPECT_THROW(CutExample(test_mesh::Slab(20, 20, 4, 10, 10),
	                        Letters({Rectangle(-4, -4, 0, 0), Rectangle(0, 0, 4, 4)}), FromAbove()),
	             PlacementConflict);
}

}  // namespace
