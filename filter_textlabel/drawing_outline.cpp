#include "drawing_outline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include "drawing_read.h"
#include "drawing_stroke.h"
#include "outline_flatten.h"
#include "outline_unite.h"
#include "text_layout.h"

namespace textlabel {
namespace {

using vcg::Point2d;

/// Most corners of all shapes, and most samples of their curves; the time grows faster than the number of corners.
constexpr std::size_t kMostCorners = 200000;
constexpr double kMostSamplesOfAll = 500000;
/// How far points may be moved where Clipper is in trouble, times the tolerance.
constexpr double kTrifle = 1.0 / 128;
constexpr double kMostEmbolden = 1;  ///< times the height
/// Grid units in the tolerance, for rounding not to matter.
constexpr double kLeastTolerance = 64;
/// Times that a drawing is painted anew, as its ink turned out smaller than all that is painted.
constexpr int kRounds = 4;

/// The longest way that a unit of length goes.
double ScaleOf(const Affine& map)
{
	const double p = std::hypot(map.xx + map.yy, map.yx - map.xy), q = std::hypot(map.xx - map.yy, map.yx + map.xy);
	return (p + q) / 2;
}

/// All that shapes may cover, on the page.
vcg::Box2d BoxOf(const std::vector<DrawnShape>& shapes)
{
	vcg::Box2d box;
	for (const DrawnShape& shape : shapes) {
		const double around =
			shape.isLine ? shape.line.width / 2 * ScaleOf(shape.toPage) * std::max(1.5, shape.line.miterLimit) : 0;
		for (const DrawnPath& path : shape.paths) {
			vcg::Box2d of = textlabel::BoxOf(Mapped({path.curves}, shape.toPage));
			for (const CurvePiece& piece : path.curves) of.Add(shape.toPage(piece.end()));
			of.Offset(around);
			box.Add(of);
		}
	}
	return box;
}

/// Paints shapes on a grid around the middle of the page.
class Painter {
public:
	/// @param[in] tolerance  units of the page, > 0
	/// @throws TextError{Unsound} when it is too fine for the grid
	Painter(const Drawing& drawing, const vcg::Box2d& box, double tolerance)
		: m_drawing(drawing), m_middle(box.Center()), m_tolerance(tolerance),
		  m_grid(Grid::Holding(box.Diag() + tolerance)), m_trifle(kTrifle * tolerance / m_grid.step)
	{
		if (!(tolerance >= kLeastTolerance * m_grid.step))
			throw TextError(TextErrorCode::Unsound, "what is seen of it is too small a part of it");
	}

	/// The ink, in units of the page, y upwards, around the middle.
	std::vector<Ring> ink()
	{
		const auto isWhite = [](const DrawnShape& shape) { return shape.isWhite; };
		const bool isInverse = std::all_of(m_drawing.shapes.begin(), m_drawing.shapes.end(), isWhite);
		Paths ink;
		std::vector<Paths> more;  // inked, but not yet united with it
		const auto unite = [&] {
			more.push_back(std::move(ink));
			ink = united(more, 0, more.size());
			more.clear();
		};
		for (const DrawnShape& shape : m_drawing.shapes) {
			if (shape.isWhite && !isInverse && more.empty() && ink.empty()) continue;
			Paths region = clipped(shape);
			if (!shape.isWhite || isInverse) {
				more.push_back(std::move(region));
				continue;
			}
			unite();
			ink = CheckedDifference(ink, region, m_trifle);
		}
		unite();
		std::vector<Ring> rings;
		for (const Path& path : ink) {
			Ring& ring = rings.emplace_back();
			for (const IntPoint& p : path) ring.push_back(m_grid.back(p));
		}
		return rings;
	}

private:
	/// The union of regions[first] .. regions[last - 1], by halves: what is within a half, and crossed there, is gone when both are united.
	Paths united(const std::vector<Paths>& regions, std::size_t first, std::size_t last) const
	{
		if (first == last) return {};
		if (first + 1 == last) return regions[first];
		const std::size_t middle = first + (last - first) / 2;
		Paths both = united(regions, first, middle), other = united(regions, middle, last);
		both.insert(both.end(), other.begin(), other.end());
		RequireFewCrossings(both);
		return CheckedUnion(both, m_trifle);
	}

	Paths clipped(const DrawnShape& shape)
	{
		Paths region = regionOf(shape);
		for (const int clip : shape.clips) {
			const Paths& window = windowOf(clip);
			if (!region.empty() && !IsFilledBy(window, region)) region = CheckedIntersection(region, window, m_trifle);
		}
		return region;
	}

	/// The region of a clip path.
	const Paths& windowOf(int clip)
	{
		const auto [it, isNew] = m_windows.try_emplace(clip);
		if (!isNew) return it->second;
		std::vector<Paths> panes;
		for (const DrawnShape& shape : m_drawing.clips[static_cast<std::size_t>(clip)]) panes.push_back(clipped(shape));
		return it->second = united(panes, 0, panes.size());
	}

	/// Most windows are a page, with all that is drawn in it.
	static bool IsFilledBy(const Paths& window, const Paths& region)
	{
		if (window.size() != 1 || window[0].size() != 4) return false;
		for (std::size_t i = 0; i < 4; ++i) {
			const IntPoint &a = window[0][i], &b = window[0][(i + 1) % 4];
			if (a.X != b.X && a.Y != b.Y) return false;
		}
		const auto [low, high] = CornersOf(window);
		const auto [from, to] = CornersOf(region);
		return low.X <= from.X && low.Y <= from.Y && to.X <= high.X && to.Y <= high.Y;
	}
	static std::pair<IntPoint, IntPoint> CornersOf(const Paths& rings)
	{
		IntPoint low = rings.front().front(), high = low;
		for (const Path& ring : rings)
			for (const IntPoint& p : ring) {
				low = {std::min(low.X, p.X), std::min(low.Y, p.Y)};
				high = {std::max(high.X, p.X), std::max(high.Y, p.Y)};
			}
		return {low, high};
	}

	/// What a shape covers: outer rings counter-clockwise, holes clockwise.
	Paths regionOf(const DrawnShape& shape)
	{
		Paths rings;
		for (const DrawnPath& path : shape.paths)
			for (const Ring& ring : shape.isLine ? stroked(path, shape) : filled(path, shape)) {
				Path& corners = rings.emplace_back();
				for (const Point2d& p : ring) corners.push_back(m_grid(p));
				m_corners += ring.size();
			}
		if (m_corners > kMostCorners)
			throw TextError(TextErrorCode::Unsound, "it takes more than " + std::to_string(kMostCorners) + " corners");
		if (shape.isLine)  // polygons of a line turn the other way where it is mirrored
			for (Path& ring : rings)
				if (!ClipperLib::Orientation(ring)) ClipperLib::ReversePath(ring);
		RequireFewCrossings(rings);
		return CheckedUnion(rings, m_trifle, shape.isLine ? FillRule::NonZero : shape.rule);
	}

	Point2d placed(const Point2d& onPage) const { return {onPage[0] - m_middle[0], m_middle[1] - onPage[1]}; }

	std::vector<Ring> filled(const DrawnPath& path, const DrawnShape& shape)
	{
		CurveContour contour = path.curves;
		for (CurvePiece& piece : contour)
			for (Point2d& p : piece.p) p = placed(shape.toPage(p));
		if (contour.front().start() != contour.back().end())
			contour.push_back(CurvePiece::Line(contour.back().end(), contour.front().start()));
		m_samples += SamplesNeeded(contour, m_tolerance);
		if (!(m_samples < kMostSamplesOfAll))
			throw TextError(TextErrorCode::Unsound, "its curves are too long for so fine a tolerance");
		Ring ring = Flatten(contour, m_tolerance);
		return ring.empty() ? std::vector<Ring>{} : std::vector<Ring>{std::move(ring)};
	}

	std::vector<Ring> stroked(const DrawnPath& path, const DrawnShape& shape) const
	{
		const double scale = ScaleOf(shape.toPage);
		if (!(scale > 0)) return {};
		// half for the line itself, half for its round joints
		const double tolerance = m_tolerance / scale / 2;
		std::vector<Ring> rings =
			StrokeRings(FlattenOpen(path.curves, tolerance), path.isClosed, shape.line, tolerance);
		for (Ring& ring : rings)
			for (Point2d& p : ring) p = placed(shape.toPage(p));
		return rings;
	}

	const Drawing& m_drawing;
	const Point2d m_middle;
	const double m_tolerance;
	const Grid m_grid;
	const double m_trifle;
	std::size_t m_corners = 0;
	double m_samples = 0;
	std::map<int, Paths> m_windows;
};

/// What was painted, and how large it is to be.
struct Painting {
	std::vector<Ring> rings;
	vcg::Box2d box;
	double scale = 0;      ///< label units for one of the page
	double tolerance = 0;  ///< label units
};

/// As large as the options say.
double ScaleFor(const vcg::Box2d& ink, const TextOptions& options)
{
	if (options.fitWidth == 0) return options.size / ink.DimY();
	const double overhang = 2 * options.embolden;
	if (!(options.fitWidth > overhang))
		throw TextError(TextErrorCode::BadSize, "fitWidth").measured(options.fitWidth, overhang);
	return (options.fitWidth - overhang) / ink.DimX();
}

/// The tolerance that is asked for is one of the label, whose scale is known once it is painted.
Painting Paint(const Drawing& drawing, const TextOptions& options)
{
	constexpr double slack = 1.2;
	vcg::Box2d all = BoxOf(drawing.shapes);
	if (drawing.shapes.empty() || !(all.DimX() > 0) || !(all.DimY() > 0)) throw TextError(TextErrorCode::DrawingEmpty);
	for (const std::vector<DrawnShape>& clip : drawing.clips) all.Add(BoxOf(clip));
	Painting painting;
	const double wanted = options.tolerance > 0 ? options.tolerance / ScaleFor(all, options) : 0;
	double onPage = std::max(wanted, all.DimY() / kDrawingTolerance);
	for (int round = 0;; ++round) {
		painting.rings = Painter(drawing, all, onPage).ink();
		painting.box = {};
		for (const Ring& ring : painting.rings)
			for (const Point2d& p : ring) painting.box.Add(p);
		const bool isEmpty = painting.rings.empty() || !(painting.box.DimX() > 0) || !(painting.box.DimY() > 0);
		if (isEmpty) throw TextError(TextErrorCode::DrawingEmpty);
		painting.scale = ScaleFor(painting.box, options);
		painting.tolerance =
			CheckedTolerance(options.tolerance, painting.scale * painting.box.DimY(), kDrawingTolerance);
		if (onPage * painting.scale <= slack * painting.tolerance || round == kRounds) return painting;
		onPage = painting.tolerance / painting.scale;
	}
}

TextOutline SetOnce(const TextOptions& options)
{
	const Painting painting = Paint(ReadDrawing(options.drawing), options);
	TextOutline text;
	text.capitalHeight = painting.scale * painting.box.DimY();
	text.tolerance = painting.tolerance;
	const double most = kMostEmbolden * text.capitalHeight;
	if (std::abs(options.embolden) > most)
		throw TextError(TextErrorCode::BadEmbolden, "the height").measured(options.embolden, most);
	const Point2d size(painting.scale * painting.box.DimX(), text.capitalHeight), low = painting.box.min;
	const Point2d anchor = AnchorOf({{0, 0}, size}, options.align, options.anchor);
	const double side = options.mirrored ? -1 : 1;
	LetterRings letter;
	for (const Ring& ring : painting.rings) {
		Ring& placed = letter.rings.emplace_back();
		for (const Point2d& p : ring) {
			const Point2d q = (p - low) * painting.scale - anchor;
			placed.emplace_back(side * q[0], q[1]);
		}
		if (options.mirrored) std::reverse(placed.begin(), placed.end());
	}
	United united = UniteLetters({letter}, {text.tolerance, options.embolden});
	if (!united.vanished.empty()) throw TextError(TextErrorCode::LetterVanished);
	if (!united.broken.empty()) throw TextError(TextErrorCode::LetterBroken);
	text.outline = std::move(united.outline);
	return text;
}

}  // namespace

TextOutline SetAsDrawing(const TextOptions& options)
{
	try {
		if (options.code != CodeKind::None) throw TextError(TextErrorCode::DrawingAndCode);
		return SetOnce(options);
	} catch (TextError& error) {
		error.ofDrawing(options.drawing);
		throw;
	}
}

}  // namespace textlabel
