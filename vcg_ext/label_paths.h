#pragma once
// The contours of a label on the sheet: points, crossings of edges, and the chains through each triangle.
//
// Source: Slabaugh et al., section 3.1: "At the end of this step, we have a new ordered list of 3D letter contour points that
// includes both the back-projected contour points and the intersection points." A point on a common edge is made once and used
// by both triangles.

#include "edge_march.h"

#include <utility>

namespace vcg::textlabel {

/// A point of the cut sheet: one of its vertices, or new.
struct CutPoint {
	vcg::Point2d plane;            ///< label plane
	vcg::Point3d label;            ///< label space
	vcg::Point3d mesh;             ///< mesh coordinates, not yet rounded
	std::array<int, 3> parent;     ///< sheet vertices it is a mixture of
	std::array<double, 3> weight;  ///< in space; sum to 1
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
	/// @throws Error{Border, Silhouette, NonManifold}, PlacementConflict
	void lay(const Outline& outline, const std::vector<int>& seeds);
	/// The triangles that contours cross or touch, as far as they were laid; also when lay() threw.
	std::vector<int> visited() const;

	std::vector<CutPoint> points;       ///< #V sheet vertices first, in their order, then the new ones
	std::vector<ContourPiece> pieces;   ///< of all contours
	std::vector<EdgePoint> edgePoints;  ///< sorted by half-edge and along it
	std::vector<ContourChain> chains;   ///< sorted by triangle
	std::vector<int> chainPoints;

private:
	void addSheetVertices();
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
	addSheetVertices();
	for (size_t c = 0; c < outline.contours.size(); ++c) {
		paths_.push_back(march_.march(outline.contours[c].points, seeds[c]));
		const SheetPath& path = paths_.back();
		std::vector<int> pathPoints;
		for (const PathNode& node : path.nodes) pathPoints.push_back(pointOf(node));
		for (size_t i = 0; i < pathPoints.size(); ++i)
			pieces.push_back({pathPoints[i], pathPoints[(i + 1) % pathPoints.size()], path.pieces[i].halfEdge});
		collectChains(path, pathPoints);
	}
	sortEdgePoints();
	std::sort(chains.begin(), chains.end(), [](const ContourChain& a, const ContourChain& b) {
		return a.triangle != b.triangle ? a.triangle < b.triangle : a.first < b.first;
	});
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

inline void LabelPaths::addSheetVertices()
{
	points.reserve(sheet_.vertices.size() + sheet_.vertices.size() / 4);
	for (int v = 0; v < int(sheet_.vertices.size()); ++v) {
		const SheetVertex& s = sheet_.vertices[size_t(v)];
		points.push_back({s.plane, s.label, s.mesh, {v, v, v}, {1, 0, 0}});
	}
	onContour_.assign(sheet_.vertices.size(), 0);
}

inline int LabelPaths::pointOf(const PathNode& node)
{
	if (node.kind == PathNode::OnVertex) {
		if (onContour_[size_t(node.where)]) throw PlacementConflict{"two contours meet in a vertex", node.plane};
		onContour_[size_t(node.where)] = 1;
		return node.where;
	}
	const int point = int(points.size());
	if (node.kind == PathNode::OnEdge) edgePoints.push_back({node.where, node.along, point});
	points.push_back(mix(node));
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
		p.parent = {a, b, b};
		p.weight = {ka / (ka + kb), kb / (ka + kb), 0};
	} else {
		const vcg::Point3d w = SpaceWeights(space_, sheet_, node.where, node.plane);
		p.parent = sheet_.triangles[size_t(node.where)].vertex;
		p.weight = {w[0], w[1], w[2]};
	}
	// as an offset from one corner: a coordinate that all corners share comes out exactly
	const SheetVertex &a = sheet_.vertices[size_t(p.parent[0])], &b = sheet_.vertices[size_t(p.parent[1])],
					  &c = sheet_.vertices[size_t(p.parent[2])];
	p.mesh = a.mesh + (b.mesh - a.mesh) * p.weight[1] + (c.mesh - a.mesh) * p.weight[2];
	p.label = a.label + (b.label - a.label) * p.weight[1] + (c.label - a.label) * p.weight[2];
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
		const vcg::Point2d &pa = points[size_t(a.point)].plane, &pb = points[size_t(b.point)].plane;
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
