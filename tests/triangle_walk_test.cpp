// The contour walk on the corpus: each case against numbers worked out by hand, and against what must hold of every cut.

#include "vcg_ext/triangle_walk.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <random>

#include "walk_case.h"

namespace {

using namespace vcg::textlabel;
using namespace walk_case;

constexpr double kRounding = 1e-12;  // relative, of areas

double TwiceAreaOf(const TriangleCase& t, const int* begin, const int* end)
{
	std::vector<Point2d> points;
	for (const int* i = begin; i != end; ++i) points.push_back(t.points[size_t(*i)]);
	return TwiceSignedArea(points);
}

double AreaOf(const TriangleCase& t, const RegionSet& set, const RegionSet::Region& r)
{
	double sum = 0;
	for (int i = r.firstRing; i < r.firstRing + r.ringCount; ++i)
		sum += TwiceAreaOf(t, set.rings.begin(i), set.rings.end(i)) / 2;
	return sum;
}

int CornersOf(const RegionSet& set, const RegionSet::Region& r)
{
	return int(set.rings.end(r.firstRing + r.ringCount - 1) - set.rings.begin(r.firstRing));
}

/// How often a closed ring goes round a point that is not on it.
int WindingNumber(const TriangleCase& t, const int* begin, const int* end, const Point2d& p)
{
	double angle = 0;
	for (const int *i = end - 1, *j = begin; j != end; i = j++) {
		const Point2d a = t.points[size_t(*i)] - p, b = t.points[size_t(*j)] - p;
		angle += std::atan2(a ^ b, a * b);
	}
	return int(std::lround(angle / (2 * M_PI)));
}

using Edge = std::pair<int, int>;

/// Every directed edge of the regions' rings, and the region it belongs to.
std::multimap<Edge, int> EdgesOf(const RegionSet& set)
{
	std::multimap<Edge, int> edges;
	for (int r = 0; r < int(set.regions.size()); ++r)
		for (int i = set.regions[size_t(r)].firstRing;
		     i < set.regions[size_t(r)].firstRing + set.regions[size_t(r)].ringCount; ++i)
			for (const int *a = set.rings.end(i) - 1, *b = set.rings.begin(i); b != set.rings.end(i); a = b++)
				edges.emplace(Edge(*a, *b), r);
	return edges;
}

std::vector<Edge> ContourPieces(const TriangleCase& t)
{
	std::vector<Edge> pieces;
	for (int i = 0; i < t.chains.size(); ++i)
		for (const int* p = t.chains.begin(i); p + 1 != t.chains.end(i); ++p) pieces.emplace_back(p[0], p[1]);
	for (int i = 0; i < t.loops.size(); ++i)
		for (const int *a = t.loops.end(i) - 1, *b = t.loops.begin(i); b != t.loops.end(i); a = b++)
			pieces.emplace_back(*a, *b);
	return pieces;
}

/// Each contour piece borders one inside region on its left and one outside region on its right, each border piece the region
/// that is said to lie there, and the rings are made of nothing else.
void ExpectEdgesShared(const TriangleCase& t, const RegionSet& set)
{
	const std::multimap<Edge, int> edges = EdgesOf(set);
	const auto sideOf = [&](const Edge& e) {
		EXPECT_EQ(edges.count(e), 1u) << "edge " << e.first << ' ' << e.second;
		return edges.count(e) == 1 ? set.regions[size_t(edges.find(e)->second)].side : Side::Unknown;
	};
	const std::vector<Edge> pieces = ContourPieces(t);
	for (const Edge& e : pieces) {
		EXPECT_EQ(sideOf(e), Side::Inside);
		EXPECT_EQ(sideOf({e.second, e.first}), Side::Outside);
	}
	ASSERT_EQ(int(set.regionAtBorder.size()), t.borderCount);
	for (int i = 0; i < t.borderCount; ++i) {
		const Edge e(i, (i + 1) % t.borderCount);
		ASSERT_EQ(edges.count(e), 1u) << "border piece " << i;
		EXPECT_EQ(edges.find(e)->second, set.regionAtBorder[size_t(i)]) << "border piece " << i;
	}
	EXPECT_EQ(edges.size(), 2 * pieces.size() + size_t(t.borderCount));
}

/// Regions are positive and tile the triangle; holes lie within the outer ring of their region.
void ExpectTiling(const TriangleCase& t, const RegionSet& set)
{
	double sum = 0, whole = 0;
	for (int i = 0; i < t.borderCount; ++i)
		whole += (t.points[size_t(i)] - t.points[0]) ^ (t.points[size_t((i + 1) % t.borderCount)] - t.points[0]);
	for (const RegionSet::Region& r : set.regions) {
		EXPECT_GT(AreaOf(t, set, r), 0);
		EXPECT_GT(TwiceAreaOf(t, set.rings.begin(r.firstRing), set.rings.end(r.firstRing)), 0) << "outer ring";
		sum += AreaOf(t, set, r);
		for (int i = r.firstRing + 1; i < r.firstRing + r.ringCount; ++i) {
			EXPECT_LT(TwiceAreaOf(t, set.rings.begin(i), set.rings.end(i)), 0) << "hole";
			const Point2d& p = t.points[size_t(*set.rings.begin(i))];
			EXPECT_EQ(WindingNumber(t, set.rings.begin(r.firstRing), set.rings.end(r.firstRing), p), 1);
		}
	}
	EXPECT_NEAR(sum, whole / 2, kRounding * whole);
}

/// The regions against the case's expectations, in any order.
void ExpectRegions(const WalkCase& c, const TriangleCase& t, const RegionSet& set, bool withCorners)
{
	using Entry = std::tuple<int, int, int, double>;  // side, holes, corners, area
	std::vector<Entry> expected, found;
	for (const ExpectedRegion& r : c.expected)
		expected.emplace_back(int(r.side), r.holes, withCorners ? r.corners : 0, r.area);
	for (const RegionSet::Region& r : set.regions)
		found.emplace_back(int(r.side), r.ringCount - 1, withCorners ? CornersOf(set, r) : 0, AreaOf(t, set, r));
	std::sort(expected.begin(), expected.end());
	std::sort(found.begin(), found.end());
	ASSERT_EQ(found.size(), expected.size()) << "regions";
	for (size_t i = 0; i < found.size(); ++i) {
		EXPECT_EQ(std::get<0>(found[i]), std::get<0>(expected[i])) << "side";
		EXPECT_EQ(std::get<1>(found[i]), std::get<1>(expected[i])) << "holes";
		EXPECT_EQ(std::get<2>(found[i]), std::get<2>(expected[i])) << "corners";
		EXPECT_NEAR(std::get<3>(found[i]), std::get<3>(expected[i]), kRounding * std::abs(std::get<3>(expected[i])));
	}
}

/// Write the case and its picture beside each other and say where they are.
void Report(const WalkCase& c, const RegionSet& set)
{
	const std::string base = testing::TempDir() + c.name;
	std::ofstream(base + ".walk") << ToText(c);
	WriteSvg(c, set, base + ".svg");
	std::cout << ToText(c) << "case:    " << base << ".walk\npicture: " << base << ".svg\n";
}

void Check(const WalkCase& c, bool withCorners)
{
	const bool failedBefore = testing::Test::HasFailure();
	const TriangleCase t = ToTriangle(c);
	RegionSet set;
	TriangleWalk walk;
	try {
		walk.cut(t, set);
		EXPECT_FALSE(c.conflict) << "a case that must be refused was cut";
		if (!c.conflict && set.regions.size() != 1) ExpectEdgesShared(t, set);
		if (!c.conflict) ExpectTiling(t, set);
		if (!c.conflict) ExpectRegions(c, t, set, withCorners);
	} catch (const WalkConflict& conflict) {
		EXPECT_TRUE(c.conflict) << conflict.why << ", point " << conflict.point;
	}
	if (!failedBefore && testing::Test::HasFailure()) Report(c, set);
}

std::filesystem::path Corpus() { return std::filesystem::path(TEXTLABEL_SOURCE_DIR) / "tests/corpus/walk"; }

std::vector<std::string> CorpusNames()
{
	std::vector<std::string> names;
	for (const auto& entry : std::filesystem::directory_iterator(Corpus()))
		if (entry.path().extension() == ".walk") names.push_back(entry.path().stem().string());
	std::sort(names.begin(), names.end());
	return names;
}

WalkCase Load(const std::string& name)
{
	std::ifstream in(Corpus() / (name + ".walk"));
	const std::string text((std::istreambuf_iterator<char>(in)), {});
	return FromText(text, name);
}

class WalkCorpus : public testing::TestWithParam<std::string> {};

TEST_P(WalkCorpus, AsWorkedOutByHand) { Check(Load(GetParam()), true); }

TEST_P(WalkCorpus, FromEveryBorderPoint)
{
	WalkCase c = Load(GetParam());
	for (int first = 0; first < int(c.border.size()); ++first) {
		WalkCase turned = Turned(c, first);
		turned.name += "_turned_" + std::to_string(first);
		Check(turned, true);
	}
}

TEST_P(WalkCorpus, MirroredAndSwapped)
{
	WalkCase mirrored = Mirrored(Load(GetParam())), swapped = SidesSwapped(Load(GetParam()));
	mirrored.name += "_mirrored";
	swapped.name += "_swapped";
	Check(mirrored, true);
	Check(swapped, true);
}

TEST_P(WalkCorpus, WithMorePointsOnTheBorder)
{
	WalkCase fine = BorderRefined(Load(GetParam()));
	fine.name += "_refined";
	Check(fine, false);
	Check(Mirrored(fine), false);
}

TEST_P(WalkCorpus, TextKeepsTheCase)
{
	const WalkCase c = Load(GetParam());
	const std::string text = ToText(c);
	EXPECT_EQ(ToText(FromText(text, c.name)), text);
	WalkCase again = FromTriangle(ToTriangle(c), c.name);
	again.expected = c.expected;
	again.conflict = c.conflict;
	EXPECT_EQ(ToText(again), text);
}

INSTANTIATE_TEST_SUITE_P(Walk, WalkCorpus, testing::ValuesIn(CorpusNames()), [](const auto& p) { return p.param; });

// One walk for many triangles: what it keeps between two of them must not leak from the one into the next.
TEST(TriangleWalk, BuffersDoNotLeak)
{
	TriangleWalk walk;
	RegionSet kept, fresh;
	const std::vector<std::string> names = CorpusNames();
	std::mt19937 random(1);
	for (int n = 0; n < 300; ++n) {
		const WalkCase c = Load(names[random() % names.size()]);
		const TriangleCase t = ToTriangle(c);
		const auto cut = [&](TriangleWalk& w, RegionSet& set) {
			try {
				w.cut(t, set);
				return true;
			} catch (const WalkConflict&) {
				return false;
			}
		};
		TriangleWalk other;
		ASSERT_EQ(cut(walk, kept), cut(other, fresh)) << c.name;
		if (c.conflict) continue;
		ASSERT_EQ(kept.rings.ids, fresh.rings.ids) << c.name;
		ASSERT_EQ(kept.rings.start, fresh.rings.start) << c.name;
		ASSERT_EQ(kept.regionAtBorder, fresh.regionAtBorder) << c.name;
	}
}

// Figure 6: the outside polygon is 1 2 3 4 5 6 of the paper, which are these points of figure_6.walk, counter-clockwise.
TEST(TriangleWalk, Figure6GivesThePapersPolygon)
{
	const TriangleCase t = ToTriangle(Load("figure_6"));
	RegionSet set;
	TriangleWalk().cut(t, set);
	const int one = 2, two = 5, three = 1, four = 0, five = 4, six = 3;
	std::vector<int> paper = {one, two, three, four, five, six};
	for (const RegionSet::Region& r : set.regions) {
		if (r.side != Side::Outside) continue;
		std::vector<int> ring(set.rings.begin(r.firstRing), set.rings.end(r.firstRing));
		std::reverse(ring.begin(), ring.end());  // the paper goes clockwise
		std::rotate(ring.begin(), std::find(ring.begin(), ring.end(), one), ring.end());
		EXPECT_EQ(ring, paper);
	}
}

/// A triangle with a right angle at (far, far), 4 wide.
TriangleCase RightTriangle(double far, double height)
{
	TriangleCase t;
	t.points = {{far, far}, {far + 4, far}, {far, far + height}};
	t.borderCount = 3;
	return t;
}

// A chain around a corner, through a point beyond one of the two edges there.
TEST(TriangleWalk, RefusesAChainThatLeavesTheTriangle)
{
	for (const Point2d& beyond : {Point2d(2, -3), Point2d(-3, 2)})
		for (const bool turned : {false, true}) {
			TriangleCase t = RightTriangle(0, 4);
			t.points.insert(t.points.begin() + 1, {1, 0});
			t.points.push_back({0, 1});
			t.borderCount = 5;
			t.points.push_back(beyond);
			for (const int id : turned ? std::vector<int>{4, 5, 1} : std::vector<int>{1, 5, 4}) t.chains.add(id);
			t.chains.close();
			RegionSet regions;
			EXPECT_THROW(TriangleWalk().cut(t, regions), WalkConflict) << beyond[0] << ' ' << turned;
		}
}

// Points on the edges of a triangle thinner than the coordinates' step are off them by a lot of its height, and right all the same.
TEST(TriangleWalk, CutsTrianglesThinnerThanTheRoundingOfTheirEdges)
{
	for (const double height : {1e-7, 1e-8, 1e-9})
		for (int i = 1; i < 20; ++i) {
			const double far = 1e6, along = i / 20.0;
			TriangleCase t = RightTriangle(far, height);
			const Point2d a = t.points[0], b = t.points[1], c = t.points[2];
			t.points = {a, a + (b - a) * along, b, b + (c - b) * (1 - along), c};
			t.borderCount = 5;
			for (const int id : {1, 3}) t.chains.add(id);
			t.chains.close();
			RegionSet regions;
			EXPECT_NO_THROW(TriangleWalk().cut(t, regions)) << height << ' ' << along;
		}
}

TEST(WalkText, RefusesWhatIsNoCase)
{
	const std::string triangle = "border 0 0\nborder 1 0\nborder 0 1\n";
	EXPECT_NO_THROW(FromText(triangle));
	for (const std::string bad :
	     {"border 0 0\nborder 1 0\n", "", "border 0\n", "border 0 0 0\n", "border x 0\n", "border nan 0\n",
	      "border 1e999 0\n", "chain 0 0.25 0.25 3\n", "chain 0 0.25 0.25\n", "chain -1 0.25 0.25 1\n",
	      "chain 0.5 0.25 0.25 1\n", "chain 0 0.25 0.25 1e99\n", "loop 0 0 1 0\n", "loop 0 0 1 0 0\n", "inside 1\n",
	      "inside 1 2 3 4\n", "outside\n", "conflict 1\n", "triangle\n"})
		EXPECT_THROW(FromText((bad.rfind("border 0 0\nb", 0) == 0 || bad.empty() ? "" : triangle) + bad),
		             std::invalid_argument)
			<< bad;
}

}  // namespace
