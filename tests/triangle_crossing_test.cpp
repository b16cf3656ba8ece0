// The contact of two triangles against their common part computed in fractions, on grids so coarse that coincidences abound.

#include "vcg_ext/triangle_crossing.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <ostream>
#include <random>

#include "oracle_fraction.h"

namespace vcg::textlabel {
void PrintTo(Contact c, std::ostream* out) { *out << Name(c); }
}  // namespace vcg::textlabel

namespace {

using namespace vcg::textlabel;
using vcg::Point3d;
using Grid = std::array<std::array<int, 3>, 3>;

Corners ToCorners(const Grid& g, double scale = 1, const Point3d& shift = {0, 0, 0})
{
	Corners t;
	for (size_t i = 0; i < 3; ++i) t[i] = shift + Point3d(g[i][0], g[i][1], g[i][2]) * scale;
	return t;
}

oracle::Triangle ToOracle(const Grid& g)
{
	oracle::Triangle t;
	for (size_t i = 0; i < 3; ++i) t[i] = {g[i][0], g[i][1], g[i][2]};
	return t;
}

bool LiesOnSegment(const oracle::Point& p, const oracle::Point& a, const oracle::Point& b)
{
	return oracle::IsZero(oracle::Cross(p - a, b - a)) && oracle::Dot(p - a, p - b).sign() <= 0;
}

/// Whether a point belongs to what the triangles share as corners of a mesh: a corner, or the edge between two.
bool IsShared(const oracle::Point& p, const std::vector<oracle::Point>& shared)
{
	if (shared.empty()) return false;
	return LiesOnSegment(p, shared.front(), shared.back());
}

/// The contact by the definition: the common part, whether it is more than is shared, and whether it is inside both.
Contact ContactInFractions(const Grid& ga, const Grid& gb)
{
	const oracle::Triangle a = ToOracle(ga), b = ToOracle(gb);
	if (oracle::IsZero(oracle::Normal(a)) || oracle::IsZero(oracle::Normal(b))) return Contact::NoArea;
	std::vector<oracle::Point> shared;
	for (const auto& p : a)
		for (const auto& q : b)
			if (p == q) shared.push_back(p);
	const std::vector<oracle::Point> common = oracle::Common(a, b);
	if (common.empty()) return Contact::Disjoint;
	// A point well inside the common part is inside both triangles if any common point is.
	oracle::Point middle{};
	for (const auto& p : common) middle = middle + p * oracle::Fraction(1, static_cast<oracle::Wide>(common.size()));
	const bool coplanar = oracle::IsZero(oracle::Cross(oracle::Normal(a), oracle::Normal(b)));
	if (oracle::IsInside(middle, a) && oracle::IsInside(middle, b))
		return coplanar ? Contact::Overlaps : Contact::Crosses;
	for (const auto& p : common)
		if (!IsShared(p, shared)) return Contact::Touches;
	return Contact::SharesOnly;
}

std::string Describe(const Grid& a, const Grid& b)
{
	std::ostringstream out;
	for (const Grid* g : {&a, &b})
		for (const auto& p : *g) out << " (" << p[0] << ' ' << p[1] << ' ' << p[2] << ')';
	return out.str();
}

/// Two random triangles on a grid; some share corners, some lie in one plane, some have no area.
std::pair<Grid, Grid> RandomPair(std::mt19937& random, int width)
{
	std::uniform_int_distribution<int> step(0, width), corners(0, 3);
	std::pair<Grid, Grid> g;
	for (Grid* t : {&g.first, &g.second})
		for (auto& p : *t)
			for (int& x : p) x = step(random);
	const int shared = std::max(0, corners(random) - 1);
	for (size_t i = 0; i < static_cast<size_t>(shared); ++i) g.second[(i + random() % 2) % 3] = g.first[i];
	if (random() % 3 == 0)
		for (Grid* t : {&g.first, &g.second})
			for (auto& p : *t) p[2] = p[0] + 2 * p[1];
	return g;
}

/// NoArea promises nothing about triangles that are plainly apart, so there the oracle's word is not compared.
bool IsNoAreaPair(const Grid& a, const Grid& b)
{
	return oracle::IsZero(oracle::Normal(ToOracle(a))) || oracle::IsZero(oracle::Normal(ToOracle(b)));
}

TEST(Contact, EqualsFractionsOnGrids)
{
	std::mt19937 random(1);
	std::map<Contact, int> seen;
	for (int n = 0; n < 60000; ++n) {
		const auto [a, b] = RandomPair(random, n % 3 == 0 ? 2 : 4);
		const Contact found = ContactOf(ToCorners(a), ToCorners(b));
		++seen[found];
		if (IsNoAreaPair(a, b)) {
			ASSERT_FALSE(IsCrossing(found)) << Describe(a, b);
			continue;
		}
		ASSERT_EQ(found, ContactInFractions(a, b)) << Describe(a, b);
	}
	for (const Contact c : {Contact::Disjoint, Contact::SharesOnly, Contact::NoArea, Contact::Touches, Contact::Crosses,
	                        Contact::Overlaps})
		EXPECT_GT(seen[c], 500) << Name(c);
}

TEST(Contact, DependsOnNeitherOrderNorScaleNorPlace)
{
	std::mt19937 random(2);
	for (int n = 0; n < 3000; ++n) {
		const auto [a, b] = RandomPair(random, 3);
		const Corners ca = ToCorners(a), cb = ToCorners(b);
		const Contact expected = ContactOf(ca, cb);
		Corners pa = ca, pb = cb;
		std::array<size_t, 3> order{0, 1, 2};
		do {
			for (size_t i = 0; i < 3; ++i) pa[i] = ca[order[i]];
			for (size_t turn = 0; turn < 6; ++turn) {
				std::swap(pb[turn % 2], pb[2]);
				ASSERT_EQ(ContactOf(pa, pb), expected) << Describe(a, b);
				ASSERT_EQ(ContactOf(pb, pa), expected) << Describe(a, b);
			}
		} while (std::next_permutation(order.begin(), order.end()));
		for (const double scale : {std::ldexp(1.0, -100), std::ldexp(1.0, 100)})
			ASSERT_EQ(ContactOf(ToCorners(a, scale), ToCorners(b, scale)), expected) << Describe(a, b);
		const Point3d utm(500000, 4000000, 100);
		ASSERT_EQ(ContactOf(ToCorners(a, 0.25, utm), ToCorners(b, 0.25, utm)), expected) << Describe(a, b);
	}
}

// One float32 ulp makes the difference between a wall that ends above a floor, on it, and in it.
TEST(Contact, OneUlpDecides)
{
	const Corners floor = {Point3d(0, 0, 7.3f), Point3d(10, 0, 7.3f), Point3d(0, 10, 7.3f)};
	Corners wall = {Point3d(2, 2, 9), Point3d(3, 2, 9), Point3d(2.5, 2, 7.3f)};
	EXPECT_EQ(ContactOf(floor, wall), Contact::Touches);
	wall[2][2] = std::nextafter(7.3f, 8.0f);
	EXPECT_EQ(ContactOf(floor, wall), Contact::Disjoint);
	wall[2][2] = std::nextafter(7.3f, 7.0f);
	EXPECT_EQ(ContactOf(floor, wall), Contact::Crosses);
}

// Neighbours along an edge are at fault only when the one is folded flat onto the other.
TEST(Contact, FoldedNeighbours)
{
	const Corners base = {Point3d(0, 0, 0), Point3d(1, 0, 0), Point3d(0.3f, 1, 0)};
	Corners flap = {Point3d(1, 0, 0), Point3d(0, 0, 0), Point3d(0.6f, 0.5f, 0)};
	EXPECT_EQ(ContactOf(base, flap), Contact::Overlaps);
	flap[2] = Point3d(0.6f, 0.5f, 1e-30);
	EXPECT_EQ(ContactOf(base, flap), Contact::SharesOnly);
	flap[2] = Point3d(0.6f, -0.5f, 0);
	EXPECT_EQ(ContactOf(base, flap), Contact::SharesOnly);
	EXPECT_EQ(ContactOf(base, {base[1], base[2], base[0]}), Contact::Overlaps);
}

TEST(Collinear, Exactly)
{
	const Point3d a(0.1f, 0.2f, 0.3f), step(0.25f, 0.5f, -1);
	EXPECT_TRUE(IsCollinear({a, a, Point3d(1, 2, 3)}));
	EXPECT_TRUE(IsCollinear({Point3d(0, 0, 0), step, step * 3}));
	EXPECT_FALSE(IsCollinear({Point3d(0, 0, 0), step, step * 3 + Point3d(0, 0, 1e-15)}));
	EXPECT_FALSE(IsCollinear({Point3d(0, 0, 0), step, step * 3 + Point3d(1e-15, 0, 0)}));
}

}  // namespace
