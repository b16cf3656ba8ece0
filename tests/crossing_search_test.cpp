// The search against all pairs tried one by one, and its effort counted.

#include "vcg_ext/crossing_search.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

using namespace vcg::textlabel;
using vcg::Point3d;

struct Soup {
	std::vector<Point3d> positions;
	std::vector<Face> faces;
};

/// Triangles of sizes from 1 to 1e-3, on coarse coordinates so that they share points and planes.
Soup RandomSoup(std::mt19937& random, int count)
{
	std::uniform_int_distribution<int> step(-64, 64);
	std::uniform_int_distribution<int> exponent(0, 10);
	Soup soup;
	for (int f = 0; f < count; ++f) {
		const double size = std::ldexp(1.0, -exponent(random));
		const Point3d centre = Point3d(step(random), step(random), step(random)) * (1 / 64.0);
		for (int k = 0; k < 3; ++k)
			soup.positions.push_back(centre + Point3d(step(random) / 16, step(random) / 16, step(random) / 16) * size);
		soup.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
	}
	return soup;
}

std::vector<FacePair> TryAllPairs(const Soup& soup, const std::vector<Face>& others)
{
	const auto corners = [&](const Face& f) {
		return Corners{soup.positions[size_t(f[0])], soup.positions[size_t(f[1])], soup.positions[size_t(f[2])]};
	};
	std::vector<FacePair> pairs;
	for (int other = 0; other < 2; ++other)
		for (size_t i = 0; i < soup.faces.size(); ++i) {
			const std::vector<Face>& second = other ? others : soup.faces;
			for (size_t j = other ? 0 : i + 1; j < second.size(); ++j) {
				const Contact c = ContactOf(corners(soup.faces[i]), corners(second[j]));
				if (IsCrossing(c)) pairs.push_back({int(i), int(j), other == 1, c});
			}
		}
	return pairs;
}

void ExpectSamePairs(const std::vector<FacePair>& found, const std::vector<FacePair>& expected)
{
	ASSERT_EQ(found.size(), expected.size());
	for (size_t i = 0; i < found.size(); ++i) {
		EXPECT_EQ(found[i].first, expected[i].first);
		EXPECT_EQ(found[i].second, expected[i].second);
		EXPECT_EQ(found[i].secondIsOther, expected[i].secondIsOther);
		EXPECT_EQ(found[i].contact, expected[i].contact);
	}
}

TEST(CrossingSearch, FindsWhatAllPairsFind)
{
	std::mt19937 random(1);
	size_t total = 0;
	for (const int count : {0, 1, 2, 3, 4, 5, 8, 9, 17, 100, 500}) {
		Soup soup = RandomSoup(random, 2 * count);
		const std::vector<Face> others(soup.faces.begin() + count, soup.faces.end());
		soup.faces.resize(size_t(count));
		const std::vector<FacePair> expected = TryAllPairs(soup, others);
		ExpectSamePairs(FindCrossings(soup.positions, soup.faces, others), expected);
		total += expected.size();
	}
	EXPECT_GT(total, 1000u);
}

TEST(CrossingSearch, StopsAtTheFirst)
{
	std::mt19937 random(2);
	Soup soup = RandomSoup(random, 300);
	const auto one = FindCrossings(soup.positions, soup.faces, {}, {true});
	ASSERT_EQ(one.size(), 1u);
	EXPECT_TRUE(IsCrossing(one[0].contact));
	EXPECT_GT(FindCrossings(soup.positions, soup.faces).size(), 1u);
}

TEST(CrossingSearch, LeavesOutWhatIsNotFinite)
{
	const double bad = std::nan(""), endless = std::numeric_limits<double>::infinity();
	const std::vector<Point3d> p = {{0, 0, 0},     {1, 0, 0},   {0, 1, 0},      {0.2, 0.2, -1},
	                                {0.2, 0.2, 1}, {2, 2, bad}, {2, 2, endless}};
	EXPECT_TRUE(FindCrossings(p, {{0, 1, 2}, {3, 4, 5}, {3, 4, 6}}).empty());
	EXPECT_TRUE(FindCrossings(p, {{3, 4, 5}}, {{0, 1, 2}}).empty());
}

/// A square sheet of 2·n·n faces in the plane z = height, or standing on its side.
Soup Sheet(int n, double height, bool upright)
{
	Soup s;
	for (int j = 0; j <= n; ++j)
		for (int i = 0; i <= n; ++i) {
			const double x = double(i) / n, y = double(j) / n;
			s.positions.push_back(upright ? Point3d(height, x, y - 0.5) : Point3d(x, y, height));
		}
	for (int j = 0; j < n; ++j)
		for (int i = 0; i < n; ++i) {
			const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
			s.faces.push_back({a, b, d});
			s.faces.push_back({a, d, c});
		}
	return s;
}

// Two sheets that cut each other at right angles along a straight line. The upright one cuts the column of cells under it: in
// each of the n cells the line goes through both triangles, so the line is divided at n + 1 corners and n diagonals into 2n
// pieces; the same for the other sheet. Pairs that meet are those whose pieces have a point in common.
TEST(CrossingSearch, TwoSheets)
{
	const int n = 16;
	Soup flat = Sheet(n, 0, false);
	// The line lies at 5/16 of a cell and the upright rows' boundaries avoid z = 0, so that no corner lies on the line.
	const Soup upright = Sheet(n + 1, (3 + 5 / 16.0) / n, true);
	std::vector<std::pair<double, double>> flatPieces, uprightPieces;
	for (int i = 0; i < n; ++i) {
		flatPieces.push_back({double(i) / n, (i + 5 / 16.0) / n});
		flatPieces.push_back({(i + 5 / 16.0) / n, double(i + 1) / n});
	}
	for (int i = 0; i < n + 1; ++i) {
		uprightPieces.push_back({double(i) / (n + 1), (i + 0.5) / (n + 1)});
		uprightPieces.push_back({(i + 0.5) / (n + 1), double(i + 1) / (n + 1)});
	}
	size_t expected = 0;
	for (const auto& p : flatPieces)
		for (const auto& q : uprightPieces) expected += p.first <= q.second && q.first <= p.second;
	const int shift = int(flat.positions.size());
	flat.positions.insert(flat.positions.end(), upright.positions.begin(), upright.positions.end());
	std::vector<Face> others = upright.faces;
	for (Face& f : others)
		for (int& v : f) v += shift;
	const auto pairs = FindCrossings(flat.positions, flat.faces, others);
	EXPECT_EQ(pairs.size(), expected);
	for (const FacePair& p : pairs) EXPECT_TRUE(p.secondIsOther);
}

/// The pairs of faces that the search looks at, for each face.
double PairsLookedAt(const Soup& s)
{
	using namespace vcg::textlabel::detail;
	const auto corners = [&](size_t i) {
		const Face& f = s.faces[i];
		return Corners{s.positions[size_t(f[0])], s.positions[size_t(f[1])], s.positions[size_t(f[2])]};
	};
	long count = 0;
	const auto visit = [&](int, int) { return ++count > 0; };
	const FaceTree tree(
		s.faces.size(), [&](size_t i) { return BoxOf(corners(i)); }, Everywhere());
	PairDescent(tree, tree, visit).run();
	return double(count) / double(s.faces.size());
}

// In a sheet the boxes of a face meet those of at most 8 neighbouring cells and its own: 17 faces, each pair looked at once.
TEST(CrossingSearch, EffortIsLinear)
{
	EXPECT_LT(PairsLookedAt(Sheet(20, 0, false)), 8.5);
	EXPECT_LT(PairsLookedAt(Sheet(200, 0, false)), 8.5);
	// a needle across the whole sheet costs what it meets, no more
	Soup withNeedle = Sheet(200, 0, false);
	withNeedle.positions.insert(withNeedle.positions.end(), {{0, 0.5, 0}, {1, 0.5, 0}, {1, 0.5001, 0}});
	const int last = int(withNeedle.positions.size()) - 1;
	withNeedle.faces.push_back({last - 2, last - 1, last});
	EXPECT_LT(PairsLookedAt(withNeedle), 8.5 + 0.02);
}

}  // namespace
