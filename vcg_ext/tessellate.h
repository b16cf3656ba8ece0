#pragma once
// Regions to triangles.
//
// GLU's tessellator does it, as in the paper (section 3.2). It must not add a vertex: when its combine callback is handed
// two different points, a region crosses itself, and that is a conflict. Most regions are a few corners between two contour points,
// for which GLU's preparations cost more than the work: from these, ears are cut (G. H. Meisters, "Polygons have ears", American
// Mathematical Monthly 82, 1975), by exact signs. Both leave needles, also flat ones between points that lie on one straight edge,
// so edges inside a region are then flipped until the worst triangle can't be made better. Region borders are never flipped. What is
// lower than coordinates can tell is worse than any longer needle: it may turn round when it is rounded.

#include "triangle_walk.h"

#include <GL/glu.h>
#include <array>
#include <cstdint>
#include <memory>
#include <vcg/space/point3.h>
#ifdef _MSC_VER
#include <intrin.h>
#endif

namespace vcg::textlabel {

/// A triangle of a region: indices of points.
using IndexTriangle = std::array<int, 3>;

/// Quality of a triangle: 1 and the square of its height over its longest edge, 1.75 for an equilateral one; of one that is lower than
/// `finest`, whatever its shape, the square of its height over that, below 1; 0 for one without area.
/// @param[in] finest  units of `space`
inline double Quality(const std::vector<vcg::Point3d>& space, const IndexTriangle& t, double finest)
{
	const vcg::Point3d &a = space[size_t(t[0])], &b = space[size_t(t[1])], &c = space[size_t(t[2])];
	const vcg::Point3d ab = b - a, bc = c - b, ca = a - c;
	const double longest = std::max({ab.SquaredNorm(), bc.SquaredNorm(), ca.SquaredNorm()}),
				 area = (ab ^ ca).SquaredNorm();
	if (!(area > 0)) return 0;
	const double height = area / longest, least = finest * finest;  // squared, as all here
	return height < least ? height / least : 1 + height / longest;
}

class Tessellator {
public:
	/// @param[in] finest  units of `space` below: a triangle that is lower is worse than all that are not, as long as it may be: when
	///                    its corners are rounded, it may turn round
	explicit Tessellator(double finest = 0);

	/// Triangulate one region.
	/// @param[in] plane  points in the label plane: decides orientation
	/// @param[in] space  the same points in space: decides quality, so that a steep triangle gets good triangles as well
	/// @param[in] rings, first, count  the region's rings: outer counter-clockwise, holes clockwise
	/// @param[out] triangles  counter-clockwise, appended; #corners + 2 #holes - 2 of them
	/// @throws WalkConflict when the region crosses itself or has fewer than three corners
	void triangulate(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space,
	                 const PolylineSet& rings, int first, int count, std::vector<IndexTriangle>& triangles);

private:
	using GluPointer = std::unique_ptr<GLUtesselator, void (*)(GLUtesselator*)>;
	static constexpr int mostEars = 24;  ///< corners of a ring that is not worth GLU's preparations
	/// Of a quality: far more than its rounding; less is not worth a flip.
	static constexpr double gain = 1e-12;
	void runGlu(const std::vector<vcg::Point2d>& plane, const PolylineSet& rings, int first, int count);
	void improve(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space);
	bool splitQuad(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space, const int* ring,
	               std::vector<IndexTriangle>& triangles) const;
	bool clipEars(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space, const int* ring,
	              int corners);
	void pairEdges();
	double quality(const std::vector<vcg::Point3d>& space, int a, int b, int c) const
	{
		return Quality(space, {a, b, c}, finest_);
	}
	void measureQualities(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space);

	const double finest_;
	GluPointer glu_;
	std::vector<std::array<double, 3>> coordinates_;
	std::vector<int> corners_;
	std::vector<IndexTriangle> triangles_;
	std::vector<double> quality_;  ///< #triangles_, while they are improved; 0 where one is not counter-clockwise
	std::vector<int> twin_;        ///< #triangles_*3: the half-edge on the other side, or -1
	std::vector<int> pending_;
	std::vector<int> table_;  ///< scratch: half-edges by their corners
	bool crossed_ = false;
};

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// The lowest bit that is set.
/// @param[in] bits  not 0
inline int FirstBit(std::uint32_t bits)
{
#ifdef _MSC_VER
	unsigned long first;
	_BitScanForward(&first, bits);
	return int(first);
#else
	return __builtin_ctz(bits);
#endif
}

}  // namespace detail

inline Tessellator::Tessellator(double finest) : finest_(finest), glu_(gluNewTess(), gluDeleteTess)
{
	if (!glu_) throw std::bad_alloc();
	using Callback = void (*)();
	const auto vertex = +[](void* id, void* self) {
		// nothing may be thrown through GLU's C code, so the room is made before, and more than that is no triangulation
		Tessellator& t = *static_cast<Tessellator*>(self);
		if (t.corners_.size() < t.corners_.capacity()) t.corners_.push_back(int(reinterpret_cast<std::intptr_t>(id)));
		else t.crossed_ = true;
	};
	const auto combine = +[](GLdouble*, void** data, GLfloat*, void** out, void* self) {
		// a ring that touches its region's border, or itself, in a corner comes here with the same point twice: no crossing
		if (data[0] != data[1] || data[2] != nullptr) static_cast<Tessellator*>(self)->crossed_ = true;
		*out = data[0];
	};
	const auto edgeFlag = +[](GLboolean, void*) {};  // asks GLU for plain triangles, no fans and strips
	const auto error = +[](GLenum, void* self) { static_cast<Tessellator*>(self)->crossed_ = true; };
	gluTessCallback(glu_.get(), GLU_TESS_VERTEX_DATA, reinterpret_cast<Callback>(vertex));
	gluTessCallback(glu_.get(), GLU_TESS_COMBINE_DATA, reinterpret_cast<Callback>(combine));
	gluTessCallback(glu_.get(), GLU_TESS_EDGE_FLAG_DATA, reinterpret_cast<Callback>(edgeFlag));
	gluTessCallback(glu_.get(), GLU_TESS_ERROR_DATA, reinterpret_cast<Callback>(error));
	gluTessProperty(glu_.get(), GLU_TESS_WINDING_RULE, GLU_TESS_WINDING_POSITIVE);
	gluTessNormal(glu_.get(), 0, 0, 1);
}

inline void Tessellator::runGlu(const std::vector<vcg::Point2d>& plane, const PolylineSet& rings, int first, int count)
{
	crossed_ = false;
	corners_.clear();
	coordinates_.clear();
	const size_t points = size_t(rings.end(first + count - 1) - rings.begin(first));
	corners_.reserve(3 * (points + 2 * size_t(count)));
	coordinates_.reserve(points);  // GLU keeps no copy before the end
	gluTessBeginPolygon(glu_.get(), this);
	for (int r = first; r < first + count; ++r) {
		gluTessBeginContour(glu_.get());
		for (const int* id = rings.begin(r); id != rings.end(r); ++id) {
			const vcg::Point2d& p = plane[size_t(*id)];
			coordinates_.push_back({p[0], p[1], 0});
			gluTessVertex(glu_.get(), coordinates_.back().data(), reinterpret_cast<void*>(std::intptr_t(*id)));
		}
		gluTessEndContour(glu_.get());
	}
	gluTessEndPolygon(glu_.get());
}

inline void Tessellator::triangulate(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space,
                                     const PolylineSet& rings, int first, int count,
                                     std::vector<IndexTriangle>& triangles)
{
	const int corners = int(rings.end(first + count - 1) - rings.begin(first)),
			  expected = corners + 2 * (count - 1) - 2;
	const int* ring = rings.begin(first);
	if (corners < 3) throw WalkConflict{"a region has no area", ring[0]};
	if (corners == 3) {
		triangles.push_back({ring[0], ring[1], ring[2]});
		return;
	}
	if (corners == 4 && splitQuad(plane, space, ring, triangles)) return;
	if (count > 1 || corners > mostEars || !clipEars(plane, space, ring, corners)) {
		runGlu(plane, rings, first, count);
		if (crossed_ || int(corners_.size()) != 3 * expected) throw WalkConflict{"a region crosses itself", ring[0]};
		triangles_.clear();
		for (size_t i = 0; i < corners_.size(); i += 3)
			triangles_.push_back({corners_[i], corners_[i + 1], corners_[i + 2]});
		pairEdges();
		measureQualities(plane, space);
	}
	improve(plane, space);
	triangles.insert(triangles.end(), triangles_.begin(), triangles_.end());
}

/// Most regions that are no triangle are the rest of one that a contour has crossed: of its two diagonals, take the one whose worse
/// triangle is the better; false when none gives two that are counter-clockwise.
inline bool Tessellator::splitQuad(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space,
                                   const int* ring, std::vector<IndexTriangle>& triangles) const
{
	const int a = ring[0], b = ring[1], c = ring[2], d = ring[3];
	const auto worse = [&](const IndexTriangle& s, const IndexTriangle& t) {
		for (const IndexTriangle* x : {&s, &t})
			if (Orient2d(plane[size_t((*x)[0])], plane[size_t((*x)[1])], plane[size_t((*x)[2])]) <= 0) return -1.0;
		return std::min(quality(space, s[0], s[1], s[2]), quality(space, t[0], t[1], t[2]));
	};
	const IndexTriangle abc = {a, b, c}, acd = {a, c, d}, abd = {a, b, d}, bcd = {b, c, d};
	const double ac = worse(abc, acd), bd = worse(abd, bcd);
	if (ac < 0 && bd < 0) return false;
	const bool takeBd = bd > ac + gain || ac < 0;
	triangles.push_back(takeBd ? abd : abc);
	triangles.push_back(takeBd ? bcd : acd);
	return true;
}

/// Cut ears off a small ring without holes, the best first; false when it can't be done, as with a ring that touches itself.
/// That all triangles are counter-clockwise is proof enough: their edges cancel but for the ring, so they cover each point as often
/// as the ring winds round it. What lies within an ear is asked only to find a way that ends.
/// @post  triangles_, quality_ and twin_ belong together
inline bool Tessellator::clipEars(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space,
                                  const int* ring, int corners)
{
	using Mask = std::uint32_t;  // a bit for each corner of the ring
	static_assert(mostEars <= 32);
	struct Corner {
		vcg::Point2d plane;
		double quality;  // of the triangle with the corners beside it; 0 where it is not convex
		int point, before, after;
		int outer;  // the half-edge of a cut ear that lies along the edge to the corner after it, or -1
	};
	std::array<Corner, mostEars> all;
	Mask repeated = 0;  // corners whose point is another corner's, too
	for (int i = 0; i < corners; ++i) {
		all[size_t(i)] = {plane[size_t(ring[i])],      0, ring[i], i > 0 ? i - 1 : corners - 1,
		                  i + 1 < corners ? i + 1 : 0, -1};
		for (int k = 0; k < i; ++k)
			if (ring[k] == ring[i]) repeated |= Mask(1) << i | Mask(1) << k;
	}
	const auto corner = [&](int i) -> Corner& { return all[size_t(i)]; };
	const auto side = [&](const Corner& a, const Corner& b, const Corner& c) {
		return Orient2d(a.plane, b.plane, c.plane);
	};
	Mask convex = 0, ears = 0, left = Mask((std::uint64_t(1) << corners) - 1);
	const auto lookAt = [&](int i) {
		Corner& b = corner(i);
		const Corner &a = corner(b.before), &c = corner(b.after);
		b.quality = side(a, b, c) > 0 ? quality(space, a.point, b.point, c.point) : 0;
		convex = b.quality > 0 ? convex | Mask(1) << i : convex & ~(Mask(1) << i);
	};
	const auto isEar = [&](int i) {
		const Corner &b = corner(i), &a = corner(b.before), &c = corner(b.after);
		if (!(b.quality > 0)) return false;
		// of the corners within a triangle, the one furthest from the cut is not convex, so only those need a look
		const Mask own = Mask(1) << i | Mask(1) << b.before | Mask(1) << b.after;
		for (Mask rest = left & (~convex | repeated) & ~own; rest; rest &= rest - 1) {
			const int k = detail::FirstBit(rest);
			const Corner& p = corner(k);
			const bool isConvex = convex >> k & 1;
			if (isConvex && p.point != a.point && p.point != b.point && p.point != c.point) continue;
			if (side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0) return false;
		}
		return true;
	};
	const auto judge = [&](int i) { ears = isEar(i) ? ears | Mask(1) << i : ears & ~(Mask(1) << i); };
	for (int i = 0; i < corners; ++i) lookAt(i);
	for (int i = 0; i < corners; ++i) judge(i);
	triangles_.clear();
	quality_.clear();
	twin_.clear();
	const auto add = [&](int i, int beyond) {  // the triangle at a corner, and the half-edge across from it
		const Corner &b = corner(i), &a = corner(b.before), &c = corner(b.after);
		for (const int outer : {a.outer, b.outer, beyond}) {
			if (outer >= 0) twin_[size_t(outer)] = int(twin_.size());
			twin_.push_back(outer);
		}
		triangles_.push_back({a.point, b.point, c.point});
		quality_.push_back(b.quality);
	};
	for (int n = corners; n > 3; --n) {
		if (!ears) return false;
		int best = detail::FirstBit(ears);
		for (Mask rest = ears & (ears - 1); rest; rest &= rest - 1)
			if (corner(detail::FirstBit(rest)).quality > corner(best).quality) best = detail::FirstBit(rest);
		add(best, -1);
		const int a = corner(best).before, c = corner(best).after;
		corner(a).after = c;
		corner(c).before = a;
		corner(a).outer = int(twin_.size()) - 1;
		left &= ~(Mask(1) << best);
		ears &= ~(Mask(1) << best);
		lookAt(a);
		lookAt(c);
		judge(a);
		judge(c);
	}
	const int last = corner(detail::FirstBit(left)).after;
	add(last, corner(corner(last).after).outer);
	return side(corner(corner(last).before), corner(last), corner(corner(last).after)) > 0;
}

/// Half-edges of an edge meet in a hash table; what is found does not depend on its order.
inline void Tessellator::pairEdges()
{
	const size_t count = triangles_.size() * 3;
	size_t places = 16;
	while (places < 2 * count) places *= 2;
	table_.assign(places, -1);
	twin_.assign(count, -1);
	const auto from = [&](int h) { return triangles_[size_t(h / 3)][size_t(h % 3)]; };
	const auto to = [&](int h) { return triangles_[size_t(h / 3)][size_t(h % 3 == 2 ? 0 : h % 3 + 1)]; };
	for (int h = 0; h < int(count); ++h) {
		const int a = from(h), b = to(h);
		const auto mixed = (std::uint64_t(std::min(a, b)) << 32 | std::uint64_t(std::max(a, b))) * 0x9E3779B97F4A7C15;
		size_t slot = size_t(mixed >> 32) & (places - 1);
		while (table_[slot] >= 0 && (from(table_[slot]) != b || to(table_[slot]) != a))
			slot = (slot + 1) & (places - 1);
		if (table_[slot] >= 0) {
			twin_[size_t(h)] = table_[slot];
			twin_[size_t(table_[slot])] = h;
		} else {
			table_[slot] = h;
		}
	}
}

inline void Tessellator::measureQualities(const std::vector<vcg::Point2d>& plane,
                                          const std::vector<vcg::Point3d>& space)
{
	quality_.clear();
	for (const auto& [a, b, c] : triangles_)
		quality_.push_back(Orient2d(plane[size_t(a)], plane[size_t(b)], plane[size_t(c)]) > 0 ? quality(space, a, b, c)
		                                                                                      : 0);
}

// Flip an edge when the worse of its two triangles gets better by it. The sorted list of qualities grows with each flip, so it ends.
inline void Tessellator::improve(const std::vector<vcg::Point2d>& plane, const std::vector<vcg::Point3d>& space)
{
	const auto next = [](int h) { return h % 3 == 2 ? h - 2 : h + 1; };
	const auto corner = [&](int h) -> int& { return triangles_[size_t(h / 3)][size_t(h % 3)]; };
	const auto join = [&](int g, int h) {
		twin_[size_t(g)] = h;
		if (h >= 0) twin_[size_t(h)] = g;
	};
	const auto isCounterClockwise = [&](int a, int b, int c) {
		return Orient2d(plane[size_t(a)], plane[size_t(b)], plane[size_t(c)]) > 0;
	};
	pending_.clear();
	for (int h = 0; h < int(twin_.size()); ++h)
		if (twin_[size_t(h)] > h) pending_.push_back(h);
	while (!pending_.empty()) {
		const int h = pending_.back(), g = twin_[size_t(h)];
		pending_.pop_back();
		if (g < 0) continue;
		//      c            triangle of h: a b c, of g: b a d;  after the flip: d b c (in h's place) and c a d (in g's)
		//    a   b
		//      d
		const int a = corner(h), b = corner(g), c = corner(next(next(h))), d = corner(next(next(g)));
		double &first = quality_[size_t(h / 3)], &second = quality_[size_t(g / 3)];
		const double least = std::min(first, second) + gain;
		const double one = quality(space, d, b, c);
		if (!(one > least)) continue;
		const double two = quality(space, c, a, d);
		if (!(two > least) || !isCounterClockwise(d, b, c) || !isCounterClockwise(c, a, d)) continue;
		first = one;
		second = two;
		const int bc = twin_[size_t(next(h))], ca = twin_[size_t(next(next(h)))], ad = twin_[size_t(next(g))],
				  db = twin_[size_t(next(next(g)))];
		const int t = h / 3 * 3, s = g / 3 * 3;
		triangles_[size_t(t / 3)] = {d, b, c};
		triangles_[size_t(s / 3)] = {c, a, d};
		join(t, db);
		join(t + 1, bc);
		join(t + 2, s + 2);
		join(s, ca);
		join(s + 1, ad);
		for (const int e : {t, t + 1, s, s + 1}) pending_.push_back(e);
	}
}

}  // namespace vcg::textlabel
