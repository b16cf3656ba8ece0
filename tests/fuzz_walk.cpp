// Fuzz target: the contour walk and the tessellation on one triangle, and the reader of .walk files.
//
//   tests/fuzz.sh walk -max_total_time=600
//
// An input whose first byte is even makes a triangle with random pieces, good or not; the rest is read as a .walk
// file. What the walk accepts must keep its promises (triangle_walk.h); a refusal is a WalkConflict. A failing
// input prints its case as a .walk file.

#include "random_source.h"
#include "vcg_ext/tessellate.h"
#include "walk_case.h"

#include <cstdio>
#include <cstdlib>
#include <set>

using namespace vcg::textlabel;
using vcg::textlabel::test::Random;
using walk_case::WalkCase;

namespace {

[[noreturn]] void Fail(const WalkCase& c, const char* why)
{
	std::fprintf(stderr, "%s\n%s", why, walk_case::ToText(c).c_str());
	std::abort();
}

/// Coordinates on a coarse grid, so that points on lines and on each other are the rule.
vcg::Point2d RandomPoint(Random& random)
{
	const double y = random.integer(0, 16), x = random.integer(0, 16 - int(y));
	return {x, y};
}

WalkCase RandomCase(Random& random)
{
	WalkCase c;
	const vcg::Point2d corner[3] = {{0, 0}, {16, 0}, {0, 16}};
	for (int k = 0; k < 3; ++k) {
		std::set<int> along;
		for (int i = random.below(5); i > 0; --i) along.insert(random.integer(1, 15));
		c.border.push_back(corner[k]);
		for (const int a : along) c.border.push_back(corner[k] + (corner[(k + 1) % 3] - corner[k]) * (a / 16.0));
	}
	const int n = int(c.border.size());
	for (int i = random.below(4); i > 0; --i) {
		walk_case::Chain chain{random.below(n), random.below(n), {}};
		for (int k = random.below(4); k > 0; --k) chain.inner.push_back(RandomPoint(random));
		c.chains.push_back(chain);
	}
	for (int i = random.below(3); i > 0; --i) {
		std::vector<vcg::Point2d> loop;
		for (int k = random.integer(3, 6); k > 0; --k) loop.push_back(RandomPoint(random));
		c.loops.push_back(loop);
	}
	if (random.chance(0.2))
		for (vcg::Point2d& p : c.border) p = vcg::Point2d(p[0] * 0.1, p[1] * 1e-7);
	return c;
}

double TwiceAreaOf(const TriangleCase& t, const int* begin, const int* end)
{
	double sum = 0;
	for (const int* p = begin; p + 2 < end; ++p)
		sum +=
			(t.points[size_t(p[1])] - t.points[size_t(*begin)]) ^ (t.points[size_t(p[2])] - t.points[size_t(*begin)]);
	return sum;
}

struct Segment {
	int from, to;
};

bool AreTouching(const TriangleCase& t, const Segment& a, const Segment& b)
{
	const auto at = [&](int i) -> const vcg::Point2d& { return t.points[size_t(i)]; };
	const auto isOn = [&](const Segment& s, int i) {
		const vcg::Point2d &p = at(s.from), &q = at(s.to), &x = at(i);
		return Orient2d(p, q, x) == 0 && std::min(p[0], q[0]) <= x[0] && x[0] <= std::max(p[0], q[0]) &&
		       std::min(p[1], q[1]) <= x[1] && x[1] <= std::max(p[1], q[1]);
	};
	if (std::minmax(a.from, a.to) == std::minmax(b.from, b.to)) return true;  // one along the other
	for (const int i : {b.from, b.to})
		if (i != a.from && i != a.to && isOn(a, i)) return true;
	for (const int i : {a.from, a.to})
		if (i != b.from && i != b.to && isOn(b, i)) return true;
	const auto side = [&](const Segment& s, int i) { return Orient2d(at(s.from), at(s.to), at(i)); };
	return side(a, b.from) * side(a, b.to) < 0 && side(b, a.from) * side(b, a.to) < 0;
}

/// Whether the pieces are what a walk may be given: they meet each other and the border in their ends only.
bool AreSimple(const TriangleCase& t)
{
	std::vector<Segment> segments;
	for (int i = 0; i < t.borderCount; ++i) segments.push_back({i, (i + 1) % t.borderCount});
	for (int i = 0; i < t.chains.size(); ++i)
		for (const int* p = t.chains.begin(i); p + 1 < t.chains.end(i); ++p) segments.push_back({p[0], p[1]});
	for (int i = 0; i < t.loops.size(); ++i)
		for (const int *p = t.loops.end(i) - 1, *q = t.loops.begin(i); q != t.loops.end(i); p = q++)
			segments.push_back({*p, *q});
	for (size_t i = 0; i < segments.size(); ++i) {
		if (t.points[size_t(segments[i].from)] == t.points[size_t(segments[i].to)]) return false;
		for (size_t j = 0; j < i; ++j)
			if (AreTouching(t, segments[i], segments[j])) return false;
	}
	return true;
}

/// No region is turned round; they tile the triangle; every border piece has one; a triangulation of them adds up
/// again.
void Check(const WalkCase& c, const TriangleCase& t, const RegionSet& set)
{
	constexpr double rounding = 1e-8;
	const auto index = [&](int i) { return i >= 0 && i < int(t.points.size()); };
	double whole = 0, sum = 0;
	for (int i = 1; i + 1 < t.borderCount; ++i)
		whole += (t.points[size_t(i)] - t.points[0]) ^ (t.points[size_t(i) + 1] - t.points[0]);
	const bool isSimple = AreSimple(t);
	Tessellator tessellator;
	std::vector<vcg::Point3d> space;  // as the plane: where all shapes are 0 no ear would be cut
	for (const vcg::Point2d& p : t.points) space.emplace_back(p[0], p[1], 0);
	for (const RegionSet::Region& r : set.regions) {
		double area = 0, tiled = 0;
		for (int i = r.firstRing; i < r.firstRing + r.ringCount; ++i) {
			for (const int* p = set.rings.begin(i); p != set.rings.end(i); ++p)
				if (!index(*p)) Fail(c, "a ring has no such point");
			area += TwiceAreaOf(t, set.rings.begin(i), set.rings.end(i));
		}
		if (!(area > -rounding * whole)) Fail(c, "a region is turned round");
		sum += area;
		std::vector<IndexTriangle> triangles;
		try {
			tessellator.triangulate(t.points, space, set.rings, r.firstRing, r.ringCount, triangles);
		} catch (const WalkConflict&) {
			// one that is thinner than the rounding of points on a slanting edge has none
			if (isSimple && area > rounding * whole) Fail(c, "a region of simple pieces has no triangulation");
			continue;
		}
		if (!isSimple) continue;
		for (const IndexTriangle& f : triangles) {
			const vcg::Point2d& a = t.points[size_t(f[0])];
			tiled += (t.points[size_t(f[1])] - a) ^ (t.points[size_t(f[2])] - a);
		}
		if (!(std::abs(tiled - area) <= rounding * whole)) Fail(c, "triangles do not tile their region");
	}
	if (!(std::abs(sum - whole) <= rounding * whole)) Fail(c, "regions do not tile the triangle");
	for (const int r : set.regionAtBorder)
		if (r < 0 || r >= int(set.regions.size())) Fail(c, "a border piece without a region");
}

void Walk(const WalkCase& c)
{
	const TriangleCase t = walk_case::ToTriangle(c);
	TriangleWalk walk;
	RegionSet set;
	try {
		walk.cut(t, set);
	} catch (const WalkConflict& conflict) {
		if (conflict.point < 0 || conflict.point >= int(t.points.size())) Fail(c, "a conflict names no point");
		return;
	}
	Check(c, t, set);
}

/// What is read is written so that it is read again; and a case from a file can be walked, unless its border is no
/// triangle.
void Read(const std::string& text)
{
	WalkCase c;
	try {
		c = walk_case::FromText(text);
	} catch (const std::invalid_argument&) {
		return;
	}
	const std::string written = walk_case::ToText(c);
	if (walk_case::ToText(walk_case::FromText(written)) != written) Fail(c, "not read as it was written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size)
{
	if (size == 0) return 0;
	if (data[0] % 2 != 0) {
		Read(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
		return 0;
	}
	Random random(data + 1, size - 1);
	Walk(RandomCase(random));
	return 0;
}
