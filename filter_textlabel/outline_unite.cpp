#include "outline_unite.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include "outline_bead.h"
#include "outline_grid.h"
#include "outline_union.h"
#include "text_error.h"

namespace textlabel {
namespace {

/// Grid units that the finest detail must have, for rounding not to matter.
constexpr double kLeastFinest = 8;
/// Points that make less of a corner than this share of the finest detail are left out: the traces of rounding.
constexpr double kTrace = 1.0 / 8;
/// How far points may be moved where Clipper is in trouble, times the finest detail.
constexpr double kTrifle = 1.0 / 16;
/// Rounds of bridging; a bridge may come close to something in its turn.
constexpr int kRounds = 12;
/// Longest miter of an emboldened corner, times the offset, as fonts and SVG have it.
constexpr double kMiterLimit = 4;

Grid GridFor(const std::vector<LetterRings>& letters, const UniteOptions& options)
{
	double reach = 0;
	for (const LetterRings& letter : letters) {
		for (const Ring& ring : letter.rings) {
			for (const vcg::Point2d& p : ring) reach = std::max({reach, std::abs(p[0]), std::abs(p[1])});
		}
	}
	reach += kMiterLimit * std::abs(options.embolden) + options.tolerance;
	const Grid grid = Grid::Holding(reach);
	const double least = kLeastFinest * grid.step / kFinest;
	if (!(options.tolerance >= least))
		throw TextError(TextErrorCode::BadTolerance, "the text is too large for it").measured(options.tolerance, least);
	return grid;
}

/// Without specks, and without the points that rounding left behind.
Paths Cleaned(const Paths& rings, double finest)
{
	Paths result;
	for (const Path& ring : rings) {
		Path clean;
		ClipperLib::CleanPolygon(ring, clean, std::max(kTrace * finest, std::sqrt(2.0)));
		double length = 0;
		for (std::size_t i = 0; i < clean.size(); ++i) {
			const IntPoint &p = clean[i], &q = clean[(i + 1) % clean.size()];
			length += std::hypot(static_cast<double>(q.X - p.X), static_cast<double>(q.Y - p.Y));
		}
		if (2 * std::abs(ClipperLib::Area(clean)) > finest * length) result.push_back(std::move(clean));
	}
	return result;
}

/// Without points that are exactly on the line of their neighbours.
void DropCollinear(Path& ring)
{
	for (std::size_t i = 0; i < ring.size() && ring.size() > 2;) {
		const std::size_t n = ring.size();
		if (Cross(ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]) != 0) {
			++i;
			continue;
		}
		ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
		if (i > 0) --i;
	}
}

/// Bridge what comes too close, until nothing does.
/// @param[in] rings  united
Paths Bridged(Paths rings, double finest)
{
	for (int round = 0;; ++round) {
		rings = Cleaned(rings, finest);
		for (Path& ring : rings) DropCollinear(ring);
		const Paths beads = round < kRounds ? BeadsOf(rings, finest) : Paths{};
		if (beads.empty()) break;
		rings.insert(rings.end(), beads.begin(), beads.end());
		rings = CheckedUnion(rings, kTrifle * finest);
	}
	if (!AreSound(rings)) throw TextError(TextErrorCode::Unsound, "it keeps touching itself");
	return rings;
}

/// One letter by itself: solid where its rings wind around, counter-clockwise.
Paths LetterShape(const LetterRings& letter, const UniteOptions& options, const Grid& grid)
{
	Paths rings;
	for (const Ring& ring : letter.rings) {
		Path path;
		for (const vcg::Point2d& p : ring) path.push_back(grid(p));
		rings.push_back(std::move(path));
	}
	RequireFewCrossings(rings);
	return CheckedUnion(rings, kTrifle * kFinest * options.tolerance / grid.step);
}

Paths Emboldened(const Paths& rings, double distance)
{
	if (distance == 0) return rings;
	ClipperLib::ClipperOffset offset(kMiterLimit);
	offset.AddPaths(rings, ClipperLib::jtMiter, ClipperLib::etClosedPolygon);
	Paths result;
	offset.Execute(result, distance);
	return result;
}

/// Pieces of a letter and holes in them, specks left out.
std::pair<std::size_t, std::size_t> CountPieces(const Paths& rings, double finest)
{
	const Paths clean = Cleaned(rings, finest);
	const auto pieces = std::count_if(clean.begin(), clean.end(), ClipperLib::Orientation);
	return {static_cast<std::size_t>(pieces), clean.size() - static_cast<std::size_t>(pieces)};
}

FlatBox<cInt> BoxOf(const Paths& rings, cInt margin)
{
	const IntPoint& first = rings.front().front();
	FlatBox<cInt> box{first.X, first.Y, first.X, first.Y};
	for (const Path& ring : rings) {
		for (const IntPoint& p : ring) box.add({p.X, p.Y, p.X, p.Y});
	}
	return {box.x0 - margin, box.y0 - margin, box.x1 + margin, box.y1 + margin};
}

/// Letters whose boxes meet, directly or over others, as lists of their indices: the others cannot touch, and need not
/// be united. Clipper's time grows with the square of the letters side by side.
std::vector<std::vector<std::size_t>> Neighbourhoods(const std::vector<Paths>& shapes, double finest)
{
	std::vector<FlatBox<cInt>> boxes;
	for (const Paths& shape : shapes) boxes.push_back(BoxOf(shape, static_cast<cInt>(std::ceil(finest))));
	const BoxTree<cInt> tree(boxes);
	std::vector<char> seen(shapes.size(), 0);
	std::vector<std::vector<std::size_t>> result;
	for (std::size_t i = 0; i < shapes.size(); ++i) {
		if (seen[i]) continue;
		seen[i] = 1;
		std::vector<std::size_t> members{i};
		for (std::size_t k = 0; k < members.size(); ++k) {
			tree.search(boxes[members[k]], [&](std::size_t other) {
				if (!seen[other]) members.push_back(other);
				seen[other] = 1;
			});
		}
		result.push_back(std::move(members));
	}
	return result;
}

/// The shapes of letters that may touch as one set of rings.
Paths UnitedShapes(const std::vector<Paths>& shapes, const std::vector<std::size_t>& members, double finest)
{
	Paths rings;
	for (const std::size_t i : members) rings.insert(rings.end(), shapes[i].begin(), shapes[i].end());
	if (members.size() == 1) return rings;
	RequireFewCrossings(rings);
	return CheckedUnion(rings, kTrifle * finest);
}

struct PointHash {
	std::size_t operator()(const IntPoint& p) const { return std::hash<cInt>()(p.X * (2 * kGridReach + 1) + p.Y); }
};
/// Which letter a point comes from; the first one, where letters share it.
using LetterOfPoint = std::unordered_map<IntPoint, int, PointHash>;

/// The first letter that has a point of the ring. Beads lie between letters, so that some point of any ring is a
/// letter's, but for a gap that is enclosed by crossings alone: it goes to the letter before it in `letters`.
int LetterOf(const Path& ring, const LetterOfPoint& letterOf, int otherwise)
{
	int first = -1;
	for (const IntPoint& p : ring) {
		const auto found = letterOf.find(p);
		if (found != letterOf.end() && (first < 0 || found->second < first)) first = found->second;
	}
	return first < 0 ? otherwise : first;
}

bool IsLess(const IntPoint& p, const IntPoint& q) { return p.X != q.X ? p.X < q.X : p.Y < q.Y; }

/// A ring with its place among the others.
struct PlacedRing {
	const Path* path;
	int letter, outer, depth;  ///< outer: index of the ring that its part belongs to
};

/// Order of the contours: parts by letter, then from left to right; in a part the outer contour first.
std::vector<std::size_t> ReadingOrder(const std::vector<PlacedRing>& rings)
{
	std::vector<std::size_t> order(rings.size());
	std::iota(order.begin(), order.end(), std::size_t(0));
	std::sort(order.begin(), order.end(), [&rings](std::size_t i, std::size_t j) {
		const PlacedRing &a = rings[i], &b = rings[j];
		const PlacedRing &outerA = rings[static_cast<std::size_t>(a.outer)],
						 &outerB = rings[static_cast<std::size_t>(b.outer)];
		if (outerA.letter != outerB.letter) return outerA.letter < outerB.letter;
		if (a.outer != b.outer) return IsLess(outerA.path->front(), outerB.path->front());
		if (a.depth != b.depth) return a.depth < b.depth;
		return IsLess(a.path->front(), b.path->front());
	});
	return order;
}

std::vector<PlacedRing> Placed(const Paths& rings, const LetterOfPoint& letterOf)
{
	const std::vector<int> parents = ParentsOf(rings);
	std::vector<PlacedRing> placed;
	int last = 0;
	for (std::size_t r = 0; r < rings.size(); ++r) {
		int depth = 0;
		for (int p = parents[r]; p >= 0; p = parents[static_cast<std::size_t>(p)]) ++depth;
		const bool isHole = depth % 2 == 1;
		if (isHole == ClipperLib::Orientation(rings[r])) throw TextError(TextErrorCode::Unsound, "nesting");
		last = LetterOf(rings[r], letterOf, last);
		placed.push_back({&rings[r], last, isHole ? parents[r] : static_cast<int>(r), depth});
	}
	return placed;
}

vcg::textlabel::Outline Assembled(Paths rings, const LetterOfPoint& letterOf, const Grid& grid)
{
	for (Path& ring : rings) std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), IsLess), ring.end());
	const std::vector<PlacedRing> placed = Placed(rings, letterOf);
	vcg::textlabel::Outline outline;
	int outerBefore = -1;
	for (const std::size_t r : ReadingOrder(placed)) {
		if (placed[r].outer != outerBefore) ++outline.partCount;
		outerBefore = placed[r].outer;
		vcg::textlabel::Contour contour;
		contour.part = outline.partCount - 1;
		contour.letter = placed[r].letter;
		for (const IntPoint& p : rings[r]) contour.points.push_back(grid.back(p));
		outline.contours.push_back(std::move(contour));
	}
	return outline;
}

}  // namespace

United UniteLetters(const std::vector<LetterRings>& letters, const UniteOptions& options)
{
	const Grid grid = GridFor(letters, options);
	const double finest = kFinest * options.tolerance / grid.step, offset = options.embolden / grid.step;
	const bool isThinned = options.embolden < 0;
	United result;
	LetterOfPoint letterOf;
	std::vector<Paths> shapes;
	std::vector<const LetterRings*> letterOfShape;
	for (const LetterRings& letter : letters) {
		Paths drawn = LetterShape(letter, options, grid);
		Paths shape = Emboldened(drawn, offset);
		const auto pieces = CountPieces(shape, finest);
		if (pieces.first == 0 && !letter.rings.empty()) result.vanished.push_back(letter.letter);
		else if (isThinned && pieces != CountPieces(drawn, finest)) result.broken.push_back(letter.letter);
		for (const Path& ring : shape) {
			for (const IntPoint& p : ring) letterOf.emplace(p, letter.letter);
		}
		if (isThinned) shape = std::move(drawn);
		if (shape.empty()) continue;
		shapes.push_back(std::move(shape));
		letterOfShape.push_back(&letter);
	}
	Paths all;
	for (const std::vector<std::size_t>& members : Neighbourhoods(shapes, finest)) {
		Paths rings = UnitedShapes(shapes, members, finest);
		if (isThinned) {
			Paths thin = Emboldened(rings, offset);
			const bool isParted = members.size() > 1 && CountPieces(thin, finest) != CountPieces(rings, finest);
			for (const std::size_t i : members) {
				if (isParted && letterOfShape[i]->isJoined) result.broken.push_back(letterOfShape[i]->letter);
			}
			rings = std::move(thin);
		}
		rings = Bridged(std::move(rings), finest);
		all.insert(all.end(), rings.begin(), rings.end());
	}
	result.outline = Assembled(std::move(all), letterOf, grid);
	return result;
}

}  // namespace textlabel
