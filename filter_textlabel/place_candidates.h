#pragma once
// Candidates for a place: looks at the part from the directions that matter, and in each look the windows that are free.

#include "auto_placement.h"
#include "free_window.h"
#include "view_directions.h"

namespace textlabel {

/// What a person would call a good place; lengths as shares, so that the part's unit does not matter.
struct Taste {
	double airShare = 1.25;         ///< a place is chosen for the text's box times this ...
	double airMargin = 0.25;        ///< ... with so many capital heights more on each side
	double tightMargin = 0.1;       ///< capital heights that even a tight place keeps around the text
	double maxCapitalShare = 0.15;  ///< of the part's diagonal, for a capital whose height we choose
	double goodTextShare = 0.1;     ///< of it, for the text's diagonal: a smaller flat place does not beat a curved one
	double turnedWeight = 0.6;      ///< reading from bottom to top
	double frontWeight = 0.97;      ///< looking along Y, the usual front; the top has 1
	double sideWeight = 0.95;
	double obliqueWeight = 0.9;     ///< facing no axis
	double downWeight = 0.8;        ///< usually the side that the part stands on ...
	double raisedDownWeight = 0.5;  ///< ... and with a raised label it would not stand any more
	double centeringSlack = 0.03;   ///< of the window, given up to be centred ...
	double roughSlack = 0.12;       ///< ... and of a window that is seen from afar, to know where to look closely
	size_t enoughGood = 3;          ///< good flat places that make a search for curved ones needless
	double centralShare = 0.1;      ///< what a place one diagonal from the middle of the part is worth less
	int windowsPerLook = 3;
};
constexpr Taste taste;

/// How hard to look.
struct Effort {
	double pixels;      ///< of one look
	double keepShare;   ///< of the best score so far; what is worth less is not pursued
	bool alwaysCurved;  ///< even if there are good flat places
};
constexpr Effort quickEffort{1 << 13, 0.5, false};

constexpr double thoroughPixels = 1 << 16, mostPixels = 1 << 20;
constexpr double pixelsForWanted = 6;  // across the shorter side of a text of wanted size, in a thorough look
constexpr double maxPixelsPerSide = 2048;
constexpr double minWindowPixels = 3;  // windows with a shorter side are not seen
constexpr double flatDegrees = 1;      // a look at a flat region may be off by that
constexpr double curvedStep = 0.1;     // pixels per pixel: facets of a curved surface, not a step

/// How steep the surface may be, and what a place is worth then.
struct Level {
	double degrees, weight;
	bool flat;
};
constexpr Level flatLevel{flatDegrees, 1, true};
constexpr Level curvedLevels[] = {{15, 0.5, false}, {30, 0.4, false}, {45, 0.3, false}, {60, 0.15, false}};

struct Shape {
	double width, height;
};

/// A window in a look, before it is measured on the triangles.
struct Candidate {
	ViewAxes axes;     ///< as the text reads
	double right, up;  ///< centre in these axes, from the part's centre
	double capital;    ///< largest capital height that the window takes with air around it
	double pixel;      ///< of the look: how exact all this is
	Level level;
	double weight;       ///< how well such a place reads; score = capital * weight
	bool sharp = false;  ///< found in a look of its own

	double score() const { return capital * weight; }
};

namespace detail {

inline Smoothness RuleFor(const Level& level, double slackDegrees)
{
	const double slope = std::tan((level.degrees + slackDegrees) * degree);
	return level.flat ? Smoothness{slope, slope, false} : Smoothness{slope, curvedStep, true};
}

inline Shape AiryShape(const PlaceQuery& query)
{
	const double margin = 2 * taste.airMargin;
	return {query.labelWidth * taste.airShare + margin, query.labelHeight * taste.airShare + margin};
}

inline Shape TightShape(const PlaceQuery& query)
{
	return {query.labelWidth + 2 * taste.tightMargin, query.labelHeight + 2 * taste.tightMargin};
}

inline double FacingWeight(const vcg::Point3d& towards, bool isRaised)
{
	const double along = std::cos(flatDegrees * degree);
	if (towards[2] < -std::sqrt(0.5)) return isRaised ? taste.raisedDownWeight : taste.downWeight;
	if (towards[2] > along) return 1;
	if (towards[1] < -along) return taste.frontWeight;
	if (std::max({towards[0], -towards[0], towards[1]}) > along) return taste.sideWeight;
	return taste.obliqueWeight;
}

/// A window for a text: the airiest, or, when the wanted size needs it, a tight one.
/// @param[in] minCapital  windows that take less do not count, mesh units
/// @return its scale is that of the airy shape in it, so that tight ones compare with airy ones
inline std::optional<FreeWindow> WindowFor(const PlaceQuery& query, const FreeArea& area, double pixel, double slack,
                                           bool turned, double minCapital)
{
	const auto find = [&](Shape shape, double least) {
		if (turned) std::swap(shape.width, shape.height);
		least = std::max(least, minWindowPixels / std::min(shape.width, shape.height));
		return LargestFreeWindow(area, shape.width, shape.height, slack, least);
	};
	const std::optional<FreeWindow> airy = find(AiryShape(query), std::max(query.size, minCapital) / pixel);
	if (airy || query.size <= 0 || query.size < minCapital) return airy;
	const Shape airyShape = AiryShape(query), tightShape = TightShape(query);
	std::optional<FreeWindow> tight = find(tightShape, query.size / pixel);
	if (tight) tight->scale *= std::min(tightShape.width / airyShape.width, tightShape.height / airyShape.height);
	return tight;
}

inline void BlockWindow(FreeArea& area, const FreeWindow& window, double scale, Shape shape)
{
	const int dx = Reach(scale * shape.width), dy = Reach(scale * shape.height);
	for (int y = std::max(0, window.y - dy); y <= std::min(area.height() - 1, window.y + dy); ++y)
		for (int x = std::max(0, window.x - dx); x <= std::min(area.width() - 1, window.x + dx); ++x) area.block(x, y);
	area.sumUp();
}

/// Everything that a search needs to know, and what it has found.
struct Search {
	const PlaceQuery& query;
	const Part& part;
	const Effort& effort;
	std::vector<Candidate> found;
	double best = 0;  ///< score

	/// Capital height below which a place of this weight is not pursued.
	double minCapital(double weight) const { return effort.keepShare * best / weight; }
	void add(const DepthImage& image, const FreeWindow& window, const Level& level, double weight, bool turned);
};

/// How well a place reads that lies so far from the middle of the part.
inline double CentralWeight(const Part& part, double right, double up)
{
	return 1 - taste.centralShare * std::hypot(right, up) / part.diagonal;
}

inline void Search::add(const DepthImage& image, const FreeWindow& window, const Level& level, double weight,
                        bool turned)
{
	const PixelGrid& grid = image.grid;
	const double x = grid.left + window.x * grid.pixel, y = grid.bottom + window.y * grid.pixel;
	Candidate candidate{image.axes, x, y, window.scale * grid.pixel, grid.pixel, level, weight};
	candidate.weight *= CentralWeight(part, x, y);
	if (turned) {
		candidate.axes = QuarterTurned(image.axes);
		candidate.right = y;
		candidate.up = -x;
	}
	found.push_back(candidate);
	best = std::max(best, candidate.score());
}

/// The best windows of one look at one level, upright or turned, whichever is worth more.
inline void FindWindows(Search& search, const DepthImage& image, const Level& level)
{
	const double weight = level.weight * FacingWeight(image.axes.towards, search.query.depth > 0);
	const double turnedWeight = weight * taste.turnedWeight, pixel = image.grid.pixel;
	FreeArea area = FindFreeArea(search.part, image, RuleFor(level, 0));
	for (int i = 0; i < taste.windowsPerLook; ++i) {
		const auto upright = WindowFor(search.query, area, pixel, taste.roughSlack, false, search.minCapital(weight));
		if (upright) search.best = std::max(search.best, upright->scale * pixel * weight);
		std::optional<FreeWindow> turned;
		const bool mayTurn = search.query.up.SquaredNorm() == 0;
		if (mayTurn && (!upright || search.query.size <= 0)) {
			const double least =
				upright ? upright->scale * pixel / taste.turnedWeight : search.minCapital(turnedWeight);
			turned = WindowFor(search.query, area, pixel, taste.roughSlack, true, least);
		}
		if (!upright && !turned) return;
		search.add(image, turned ? *turned : *upright, level, turned ? turnedWeight : weight, turned.has_value());
		Shape shape = TightShape(search.query);
		if (turned) std::swap(shape.width, shape.height);
		const FreeWindow& window = turned ? *turned : *upright;
		BlockWindow(area, window, std::max(window.scale, search.query.size / pixel), shape);
	}
}

inline void SearchFlat(Search& search)
{
	const Shape tight = TightShape(search.query);
	for (const FlatView& view : FlatViews(search.part)) {
		const double weight = FacingWeight(view.towards, search.query.depth > 0);
		const double atMost = std::sqrt(view.area / (tight.width * tight.height));  // if all of it made one window
		if (atMost < std::max(search.minCapital(weight), search.query.size)) continue;
		ViewAxes axes = UprightAxes(view.towards, search.query.up);
		if (search.query.up.SquaredNorm() == 0) axes = AlignedAxes(search.part, axes, std::cos(flatDegrees * degree));
		const PixelGrid grid = GridOverPart(search.part, axes, search.effort.pixels, maxPixelsPerSide);
		FindWindows(search, Look(search.part, axes, grid), flatLevel);
	}
}

inline void SearchCurved(Search& search)
{
	for (const vcg::Point3d& towards : RoundDirections()) {
		const ViewAxes axes = UprightAxes(towards, search.query.up);
		const PixelGrid grid = GridOverPart(search.part, axes, search.effort.pixels, maxPixelsPerSide);
		const DepthImage image = Look(search.part, axes, grid);
		for (const Level& level : curvedLevels) FindWindows(search, image, level);
	}
}

}  // namespace detail

/// Flat, and large enough to be preferred to any curved place.
inline bool IsGood(const PlaceQuery& query, const Part& part, const Candidate& candidate)
{
	if (!candidate.level.flat) return false;
	const double diagonal = candidate.capital * std::hypot(query.labelWidth, query.labelHeight);
	return query.size > 0 || diagonal >= taste.goodTextShare * part.diagonal;
}

/// For when the quick search was in vain: every direction, and pixels small enough to see a place of the wanted size.
inline Effort ThoroughEffort(const PlaceQuery& query, const Part& part)
{
	const Shape tight = detail::TightShape(query);
	const double across = part.diagonal / (query.size * std::min(tight.width, tight.height));
	const double needed = std::pow(across * pixelsForWanted, 2);
	return {query.size > 0 ? std::clamp(needed, quickEffort.pixels, mostPixels) : thoroughPixels, 0.05, true};
}

/// Windows that can hold the text, as far as one sees from afar; in no order.
inline std::vector<Candidate> FindCandidates(const PlaceQuery& query, const Part& part, const Effort& effort)
{
	detail::Search search{query, part, effort, {}, 0};
	detail::SearchFlat(search);
	const auto good = std::count_if(search.found.begin(), search.found.end(),
	                                [&](const Candidate& c) { return IsGood(query, part, c); });
	if (effort.alwaysCurved || size_t(good) < taste.enoughGood) detail::SearchCurved(search);
	return std::move(search.found);
}

/// Look once more, from near: where exactly is the largest window there? Nothing when it was a trick of coarse pixels.
inline std::optional<Candidate> Sharpened(const PlaceQuery& query, const Part& part, const Candidate& candidate)
{
	const Shape shape = detail::AiryShape(query);
	const double size = std::max(candidate.capital, query.size), around = 4 * candidate.pixel;
	const double width = size * shape.width + 2 * around, height = size * shape.height + 2 * around;
	PixelGrid grid;
	grid.pixel = std::sqrt(width * height / quickEffort.pixels);
	grid.width = 2 * detail::Reach(width / grid.pixel) + 1;
	grid.height = 2 * detail::Reach(height / grid.pixel) + 1;
	grid.left = candidate.right - grid.pixel * (grid.width / 2);
	grid.bottom = candidate.up - grid.pixel * (grid.height / 2);
	const DepthImage image = Look(part, candidate.axes, grid);
	const FreeArea area = FindFreeArea(part, image, detail::RuleFor(candidate.level, 0));
	const std::optional<FreeWindow> window = detail::WindowFor(query, area, grid.pixel, taste.centeringSlack, false, 0);
	if (!window) return std::nullopt;
	Candidate sharp = candidate;
	sharp.right = grid.left + window->x * grid.pixel;
	sharp.up = grid.bottom + window->y * grid.pixel;
	sharp.capital = window->scale * grid.pixel;
	sharp.pixel = grid.pixel;
	sharp.sharp = true;
	return sharp;
}

}  // namespace textlabel
