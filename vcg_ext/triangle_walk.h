#pragma once
// The contour walk of the paper, on one triangle.
//
// Source: Slabaugh et al., section 3.2 and Code Listing 1. Start where a contour enters the triangle, follow it to where it leaves,
// turn clockwise along the triangle's border to the next crossing or corner, until back at the start: that polygon lies to the
// right of the contour, *outside* the letter. The mirrored walk (left of the contour, counter-clockwise along the border) gives the
// *inside* polygons, which the paper throws away: the top of a raised letter, the floor of a sunk one and a flat one are made of
// them. The paper's special cases (a contour wholly within the triangle, holes, islands in holes) are nesting, found here for any
// depth. One case is new: after snapping, a contour may touch the border from within at a point; the side to which it turns there
// tells which of the two walks goes straight on and which follows the border.
//
// Pure planar code on indices; no mesh.

#include "contour.h"
#include "plane_box.h"
#include "predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace vcg::textlabel {

/// Several polylines in one array: line i is ids[start[i]] .. ids[start[i+1]-1].
struct PolylineSet {
	std::vector<int> ids, start{0};

	int size() const { return int(start.size()) - 1; }
	const int* begin(int i) const { return ids.data() + start[size_t(i)]; }
	const int* end(int i) const { return ids.data() + start[size_t(i) + 1]; }
	int length(int i) const { return start[size_t(i) + 1] - start[size_t(i)]; }
	void add(int id) { ids.push_back(id); }
	void close() { start.push_back(int(ids.size())); }
	void clear()
	{
		ids.clear();
		start.assign(1, 0);
	}
};

/// One triangle and the contour pieces that cross it.
struct TriangleCase {
	std::vector<vcg::Point2d>
		points;           ///< #P by 2; the first `borderCount` are the border, counter-clockwise from corner 0
	int borderCount = 0;  ///< corners and the points on the edges between them
	PolylineSet chains;   ///< from border point to border point through inner points; inside of the letter to the left
	PolylineSet loops;    ///< closed contours that lie wholly within

	void clear()
	{
		points.clear();
		borderCount = 0;
		chains.clear();
		loops.clear();
	}
};

enum class Side : signed char { Outside = -1, Unknown = 0, Inside = 1 };

/// The regions that tile a triangle.
struct RegionSet {
	struct Region {
		Side side;      ///< Unknown only when no contour piece lies in the triangle
		int firstRing;  ///< ring `firstRing` is the outer boundary, the rest are holes, clockwise
		int ringCount;
	};
	PolylineSet rings;  ///< indices into TriangleCase::points
	std::vector<Region> regions;
	std::vector<int> regionAtBorder;  ///< #borderCount: the region along the border piece from point i to point i+1

	void clear()
	{
		rings.clear();
		regions.clear();
		regionAtBorder.clear();
	}
};

/// Why a walk could not be done; the input was not a set of simple, disjoint, correctly oriented pieces.
struct WalkConflict {
	const char* why;
	int point;  ///< index into TriangleCase::points
};

/// Cuts triangles; keeps its buffers from one to the next.
class TriangleWalk {
public:
	/// Cut one triangle along the contour pieces that cross it.
	/// @param[in] c  points in the label plane (label units); chains and loops simple and disjoint
	/// @param[out] out  counter-clockwise regions tagged by side; border pieces know their region
	/// @post  areas of the regions are positive and add up to the triangle's; corners are kept; every contour piece borders one
	///        inside and one outside region
	/// @throws WalkConflict
	/// Source: Slabaugh et al., section 3.2; differs in: inside regions are kept, nesting to any depth, touching points
	void cut(const TriangleCase& c, RegionSet& out);

private:
	void indexChains(const TriangleCase& c);
	void walkRegions(const TriangleCase& c, Side side, RegionSet& out);
	void nestLoops(const TriangleCase& c, RegionSet& out);
	void checkAreas(const TriangleCase& c, const RegionSet& out) const;
	static bool isInRing(const TriangleCase& c, const int* begin, const int* end, const vcg::Point2d& p);
	static double twiceArea(const TriangleCase& c, const int* begin, const int* end);

	std::vector<int> chainFrom_, chainTo_;  ///< #borderCount: the chain that starts or ends at a border point, or -1
	std::vector<char> walked_;
	std::vector<int> ring_, order_, parent_;
	PolylineSet holes_;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline void TriangleWalk::cut(const TriangleCase& c, RegionSet& out)
{
	out.clear();
	out.regionAtBorder.assign(size_t(c.borderCount), -1);
	indexChains(c);
	if (c.chains.size() == 0) {
		for (int i = 0; i < c.borderCount; ++i) out.rings.add(i);
		out.rings.close();
		out.regions.push_back({Side::Unknown, 0, 1});
		std::fill(out.regionAtBorder.begin(), out.regionAtBorder.end(), 0);
	} else {
		walkRegions(c, Side::Outside, out);
		walkRegions(c, Side::Inside, out);
		for (int i = 0; i < c.borderCount; ++i)
			if (out.regionAtBorder[size_t(i)] < 0) throw WalkConflict{"a border piece belongs to no region", i};
	}
	if (c.loops.size() > 0) nestLoops(c, out);
	checkAreas(c, out);
}

inline void TriangleWalk::indexChains(const TriangleCase& c)
{
	chainFrom_.assign(size_t(c.borderCount), -1);
	chainTo_.assign(size_t(c.borderCount), -1);
	for (int i = 0; i < c.chains.size(); ++i) {
		const int from = *c.chains.begin(i), to = *(c.chains.end(i) - 1);
		if (c.chains.length(i) < 2 || from >= c.borderCount || to >= c.borderCount)
			throw WalkConflict{"a chain does not run from border to border", from};
		if (chainFrom_[size_t(from)] >= 0 || chainTo_[size_t(to)] >= 0)
			throw WalkConflict{"two chains share a border point in the same direction",
			                   chainFrom_[size_t(from)] >= 0 ? from : to};
		chainFrom_[size_t(from)] = i;
		chainTo_[size_t(to)] = i;
	}
}

inline void TriangleWalk::walkRegions(const TriangleCase& c, Side side, RegionSet& out)
{
	const int n = c.borderCount,
			  turn = side == Side::Outside ? -1 : 1;  // right of the contour: clockwise along the border
	walked_.assign(size_t(c.chains.size()), 0);
	for (int first = 0; first < c.chains.size(); ++first) {
		if (walked_[size_t(first)]) continue;
		const int region = int(out.regions.size());
		ring_.clear();
		for (int chain = first; !walked_[size_t(chain)];) {
			walked_[size_t(chain)] = 1;
			ring_.insert(ring_.end(), c.chains.begin(chain), c.chains.end(chain) - 1);
			int p = *(c.chains.end(chain) - 1), next = chainFrom_[size_t(p)];
			const vcg::Point2d* at = c.points.data();
			const int before = *(c.chains.end(chain) - 2);
			const bool straightOn =
				next >= 0 && Orient2d(at[before], at[p], at[*(c.chains.begin(next) + 1)]) * turn > 0;
			while (!straightOn) {  // along the border to the next entry point
				ring_.push_back(p);
				const int piece = turn > 0 ? p : (p + n - 1) % n;
				if (out.regionAtBorder[size_t(piece)] >= 0) throw WalkConflict{"two walks along one border piece", p};
				out.regionAtBorder[size_t(piece)] = region;
				p = (p + n + turn) % n;
				next = chainFrom_[size_t(p)];
				if (next >= 0) break;
				if (chainTo_[size_t(p)] >= 0) throw WalkConflict{"the walk meets an exit where an entry is due", p};
			}
			if (walked_[size_t(next)] && next != first) throw WalkConflict{"a walk runs into another", p};
			chain = next;
		}
		if (turn < 0) std::reverse(ring_.begin(), ring_.end());
		for (const int id : ring_) out.rings.add(id);
		out.rings.close();
		out.regions.push_back({side, out.rings.size() - 1, 1});
	}
}

inline double TriangleWalk::twiceArea(const TriangleCase& c, const int* begin, const int* end)
{
	const vcg::Point2d origin = c.points[size_t(*begin)];
	double sum = 0;
	for (const int *p = end - 1, *q = begin; q != end; p = q++)
		sum += (c.points[size_t(*p)] - origin) ^ (c.points[size_t(*q)] - origin);
	return sum;
}

inline bool TriangleWalk::isInRing(const TriangleCase& c, const int* begin, const int* end, const vcg::Point2d& p)
{
	bool inside = false;  // even-odd by exact side; p is never on the ring
	for (const int *i = end - 1, *j = begin; j != end; i = j++) {
		const vcg::Point2d &a = c.points[size_t(*i)], &b = c.points[size_t(*j)];
		if ((a[1] > p[1]) == (b[1] > p[1])) continue;
		if ((Orient2d(a, b, p) > 0) == (b[1] > a[1])) inside = !inside;
	}
	return inside;
}

// Each loop bounds the region within it and is a hole of the region around it: the smallest larger loop that holds it, or the
// region of the chains that does. Sides alternate, which the orientation of the loops must agree with.
inline void TriangleWalk::nestLoops(const TriangleCase& c, RegionSet& out)
{
	const int count = c.loops.size(), outer = int(out.regions.size());
	order_.resize(size_t(count));
	std::vector<double> area(static_cast<size_t>(count));
	std::vector<PlaneBox> box(static_cast<size_t>(count));
	for (int i = 0; i < count; ++i) {
		order_[size_t(i)] = i;
		area[size_t(i)] = twiceArea(c, c.loops.begin(i), c.loops.end(i));
		for (const int* id = c.loops.begin(i); id != c.loops.end(i); ++id) box[size_t(i)].add(c.points[size_t(*id)]);
	}
	std::sort(order_.begin(), order_.end(), [&](int x, int y) {
		const double ax = std::abs(area[size_t(x)]), ay = std::abs(area[size_t(y)]);
		return ax != ay ? ax > ay : x < y;
	});
	// regions `outer + k` belong to loop order_[k]
	parent_.assign(size_t(count), -1);
	for (int k = 0; k < count; ++k) {
		const int loop = order_[size_t(k)];
		const vcg::Point2d& p = c.points[size_t(*c.loops.begin(loop))];
		for (int j = k - 1; j >= 0 && parent_[size_t(k)] < 0; --j) {
			const int around = order_[size_t(j)];
			if (box[size_t(around)].holds(p) && isInRing(c, c.loops.begin(around), c.loops.end(around), p))
				parent_[size_t(k)] = outer + j;
		}
		for (int r = 0; r < outer && parent_[size_t(k)] < 0; ++r) {
			const int ring = out.regions[size_t(r)].firstRing;
			if (outer == 1 || isInRing(c, out.rings.begin(ring), out.rings.end(ring), p)) parent_[size_t(k)] = r;
		}
		if (parent_[size_t(k)] < 0) throw WalkConflict{"a loop lies in no region", *c.loops.begin(loop)};
	}
	std::vector<int> child(size_t(outer + count), -1), sibling(static_cast<size_t>(count), -1);  // first one, next one
	for (int k = count - 1; k >= 0; --k) sibling[size_t(k)] = std::exchange(child[size_t(parent_[size_t(k)])], k);
	// rewrite the regions with their holes behind them
	holes_ = out.rings;
	std::vector<RegionSet::Region> regions(size_t(outer + count));
	out.rings.clear();
	for (int r = 0; r < outer + count; ++r) {
		const int loop = r < outer ? -1 : order_[size_t(r - outer)];
		Side side = loop < 0 ? out.regions[size_t(r)].side : area[size_t(loop)] > 0 ? Side::Inside : Side::Outside;
		const int first = out.rings.size();
		const PolylineSet& from = loop < 0 ? holes_ : c.loops;
		ring_.assign(from.begin(loop < 0 ? r : loop), from.end(loop < 0 ? r : loop));
		if (loop >= 0 && side == Side::Outside) std::reverse(ring_.begin(), ring_.end());
		for (const int id : ring_) out.rings.add(id);
		out.rings.close();
		for (int k = child[size_t(r)]; k >= 0; k = sibling[size_t(k)]) {
			const int hole = order_[size_t(k)];
			const Side around = area[size_t(hole)] > 0 ? Side::Outside : Side::Inside;
			if (side == Side::Unknown) side = around;
			if (side != around) throw WalkConflict{"a loop is oriented against its nesting", *c.loops.begin(hole)};
			ring_.assign(c.loops.begin(hole), c.loops.end(hole));
			if (area[size_t(hole)] > 0) std::reverse(ring_.begin(), ring_.end());
			for (const int id : ring_) out.rings.add(id);
			out.rings.close();
		}
		regions[size_t(r)] = {side, first, out.rings.size() - first};
	}
	out.regions.swap(regions);
}

inline void TriangleWalk::checkAreas(const TriangleCase& c, const RegionSet& out) const
{
	// What is wrong here is wrong by whole regions; points on an edge are off it by the rounding of doubles, which is a lot of
	// the area of a triangle that is thinner than the coordinates' step.
	constexpr double relative = 1e-9, roundings = 64;
	double whole = 0, sum = 0, perimeter = 0, largest = 0;
	for (int i = 0; i < c.borderCount; ++i) {
		const vcg::Point2d &p = c.points[size_t(i)], &q = c.points[size_t((i + 1) % c.borderCount)];
		whole += (p - c.points[0]) ^ (q - c.points[0]);
		perimeter += (q - p).Norm();
		largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
	}
	const double allowed = roundings * std::numeric_limits<double>::epsilon() * largest * perimeter;
	for (const RegionSet::Region& r : out.regions) {
		double area = 0;
		for (int i = r.firstRing; i < r.firstRing + r.ringCount; ++i)
			area += twiceArea(c, out.rings.begin(i), out.rings.end(i));
		if (!(area > -allowed)) throw WalkConflict{"a region is turned round", *out.rings.begin(r.firstRing)};
		sum += area;
	}
	if (!(std::abs(sum - whole) <= relative * whole + allowed))
		throw WalkConflict{"the regions do not tile the triangle", 0};
}

}  // namespace vcg::textlabel
