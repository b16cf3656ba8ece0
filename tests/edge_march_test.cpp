// The march: contours on a sheet against crossings counted one by one.

#include "vcg_ext/edge_march.h"

#include <gtest/gtest.h>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

constexpr double kSnap = 1e-6;

/// Squares of side 2 over (-10, -10) .. (10, 10), diagonals from lower left to upper right; bent when asked.
Shape Grid(double bend = 0)
{
	return test_mesh::Sheet(
		10, 10, [&](int i, int j) { return Point3d(2 * i - 10, 2 * j - 10, bend * (i % 3) + bend * (j % 4)); });
}

int TriangleAt(const Sheet& sheet, const Point2d& p)
{
	for (size_t t = 0; t < sheet.triangles.size(); ++t) {
		const auto& v = sheet.triangles[t].vertex;
		bool inside = sheet.triangles[t].facing;
		for (size_t k = 0; k < 3; ++k)
			inside = inside && Orient2d(sheet.plane(v[k]), sheet.plane(v[(k + 1) % 3]), p) >= 0;
		if (inside) return int(t);
	}
	return -1;
}

SheetPath March(const Sheet& sheet, const std::vector<Point2d>& contour)
{
	return EdgeMarch(sheet, kSnap).march(contour, TriangleAt(sheet, contour[0]));
}

double Length(const std::vector<Point2d>& p)
{
	double sum = 0;
	for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) sum += (p[i] - p[j]).Norm();
	return sum;
}

/// Nodes lie on the contour and where they say; each piece is in the triangle or along the edge that it names.
void ExpectPathOnSheet(const Sheet& sheet, const SheetPath& path, const std::vector<Point2d>& contour)
{
	const Outline outline = Letters({contour});
	std::vector<Point2d> nodes;
	for (const PathNode& n : path.nodes) {
		nodes.push_back(n.plane);
		EXPECT_LE(ContourDistance(outline, n.plane), kSnap);
		EXPECT_TRUE(n.kind != PathNode::OnVertex || n.plane == sheet.plane(n.where));
		if (n.kind == PathNode::OnEdge) {
			EXPECT_EQ(sheet.canonical(n.where), n.where);
			const Point2d &a = sheet.plane(sheet.from(n.where)), &b = sheet.plane(sheet.to(n.where));
			EXPECT_NEAR((a + (b - a) * n.along - n.plane).Norm(), 0, 1e-12);
		}
	}
	EXPECT_NEAR(Length(nodes), Length(contour), 2 * kSnap * double(nodes.size()));
	ASSERT_EQ(path.pieces.size(), path.nodes.size());
	for (size_t i = 0; i < nodes.size(); ++i) {
		const Point2d &a = nodes[i], &b = nodes[(i + 1) % nodes.size()], middle = (a + b) / 2;
		const SheetPath::Piece& piece = path.pieces[i];
		const int t = piece.triangle >= 0 ? piece.triangle : piece.halfEdge / 3;
		ASSERT_GE(t, 0);
		ASSERT_TRUE((piece.triangle >= 0) != (piece.halfEdge >= 0));
		EXPECT_TRUE(sheet.triangles[size_t(t)].facing);
		const auto& v = sheet.triangles[size_t(t)].vertex;
		for (size_t k = 0; k < 3; ++k) {
			const Point2d &p = sheet.plane(v[k]), &q = sheet.plane(v[(k + 1) % 3]);
			EXPECT_GE(((q - p) ^ (middle - p)) / (q - p).Norm(), -2 * kSnap)
				<< "piece " << i << " lies outside its triangle";
		}
		if (piece.halfEdge < 0) continue;
		const Point2d along = sheet.plane(sheet.to(piece.halfEdge)) - sheet.plane(sheet.from(piece.halfEdge));
		EXPECT_GT(along * (b - a), 0) << "the half-edge runs with the contour: the letter lies on its side";
		EXPECT_NEAR((along ^ (b - a)) / along.Norm(), 0, 2 * kSnap);
	}
}

/// How often a contour crosses edges of the sheet, each counted once; nothing may touch.
int CountCrossings(const Sheet& sheet, const std::vector<Point2d>& contour)
{
	int count = 0;
	for (int h = 0; h < int(sheet.twin.size()); ++h) {
		if (sheet.canonical(h) != h) continue;
		const Point2d &a = sheet.plane(sheet.from(h)), &b = sheet.plane(sheet.to(h));
		for (size_t i = 0, j = contour.size() - 1; i < contour.size(); j = i++)
			count += Orient2d(a, b, contour[i]) * Orient2d(a, b, contour[j]) < 0 &&
			         Orient2d(contour[j], contour[i], a) * Orient2d(contour[j], contour[i], b) < 0;
	}
	return count;
}

TEST(March, CrossesEveryEdgeThatTheContourCrosses)
{
	for (const double bend : {0.0, 0.2})
		for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(30)}) {
			const Sheet sheet = CandidatesOf(Grid(bend), LabelSpace(frame), 20, 20);
			for (const std::vector<Point2d>& contour :
			     {std::vector<Point2d>{{-3.3, -2.7}, {3.1, -2.6}, {3.2, 2.9}, {-3.4, 2.8}},
			      RegularPolygon(0.13, 0.21, 6.07, 90, 0.1), Hole(RegularPolygon(0.13, 0.21, 2.57, 7, 0.2)),
			      std::vector<Point2d>{{0.3, 0.1}, {0.4, 0.1}, {0.4, 0.2}}}) {
				const SheetPath path = March(sheet, contour);
				ExpectPathOnSheet(sheet, path, contour);
				EXPECT_EQ(int(path.nodes.size()), int(contour.size()) + CountCrossings(sheet, contour));
			}
		}
}

// A square of whole cells: from vertex to vertex, always along edges, the inside on the left.
TEST(March, RunsAlongEdges)
{
	const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
	const std::vector<Point2d> square = Rectangle(-4, -4, 4, 4);
	const SheetPath path = March(sheet, square);
	ExpectPathOnSheet(sheet, path, square);
	EXPECT_EQ(path.nodes.size(), 16u);
	for (const PathNode& n : path.nodes) EXPECT_EQ(n.kind, PathNode::OnVertex);
	for (const SheetPath::Piece& piece : path.pieces) {
		ASSERT_GE(piece.halfEdge, 0);
		const auto& v = sheet.triangles[size_t(piece.halfEdge / 3)].vertex;
		const Point2d middle = (sheet.plane(v[0]) + sheet.plane(v[1]) + sheet.plane(v[2])) / 3;
		EXPECT_EQ(Winding(Letters({square}), middle), 1);
	}
}

// It leaves the row by less than snap from one vertex to the next, and is measured from where it should be, not from where it is.
TEST(March, DoesNotFollowARowThatItLeavesAtASmallAngle)
{
	for (const double angle : {2e-8, 1e-7, 3e-7, 1e-6}) {
		const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
		std::vector<Point2d> bar = Rectangle(-9, -2, 9, 2);
		for (Point2d& p : bar) p += Point2d(-p[1], p[0]) * angle;
		ExpectPathOnSheet(sheet, March(sheet, bar), bar);
	}
}

TEST(March, GoesThroughVertices)
{
	const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
	// along the other diagonals: from vertex to vertex across the cells' diagonals
	const std::vector<Point2d> rhombus = {{0, -4}, {4, 0}, {0, 4}, {-4, 0}};
	const SheetPath path = March(sheet, rhombus);
	ExpectPathOnSheet(sheet, path, rhombus);
	int vertices = 0, edges = 0;
	for (const PathNode& n : path.nodes) {
		vertices += n.kind == PathNode::OnVertex;
		edges += n.kind == PathNode::OnEdge;
	}
	EXPECT_EQ(vertices, 8);
	EXPECT_EQ(edges, 4) << "two sides lie along diagonals, two cross two of them each";
}

// What passes a vertex within snap goes through it; what passes at ten times that does not.
TEST(March, SnapsToVerticesNearby)
{
	const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
	const auto vertices = [&](double off) {
		const SheetPath path = March(sheet, {{-3, -3.3}, {3, -3.3}, {3, off}, {-3, off}});
		return std::count_if(path.nodes.begin(), path.nodes.end(),
		                     [](const PathNode& n) { return n.kind == PathNode::OnVertex; });
	};
	EXPECT_EQ(vertices(0), 3);  // (2,0), (0,0), (-2,0)
	EXPECT_EQ(vertices(0.9 * kSnap), 3);
	EXPECT_EQ(vertices(-0.9 * kSnap), 3);
	EXPECT_EQ(vertices(10 * kSnap), 0);
}

// A point of the contour that is within snap of an edge, there within snap of its end, is the vertex: whatever the edges' angle.
TEST(March, StartsOnNoEdgeWithinSnapOfItsEnd)
{
	for (const int sides : {3, 4, 5, 7, 12})
		for (int i = 0; i < 200; ++i) {
			const Sheet sheet = CandidatesOf(test_mesh::Fan(sides, 10, 4), LabelSpace(FromAbove()), 20, 20);
			const double angle = 0.37 * i, distance = (0.9 + 0.003 * i) * kSnap;
			const Point2d corner(distance * std::cos(angle), distance * std::sin(angle));
			const SheetPath path = March(sheet, {corner, {3.1, -0.3}, {1.7, 2.9}});
			const PathNode& n = path.nodes.front();
			if (n.kind == PathNode::OnEdge) { EXPECT_GT(n.plane.Norm(), kSnap) << sides << " sides, point " << i; }
		}
}

// Two vertices in a row, both neighbours of the one where the march stands, and all within snap of its line.
TEST(March, GoesThroughTheNearerOfTwoVerticesInARow)
{
	Shape s;
	const int a = s.add({0, 0, 0}), near = s.add({1, 0.5 * kSnap, 0}), far = s.add({2, 0, 0}), low = s.add({1, -3, 0}),
			  high = s.add({1, 3, 0}), left = s.add({-3, 0, 0}), right = s.add({5, 0, 0});
	s.faces = {{a, far, near}, {a, near, high}, {near, far, high}, {a, low, far},
	           {left, low, a}, {left, a, high}, {low, right, far}, {far, right, high}};
	const Sheet sheet = CandidatesOf(s, LabelSpace(FromAbove()), 20, 20);
	const SheetPath path = March(sheet, {{0, 0}, {5, 0}, {1, 1}});
	EXPECT_TRUE(std::any_of(path.nodes.begin(), path.nodes.end(), [&](const PathNode& n) {
		return n.kind == PathNode::OnVertex && sheet.vertices[size_t(n.where)].index == near;
	}));
}

// A spike thinner than the resolution is no part of the letter, wherever the contour starts.
TEST(March, DropsSpikes)
{
	const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
	const std::vector<Point2d> plain = Rectangle(-4, -4, 4, 4);
	std::vector<Point2d> spiked = {{-4, -4}, {4, -4}, {4, 0}, {8, 0}, {4, 0.2 * kSnap}, {4, 4}, {-4, 4}};
	for (size_t first = 0; first < spiked.size(); ++first) {
		EXPECT_EQ(March(sheet, spiked).nodes.size(), March(sheet, plain).nodes.size()) << first;
		std::rotate(spiked.begin(), spiked.begin() + 1, spiked.end());
	}
}

TEST(March, NamesThePlaceWhereItLeaves)
{
	const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
	try {
		March(sheet, Rectangle(5, -1, 13, 1.5));
		FAIL() << "the sheet ends at 10";
	} catch (const Error& e) {
		EXPECT_EQ(e.code, ErrorCode::Border);
		ASSERT_TRUE(e.hasPlace);
		EXPECT_NEAR((e.place - Point3d(10, -1, 0)).Norm(), 0, 1e-9);
	}
}

// Once around the axis of a spiral staircase the contour arrives a storey above its start: finer coordinates would not help.
TEST(March, SaysThatTheSheetLiesOverItselfWhereAContourEndsOnAnotherStorey)
{
	const Sheet sheet = CandidatesOf(test_mesh::Helicoid(4, 20, 3, 2.5, 120, 8), LabelSpace(FromAbove()), 40, 40);
	const std::vector<Point2d> around = RegularPolygon(0, 0, 15, 60, 0.4);
	try {
		March(sheet, around);
		FAIL() << "it does not close";
	} catch (const PlacementConflict& e) {
		EXPECT_EQ(int(e.code), int(ErrorCode::Occluded)) << e.why;
	}
}

TEST(March, WantsASeedThatHoldsTheStart)
{
	const Sheet sheet = CandidatesOf(Grid(), LabelSpace(FromAbove()), 20, 20);
	const int elsewhere = TriangleAt(sheet, {7.5, 7});
	EXPECT_THROW(EdgeMarch(sheet, kSnap).march(Rectangle(-3, -3, 3, 3), elsewhere), PlacementConflict);
}

}  // namespace
