#pragma once
// Whether two triangles meet in more than the corners and edges they share, decided exactly.
//
// Two faces of a sound surface meet nowhere, in one common corner, or along one common edge. Anything more is a fault of the
// surface. The answer is made of signs of exact predicates only: no intersection point is ever computed.
//
// Source: P. Guigue, O. Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using Orientation Predicates", Journal of
// Graphics Tools 8 (2003). Differs in: exact predicates instead of floating-point ones, and shared corners: the line in which
// the two planes meet leaves both triangles at a shared corner, so the same two comparisons that find the overlap of the
// intervals on that line also tell whether anything lies beyond the corner.

#include <algorithm>
#include <array>
#include <utility>

#include "predicates.h"

namespace vcg::textlabel {

/// The corners of a triangle.
using Corners = std::array<vcg::Point3d, 3>;

/// How two triangles meet. Corners are shared when their coordinates are equal, whatever indices they go by.
enum class Contact {
	Disjoint,    ///< no common point
	SharesOnly,  ///< a common corner or edge and nothing beyond it
	NoArea,  ///< one of them is collinear: it has no inside to cross, and the neighbours along its edges tell of the place
	Touches,  ///< common points beyond what is shared, none of them inside both triangles
	Crosses,  ///< not coplanar, and points inside the one are inside the other
	Overlaps  ///< coplanar, and an area in common: folded onto one another, or the same face twice
};

/// Whether a contact is a fault of the surface; triangles without area are a fault of another kind.
inline bool IsCrossing(Contact c) { return c >= Contact::Touches; }

inline const char* Name(Contact c)
{
	constexpr const char* kNames[] = {"disjoint", "shares-only", "no-area", "touches", "crosses", "overlaps"};
	return kNames[static_cast<int>(c)];
}

/// How triangles a and b meet, exactly; symmetric in a and b and independent of the order of their corners.
/// @param[in] a,b  coordinates in the domain of the exact predicates (predicates.h)
/// @post NoArea only when the boxes of a and b meet, and neither lies strictly on one side of the other's plane
Contact ContactOf(const Corners& a, const Corners& b);

/// As ContactOf, for a caller who knows that the boxes of a and b meet.
Contact ContactWithinBoxes(const Corners& a, const Corners& b);

/// Whether the three points lie on one line, exactly.
bool IsCollinear(const Corners& t);

namespace detail {

/// A corner of each triangle that is the same point; the others are not, or there is a second pair.
struct SharedCorners {
	int count = 0;
	std::array<int, 3> inA{}, inB{};  ///< the first `count` are set
};

inline SharedCorners FindShared(const Corners& a, const Corners& b)
{
	SharedCorners s;
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j) {
			if (a[static_cast<size_t>(i)] != b[static_cast<size_t>(j)]) continue;
			s.inA[static_cast<size_t>(s.count)] = i;
			s.inB[static_cast<size_t>(s.count++)] = j;
			break;
		}
	return s;
}

/// Drops one axis: the plane projection in which exact coplanar questions are asked.
inline vcg::Point2d Dropped(const vcg::Point3d& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

using Flat = std::array<vcg::Point2d, 3>;

/// The triangle seen along an axis, turned counter-clockwise.
/// @return its orientation before: 0 when it is seen edge-on (and then it is not turned)
inline int Flatten(const Corners& t, int axis, Flat& flat)
{
	for (size_t i = 0; i < 3; ++i) flat[i] = Dropped(t[i], axis);
	const int orientation = Orient2d(flat[0], flat[1], flat[2]);
	if (orientation < 0) std::swap(flat[1], flat[2]);
	return orientation;
}

/// How far an edge line of `a` keeps `b` out: +1 b strictly outside, 0 b outside or on the line, -1 no edge does.
inline int EdgeSeparation(const Flat& a, const Flat& b)
{
	int best = -1;
	for (size_t i = 0; i < 3 && best < 1; ++i) {
		int inmost = -1;
		for (size_t j = 0; j < 3 && inmost < 1; ++j) inmost = std::max(inmost, Orient2d(a[i], a[(i + 1) % 3], b[j]));
		best = std::max(best, -inmost);
	}
	return best;
}

/// Whether p and q, which lie on one line with `from`, lie on the same side of it.
inline bool SameDirection(const vcg::Point2d& from, const vcg::Point2d& p, const vcg::Point2d& q)
{
	const int axis = p[0] != from[0] ? 0 : 1;
	return (p[axis] > from[axis]) == (q[axis] > from[axis]);
}

/// The contact of counter-clockwise triangles that share their first corner and no other.
/// Two wedges are apart when a side of one of them has the other on its far side.
inline Contact WedgeContact(const Flat& a, const Flat& b)
{
	const int a1b1 = Orient2d(a[0], a[1], b[1]), a1b2 = Orient2d(a[0], a[1], b[2]);
	const int a2b1 = Orient2d(a[0], a[2], b[1]), a2b2 = Orient2d(a[0], a[2], b[2]);
	const bool apart =
		(a1b1 <= 0 && a1b2 <= 0) || (a2b1 >= 0 && a2b2 >= 0) || (a1b1 >= 0 && a2b1 >= 0) || (a1b2 <= 0 && a2b2 <= 0);
	if (!apart) return Contact::Overlaps;
	const bool edgesRunTogether =
		(a1b2 == 0 && SameDirection(a[0], a[1], b[2])) || (a2b1 == 0 && SameDirection(a[0], a[2], b[1]));
	return edgesRunTogether ? Contact::Touches : Contact::SharesOnly;
}

/// Whether neighbours lie on the same side of their common edge, told by which way each runs along it.
/// @param[in] sameTurn  whether both are seen with the same orientation
inline bool IsFolded(const SharedCorners& shared, bool sameTurn)
{
	const bool alongA = (shared.inA[1] - shared.inA[0] + 3) % 3 == 1,
			   alongB = (shared.inB[1] - shared.inB[0] + 3) % 3 == 1;
	return (alongA == alongB) == sameTurn;
}

inline Corners StartingAt(Corners t, int corner)
{
	std::rotate(t.begin(), t.begin() + corner, t.end());
	return t;
}

/// The contact of triangles in one plane, or of any pair of which one has no area.
inline Contact CoplanarContact(Corners a, Corners b, const SharedCorners& shared)
{
	if (shared.count == 1) {
		a = StartingAt(a, shared.inA[0]);
		b = StartingAt(b, shared.inB[0]);
	}
	Flat fa, fb;
	int axis = 0, turnA = 0;
	while (axis < 3 && (turnA = Flatten(a, axis, fa)) == 0) ++axis;
	const int turnB = axis < 3 ? Flatten(b, axis, fb) : 0;
	if (turnB == 0) return Contact::NoArea;
	if (shared.count == 3) return Contact::Overlaps;
	if (shared.count == 2) return IsFolded(shared, turnA == turnB) ? Contact::Overlaps : Contact::SharesOnly;
	if (shared.count == 1) return WedgeContact(fa, fb);
	const int apart = std::max(EdgeSeparation(fa, fb), EdgeSeparation(fb, fa));
	return apart < 0 ? Contact::Overlaps : apart == 0 ? Contact::Touches : Contact::Disjoint;
}

/// The axis along which a triangle is seen widest, or nearly.
inline int WidestAxis(const Corners& t)
{
	const vcg::Point3d n = (t[1] - t[0]) ^ (t[2] - t[0]);
	const double x = std::abs(n[0]), y = std::abs(n[1]), z = std::abs(n[2]);
	return x > y && x > z ? 0 : y > z ? 1 : 2;
}

/// Whether an edge line of `a`, seen along an axis, keeps b on its far side, but for a corner that the edge shares with it. As
/// EdgeSeparation, for triangles that are not turned, so that their corners keep their numbers.
/// @param[in] turn  the orientation of a, seen so; not 0
/// @param[in] cornerA, cornerB  the shared corner in both; -1: none
inline bool EdgeKeepsOut(const Flat& a, int cornerA, int turn, const Flat& b, int cornerB)
{
	for (int i = 0; i < 3; ++i) {
		const int next = (i + 1) % 3;
		const auto isBeyond = [&](int j) {
			if (j == cornerB && (i == cornerA || next == cornerA)) return true;
			return Orient2d(a[static_cast<size_t>(i)], a[static_cast<size_t>(next)], b[static_cast<size_t>(j)]) ==
			       -turn;
		};
		if (isBeyond(0) && isBeyond(1) && isBeyond(2)) return true;
	}
	return false;
}

/// Whether two triangles, seen along an axis, have nothing in common but what they share; false tells nothing. Neither is seen edge-on,
/// so each point that is seen is one point of a triangle, and what has no place in common there has none in space. It saves exact
/// arithmetic for the pieces of a facet: rounding leaves them so nearly in one plane that no filter can tell its sides.
inline bool AreSeenApart(const Corners& a, const Corners& b, const SharedCorners& shared)
{
	const int axis = WidestAxis(a);
	Flat fa, fb;
	for (size_t i = 0; i < 3; ++i) {
		fa[i] = Dropped(a[i], axis);
		fb[i] = Dropped(b[i], axis);
	}
	const int turnA = Orient2d(fa[0], fa[1], fa[2]), turnB = Orient2d(fb[0], fb[1], fb[2]);
	if (turnA == 0 || turnB == 0) return false;
	if (shared.count == 2) return !IsFolded(shared, turnA == turnB);
	const int inA = shared.count > 0 ? shared.inA[0] : -1, inB = shared.count > 0 ? shared.inB[0] : -1;
	return EdgeKeepsOut(fa, inA, turnA, fb, inB) || EdgeKeepsOut(fb, inB, turnB, fa, inA);
}

/// The sides of a plane on which the corners of a triangle lie: +1, 0, -1 each.
using Sides = std::array<int, 3>;

/// @param[in] corner  the corner of t that is known to lie in the plane; -1: none
inline Sides SidesOf(const Corners& plane, const Corners& t, int corner)
{
	Sides s{};
	for (int i = 0; i < 3; ++i)
		if (i != corner) s[static_cast<size_t>(i)] = Orient3d(plane[0], plane[1], plane[2], t[static_cast<size_t>(i)]);
	return s;
}

inline bool AllZero(const Sides& s) { return s[0] == 0 && s[1] == 0 && s[2] == 0; }

/// Whether a triangle meets the plane nowhere but in the given corner (which lies in the plane; -1: nowhere at all).
inline bool StaysOut(const Sides& s, int corner)
{
	const size_t i = corner < 0 ? 0 : static_cast<size_t>(corner);
	const int next = s[(i + 1) % 3], last = s[(i + 2) % 3];
	return next == last && next != 0 && (corner >= 0 || s[0] == next);
}

inline bool Straddles(const Sides& s) { return std::min({s[0], s[1], s[2]}) < 0 && std::max({s[0], s[1], s[2]}) > 0; }

/// The corner whose two edges reach the plane: alone on its side, or the only one in the plane, or the only one out of it.
/// @pre neither AllZero(s) nor StaysOut(s, -1)
inline size_t LoneCorner(const Sides& s)
{
	for (size_t i = 0; i < 2; ++i) {
		const int next = s[(i + 1) % 3], last = s[(i + 2) % 3];
		if (s[i] != next && s[i] != last && next * last >= 0) return i;
	}
	return 2;
}

/// The contact of triangles in different planes, each of which the other one reaches.
///
/// Both cut the line of the two planes in an interval. Each is turned so that its lone corner p comes first, and the other
/// turned over when p is below it, so that p is above; the interval then runs from edge pq to edge pr in the one, from pr to
/// pq in the other, and one Orient3d of two edges compares the ends that they cut.
///
///              p                a in the paper, counter-clockwise; b stands on the line, p above the paper, q below it on
///            /   \              the right, r on the left: they overlap when pq of a is left of pq of b, and pr of b left
///     -----/-------\---- line   of pr of a
///         q         r
inline Contact SpatialContact(const Corners& cornersA, const Corners& cornersB, const Sides& sidesA,
                              const Sides& sidesB, int sharedCount)
{
	const size_t pa = LoneCorner(sidesA), pb = LoneCorner(sidesB);
	Corners a = StartingAt(cornersA, static_cast<int>(pa)), b = StartingAt(cornersB, static_cast<int>(pb));
	if (sidesA[pa] < sidesA[(pa + 1) % 3]) std::swap(b[1], b[2]);
	if (sidesB[pb] < sidesB[(pb + 1) % 3]) std::swap(a[1], a[2]);

	const int first = -Orient3d(a[0], a[1], b[0], b[1]);
	if (first < 0 || (first == 0 && sharedCount > 0)) return sharedCount > 0 ? Contact::SharesOnly : Contact::Disjoint;
	const int second = Orient3d(a[0], a[2], b[0], b[2]);
	if (second < 0 || (second == 0 && sharedCount > 0))
		return sharedCount > 0 ? Contact::SharesOnly : Contact::Disjoint;
	const bool insides = first > 0 && second > 0 && Straddles(sidesA) && Straddles(sidesB);
	return insides ? Contact::Crosses : Contact::Touches;
}

inline bool BoxesMeet(const Corners& a, const Corners& b)
{
	for (int k = 0; k < 3; ++k) {
		if (std::max({a[0][k], a[1][k], a[2][k]}) < std::min({b[0][k], b[1][k], b[2][k]})) return false;
		if (std::max({b[0][k], b[1][k], b[2][k]}) < std::min({a[0][k], a[1][k], a[2][k]})) return false;
	}
	return true;
}

}  // namespace detail

inline Contact ContactWithinBoxes(const Corners& a, const Corners& b)
{
	const detail::SharedCorners shared = detail::FindShared(a, b);
	if (shared.count == 3) return detail::CoplanarContact(a, b, shared);
	const Contact apart = shared.count > 0 ? Contact::SharesOnly : Contact::Disjoint;
	if (detail::AreSeenApart(a, b, shared)) return apart;
	if (shared.count == 2) {
		const size_t apex = static_cast<size_t>(3 - shared.inB[0] - shared.inB[1]);
		// Neighbours out of one plane meet along their common edge and nowhere else.
		if (apex < 3 && Orient3d(a[0], a[1], a[2], b[apex]) != 0) return apart;
		return detail::CoplanarContact(a, b, shared);
	}
	const bool shares = shared.count == 1;
	const int cornerA = shares ? shared.inA[0] : -1, cornerB = shares ? shared.inB[0] : -1;
	const detail::Sides sidesB = detail::SidesOf(a, b, cornerB);
	if (detail::StaysOut(sidesB, cornerB)) return apart;
	const detail::Sides sidesA = detail::SidesOf(b, a, cornerA);
	if (detail::StaysOut(sidesA, cornerA)) return apart;
	if (detail::AllZero(sidesA) && detail::AllZero(sidesB)) return detail::CoplanarContact(a, b, shared);
	if (detail::AllZero(sidesA) || detail::AllZero(sidesB)) return Contact::NoArea;
	return detail::SpatialContact(a, b, sidesA, sidesB, shared.count);
}

inline Contact ContactOf(const Corners& a, const Corners& b)
{
	return detail::BoxesMeet(a, b) ? ContactWithinBoxes(a, b) : Contact::Disjoint;
}

inline bool IsCollinear(const Corners& t)
{
	detail::Flat flat;
	for (int axis = 0; axis < 3; ++axis)
		if (detail::Flatten(t, axis, flat) != 0) return false;
	return true;
}

}  // namespace vcg::textlabel
