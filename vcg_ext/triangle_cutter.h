#pragma once
// The triangles that contours touch, cut up one by one.
//
// Source: Slabaugh et al., section 3.2. Each triangle is walked into regions, and these are triangulated. It is cut in the label plane;
// one that does not face the viewer is cut only where a contour runs along its edge, in its own barycentric plane.

#include "inside_search.h"
#include "tessellate.h"

namespace vcg::textlabel {

/// A triangle of the cut sheet.
struct CutTriangle {
	IndexTriangle point;  ///< cut points, counter-clockwise in the label plane
	int parent;           ///< the sheet triangle it is a piece of (its birth face)
	Side side;
};

/// What some triangles are cut into.
struct CutPieces {
	std::vector<CutTriangle> triangles;
	std::vector<int> triangleRegion;  ///< #triangles
	std::vector<Side> regionSide;     ///< #regions: as the walk knows it
	std::vector<BorderPiece> borderPieces;

	/// Add those of other triangles.
	void append(CutPieces more);
};

/// Cuts triangles one by one; its memory serves for all.
class TriangleCutter {
public:
	/// @param snap  label units
	TriangleCutter(const Sheet& sheet, const LabelPaths& paths, double snap)
		: sheet_(sheet), paths_(paths), tessellator_(snap)
	{}

	/// Cut touched[first] .. touched[last - 1].
	/// @param[in] touched  sheet triangles, ascending
	/// @param[out] out  appended
	/// @throws PlacementConflict
	void cut(const std::vector<int>& touched, size_t first, size_t last, CutPieces& out);

private:
	void buildCase(int triangle, size_t firstChain, size_t lastChain);
	void addEdgePoints(int halfEdge);
	vcg::Point2d casePlane(int point, int triangle) const;
	int addCasePoint(int point, int triangle);
	int borderIndexOf(int point) const;
	void takeRegions(int triangle, CutPieces& out);

	const Sheet& sheet_;
	const LabelPaths& paths_;
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

inline void CutPieces::append(CutPieces more)
{
	if (triangles.empty()) {
		*this = std::move(more);
		return;
	}
	const int shift = int(regionSide.size());
	for (int& region : more.triangleRegion) region += shift;
	for (BorderPiece& piece : more.borderPieces) piece.region += shift;
	const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
	add(triangles, more.triangles);
	add(triangleRegion, more.triangleRegion);
	add(regionSide, more.regionSide);
	add(borderPieces, more.borderPieces);
}

inline void TriangleCutter::cut(const std::vector<int>& touched, size_t first, size_t last, CutPieces& out)
{
	if (first == last) return;
	const auto& chains = paths_.chains;
	const auto before = [](const ContourChain& c, int triangle) { return c.triangle < triangle; };
	size_t chain = size_t(std::lower_bound(chains.begin(), chains.end(), touched[first], before) - chains.begin());
	for (size_t i = first; i < last; ++i) {
		const size_t firstChain = chain;
		while (chain < chains.size() && chains[chain].triangle == touched[i]) ++chain;
		try {
			buildCase(touched[i], firstChain, chain);
			walk_.cut(case_, regions_);
			takeRegions(touched[i], out);
		} catch (const WalkConflict& conflict) {
			throw PlacementConflict{conflict.why, case_.points[size_t(conflict.point)]};
		}
	}
}

inline vcg::Point2d TriangleCutter::casePlane(int point, int triangle) const
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

inline int TriangleCutter::addCasePoint(int point, int triangle)
{
	case_.points.push_back(casePlane(point, triangle));
	caseSpace_.push_back(paths_.points.at(sheet_, point).label);
	casePoint_.push_back(point);
	return int(casePoint_.size()) - 1;
}

inline void TriangleCutter::addEdgePoints(int halfEdge)
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

inline int TriangleCutter::borderIndexOf(int point) const
{
	const auto found = std::lower_bound(caseBorder_.begin(), caseBorder_.end(), std::make_pair(point, 0));
	if (found == caseBorder_.end() || found->first != point) throw WalkConflict{"a chain ends off the border", 0};
	return found->second;
}

inline void TriangleCutter::buildCase(int triangle, size_t firstChain, size_t lastChain)
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

inline void TriangleCutter::takeRegions(int triangle, CutPieces& out)
{
	const int firstRegion = int(out.regionSide.size());
	for (const RegionSet::Region& r : regions_.regions) {
		regionTriangles_.clear();
		tessellator_.triangulate(case_.points, caseSpace_, regions_.rings, r.firstRing, r.ringCount, regionTriangles_);
		for (const IndexTriangle& t : regionTriangles_) {
			const IndexTriangle points = {casePoint_[size_t(t[0])], casePoint_[size_t(t[1])], casePoint_[size_t(t[2])]};
			out.triangles.push_back({points, triangle, r.side});
			out.triangleRegion.push_back(int(out.regionSide.size()));
		}
		out.regionSide.push_back(r.side);
	}
	for (int i = 0; i < case_.borderCount; ++i)
		out.borderPieces.push_back({casePoint_[size_t(i)], casePoint_[size_t((i + 1) % case_.borderCount)],
		                            caseHalfEdge_[size_t(i)], firstRegion + regions_.regionAtBorder[size_t(i)]});
}

}  // namespace vcg::textlabel
