#pragma once
// The cut: contours laid on the sheet become triangles inside and outside the letters.
//
// Source: Slabaugh et al., section 3.2. March the contours, walk every triangle that they cross, triangulate the regions. The walk
// knows the side of every region that a contour touches; triangles that lie wholly within a letter are then found by going from
// region to region over the sheet, never across a contour. Whatever that search meets but should not (a border, the horizon, a
// third triangle at an edge) is a fault of the place and is named.

#include "edge_march.h"
#include "tessellate.h"

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

/// A triangle of the cut sheet.
struct CutTriangle {
	IndexTriangle point;  ///< indices into CutLabel::points, counter-clockwise in the label plane
	int parent;           ///< the sheet triangle it is a piece of (its birth face)
	Side side;
};

/// A piece of a contour; the inside of the letter lies to the left of from-to.
struct ContourPiece {
	int from, to;  ///< indices into CutLabel::points
};

struct CutLabel {
	std::vector<CutPoint> points;        ///< #V sheet vertices first, in their order, then the new ones
	std::vector<CutTriangle> triangles;  ///< what replaces the sheet triangles in `touched`
	std::vector<int> touched;            ///< sheet triangles that are cut up, ascending
	std::vector<int> within;             ///< sheet triangles that lie wholly within a letter and are not cut, ascending
	std::vector<ContourPiece> pieces;
	double insideArea = 0;  ///< in the label plane
};

/// Cuts the contours of a label into a sheet.
class LabelCutter {
public:
	LabelCutter(const LabelSpace& space, const Sheet& sheet, double snap)
		: space_(space), sheet_(sheet), march_(sheet, snap), snap_(snap)
	{}

	/// @param[in] outline  in the label plane
	/// @param[in] seeds  #contours: a facing sheet triangle that holds the contour's first point
	/// @throws Error{Border, Silhouette, NonManifold, Occluded}, PlacementConflict
	CutLabel cut(const Outline& outline, const std::vector<int>& seeds);
	/// The triangles that contours cross or touch, as far as they were laid; also when cut() threw.
	std::vector<int> visited() const;

private:
	struct EdgePoint {
		int halfEdge;  ///< canonical
		double along;
		int point;
	};
	struct BorderPiece {
		int from, to, halfEdge, region;
	};
	struct Chain {
		int triangle, path, first,
			length;  ///< nodes first .. first+length-1 (modulo) of a path; a loop when length is the path's
		bool loop;
	};

	void addSheetVertices();
	void layContours(const Outline& outline, const std::vector<int>& seeds);
	int pointOf(const PathNode& node);
	CutPoint mix(const PathNode& node) const;
	void sortEdgePoints();
	void collectChains(int path);
	void cutTriangles();
	void buildCase(int triangle, size_t firstChain, size_t lastChain);
	void addEdgePoints(int halfEdge);
	vcg::Point2d casePlane(int point, int triangle) const;
	int addCasePoint(int point, int triangle);
	void takeRegions(int triangle);
	void floodInside();
	void enter(int region);
	void leaveRegion(int region);
	void crossBorder(const BorderPiece& piece);
	void finish(const Outline& outline);
	int touchedIndex(int triangle) const;
	bool isContour(int from, int to) const;
	int regionBeside(int from, int to, int triangle) const;
	void throwOffSheet(int halfEdge) const;

	const LabelSpace& space_;
	const Sheet& sheet_;
	EdgeMarch march_;
	double snap_;
	CutLabel out_;
	std::vector<SheetPath> paths_;
	std::vector<std::vector<int>> pathPoints_;  ///< point of each node
	std::vector<char> onContour_;               ///< per sheet vertex
	std::vector<EdgePoint> edgePoints_;
	std::vector<Chain> chains_;
	std::vector<std::pair<int, int>> contourPieces_;  ///< sorted, for look-up
	std::vector<BorderPiece> borderPieces_;           ///< sorted by (from, to)
	std::vector<int> regionStart_;                    ///< pieces of each region, CSR into regionPieces_
	std::vector<int> regionPieces_;
	std::vector<Side> regionSide_;     ///< regions of touched triangles, then one for each sheet triangle
	std::vector<int> triangleRegion_;  ///< #cut triangles
	int regionCount_ = 0;              ///< regions of touched triangles
	std::vector<int> stack_;
	TriangleWalk walk_;
	TriangleCase case_;
	RegionSet regions_;
	Tessellator tessellator_;
	std::vector<int> casePoint_;  ///< point of each case point
	std::vector<vcg::Point3d> caseSpace_;
	std::vector<std::pair<int, int>> caseBorder_;  ///< (point, index in the case), sorted
	std::vector<int> caseHalfEdge_;                ///< #borderCount: the half-edge that each border piece lies on
	std::vector<IndexTriangle> regionTriangles_;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline CutLabel LabelCutter::cut(const Outline& outline, const std::vector<int>& seeds)
{
	addSheetVertices();
	layContours(outline, seeds);
	sortEdgePoints();
	for (int p = 0; p < int(paths_.size()); ++p) collectChains(p);
	cutTriangles();
	floodInside();
	finish(outline);
	return std::move(out_);
}

inline std::vector<int> LabelCutter::visited() const
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

inline void LabelCutter::addSheetVertices()
{
	out_.points.reserve(sheet_.vertices.size() * 2);
	for (int v = 0; v < int(sheet_.vertices.size()); ++v) {
		const SheetVertex& s = sheet_.vertices[size_t(v)];
		out_.points.push_back({s.plane, s.label, s.mesh, {v, v, v}, {1, 0, 0}});
	}
	onContour_.assign(sheet_.vertices.size(), 0);
}

inline void LabelCutter::layContours(const Outline& outline, const std::vector<int>& seeds)
{
	for (size_t c = 0; c < outline.contours.size(); ++c) {
		paths_.push_back(march_.march(outline.contours[c].points, seeds[c]));
		std::vector<int>& points = pathPoints_.emplace_back();
		for (const PathNode& node : paths_.back().nodes) points.push_back(pointOf(node));
		for (size_t i = 0; i < points.size(); ++i) out_.pieces.push_back({points[i], points[(i + 1) % points.size()]});
	}
	for (const ContourPiece& piece : out_.pieces) contourPieces_.emplace_back(piece.from, piece.to);
	std::sort(contourPieces_.begin(), contourPieces_.end());
}

inline int LabelCutter::pointOf(const PathNode& node)
{
	if (node.kind == PathNode::OnVertex) {
		if (onContour_[size_t(node.where)]) throw PlacementConflict{"two contours meet in a vertex", node.plane};
		onContour_[size_t(node.where)] = 1;
		return node.where;
	}
	const int point = int(out_.points.size());
	if (node.kind == PathNode::OnEdge) edgePoints_.push_back({node.where, node.along, point});
	out_.points.push_back(mix(node));
	return point;
}

inline CutPoint LabelCutter::mix(const PathNode& node) const
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

inline void LabelCutter::sortEdgePoints()
{
	std::sort(edgePoints_.begin(), edgePoints_.end(), [](const EdgePoint& a, const EdgePoint& b) {
		return a.halfEdge != b.halfEdge ? a.halfEdge < b.halfEdge
		       : a.along != b.along     ? a.along < b.along
		                                : a.point < b.point;
	});
	constexpr double apart = 0.25;  // of snap: closer points would not survive the rounding of coordinates
	for (size_t i = 1; i < edgePoints_.size(); ++i) {
		const EdgePoint &a = edgePoints_[i - 1], &b = edgePoints_[i];
		const vcg::Point2d &pa = out_.points[size_t(a.point)].plane, &pb = out_.points[size_t(b.point)].plane;
		if (a.halfEdge == b.halfEdge && (pb - pa).SquaredNorm() < snap_ * snap_ * apart * apart)
			throw PlacementConflict{"two contour pieces cross an edge in one place", pb};
	}
}

// Runs of pieces through one triangle: a chain from border to border, or a loop.
inline void LabelCutter::collectChains(int path)
{
	const SheetPath& p = paths_[size_t(path)];
	const int n = int(p.nodes.size());
	int first = 0;
	while (first < n && p.nodes[size_t(first)].kind == PathNode::InFace) ++first;
	if (first == n) {
		chains_.push_back({p.pieces[0].triangle, path, 0, n, true});
		return;
	}
	for (int i = 0; i < n;) {
		int length = 1;
		const SheetPath::Piece& piece = p.pieces[size_t((first + i) % n)];
		while (p.nodes[size_t((first + i + length) % n)].kind == PathNode::InFace) ++length;
		if (piece.triangle >= 0) chains_.push_back({piece.triangle, path, (first + i) % n, length + 1, false});
		i += length;
	}
}

inline void LabelCutter::cutTriangles()
{
	std::sort(chains_.begin(), chains_.end(), [](const Chain& a, const Chain& b) {
		return a.triangle != b.triangle ? a.triangle < b.triangle
		       : a.path != b.path       ? a.path < b.path
		                                : a.first < b.first;
	});
	for (const Chain& c : chains_) out_.touched.push_back(c.triangle);
	for (const EdgePoint& e : edgePoints_)
		for (const int h : {e.halfEdge, sheet_.twin[size_t(e.halfEdge)]})
			if (h >= 0) out_.touched.push_back(h / 3);
	std::sort(out_.touched.begin(), out_.touched.end());
	out_.touched.erase(std::unique(out_.touched.begin(), out_.touched.end()), out_.touched.end());
	size_t chain = 0;
	for (const int t : out_.touched) {
		const size_t first = chain;
		while (chain < chains_.size() && chains_[chain].triangle == t) ++chain;
		buildCase(t, first, chain);
		try {
			walk_.cut(case_, regions_);
			takeRegions(t);
		} catch (const WalkConflict& conflict) {
			throw PlacementConflict{conflict.why, case_.points[size_t(conflict.point)]};
		}
	}
	regionCount_ = int(regionSide_.size());
}

// A triangle that does not face the viewer is cut only where a contour runs along its edge. Its own barycentric plane does then.
inline vcg::Point2d LabelCutter::casePlane(int point, int triangle) const
{
	const CutPoint& p = out_.points[size_t(point)];
	if (sheet_.triangles[size_t(triangle)].facing) return p.plane;
	const auto& corner = sheet_.triangles[size_t(triangle)].vertex;
	vcg::Point2d plane(0, 0);
	for (size_t i = 0; i < 3; ++i)
		for (int k = 1; k < 3; ++k)
			if (p.parent[i] == corner[size_t(k)]) plane[k - 1] += p.weight[i];
	return plane;
}

inline int LabelCutter::addCasePoint(int point, int triangle)
{
	case_.points.push_back(casePlane(point, triangle));
	caseSpace_.push_back(out_.points[size_t(point)].label);
	casePoint_.push_back(point);
	return int(casePoint_.size()) - 1;
}

inline void LabelCutter::addEdgePoints(int halfEdge)
{
	const int c = sheet_.canonical(halfEdge);
	const auto less = [](const EdgePoint& e, int h) { return e.halfEdge < h; };
	const auto begin = std::lower_bound(edgePoints_.begin(), edgePoints_.end(), c, less);
	auto end = begin;
	while (end != edgePoints_.end() && end->halfEdge == c) ++end;
	const auto count = end - begin;
	for (std::ptrdiff_t i = 0; i < count; ++i) {
		addCasePoint((c == halfEdge ? begin[i] : end[-1 - i]).point, halfEdge / 3);
		caseHalfEdge_.push_back(halfEdge);
	}
}

inline void LabelCutter::buildCase(int triangle, size_t firstChain, size_t lastChain)
{
	case_.clear();
	casePoint_.clear();
	caseSpace_.clear();
	caseBorder_.clear();
	caseHalfEdge_.clear();
	for (int h = 3 * triangle; h < 3 * triangle + 3; ++h) {
		addCasePoint(sheet_.from(h), triangle);
		caseHalfEdge_.push_back(h);
		addEdgePoints(h);
	}
	case_.borderCount = int(casePoint_.size());
	for (int i = 0; i < case_.borderCount; ++i) caseBorder_.emplace_back(casePoint_[size_t(i)], i);
	std::sort(caseBorder_.begin(), caseBorder_.end());
	const auto onBorder = [&](int point) {
		const auto found = std::lower_bound(caseBorder_.begin(), caseBorder_.end(), std::make_pair(point, 0));
		if (found == caseBorder_.end() || found->first != point) throw WalkConflict{"a chain ends off the border", 0};
		return found->second;
	};
	for (size_t k = firstChain; k < lastChain; ++k) {
		const Chain& chain = chains_[k];
		const std::vector<int>& points = pathPoints_[size_t(chain.path)];
		PolylineSet& lines = chain.loop ? case_.loops : case_.chains;
		for (int i = 0; i < chain.length; ++i) {
			const int point = points[size_t(chain.first + i) % points.size()];
			const bool end = !chain.loop && (i == 0 || i == chain.length - 1);
			lines.add(end ? onBorder(point) : addCasePoint(point, triangle));
		}
		lines.close();
	}
}

inline void LabelCutter::takeRegions(int triangle)
{
	const int firstRegion = int(regionSide_.size());
	for (const RegionSet::Region& r : regions_.regions) {
		regionTriangles_.clear();
		tessellator_.triangulate(case_.points, caseSpace_, regions_.rings, r.firstRing, r.ringCount, regionTriangles_);
		for (const IndexTriangle& t : regionTriangles_) {
			const IndexTriangle points = {casePoint_[size_t(t[0])], casePoint_[size_t(t[1])], casePoint_[size_t(t[2])]};
			out_.triangles.push_back({points, triangle, r.side});
			triangleRegion_.push_back(int(regionSide_.size()));
		}
		regionSide_.push_back(r.side);
	}
	for (int i = 0; i < case_.borderCount; ++i)
		borderPieces_.push_back({casePoint_[size_t(i)], casePoint_[size_t((i + 1) % case_.borderCount)],
		                         caseHalfEdge_[size_t(i)], firstRegion + regions_.regionAtBorder[size_t(i)]});
}

inline int LabelCutter::touchedIndex(int triangle) const
{
	const auto found = std::lower_bound(out_.touched.begin(), out_.touched.end(), triangle);
	return found != out_.touched.end() && *found == triangle ? int(found - out_.touched.begin()) : -1;
}

inline bool LabelCutter::isContour(int from, int to) const
{
	return std::binary_search(contourPieces_.begin(), contourPieces_.end(), std::make_pair(from, to));
}

/// The region of `triangle` along its border piece from-to.
inline int LabelCutter::regionBeside(int from, int to, int triangle) const
{
	if (touchedIndex(triangle) < 0) return regionCount_ + triangle;
	const auto less = [](const BorderPiece& p, const std::pair<int, int>& key) {
		return std::make_pair(p.from, p.to) < key;
	};
	const auto found = std::lower_bound(borderPieces_.begin(), borderPieces_.end(), std::make_pair(from, to), less);
	if (found == borderPieces_.end() || found->from != from || found->to != to)
		throw PlacementConflict{"neighbours cut their common edge differently", out_.points[size_t(from)].plane};
	return found->region;
}

inline void LabelCutter::floodInside()
{
	std::sort(borderPieces_.begin(), borderPieces_.end(), [](const BorderPiece& a, const BorderPiece& b) {
		return std::make_pair(a.from, a.to) < std::make_pair(b.from, b.to);
	});
	regionStart_.assign(size_t(regionCount_) + 1, 0);
	for (const BorderPiece& p : borderPieces_) ++regionStart_[size_t(p.region) + 1];
	for (size_t i = 1; i < regionStart_.size(); ++i) regionStart_[i] += regionStart_[i - 1];
	regionPieces_.resize(borderPieces_.size());
	std::vector<int> next(regionStart_.begin(), regionStart_.end() - 1);
	for (size_t i = 0; i < borderPieces_.size(); ++i)
		regionPieces_[size_t(next[size_t(borderPieces_[i].region)]++)] = int(i);

	regionSide_.resize(size_t(regionCount_) + sheet_.triangles.size(), Side::Unknown);
	for (int r = 0; r < regionCount_; ++r)
		if (regionSide_[size_t(r)] == Side::Inside) stack_.push_back(r);
	for (size_t p = 0; p < paths_.size(); ++p)
		for (size_t i = 0; i < paths_[p].pieces.size(); ++i) {
			const int h = paths_[p].pieces[i].halfEdge;
			if (h < 0) continue;
			const int from = pathPoints_[p][i], to = pathPoints_[p][(i + 1) % pathPoints_[p].size()];
			enter(regionBeside(from, to, h / 3));
			if (sheet_.twin[size_t(h)] >= 0) leaveRegion(regionBeside(to, from, sheet_.twin[size_t(h)] / 3));
		}
	while (!stack_.empty()) {
		const int r = stack_.back();
		stack_.pop_back();
		if (r < regionCount_) {
			for (int i = regionStart_[size_t(r)]; i < regionStart_[size_t(r) + 1]; ++i)
				crossBorder(borderPieces_[size_t(regionPieces_[size_t(i)])]);
		} else {
			for (int h = 3 * (r - regionCount_), k = 0; k < 3; ++k, ++h)
				crossBorder({sheet_.from(h), sheet_.to(h), h, r});
		}
	}
}

inline void LabelCutter::enter(int region)
{
	Side& side = regionSide_[size_t(region)];
	if (side == Side::Outside) throw PlacementConflict{"inside and outside of a letter meet", {0, 0}};
	if (side == Side::Unknown) {
		side = Side::Inside;
		stack_.push_back(region);
	}
}

inline void LabelCutter::leaveRegion(int region)
{
	Side& side = regionSide_[size_t(region)];
	if (side == Side::Inside) throw PlacementConflict{"inside and outside of a letter meet", {0, 0}};
	side = Side::Outside;
}

inline void LabelCutter::crossBorder(const BorderPiece& piece)
{
	if (isContour(piece.from, piece.to)) return;
	const int across = sheet_.facingAcross(piece.halfEdge);
	if (across < 0) throwOffSheet(piece.halfEdge);
	enter(regionBeside(piece.to, piece.from, across));
}

inline void LabelCutter::throwOffSheet(int halfEdge) const
{
	const int twin = sheet_.twin[size_t(halfEdge)];
	const ErrorCode code = twin == BorderEdge        ? ErrorCode::Border
	                       : twin == NonManifoldEdge ? ErrorCode::NonManifold
	                                                 : ErrorCode::Silhouette;
	const vcg::Point3d &a = sheet_.vertices[size_t(sheet_.from(halfEdge))].mesh,
					   &b = sheet_.vertices[size_t(sheet_.to(halfEdge))].mesh;
	throw Error(code, "the inside of a letter leaves the sheet")
		.atFace(sheet_.triangles[size_t(halfEdge / 3)].face)
		.atPlace((a + b) / 2);
}

inline void LabelCutter::finish(const Outline& outline)
{
	double perimeter = 0;
	for (const ContourPiece& p : out_.pieces)
		perimeter += (out_.points[size_t(p.to)].plane - out_.points[size_t(p.from)].plane).Norm();
	const auto add = [&](int a, int b, int c) {
		const vcg::Point2d& p = out_.points[size_t(a)].plane;
		out_.insideArea += ((out_.points[size_t(b)].plane - p) ^ (out_.points[size_t(c)].plane - p)) / 2;
	};
	for (size_t i = 0; i < out_.triangles.size(); ++i) {
		CutTriangle& t = out_.triangles[i];
		t.side = regionSide_[size_t(triangleRegion_[i])] == Side::Inside ? Side::Inside : Side::Outside;
		if (t.side == Side::Inside) add(t.point[0], t.point[1], t.point[2]);
	}
	for (int t = 0; t < int(sheet_.triangles.size()); ++t)
		if (regionSide_[size_t(regionCount_ + t)] == Side::Inside) {
			out_.within.push_back(t);
			const auto& v = sheet_.triangles[size_t(t)].vertex;
			add(v[0], v[1], v[2]);
		}
	constexpr double rounding = 1e-9;
	const double area = Area(outline), allowed = rounding * area + 8 * snap_ * perimeter;
	if (!(std::abs(out_.insideArea - area) <= allowed))
		throw PlacementConflict{"the letters do not keep their area: the sheet covers itself",
		                        outline.contours[0].points[0], ErrorCode::Occluded};
}

}  // namespace vcg::textlabel
