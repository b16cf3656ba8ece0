#pragma once
// The inside search: which regions and triangles lie within the letters.
//
// The walk knows the side of every region that a contour touches. Regions and whole triangles further in are found by going from one
// to the next over the sheet, never across a contour. Whatever the search meets but should not (a border, the horizon, a third
// triangle at an edge) is a fault of the place and is named.

#include "label_paths.h"
#include "triangle_walk.h"

namespace vcg::textlabel {

/// A piece of a cut triangle's border.
struct BorderPiece {
	int from, to;  ///< cut points, counter-clockwise
	int halfEdge;  ///< that it lies on
	int region;    ///< beside it
};

/// Finds what lies within the letters.
class InsideSearch {
public:
	/// @param[in] pieces  of the contours
	/// @param[in] touched  sheet triangles that are cut up, ascending
	/// @param[in] borderPieces  of their regions
	/// @param[in] pointCount  cut points are numbered below it; one piece of a contour starts at a point, at most
	InsideSearch(const Sheet& sheet, const std::vector<ContourPiece>& pieces, const std::vector<int>& touched,
	             const std::vector<BorderPiece>& borderPieces, size_t pointCount);

	/// @param[in] side  #R sides of the regions as the walk knows them
	/// @return #R sides of the regions, then one for each sheet triangle that is not touched; Unknown is outside
	/// @throws Error{Border, Silhouette, NonManifold, BehindCamera} with face and place; PlacementConflict when inside and outside meet
	std::vector<Side> run(std::vector<Side> side);

private:
	void indexPieces(int regionCount);
	void startAlongEdges();
	/// @param[in] halfEdge  beside the region: the place, when it can't be
	void enter(int region, int halfEdge);
	void markOutside(int region, int halfEdge);
	[[noreturn]] void refuse(int halfEdge) const
	{
		throw PlacementConflict{"inside and outside of a letter meet", sheet_.plane(sheet_.from(halfEdge))};
	}
	void cross(const BorderPiece& piece);
	[[noreturn]] void throwOffSheet(int halfEdge) const;
	bool isContour(int from, int to) const;
	int regionBeside(int from, int to, int triangle) const;

	const Sheet& sheet_;
	const std::vector<ContourPiece>& pieces_;
	std::vector<char> isTouched_;                  ///< #T
	std::vector<BorderPiece> borderPieces_;        ///< in groups of equal `from`
	std::vector<int> fromStart_;                   ///< CSR: where each point's group begins
	std::vector<int> contourTo_;                   ///< #points: where the contour goes on from there, or -1
	std::vector<int> regionStart_, regionPieces_;  ///< border pieces of each region, CSR
	std::vector<Side> side_;
	int regionCount_ = 0;  ///< regions of touched triangles; region regionCount_ + t is the untouched sheet triangle t
	std::vector<int> stack_;
};

// ---------------------------------------------------------------------------------------------------------------------------

inline InsideSearch::InsideSearch(const Sheet& sheet, const std::vector<ContourPiece>& pieces,
                                  const std::vector<int>& touched, const std::vector<BorderPiece>& borderPieces,
                                  size_t pointCount)
	: sheet_(sheet), pieces_(pieces), isTouched_(sheet.triangles.size(), 0), borderPieces_(borderPieces.size()),
	  fromStart_(pointCount + 1, 0), contourTo_(pointCount, -1)
{
	for (const int t : touched) isTouched_[size_t(t)] = 1;
	for (const ContourPiece& piece : pieces_) contourTo_[size_t(piece.from)] = piece.to;
	for (const BorderPiece& p : borderPieces) ++fromStart_[size_t(p.from) + 1];
	for (size_t i = 1; i < fromStart_.size(); ++i) fromStart_[i] += fromStart_[i - 1];
	std::vector<int> next(fromStart_.begin(), fromStart_.end() - 1);
	for (const BorderPiece& p : borderPieces) borderPieces_[size_t(next[size_t(p.from)]++)] = p;
}

inline std::vector<Side> InsideSearch::run(std::vector<Side> side)
{
	side_ = std::move(side);
	regionCount_ = int(side_.size());
	indexPieces(regionCount_);
	side_.resize(size_t(regionCount_) + sheet_.triangles.size(), Side::Unknown);
	for (int r = 0; r < regionCount_; ++r)
		if (side_[size_t(r)] == Side::Inside) stack_.push_back(r);
	startAlongEdges();
	while (!stack_.empty()) {
		const int r = stack_.back();
		stack_.pop_back();
		if (r < regionCount_) {
			for (int i = regionStart_[size_t(r)]; i < regionStart_[size_t(r) + 1]; ++i)
				cross(borderPieces_[size_t(regionPieces_[size_t(i)])]);
		} else {
			for (int h = 3 * (r - regionCount_), k = 0; k < 3; ++k, ++h) cross({sheet_.from(h), sheet_.to(h), h, r});
		}
	}
	return std::move(side_);
}

inline void InsideSearch::indexPieces(int regionCount)
{
	regionStart_.assign(size_t(regionCount) + 1, 0);
	for (const BorderPiece& p : borderPieces_) ++regionStart_[size_t(p.region) + 1];
	for (size_t i = 1; i < regionStart_.size(); ++i) regionStart_[i] += regionStart_[i - 1];
	regionPieces_.resize(borderPieces_.size());
	std::vector<int> next(regionStart_.begin(), regionStart_.end() - 1);
	for (size_t i = 0; i < borderPieces_.size(); ++i)
		regionPieces_[size_t(next[size_t(borderPieces_[i].region)]++)] = int(i);
}

/// A contour along an edge touches no region from within; it has the inside on its left all the same.
inline void InsideSearch::startAlongEdges()
{
	for (const ContourPiece& piece : pieces_) {
		if (piece.halfEdge < 0) continue;
		enter(regionBeside(piece.from, piece.to, piece.halfEdge / 3), piece.halfEdge);
		const int twin = sheet_.twin[size_t(piece.halfEdge)];
		if (twin >= 0) markOutside(regionBeside(piece.to, piece.from, twin / 3), twin);
	}
}

inline void InsideSearch::enter(int region, int halfEdge)
{
	Side& side = side_[size_t(region)];
	if (side == Side::Outside) refuse(halfEdge);
	if (side == Side::Unknown) {
		side = Side::Inside;
		stack_.push_back(region);
	}
}

inline void InsideSearch::markOutside(int region, int halfEdge)
{
	Side& side = side_[size_t(region)];
	if (side == Side::Inside) refuse(halfEdge);
	side = Side::Outside;
}

inline void InsideSearch::cross(const BorderPiece& piece)
{
	if (isContour(piece.from, piece.to)) return;
	const int across = sheet_.facingAcross(piece.halfEdge);
	if (across < 0) throwOffSheet(piece.halfEdge);
	enter(regionBeside(piece.to, piece.from, across), piece.halfEdge);
}

inline void InsideSearch::throwOffSheet(int halfEdge) const
{
	const vcg::Point3d &a = sheet_.vertices[size_t(sheet_.from(halfEdge))].mesh,
					   &b = sheet_.vertices[size_t(sheet_.to(halfEdge))].mesh;
	throw Error(CodeOfEdge(sheet_.twin[size_t(halfEdge)]), "the inside of a letter leaves the sheet")
		.atFace(sheet_.triangles[size_t(halfEdge / 3)].face)
		.atPlace((a + b) / 2);
}

inline bool InsideSearch::isContour(int from, int to) const { return contourTo_[size_t(from)] == to; }

/// The region of `triangle` along its border piece from-to.
inline int InsideSearch::regionBeside(int from, int to, int triangle) const
{
	if (!isTouched_[size_t(triangle)]) return regionCount_ + triangle;
	for (int i = fromStart_[size_t(from)]; i < fromStart_[size_t(from) + 1]; ++i)
		if (borderPieces_[size_t(i)].to == to) return borderPieces_[size_t(i)].region;
	throw PlacementConflict{"neighbours cut their common edge differently", sheet_.plane(sheet_.from(3 * triangle))};
}

}  // namespace vcg::textlabel
