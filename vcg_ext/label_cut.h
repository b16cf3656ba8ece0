#pragma once
// The cut: contours laid on the sheet become triangles inside and outside the letters.
//
// Source: Slabaugh et al., section 3.2. Lay the contours, walk every triangle that they cross, triangulate the regions, and find
// what lies wholly within the letters. A triangle is cut in the label plane; one that does not face the viewer is cut only where a
// contour runs along its edge, in its own barycentric plane.

#include "inside_search.h"
#include "tessellate.h"

namespace vcg::textlabel {

/// A triangle of the cut sheet.
struct CutTriangle {
	IndexTriangle point;  ///< indices into CutLabel::points, counter-clockwise in the label plane
	int parent;           ///< the sheet triangle it is a piece of (its birth face)
	Side side;
};

struct CutLabel {
	CutPoints points;
	std::vector<CutTriangle> triangles;  ///< what replaces the sheet triangles in `touched`
	std::vector<int> touched;            ///< sheet triangles that are cut up, ascending
	std::vector<int> within;             ///< sheet triangles that lie wholly within a letter and are not cut, ascending
	std::vector<ContourPiece> pieces;
	double insideArea = 0;  ///< in the label plane
};

/// Cuts the contours of a label into a sheet.
class LabelCutter {
public:
	/// @param snap  label units
	LabelCutter(const LabelSpace& space, const Sheet& sheet, double snap)
		: sheet_(sheet), paths_(space, sheet, snap), snap_(snap)
	{}

	/// @param[in] outline  in the label plane
	/// @param[in] seeds  #contours: a facing sheet triangle that holds the contour's first point
	/// @throws Error{Border, Silhouette, NonManifold}, PlacementConflict
	CutLabel cut(const Outline& outline, const std::vector<int>& seeds);
	/// The triangles that contours cross or touch, as far as they were laid; also when cut() threw.
	std::vector<int> visited() const { return paths_.visited(); }

private:
	void collectTouched();
	void cutTriangles();
	void buildCase(int triangle, size_t firstChain, size_t lastChain);
	void addEdgePoints(int halfEdge);
	vcg::Point2d casePlane(int point, int triangle) const;
	int addCasePoint(int point, int triangle);
	int borderIndexOf(int point) const;
	void takeRegions(int triangle);
	void takeSides(const std::vector<Side>& side);
	void requireArea(const Outline& outline) const;

	const Sheet& sheet_;
	LabelPaths paths_;
	double snap_;
	CutLabel out_;
	std::vector<BorderPiece> borderPieces_;
	std::vector<Side> regionSide_;
	std::vector<int> triangleRegion_;  ///< #cut triangles
	TriangleWalk walk_;
	Tessellator tessellator_;
	// the triangle at hand
	TriangleCase case_;
	RegionSet regions_;
	std::vector<int> casePoint_;  ///< point of each case point
	std::vector<vcg::Point3d> caseSpace_;
	std::vector<std::pair<int, int>> caseBorder_;  ///< (point, index in the case), sorted
	std::vector<int> caseHalfEdge_;                ///< #borderCount: the half-edge that each border piece lies on
	std::vector<IndexTriangle> regionTriangles_;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline CutLabel LabelCutter::cut(const Outline& outline, const std::vector<int>& seeds)
{
	paths_.lay(outline, seeds);
	collectTouched();
	cutTriangles();
	takeSides(InsideSearch(sheet_, paths_.pieces, out_.touched, borderPieces_, size_t(paths_.points.count(sheet_)))
	              .run(regionSide_));
	out_.points = std::move(paths_.points);
	out_.pieces = std::move(paths_.pieces);
	requireArea(outline);
	borderPieces_ = std::vector<BorderPiece>();  // memory that those who go on with the cut can use
	regionSide_ = std::vector<Side>();
	triangleRegion_ = std::vector<int>();
	return std::move(out_);
}

inline void LabelCutter::collectTouched()
{
	for (const ContourChain& c : paths_.chains) out_.touched.push_back(c.triangle);
	for (const EdgePoint& e : paths_.edgePoints)
		for (const int h : {e.halfEdge, sheet_.twin[size_t(e.halfEdge)]}) out_.touched.push_back(h / 3);
	std::sort(out_.touched.begin(), out_.touched.end());
	out_.touched.erase(std::unique(out_.touched.begin(), out_.touched.end()), out_.touched.end());
}

inline void LabelCutter::cutTriangles()
{
	size_t chain = 0;
	for (const int t : out_.touched) {
		const size_t first = chain;
		while (chain < paths_.chains.size() && paths_.chains[chain].triangle == t) ++chain;
		try {
			buildCase(t, first, chain);
			walk_.cut(case_, regions_);
			takeRegions(t);
		} catch (const WalkConflict& conflict) {
			throw PlacementConflict{conflict.why, case_.points[size_t(conflict.point)]};
		}
	}
}

inline vcg::Point2d LabelCutter::casePlane(int point, int triangle) const
{
	if (sheet_.triangles[size_t(triangle)].facing) return paths_.points.at(sheet_, point).plane;
	const Mixture p = paths_.points.mixtureOf(sheet_, point);
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
	caseSpace_.push_back(paths_.points.at(sheet_, point).label);
	casePoint_.push_back(point);
	return int(casePoint_.size()) - 1;
}

inline void LabelCutter::addEdgePoints(int halfEdge)
{
	const int c = sheet_.canonical(halfEdge);
	const auto less = [](const EdgePoint& e, int h) { return e.halfEdge < h; };
	const auto begin = std::lower_bound(paths_.edgePoints.begin(), paths_.edgePoints.end(), c, less);
	auto end = begin;
	while (end != paths_.edgePoints.end() && end->halfEdge == c) ++end;
	const auto count = end - begin;
	for (std::ptrdiff_t i = 0; i < count; ++i) {
		addCasePoint((c == halfEdge ? begin[i] : end[-1 - i]).point, halfEdge / 3);
		caseHalfEdge_.push_back(halfEdge);
	}
}

inline int LabelCutter::borderIndexOf(int point) const
{
	const auto found = std::lower_bound(caseBorder_.begin(), caseBorder_.end(), std::make_pair(point, 0));
	if (found == caseBorder_.end() || found->first != point) throw WalkConflict{"a chain ends off the border", 0};
	return found->second;
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
	for (size_t k = firstChain; k < lastChain; ++k) {
		const ContourChain& chain = paths_.chains[k];
		PolylineSet& lines = chain.isLoop ? case_.loops : case_.chains;
		for (int i = 0; i < chain.length; ++i) {
			const int point = paths_.chainPoints[size_t(chain.first + i)];
			const bool isEnd = !chain.isLoop && (i == 0 || i == chain.length - 1);
			lines.add(isEnd ? borderIndexOf(point) : addCasePoint(point, triangle));
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

inline void LabelCutter::takeSides(const std::vector<Side>& side)
{
	for (size_t i = 0; i < out_.triangles.size(); ++i)
		out_.triangles[i].side = side[size_t(triangleRegion_[i])] == Side::Inside ? Side::Inside : Side::Outside;
	for (size_t t = 0; t < sheet_.triangles.size(); ++t)
		if (side[regionSide_.size() + t] == Side::Inside) out_.within.push_back(int(t));
	const auto add = [&](const IndexTriangle& t) {
		const auto at = [&](size_t k) { return paths_.points.at(sheet_, t[k]).plane; };
		out_.insideArea += ((at(1) - at(0)) ^ (at(2) - at(0))) / 2;
	};
	for (const CutTriangle& t : out_.triangles)
		if (t.side == Side::Inside) add(t.point);
	for (const int t : out_.within) add(sheet_.triangles[size_t(t)].vertex);
}

/// The letters keep their area, but for what snapping moved; more means that the sheet lies over itself in this view.
inline void LabelCutter::requireArea(const Outline& outline) const
{
	constexpr double rounding = 1e-9, snaps = 8;
	double perimeter = 0;
	for (const ContourPiece& p : out_.pieces)
		perimeter += (out_.points.at(sheet_, p.to).plane - out_.points.at(sheet_, p.from).plane).Norm();
	const double area = Area(outline), allowed = rounding * area + snaps * snap_ * perimeter;
	if (!(std::abs(out_.insideArea - area) <= allowed))
		throw PlacementConflict{"the letters do not keep their area", outline.contours[0].points[0],
		                        ErrorCode::Occluded};
}

}  // namespace vcg::textlabel
