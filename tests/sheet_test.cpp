// The sheet: which triangles become candidates and how they hang together, against a look at every one of them.

#include "vcg_ext/collect_sheet.h"

#include <gtest/gtest.h>
#include <random>
#include <set>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

/// Whether a triangle, projected, meets a box: clipped by its four sides, something is left.
bool MeetsBox(std::vector<Point2d> polygon, double halfWidth, double halfHeight)
{
	for (int side = 0; side < 4; ++side) {
		const double sign = side % 2 == 0 ? 1 : -1, limit = side < 2 ? halfWidth : halfHeight;
		const auto inside = [&](const Point2d& p) { return limit - sign * p[side < 2 ? 0 : 1]; };
		std::vector<Point2d> kept;
		for (size_t i = 0; i < polygon.size(); ++i) {
			const Point2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
			const double da = inside(a), db = inside(b);
			if (da >= 0) kept.push_back(a);
			if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
		}
		polygon.swap(kept);
	}
	return !polygon.empty();
}

TEST(Sheet, HoldsEveryTriangleThatMeetsTheBox)
{
	const Shape ball = test_mesh::Sphere(12, 40, 24);
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(40)}) {
		const LabelSpace space(frame);
		const Sheet sheet = CandidatesOf(ball, space, 5, 3);
		std::set<int> candidates;
		for (const SheetTriangle& t : sheet.triangles) candidates.insert(t.face);
		for (size_t f = 0; f < ball.faces.size(); ++f) {
			std::vector<Point2d> plane;
			for (const int v : ball.faces[f]) plane.push_back(space.project(space.toLabel(ball.points[size_t(v)])));
			if (MeetsBox(plane, 5, 3)) { EXPECT_EQ(candidates.count(int(f)), 1u) << "face " << f; }
		}
		EXPECT_LT(candidates.size(), ball.faces.size() / 2) << "and not the whole mesh";
	}
}

/// The code that CodeVertices gives a point, and the one that it has by the angle round the axis itself.
void ExpectCodeOfUnrolled(const LabelSpace& space, const PlaneBox& box, const Point3d& p)
{
	const Point3d q = space.inFrame(p);
	EXPECT_EQ(int(detail::WindowRoundAxis(space, box).codeOf(q)),
	          int(detail::OutCodeOfUnrolled(space, space.unrolledBox(box), space.unrolledInFrame(q))))
		<< p[0] << ' ' << p[1] << ' ' << p[2];
}

TEST(Sheet, CodesRoundAnAxisAreThoseOfTheAngle)
{
	std::mt19937 random(5);
	std::uniform_real_distribution<double> number(-1, 1);
	const double pi = std::acos(-1.0);
	for (const double radius : {10.0, -10.0}) {
		for (const double width : {0.5, 8.0, 15.0, 29.0, 31.0, 31.5, 40.0}) {  // half of it; half the way round is 31.4
			LabelFrame frame = FromAbove();
			frame.wrapRadius = radius;
			const double slant = number(random);
			frame.wrapAxis = frame.u * std::sin(slant) + frame.v * std::cos(slant);
			const Point2d middle(4 * number(random), 0);
			const LabelSpace space(frame, middle);
			const double atMiddle = space.angleAt(0);
			PlaneBox box;
			box.add(middle - Point2d(width, 3));
			box.add(middle + Point2d(width, 3));
			std::vector<double> angles = {0, pi / 2, -pi / 2, pi, -pi};
			const PlaneBox window = space.unrolledBox(box);
			for (const double end : {window.low[0], window.high[0]})
				for (const double by : {0.0, 1e-15, -1e-15, 1e-10, -1e-10, 1e-7, -1e-7})
					angles.push_back(space.angleAt(end) + by);
			for (int i = 0; i < 300; ++i) angles.push_back(pi * number(random));
			for (const double angle : angles)
				for (const double distance : {0.0, 1e-3, 9e-3, 1.0, 10.0, 1e6, 1e200}) {
					const double height = std::copysign(1.0, radius) * distance - radius;
					for (const double along : {-8.0, 0.0, 2.0})
						ExpectCodeOfUnrolled(space, box,
						                     space.toMesh(space.turned({radius * (angle - atMiddle), along, height})));
				}
		}
	}
}

TEST(Sheet, KeepsOrderPlacesAndFacing)
{
	const Shape ball = test_mesh::Sphere(12, 40, 24);
	const LabelSpace space(FromAbovePerspective(40));
	const Sheet sheet = CandidatesOf(ball, space, 5, 3);
	double largest = 0;
	for (const SheetVertex& v : sheet.vertices) {
		EXPECT_EQ(v.mesh, ball.points[size_t(v.index)]);
		EXPECT_NEAR((v.plane - space.project(v.mesh)).Norm(), 0, 1e-12);
		for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(v.mesh[i]));
	}
	EXPECT_EQ(sheet.largestCoordinate, largest);
	for (size_t t = 0; t < sheet.triangles.size(); ++t) {
		EXPECT_TRUE(t == 0 || sheet.triangles[t - 1].face < sheet.triangles[t].face);
		std::array<Point3d, 3> p;
		for (size_t k = 0; k < 3; ++k) {
			const SheetVertex& v = sheet.vertices[size_t(sheet.triangles[t].vertex[k])];
			EXPECT_EQ(v.index, ball.faces[size_t(sheet.triangles[t].face)][k]);
			p[k] = v.mesh;
		}
		EXPECT_EQ(sheet.triangles[t].facing, ((p[1] - p[0]) ^ (p[2] - p[0])) * (Point3d(0, 0, 40) - p[0]) > 0);
	}
}

// A slab 4 thick on two feet, seen from above: the undersides lie at -4 and -10, the deepest that face the viewer, the feet's tops,
// at -4.
TEST(Sheet, LeavesOutBacksThatLieTooDeep)
{
	const auto at = [](double x, double z) { return [=](const Point3d& p) { return p + Point3d(x, 0, z); }; };
	const Shape slab = test_mesh::Slab(30, 20, 4, 6, 4),
				part = slab.joined(test_mesh::Slab(4, 4, 6, 2, 2).moved(at(-5, -4)))
	                       .joined(test_mesh::Box(2, 2, 6).moved(at(5, -4)));
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, part);
	PlaneBox box;
	box.add({-9, -6});
	box.add({9, 6});
	const LabelSpace space(FromAbove());
	const auto deepest = [&](const Sheet& sheet) {
		double z = 0;
		for (const SheetVertex& v : sheet.vertices) z = std::min(z, v.mesh[2]);
		return z;
	};
	const Sheet whole = CollectSheet(m, space, box), shallow = CollectSheet(m, space, box, 5);
	EXPECT_FALSE(whole.isShallow);
	EXPECT_EQ(deepest(whole), -10);
	EXPECT_TRUE(shallow.isShallow);
	EXPECT_EQ(deepest(shallow), -10) << "the sides of the feet reach up to -4";
	std::set<int> kept;
	for (const SheetTriangle& t : shallow.triangles) kept.insert(t.face);
	for (const SheetTriangle& t : whole.triangles) {
		double nearest = -100;
		for (const int v : t.vertex) nearest = std::max(nearest, whole.vertices[size_t(v)].mesh[2]);
		EXPECT_EQ(kept.count(t.face) == 1, t.facing || nearest >= -9) << t.face;
	}
	EXPECT_FALSE(CollectSheet(m, space, box, 6.1).isShallow);
}

TEST(Sheet, TwinsAreTwins)
{
	const Sheet sheet = CandidatesOf(test_mesh::Sphere(12, 40, 24), LabelSpace(FromAbove()), 5, 3);
	int paired = 0;
	for (int h = 0; h < int(sheet.twin.size()); ++h) {
		const int other = sheet.twin[size_t(h)];
		EXPECT_NE(other, NonManifoldEdge);
		if (other < 0) continue;
		++paired;
		EXPECT_EQ(sheet.twin[size_t(other)], h);
		EXPECT_EQ(sheet.from(h), sheet.to(other));
		EXPECT_EQ(sheet.to(h), sheet.from(other));
		EXPECT_EQ(sheet.canonical(h), std::min(h, other));
	}
	EXPECT_GT(paired, int(sheet.twin.size()) / 2);
}

TEST(Sheet, TellsBordersAndNonManifoldEdgesApart)
{
	const Shape two = test_mesh::Sheet(1, 1, [](int i, int j) { return Point3d(i, j, 0); });  // faces 0 1 3, 0 3 2
	const auto kinds = [](const Shape& s) {
		const Sheet sheet = CandidatesOf(s, LabelSpace(LabelFrame()), 5, 5);
		std::array<int, 3> count = {0, 0, 0};  // twins, borders, non-manifold
		for (const int t : sheet.twin) ++count[t >= 0 ? 0 : t == BorderEdge ? 1 : 2];
		return count;
	};
	EXPECT_EQ(kinds(two), (std::array<int, 3>{2, 4, 0}));
	Shape flipped = two;
	std::swap(flipped.faces[1][1], flipped.faces[1][2]);
	EXPECT_EQ(kinds(flipped), (std::array<int, 3>{0, 4, 2})) << "the diagonal, run along twice in the same direction";
	Shape fin = two;
	fin.faces.push_back({0, 3, fin.add({0, 0, 1})});
	EXPECT_EQ(kinds(fin), (std::array<int, 3>{0, 6, 3}));
	Shape twice = two;
	twice.faces.push_back(twice.faces[0]);
	EXPECT_EQ(kinds(twice), (std::array<int, 3>{0, 2, 7}))
		<< "a duplicate face: its edges are doubled, the diagonal has three";
}

TEST(Sheet, FansHoldTheTrianglesAroundEachVertex)
{
	const Sheet sheet = CandidatesOf(test_mesh::Fan(50, 10, 3), LabelSpace(LabelFrame()), 20, 20);
	for (size_t v = 0; v < sheet.vertices.size(); ++v) {
		std::set<int> expected, found;
		for (size_t t = 0; t < sheet.triangles.size(); ++t)
			for (const int corner : sheet.triangles[t].vertex)
				if (corner == int(v)) expected.insert(int(t));
		for (int i = sheet.vertexStart[v]; i < sheet.vertexStart[v + 1]; ++i) found.insert(sheet.vertexFan[size_t(i)]);
		EXPECT_EQ(found, expected);
	}
}

TEST(Sheet, LeavesOutWhatHasNoPlace)
{
	Shape s = test_mesh::Sheet(2, 1, [](int i, int j) { return Point3d(i, j, 0); });
	s.points[0][2] = std::nan("");
	const Sheet sheet = CandidatesOf(s, LabelSpace(LabelFrame()), 5, 5);
	EXPECT_EQ(sheet.triangles.size(), 2u);  // both triangles of the first square have vertex 0
	EXPECT_TRUE(sheet.straddling.empty());
	s.points[0][2] = 50;
	const Sheet behind = CandidatesOf(s, LabelSpace(FromAbovePerspective(20)), 5, 5);
	EXPECT_EQ(behind.triangles.size(), 2u);
	EXPECT_FALSE(behind.straddling.empty());
}

TEST(Sheet, KnowsEdgesThatGoOnBehindTheCamera)
{
	// strips that rise from z = -30 to 30; those from 18 on reach behind the camera at 20
	const Shape ramp =
		test_mesh::Sheet(10, 1, [](int i, int j) { return Point3d(10 * i - 50, 100 * j - 50, 6.0 * i - 30); });
	const LabelSpace space(FromAbovePerspective(20));
	Sheet sheet = CandidatesOf(ramp, space, 1000, 1000);
	ASSERT_EQ(sheet.straddling.size(), 2u);
	int beside = 0;
	for (int h = 0; h < int(sheet.twin.size()); ++h) {
		const double x = sheet.vertices[size_t(sheet.from(h))].mesh[0], y = sheet.vertices[size_t(sheet.to(h))].mesh[0];
		const bool isLast = x == 30 && y == 30;
		EXPECT_EQ(sheet.twin[size_t(h)] == vcg::textlabel::BehindCameraEdge, isLast) << x << " " << y;
		beside += isLast;
	}
	EXPECT_EQ(beside, 1);
	const std::vector<int> twin = sheet.twin;
	vcg::textlabel::detail::LinkTriangles(sheet);  // as after a flip
	EXPECT_EQ(sheet.twin, twin);
}

}  // namespace
