#pragma once
// The contours of a label on the sheet: points, crossings of edges, and the chains through each triangle.
//
// Source: Slabaugh et al., section 3.1: "At the end of this step, we have a new ordered list of 3D letter contour points that
// includes both the back-projected contour points and the intersection points." A point on a common edge is made once and used
// by both triangles.

#include "edge_march.h"
#include "surface_point.h"

#include <utility>

namespace vcg::textlabel {

/// Which vertices of the sheet a point is a mixture of.
struct Mixture {
	std::array<int, 3> parent;     ///< sheet vertices
	std::array<double, 3> weight;  ///< in space; sum to 1
};

/// A new point of the cut sheet.
struct CutPoint : SheetPoint {
	Mixture mixture;
};

/// The points of a cut sheet under one number each: its vertices first, in their order, then the new ones.
struct CutPoints {
	std::vector<CutPoint> added;

	int count(const Sheet& sheet) const { return int(sheet.vertices.size() + added.size()); }
	const SheetPoint& at(const Sheet& sheet, int point) const
	{
		const size_t i = size_t(point), old = sheet.vertices.size();
		return i < old ? static_cast<const SheetPoint&>(sheet.vertices[i]) : added[i - old];
	}
	Mixture mixtureOf(const Sheet& sheet, int point) const
	{
		const size_t i = size_t(point), old = sheet.vertices.size();
		return i < old ? Mixture{{point, point, point}, {1, 0, 0}} : added[i - old].mixture;
	}
};

/// A piece of a contour; the inside of the letter lies to the left of from-to.
struct ContourPiece {
	int from, to;  ///< indices of cut points
	int halfEdge;  ///< the half-edge it runs along, in its own direction; -1 when it crosses a triangle
};

/// A new point on an edge of the sheet.
struct EdgePoint {
	int halfEdge;  ///< canonical
	double along;  ///< 0..1, in the label plane
	int point;
};

/// A run of contour pieces through one triangle: from border to border, or a loop within it.
struct ContourChain {
	int triangle;
	int first, length;  ///< LabelPaths::chainPoints[first] .. [first + length - 1]
	bool isLoop;
};

/// Lays the contours of a label on a sheet.
class LabelPaths {
public:
	/// @param snap  label units
	LabelPaths(const LabelSpace& space, const Sheet& sheet, double snap)
		: space_(space), sheet_(sheet), march_(sheet, snap), snap_(snap)
	{}

	/// @param[in] outline  in the label plane
	/// @param[in] seeds  #contours: a facing sheet triangle that holds the contour's first point
	/// @throws Error{Border, Silhouette, NonManifold, BehindCamera}, PlacementConflict
	void lay(const Outline& outline, const std::vector<int>& seeds);
	/// When all is cut: give back the memory of what it was cut along; visited() still knows.
	void forgetChains();
	/// The triangles that contours cross or touch, as far as they were laid; also when lay() threw.
	std::vector<int> visited() const;

	CutPoints points;
	std::vector<ContourPiece> pieces;   ///< of all contours
	std::vector<EdgePoint> edgePoints;  ///< sorted by half-edge and along it
	std::vector<ContourChain> chains;   ///< sorted by triangle
	std::vector<int> chainPoints;

private:
	int pointOf(const PathNode& node);
	CutPoint mix(const PathNode& node) const;
	void sortEdgePoints();
	void collectChains(const SheetPath& path, const std::vector<int>& pathPoints);

	const LabelSpace& space_;
	const Sheet& sheet_;
	EdgeMarch march_;
	double snap_;
	std::vector<SheetPath> paths_;
	std::vector<char> onContour_;  ///< per sheet vertex
};

// ---------------------------------------------------------------------------------------------------------------------------

inline void LabelPaths::lay(const Outline& outline, const std::vector<int>& seeds)
{
	onContour_.assign(sheet_.vertices.size(), 0);
	for (size_t c = 0; c < outline.contours.size(); ++c) {
		paths_.push_back(march_.march(outline.contours[c].points, seeds[c]));
		const SheetPath& path = paths_.back();
		std::vector<int> pathPoints;
		for (const PathNode& node : path.nodes) pathPoints.push_back(pointOf(node));
		for (size_t i = 0; i < pathPoints.size(); ++i)
			pieces.push_back({pathPoints[i], pathPoints[(i + 1) % pathPoints.size()], path.pieces[i].halfEdge});
		collectChains(path, pathPoints);
	}
	points.added.shrink_to_fit();  // they stay until the label is made
	sortEdgePoints();
	std::sort(chains.begin(), chains.end(), [](const ContourChain& a, const ContourChain& b) {
		return a.triangle != b.triangle ? a.triangle < b.triangle : a.first < b.first;
	});
}

inline void LabelPaths::forgetChains()
{
	edgePoints = {};
	chains = {};
	chainPoints = {};
}

inline std::vector<int> LabelPaths::visited() const
{
	std::vector<int> triangles;
	for (const SheetPath& path : paths_)
		for (const PathNode& node : path.nodes) {
			triangles.push_back(node.triangle);
			if (node.kind == PathNode::OnEdge && sheet_.twin[size_t(node.where)] >= 0)
				for (const int h : {node.where, sheet_.twin[size_t(node.where)]}) triangles.push_back(h / 3);
		}
	std::sort(triangles.begin(), triangles.end());
	triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
	return triangles;
}

inline int LabelPaths::pointOf(const PathNode& node)
{
	if (node.kind == PathNode::OnVertex) {
		if (onContour_[size_t(node.where)]) throw PlacementConflict{"two contours meet in a vertex", node.plane};
		onContour_[size_t(node.where)] = 1;
		return node.where;
	}
	const int point = points.count(sheet_);
	if (node.kind == PathNode::OnEdge) edgePoints.push_back({node.where, node.along, point});
	points.added.push_back(mix(node));
	return point;
}

inline CutPoint LabelPaths::mix(const PathNode& node) const
{
	CutPoint p;
	p.plane = node.plane;
	if (node.kind == PathNode::OnEdge) {
		const int a = sheet_.from(node.where), b = sheet_.to(node.where);
		const double ka = (1 - node.along) * space_.magnification(sheet_.vertices[size_t(a)].label),
					 kb = node.along * space_.magnification(sheet_.vertices[size_t(b)].label);
		p.mixture = {{a, b, b}, {ka / (ka + kb), kb / (ka + kb), 0}};
	} else {
		const vcg::Point3d w = SpaceWeights(space_, sheet_, node.where, node.plane);
		p.mixture = {sheet_.triangles[size_t(node.where)].vertex, {w[0], w[1], w[2]}};
	}
	// as an offset from one corner: a coordinate that all corners share comes out exactly
	const auto& [parent, weight] = p.mixture;
	const SheetVertex &a = sheet_.vertices[size_t(parent[0])], &b = sheet_.vertices[size_t(parent[1])],
					  &c = sheet_.vertices[size_t(parent[2])];
	p.mesh = a.mesh + (b.mesh - a.mesh) * weight[1] + (c.mesh - a.mesh) * weight[2];
	p.label = a.label + (b.label - a.label) * weight[1] + (c.label - a.label) * weight[2];
	return p;
}

inline void LabelPaths::sortEdgePoints()
{
	std::sort(edgePoints.begin(), edgePoints.end(), [](const EdgePoint& a, const EdgePoint& b) {
		return a.halfEdge != b.halfEdge ? a.halfEdge < b.halfEdge
		       : a.along != b.along     ? a.along < b.along
		                                : a.point < b.point;
	});
	constexpr double apart = 0.25;  // of snap: closer points would not survive the rounding of coordinates
	for (size_t i = 1; i < edgePoints.size(); ++i) {
		const EdgePoint &a = edgePoints[i - 1], &b = edgePoints[i];
		const vcg::Point2d &pa = points.at(sheet_, a.point).plane, &pb = points.at(sheet_, b.point).plane;
		if (a.halfEdge == b.halfEdge && (pb - pa).SquaredNorm() < snap_ * snap_ * apart * apart)
			throw PlacementConflict{"two contour pieces cross an edge in one place", pb};
	}
}

inline void LabelPaths::collectChains(const SheetPath& path, const std::vector<int>& pathPoints)
{
	const int n = int(path.nodes.size());
	const auto isInner = [&](int i) { return path.nodes[size_t(i % n)].kind == PathNode::InFace; };
	const auto add = [&](int triangle, int from, int length, bool isLoop) {
		chains.push_back({triangle, int(chainPoints.size()), length, isLoop});
		for (int i = 0; i < length; ++i) chainPoints.push_back(pathPoints[size_t((from + i) % n)]);
	};
	int first = 0;
	while (first < n && isInner(first)) ++first;
	if (first == n) return add(path.pieces[0].triangle, 0, n, true);
	for (int i = first, length; i < first + n; i += length) {
		for (length = 1; isInner(i + length);) ++length;
		const int triangle = path.pieces[size_t(i % n)].triangle;
		if (triangle >= 0) add(triangle, i, length + 1, false);
	}
}

}  // namespace vcg::textlabel
