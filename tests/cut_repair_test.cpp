// Repairs below the resolution, made visible: what is short or thin here is far above the rounding of doubles, so that each rule that
// keeps the surface a surface can be seen to hold.

#include "vcg_ext/cut_repair.h"

#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

// ---- short edges ----

using Edge = std::pair<int, int>;

/// The triangles of a cut, and those within the letters.
std::vector<CutTriangle> TrianglesOf(const CutExample& e)
{
	std::vector<CutTriangle> triangles = e.cut.triangles;
	for (const int t : e.cut.within) triangles.push_back({e.sheet.triangles[size_t(t)].vertex, t, Side::Inside});
	return triangles;
}

/// Their directed edges, each with the side of its triangle; there must be no two of one kind.
std::map<Edge, Side> EdgesOf(const CutExample& e)
{
	std::map<Edge, Side> edges;
	for (const CutTriangle& t : TrianglesOf(e))
		for (size_t k = 0; k < 3; ++k) {
			const Edge edge(t.point[k], t.point[(k + 1) % 3]);
			EXPECT_TRUE(edges.emplace(edge, t.side).second) << edge.first << ' ' << edge.second;
		}
	return edges;
}

/// Those without a triangle on the other side.
std::set<Edge> BorderOf(const std::map<Edge, Side>& edges)
{
	std::set<Edge> border;
	for (const auto& [edge, side] : edges)
		if (edges.count({edge.second, edge.first}) == 0) border.insert(edge);
	return border;
}

std::set<int> OldVertices(const CutExample& e)
{
	std::set<int> old;
	for (const CutTriangle& t : TrianglesOf(e))
		for (const int v : t.point)
			if (v < int(e.sheet.vertices.size())) old.insert(v);
	return old;
}

/// The triangles around a point that is not at the rim of what was cut are one closed fan.
void ExpectFans(const CutExample& e)
{
	std::map<int, std::map<int, int>> next;  // of a point: from one neighbour to the next, counter-clockwise
	for (const CutTriangle& t : TrianglesOf(e))
		for (size_t k = 0; k < 3; ++k) next[t.point[k]][t.point[(k + 1) % 3]] = t.point[(k + 2) % 3];
	for (const auto& [point, fan] : next) {
		const int start = fan.begin()->first;
		size_t steps = 1;
		auto i = fan.find(fan.begin()->second);
		for (; i != fan.end() && i->first != start && steps <= fan.size(); i = fan.find(i->second)) ++steps;
		if (i != fan.end()) { EXPECT_EQ(steps, fan.size()) << point; }
	}
}

void ExpectStillASurface(const CutExample& e, const std::set<Edge>& border, const std::set<int>& old)
{
	const std::map<Edge, Side> edges = EdgesOf(e);
	EXPECT_EQ(BorderOf(edges), border) << "what was not cut still fits";
	EXPECT_EQ(OldVertices(e), old) << "no vertex of the mesh goes";
	ExpectFans(e);
	for (const CutTriangle& t : e.cut.triangles) {
		const auto at = [&](size_t k) { return e.cut.points.at(e.sheet, t.point[k]).plane; };
		if (e.sheet.triangles[size_t(t.parent)].facing) { EXPECT_GT(Orient2d(at(0), at(1), at(2)), 0); }
	}
	// the contours are closed, each point of theirs is passed once, and letters lie on their left
	std::map<int, int> starts, ends;
	for (const ContourPiece& p : e.cut.pieces) {
		EXPECT_EQ(++starts[p.from], 1) << p.from;
		EXPECT_EQ(++ends[p.to], 1) << p.to;
		ASSERT_EQ(edges.count({p.from, p.to}), 1u);
		EXPECT_EQ(edges.at({p.from, p.to}), Side::Inside);
		if (edges.count({p.to, p.from}) != 0) { EXPECT_EQ(edges.at({p.to, p.from}), Side::Outside); }
	}
	EXPECT_EQ(starts, ends);
	for (const auto& [edge, side] : edges)
		if (side == Side::Inside && edges.count({edge.second, edge.first}) != 0 &&
		    edges.at({edge.second, edge.first}) == Side::Outside) {
			EXPECT_EQ(starts.count(edge.first), 1u) << "inside and outside meet only at contours";
		}
}

TEST(CollapseShortEdges, LeavesASurface)
{
	std::mt19937 random(5);
	std::uniform_real_distribution<double> unit(-1, 1);
	int collapsed = 0;
	for (int n = 0; n < 60; ++n) {
		const Shape grid = test_mesh::Slab(20, 16, 4, 20, 16).moved([&](const Point3d& p) {
			const bool isInner = std::abs(p[0]) < 9.9 && std::abs(p[1]) < 7.9 && p[2] == 0;
			return isInner ? p + Point3d(0.2 * unit(random), 0.2 * unit(random), 0) : p;
		});
		const Outline letters = Letters({RegularPolygon(-3, 0.1 * unit(random), 3, 30, unit(random)),
		                                 Hole(RegularPolygon(-3, 0.1 * unit(random), 2.6, 30, unit(random))),
		                                 RegularPolygon(3.1, unit(random), 2.9 + 0.1 * unit(random), 50)});
		CutExample e(grid, letters, FromAbove());
		const std::set<Edge> border = BorderOf(EdgesOf(e));
		const std::set<int> old = OldVertices(e);
		const size_t before = e.cut.points.added.size();
		CollapseShortEdges(e.sheet, e.cut, 0.05 + 0.02 * n);  // at last longer than edges of the mesh, which stay
		ExpectStillASurface(e, border, old);
		collapsed += int(before - e.cut.points.added.size());
		if (HasFailure()) return;
	}
	EXPECT_GT(collapsed, 1000);
}

// ---- caps ----

constexpr double kThinnest = 1e-3;

/// Two triangles at an edge from (-2, 0) to (2, 0): face 0 with its tip `c` near the edge, face 1 with its tip `d` below it; above the
/// cap two more, up to (0, 2).
struct CapShape {
	Shape shape;
	int a, b, c, d;

	CapShape(const Point2d& tip, const Point2d& below, bool isClosedAbove = true)
	{
		a = shape.add({-2, 0, 0}), b = shape.add({2, 0, 0}), c = shape.add({tip[0], tip[1], 0});
		d = shape.add({below[0], below[1], 0});
		shape.faces = {{a, b, c}, {b, a, d}};
		if (!isClosedAbove) return;
		const int e = shape.add({0, 2, 0});
		shape.faces.push_back({c, b, e});
		shape.faces.push_back({a, c, e});
	}
	Sheet sheet(double halfSize = 10) const { return CandidatesOf(shape, LabelSpace(FromAbove()), halfSize, halfSize); }
};

bool IsFlipped(const CapShape& s)
{
	Sheet sheet = s.sheet();
	const std::vector<int> twins = sheet.twin;
	const bool isFlipped = FlipCaps(sheet, {0}, kThinnest);
	EXPECT_EQ(sheet.flipped.empty(), !isFlipped);
	if (!isFlipped) { EXPECT_EQ(sheet.twin, twins) << "nothing was changed"; }
	return isFlipped;
}

TEST(FlipCaps, TurnsTheEdgeBelowACap)
{
	for (const double y : {0.0, 5e-4, -5e-4}) {
		const CapShape s({0.3, y}, {0.1, -2});
		Sheet sheet = s.sheet();
		const std::vector<SheetTriangle> before = sheet.triangles;
		ASSERT_TRUE(FlipCaps(sheet, {0}, kThinnest)) << y;
		EXPECT_EQ(sheet.flipped, (std::vector<int>{0, 1}));
		ASSERT_EQ(sheet.unflipped.size(), 2u);
		for (size_t t = 0; t < 2; ++t) EXPECT_EQ(sheet.unflipped[t], before[t].vertex);
		EXPECT_EQ(sheet.triangles[0].birthFace(), 1) << "the cap had nothing to show";
		std::set<std::set<int>> faces;
		for (const SheetTriangle& t : sheet.triangles) {
			EXPECT_TRUE(t.facing);
			EXPECT_GT(Orient2d(sheet.plane(t.vertex[0]), sheet.plane(t.vertex[1]), sheet.plane(t.vertex[2])), 0);
			faces.insert({t.vertex.begin(), t.vertex.end()});
		}
		EXPECT_EQ(faces.count({s.a, s.d, s.c}) + faces.count({s.d, s.b, s.c}), 2u);
		Sheet again = sheet;
		vcg::textlabel::detail::LinkTriangles(again);
		EXPECT_EQ(sheet.twin, again.twin);
		EXPECT_EQ(sheet.vertexStart, again.vertexStart);
		EXPECT_EQ(sheet.vertexFan, again.vertexFan);
	}
}

TEST(FlipCaps, LeavesWhatIsNoCap)
{
	EXPECT_FALSE(IsFlipped(CapShape({0.3, 2 * kThinnest}, {0, -2}))) << "too high";
	EXPECT_FALSE(IsFlipped(CapShape({-2 + 0.5 * kThinnest, 0.2 * kThinnest}, {0, -2}))) << "a needle";
	EXPECT_FALSE(IsFlipped(CapShape({2 - 0.5 * kThinnest, 0.2 * kThinnest}, {0, -2}))) << "a needle at the other end";
}

// The cap hangs lower than the triangle below it is high: turned, the edge would leave a triangle that shows its back.
TEST(FlipCaps, TurnsNoTriangleOver)
{
	EXPECT_FALSE(IsFlipped(CapShape({0, -0.5 * kThinnest}, {0, -0.2 * kThinnest})));
	EXPECT_FALSE(IsFlipped(CapShape({0.5, -0.5 * kThinnest}, {-1.9, -0.5 * kThinnest})));
}

// On a part of four faces the tips have an edge already, on the far side: a second one would have four faces.
TEST(FlipCaps, MakesNoEdgeASecondTime)
{
	CapShape s({0.3, 0}, {0, -2}, false);
	s.shape.faces.push_back({s.a, s.c, s.d});
	s.shape.faces.push_back({s.c, s.b, s.d});
	EXPECT_FALSE(IsFlipped(s));
}

// Where neither tip has all its faces among the candidates, they may be neighbours outside; a larger box would tell.
TEST(FlipCaps, AsksForWhatLiesAroundATip)
{
	const CapShape s({0.3, 0}, {0, -2}, false);
	EXPECT_FALSE(IsFlipped(s));
	Sheet sheet = s.sheet(1);
	EXPECT_FALSE(FlipCaps(sheet, {0}, kThinnest));
	EXPECT_EQ(sheet.capReach, 1) << "from the box's border at -1 to the lower tip at -2";
}

// A flipped cap below which there was another one would be one again: what was a cap once stays, and is listed once.
TEST(FlipCaps, ChangesATriangleOnce)
{
	CapShape s({0.5, 0}, {-0.5, -0.1 * kThinnest});
	const int low = s.shape.add({0, -3, 0});
	s.shape.faces.push_back({s.d, s.a, low});
	s.shape.faces.push_back({s.b, s.d, low});
	Sheet sheet = s.sheet();
	ASSERT_TRUE(FlipCaps(sheet, {0}, kThinnest));
	const std::vector<SheetTriangle> once = sheet.triangles;
	for (int round = 0; round < 3; ++round) {
		EXPECT_FALSE(FlipCaps(sheet, {0, 1, 2, 3, 4, 5}, kThinnest));
		EXPECT_EQ(sheet.flipped, (std::vector<int>{0, 1}));
		for (size_t t = 0; t < once.size(); ++t) EXPECT_EQ(sheet.triangles[t].vertex, once[t].vertex);
	}
}

// Caps that lie on one another go from the lowest to the uppermost, whichever of them was asked for.
TEST(FlipCaps, TakesTheLowestFirst)
{
	CapShape s({0, 0}, {0.1, -2});  // face 0 is the cap from -2 to 2 with its tip at 0
	const int e = 4, m = s.shape.add({-1, 0, 0});
	s.shape.faces[3] = {s.a, m, e};  // above its left half lies a cap with its tip at -1
	s.shape.faces.push_back({m, s.c, e});
	s.shape.faces.push_back({s.a, s.c, m});
	for (const std::vector<int>& asked : {std::vector<int>{5}, {5, 0}, {0, 5}, {0}}) {
		Sheet sheet = s.sheet();
		ASSERT_TRUE(FlipCaps(sheet, asked, kThinnest));
		const bool isAll = asked.size() > 1 || asked[0] == 5;
		EXPECT_EQ(sheet.flipped, isAll ? (std::vector<int>{0, 1, 5}) : (std::vector<int>{0, 1}));
		EXPECT_EQ(sheet.triangles[5].facing, isAll);
		if (isAll) { EXPECT_EQ(sheet.triangles[5].birthFace(), 1) << "none of the caps had anything to show"; }
		for (size_t t = 0; t < sheet.triangles.size(); ++t) {
			const auto& v = sheet.triangles[t].vertex;
			if (sheet.triangles[t].facing) {
				EXPECT_GT(Orient2d(sheet.plane(v[0]), sheet.plane(v[1]), sheet.plane(v[2])), 0);
			}
		}
	}
}

// The same when a short edge is collapsed: a new point on the edge from a to b, near the upper tip, would bring the lower tip's edge
// to it.
TEST(CollapseShortEdges, MakesNoEdgeASecondTime)
{
	for (const bool isThin : {true, false}) {
		CapShape s({0.3, 0.5 * kThinnest}, {0, -2}, !isThin);
		if (isThin) {
			s.shape.faces.push_back({s.a, s.c, s.d});
			s.shape.faces.push_back({s.c, s.b, s.d});
		}
		const Sheet sheet = s.sheet();
		CutPoint added;
		added.mesh = added.label = Point3d(0.3, 0, 0);
		added.plane = Point2d(0.3, 0);
		added.mixture = {{s.a, s.b, s.b}, {0.425, 0.575, 0}};
		CutLabel cut;
		cut.points.added.push_back(added);
		const int n = int(sheet.vertices.size());
		cut.touched = {0, 1};
		cut.triangles = {{{s.a, n, s.c}, 0, Side::Outside},
		                 {{n, s.b, s.c}, 0, Side::Outside},
		                 {{n, s.a, s.d}, 1, Side::Outside},
		                 {{s.b, n, s.d}, 1, Side::Outside}};
		CollapseShortEdges(sheet, cut, kThinnest);
		EXPECT_EQ(cut.points.added.size(), isThin ? 1u : 0u);
		EXPECT_EQ(cut.triangles.size(), isThin ? 4u : 2u);
	}
}

// A texture would be smeared by it.
TEST(FlipCaps, LeavesWhatHasATexture)
{
	const CapShape s({0.3, 0}, {0, -2});
	test_mesh::RichMesh m;
	test_mesh::Fill(m, s.shape);
	PlaneBox box;
	box.add({-10, -10});
	box.add({10, 10});
	Sheet sheet = CollectSheet(m, LabelSpace(FromAbove()), box);
	EXPECT_FALSE(FlipCaps(sheet, {0}, kThinnest));
	EXPECT_TRUE(sheet.flipped.empty());
}

}  // namespace
