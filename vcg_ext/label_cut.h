#pragma once
// The cut: contours laid on the sheet become triangles inside and outside the letters.
//
// Source: Slabaugh et al., section 3.2. Lay the contours, cut every triangle that they touch, and find what lies wholly within the
// letters.

#include "parallel_chunks.h"
#include "triangle_cutter.h"

namespace vcg::textlabel {

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
	/// @throws Error{Border, Silhouette, NonManifold, BehindCamera}, PlacementConflict
	CutLabel cut(const Outline& outline, const std::vector<int>& seeds);
	/// The triangles that contours cross or touch, as far as they were laid; also when cut() threw.
	std::vector<int> visited() const { return paths_.visited(); }

private:
	void collectTouched();
	void cutTriangles();
	void takeSides(const std::vector<Side>& side);
	void requireArea(const Outline& outline) const;

	const Sheet& sheet_;
	LabelPaths paths_;
	double snap_;
	CutLabel out_;
	CutPieces cut_;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline CutLabel LabelCutter::cut(const Outline& outline, const std::vector<int>& seeds)
{
	paths_.lay(outline, seeds);
	collectTouched();
	cutTriangles();
	const size_t points = size_t(paths_.points.count(sheet_));
	takeSides(InsideSearch(sheet_, paths_.pieces, out_.touched, cut_.borderPieces, points).run(cut_.regionSide));
	out_.triangles = std::move(cut_.triangles);
	cut_ = CutPieces();  // memory that those who go on with the cut can use
	paths_.forgetChains();
	out_.points = std::move(paths_.points);
	out_.pieces = std::move(paths_.pieces);
	requireArea(outline);
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

/// Some at the same time where there is much to do: shares of about as many points each.
inline void LabelCutter::cutTriangles()
{
	constexpr size_t cost = 200;  // of a triangle and of a point in it, in elements of a linear pass
	const std::vector<int>& touched = out_.touched;
	std::vector<size_t> before(1, 0);  // #touched + 1: triangles and points in all those before
	size_t chain = 0;
	for (const int t : touched) {
		before.push_back(before.back() + 1);
		for (; chain < paths_.chains.size() && paths_.chains[chain].triangle == t; ++chain)
			before.back() += size_t(paths_.chains[chain].length);
	}
	const auto triangleAt = [&](size_t share) {
		return size_t(std::lower_bound(before.begin(), before.end(), share) - before.begin());
	};
	std::vector<CutPieces> pieces(ChunkCount(cost * before.back()));
	EachChunk(before.back(), pieces.size(), [&](size_t chunk, size_t first, size_t last) {
		TriangleCutter(sheet_, paths_, snap_).cut(touched, triangleAt(first), triangleAt(last), pieces[chunk]);
	});
	for (CutPieces& more : pieces) cut_.append(std::move(more));
}

inline void LabelCutter::takeSides(const std::vector<Side>& side)
{
	for (size_t i = 0; i < cut_.triangles.size(); ++i)
		cut_.triangles[i].side = side[size_t(cut_.triangleRegion[i])] == Side::Inside ? Side::Inside : Side::Outside;
	for (size_t t = 0; t < sheet_.triangles.size(); ++t)
		if (side[cut_.regionSide.size() + t] == Side::Inside) out_.within.push_back(int(t));
	const auto add = [&](const IndexTriangle& t) {
		const auto at = [&](size_t k) { return paths_.points.at(sheet_, t[k]).plane; };
		out_.insideArea += ((at(1) - at(0)) ^ (at(2) - at(0))) / 2;
	};
	for (const CutTriangle& t : cut_.triangles)
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
