#pragma once
// The march: lay a contour on the sheet, from contour point to contour point, edge by edge.
//
// Source: Slabaugh et al., section 3.1. The paper's intersection points, where the plane (C, V_i, V_i+1) meets an edge, are
// crossings of a line with an edge in the label plane here. Where the paper is silent we decide as follows.
//
// Exact coincidences. A contour point that comes within `snap` of a vertex or an edge *is* on it, and a contour that passes a
// vertex within `snap` goes through that vertex. The rule is applied along the way and the march goes on from the point where it
// really is, so what follows is decided (by sign, exactly) about the path that is built and not about the one that was wished for.
// `snap` is a few units in the last place of the output's coordinates: of float32, 1e8 times the rounding of the arithmetic in
// doubles, so that no decision hangs on a rounding error; of float64 it is of their size, and there the check on the result decides
// (patch_check.h). No vertex of the mesh moves; a contour moves by `snap` at most: what it passes is measured from the segment that was
// wished for as well, or it would follow a row of vertices that it leaves at a small angle. Where it leaves the row it may pass the next
// vertex within `snap`; what is too short there is collapsed afterwards (cut_repair.h).

#include "sheet.h"

#include <vector>

namespace vcg::textlabel {

/// A point of a contour on the sheet.
struct PathNode {
	enum Kind { OnVertex, OnEdge, InFace };
	Kind kind = InFace;
	int where = -1;            ///< vertex, canonical half-edge, or triangle of the sheet
	double along = 0;          ///< OnEdge: 0..1 from the start of the canonical half-edge, in the label plane
	vcg::Point2d plane{0, 0};  ///< in the label plane
	int triangle = -1;         ///< the triangle through which the march came here
};

/// A contour on the sheet: a closed chain of nodes; piece i runs from node i to node i+1.
struct SheetPath {
	struct Piece {
		int triangle = -1;  ///< the triangle it crosses, or -1 when it runs along an edge
		int halfEdge = -1;  ///< the half-edge it runs along, in its own direction; -1 when it crosses a triangle
	};
	std::vector<PathNode> nodes;  ///< #N
	std::vector<Piece> pieces;    ///< #N
};

/// Thrown inside the library when a placement runs into a coincidence that the resolution can't express; the facade shifts the
/// label by less than the resolution and tries again.
struct PlacementConflict {
	const char* why;
	vcg::Point2d place;
	ErrorCode code = ErrorCode::TooFine;  ///< what to say when no shift helps
};

/// Lays contours on a sheet.
class EdgeMarch {
public:
	/// @param snap  label units: what is closer than this is the same
	EdgeMarch(const Sheet& sheet, double snap) : sheet_(sheet), snap_(snap) {}

	/// Lay a closed contour on the sheet.
	/// @param[in] points  #P by 2, in the label plane, neighbours further apart than snap
	/// @param[in] triangle  a facing triangle that holds points[0] (within snap)
	/// @return nodes and pieces, each piece within one triangle or along one edge
	/// @throws Error{Border, Silhouette, NonManifold, BehindCamera} with the face and the place where the contour leaves the sheet;
	///         PlacementConflict when it comes back to a place where it has been
	SheetPath march(const std::vector<vcg::Point2d>& points, int triangle) const;

private:
	PathNode vertexNode(int v, int triangle) const { return {PathNode::OnVertex, v, 0, sheet_.plane(v), triangle}; }
	PathNode edgeNode(int h, double along) const;
	/// The vertex, edge or interior of a triangle that holds p within snap, if any; on the last leg only the start will do.
	bool settle(int triangle, const vcg::Point2d& p, PathNode& node) const;
	/// Where the line from-to crosses half-edge h.
	PathNode crossing(int h, const vcg::Point2d& from, const vcg::Point2d& to) const;
	/// True when the segment from-to passes vertex v within snap, and so does the contour's own.
	bool isPassed(int v, const vcg::Point2d& from, const vcg::Point2d& to) const;
	/// How far vertex v is from the line a-b, times its length.
	double offLine(int v, const vcg::Point2d& a, const vcg::Point2d& b) const
	{
		return std::abs((b - a) ^ (sheet_.plane(v) - a));
	}

	/// One step from `node` towards `target`; true when `next` is the target itself.
	bool step(const PathNode& node, const vcg::Point2d& target, PathNode& next) const;
	bool stepFromFace(const PathNode& node, const vcg::Point2d& target, PathNode& next) const;
	bool stepFromEdge(const PathNode& node, const vcg::Point2d& target, PathNode& next) const;
	bool stepFromVertex(const PathNode& node, const vcg::Point2d& target, PathNode& next) const;
	/// Half-edges out of v in the facing fan around it that holds `triangle`; returns the half-edge where the fan ends, or -1.
	int collectFan(int v, int triangle) const;
	/// A conflict; on the last leg it means that the start lies on another sheet than where the march has come.
	[[noreturn]] void refuse(const char* why, const vcg::Point2d& place) const
	{
		throw PlacementConflict{why, place, goal_ == nullptr ? ErrorCode::TooFine : ErrorCode::Occluded};
	}
	[[noreturn]] void leave(int halfEdge, const PathNode& node) const;

	bool areSame(const PathNode& a, const PathNode& b) const;
	bool lieOn(int halfEdge, const PathNode& node) const;
	bool lieIn(int triangle, const PathNode& node) const;
	void requireTwoSides(const PathNode& node) const;
	SheetPath::Piece pieceBetween(const PathNode& a, const PathNode& b) const;
	void removeSpikes(std::vector<PathNode>& nodes) const;

	const Sheet& sheet_;
	double snap_;
	mutable std::vector<int> fan_;                ///< scratch
	mutable const PathNode* goal_ = nullptr;      ///< where the contour closes, on its last leg
	mutable std::array<vcg::Point2d, 2> wished_;  ///< the segment of the contour at hand
};

// ---------------------------------------------------------------------------------------------------------------------------

inline PathNode EdgeMarch::edgeNode(int h, double along) const
{
	const int c = sheet_.canonical(h);
	const double t = c == h ? along : 1 - along;
	const vcg::Point2d &a = sheet_.plane(sheet_.from(c)), &b = sheet_.plane(sheet_.to(c));
	return {PathNode::OnEdge, c, t, a + (b - a) * t, h / 3};
}

inline bool EdgeMarch::settle(int t, const vcg::Point2d& p, PathNode& node) const
{
	const auto& v = sheet_.triangles[size_t(t)].vertex;
	if (goal_ != nullptr) {
		if (!lieIn(t, *goal_)) return false;
		node = *goal_;
		node.triangle = t;
		return true;
	}
	const double snapSquared = snap_ * snap_;
	bool inside = true;
	double nearest = snap_;
	PathNode onEdge;
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point2d &a = sheet_.plane(v[k]), &b = sheet_.plane(v[(k + 1) % 3]), d = b - a;
		const double along = ((p - a) * d) / d.SquaredNorm(), distance = std::abs(d ^ (p - a)) / d.Norm();
		const vcg::Point2d foot = a + d * along;
		if ((p - a).SquaredNorm() <= snapSquared || (distance <= snap_ && (foot - a).SquaredNorm() <= snapSquared)) {
			node = vertexNode(v[k], t);
			return true;
		}
		if (distance <= nearest && along > 0 && along < 1 && (foot - b).SquaredNorm() > snapSquared) {
			onEdge = edgeNode(3 * t + int(k), along);
			nearest = distance;
		}
		inside = inside && Orient2d(a, b, p) > 0;
	}
	if (onEdge.where >= 0) node = onEdge;
	else if (inside) node = {PathNode::InFace, t, 0, p, t};
	return inside || onEdge.where >= 0;
}

inline bool EdgeMarch::isPassed(int v, const vcg::Point2d& from, const vcg::Point2d& to) const
{
	const vcg::Point2d d = to - from, x = sheet_.plane(v) - from;
	const double length = d.Norm(), along = x * d;
	return along > 0 && along < length * length && offLine(v, from, to) <= snap_ * length &&
	       offLine(v, wished_[0], wished_[1]) <= snap_ * (wished_[1] - wished_[0]).Norm();
}

inline PathNode EdgeMarch::crossing(int h, const vcg::Point2d& from, const vcg::Point2d& to) const
{
	const vcg::Point2d &a = sheet_.plane(sheet_.from(h)), &b = sheet_.plane(sheet_.to(h)), d = to - from;
	const double da = d ^ (a - from), db = d ^ (b - from);
	const double along = da / (da - db);
	if (!(along > 0 && along < 1)) throw PlacementConflict{"a crossing falls off its edge", a};
	return edgeNode(h, along);
}

inline void EdgeMarch::leave(int h, const PathNode& node) const
{
	const int edge = sheet_.canonical(h);  // along which the node counts
	const vcg::Point3d &a = sheet_.vertices[size_t(sheet_.from(edge))].mesh,
					   &b = sheet_.vertices[size_t(sheet_.to(edge))].mesh;
	const vcg::Point3d place =
		node.kind == PathNode::OnVertex ? sheet_.vertices[size_t(node.where)].mesh : a + (b - a) * node.along;
	throw Error(CodeOfEdge(sheet_.twin[size_t(h)]), "the contour leaves the sheet")
		.atFace(sheet_.triangles[size_t(h / 3)].face)
		.atPlace(place);
}

inline bool EdgeMarch::step(const PathNode& node, const vcg::Point2d& target, PathNode& next) const
{
	switch (node.kind) {
	case PathNode::InFace: return stepFromFace(node, target, next);
	case PathNode::OnEdge: return stepFromEdge(node, target, next);
	default: return stepFromVertex(node, target, next);
	}
}

inline bool EdgeMarch::stepFromFace(const PathNode& node, const vcg::Point2d& target, PathNode& next) const
{
	const int t = node.where;
	if (settle(t, target, next)) return true;
	const auto& v = sheet_.triangles[size_t(t)].vertex;
	std::array<int, 3> side;
	for (size_t k = 0; k < 3; ++k) {
		if (isPassed(v[k], node.plane, target)) {
			next = vertexNode(v[k], t);
			return false;
		}
		side[k] = Orient2d(node.plane, target, sheet_.plane(v[k]));
	}
	for (size_t k = 0; k < 3;
	     ++k)  // the line leaves through the edge whose start is on its right and whose end on its left
		if (side[k] < 0 && side[(k + 1) % 3] > 0) {
			next = crossing(3 * t + int(k), node.plane, target);
			return false;
		}
	refuse("no way out of a triangle", node.plane);
}

inline bool EdgeMarch::stepFromEdge(const PathNode& node, const vcg::Point2d& target, PathNode& next) const
{
	const int h = node.where, other = sheet_.twin[size_t(h)];
	const bool onLeft = sheet_.triangles[size_t(h / 3)].facing, onRight = sheet_.facingAcross(h) >= 0;
	if (onLeft && settle(h / 3, target, next)) return true;
	if (onRight && settle(other / 3, target, next)) return true;
	for (const int v : {sheet_.from(h), sheet_.to(h)})
		if (isPassed(v, node.plane, target)) {
			next = vertexNode(v, node.triangle);
			return false;
		}
	const int side = Orient2d(sheet_.plane(sheet_.from(h)), sheet_.plane(sheet_.to(h)), target);
	if (side == 0) refuse("the march runs along an edge and does not end", node.plane);
	if (side > 0 && !onLeft) leave(other, node);
	if (side < 0 && !onRight) leave(h, node);
	const int into = side > 0 ? h : other, apex = sheet_.from(Sheet::Previous(into));
	if (isPassed(apex, node.plane, target)) {
		next = vertexNode(apex, into / 3);
		return false;
	}
	const bool apexOnLeft = Orient2d(node.plane, target, sheet_.plane(apex)) > 0;
	next = crossing(apexOnLeft ? Sheet::Next(into) : Sheet::Previous(into), node.plane, target);
	return false;
}

inline int EdgeMarch::collectFan(int v, int triangle) const
{
	int start = 3 * triangle;
	while (sheet_.from(start) != v) ++start;
	fan_.clear();
	int h = start;
	do {  // counter-clockwise: across the edge that comes in
		fan_.push_back(h);
		const int in = Sheet::Previous(h);
		if (sheet_.facingAcross(in) < 0) {
			for (h = start; sheet_.facingAcross(h) >= 0; fan_.push_back(h)) h = Sheet::Next(sheet_.twin[size_t(h)]);
			return in;
		}
		h = sheet_.twin[size_t(in)];
	} while (h != start);
	return -1;
}

inline bool EdgeMarch::stepFromVertex(const PathNode& node, const vcg::Point2d& target, PathNode& next) const
{
	const int gap = collectFan(node.where, node.triangle);
	for (const int h : fan_)
		if (settle(h / 3, target, next)) return true;
	double nearest = std::numeric_limits<double>::infinity();
	for (const int h : fan_)
		for (const int v : {sheet_.to(h), sheet_.from(Sheet::Previous(h))}) {
			const double distance = (sheet_.plane(v) - node.plane).SquaredNorm();
			if (distance >= nearest || !isPassed(v, node.plane, target)) continue;
			nearest = distance;
			next = vertexNode(v, h / 3);
		}
	if (std::isfinite(nearest)) return false;
	for (const int h : fan_) {
		const vcg::Point2d &a = sheet_.plane(sheet_.to(h)), &b = sheet_.plane(sheet_.from(Sheet::Previous(h)));
		if (Orient2d(node.plane, a, target) > 0 && Orient2d(node.plane, b, target) < 0) {
			next = crossing(Sheet::Next(h), node.plane, target);
			return false;
		}
	}
	if (gap >= 0) leave(gap, node);
	refuse("no way out of a vertex", node.plane);
}

inline bool EdgeMarch::lieOn(int halfEdge, const PathNode& node) const
{
	if (node.kind == PathNode::OnVertex)
		return node.where == sheet_.from(halfEdge) || node.where == sheet_.to(halfEdge);
	return node.kind == PathNode::OnEdge && node.where == sheet_.canonical(halfEdge);
}

inline bool EdgeMarch::lieIn(int triangle, const PathNode& node) const
{
	if (node.kind == PathNode::InFace) return node.where == triangle;
	for (int h = 3 * triangle; h < 3 * triangle + 3; ++h)
		if (lieOn(h, node)) return true;
	return false;
}

// An edge that would be cut on one side only would leave a crack: the faces beyond it are not ours, or there are none.
inline void EdgeMarch::requireTwoSides(const PathNode& node) const
{
	if (node.kind == PathNode::OnEdge && sheet_.twin[size_t(node.where)] < 0) leave(node.where, node);
}

inline SheetPath::Piece EdgeMarch::pieceBetween(const PathNode& a, const PathNode& b) const
{
	// b was reached through b.triangle, which holds a as well; when both are on one of its edges the piece runs along it
	const int t = b.triangle;
	for (int h = 3 * t; h < 3 * t + 3; ++h) {
		if (!lieOn(h, a) || !lieOn(h, b)) continue;
		const vcg::Point2d direction = sheet_.plane(sheet_.to(h)) - sheet_.plane(sheet_.from(h));
		if (direction * (b.plane - a.plane) > 0) return {-1, h};
		const int other = sheet_.twin[size_t(h)];
		if (other < 0 || sheet_.facingAcross(h) < 0) leave(h, b);  // the letter's inside would lie beyond the sheet
		return {-1, other};
	}
	return {t, -1};
}

inline SheetPath EdgeMarch::march(const std::vector<vcg::Point2d>& points, int triangle) const
{
	SheetPath path;
	PathNode node;
	goal_ = nullptr;
	if (!settle(triangle, points[0], node)) throw PlacementConflict{"the seed is not in its triangle", points[0]};
	const size_t patience = 4 * sheet_.triangles.size() + 64;  // steps for one segment; more would be a circle
	requireTwoSides(node);
	path.nodes.push_back(node);
	for (size_t i = 1; i <= points.size(); ++i) {
		const vcg::Point2d target = i < points.size() ? points[i] : node.plane;
		goal_ = i < points.size() ? nullptr : &node;
		wished_ = {points[i - 1], points[i % points.size()]};
		for (size_t steps = 0;; ++steps) {
			PathNode next;
			if (steps > patience) refuse("the march does not end", target);
			const bool arrived = step(path.nodes.back(), target, next);
			requireTwoSides(next);
			if (!areSame(next, path.nodes.back())) path.nodes.push_back(next);
			if (arrived) break;
		}
	}
	goal_ = nullptr;
	if (path.nodes.size() < 4 || !areSame(path.nodes.front(), path.nodes.back()))
		throw PlacementConflict{"the contour does not close on the sheet", points[0], ErrorCode::Occluded};
	path.nodes.front() = path.nodes.back();  // keeps the triangle that the last piece comes through
	path.nodes.pop_back();
	removeSpikes(path.nodes);
	for (size_t i = 0; i < path.nodes.size(); ++i)
		path.pieces.push_back(pieceBetween(path.nodes[i], path.nodes[(i + 1) % path.nodes.size()]));
	return path;
}

inline bool EdgeMarch::areSame(const PathNode& a, const PathNode& b) const
{
	if (a.kind != b.kind || a.where != b.where) return false;
	return a.kind == PathNode::OnVertex || (a.plane - b.plane).SquaredNorm() <= snap_ * snap_;
}

// A sharp corner whose two sides were snapped to the same nodes goes there and back: a, b, a becomes a.
inline void EdgeMarch::removeSpikes(std::vector<PathNode>& nodes) const
{
	std::vector<PathNode> kept;
	for (const PathNode& node : nodes) {
		if (kept.size() >= 2 && areSame(kept[kept.size() - 2], node)) kept.pop_back();
		else if (kept.empty() || !areSame(kept.back(), node)) kept.push_back(node);
	}
	for (bool changed = true; changed && kept.size() >= 3;) {  // and across the seam of the closed chain
		const size_t n = kept.size();
		changed = true;
		if (areSame(kept[n - 1], kept[0])) {
			kept[0] = kept[n - 1];
			kept.pop_back();
		} else if (areSame(kept[n - 2], kept[0])) {
			kept[0] = kept[n - 2];
			kept.resize(n - 2);
		} else if (areSame(kept[n - 1], kept[1])) {
			kept[1] = kept[n - 1];
			kept.pop_back();
			kept.erase(kept.begin());
		} else {
			changed = false;
		}
	}
	if (kept.size() < 3) throw PlacementConflict{"a contour shrinks to nothing at the resolution", nodes[0].plane};
	nodes.swap(kept);
}

}  // namespace vcg::textlabel
