#include "text_layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include "text_utf8.h"

namespace textlabel {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Tab stops, in blanks.
constexpr double kTabStop = 8;

using Items = std::vector<const ShapedItem*>;

/// Index of a letter by its line and first character.
using LetterIndex = std::map<std::pair<std::size_t, int>, int>;

/// First character of every letter of a line, ascending.
std::vector<int> LetterStarts(const ShapedLine& line)
{
	std::vector<int> starts;
	for (const ShapedItem& item : line.items) {
		if (item.isTab) starts.push_back(item.begin);
		for (const ShapedGlyph& glyph : item.glyphs) starts.push_back(glyph.cluster);
	}
	std::sort(starts.begin(), starts.end());
	starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
	return starts;
}

LetterIndex IndexLetters(const std::vector<ShapedLine>& lines)
{
	LetterIndex index;
	for (std::size_t k = 0; k < lines.size(); ++k) {
		for (const int start : LetterStarts(lines[k]))
			index.emplace(std::make_pair(k, start), static_cast<int>(index.size()));
	}
	return index;
}

/// Rule L2 of the bidirectional algorithm: from the highest level down to the lowest odd one, turn every run of that
/// level or higher round.
void OrderVisually(Items& items)
{
	int highest = 0;
	for (const ShapedItem* item : items) highest = std::max(highest, item->level);
	for (int level = highest; level > 0; --level) {
		for (std::size_t i = 0; i < items.size();) {
			std::size_t end = i;
			while (end < items.size() && items[end]->level >= level) ++end;
			std::reverse(items.begin() + static_cast<std::ptrdiff_t>(i),
			             items.begin() + static_cast<std::ptrdiff_t>(end));
			i = end + 1;
		}
	}
}

/// Scripts whose letters hang together, which spacing would tear apart: those with joining types in Unicode, and those with a
/// line at their head.
bool IsJoined(hb_script_t s)
{
	static const hb_script_t kJoined[] = {
		HB_SCRIPT_ARABIC,     HB_SCRIPT_SYRIAC,          HB_SCRIPT_MONGOLIAN,  HB_SCRIPT_NKO,
		HB_SCRIPT_MANDAIC,    HB_SCRIPT_PHAGS_PA,        HB_SCRIPT_MANICHAEAN, HB_SCRIPT_PSALTER_PAHLAVI,
		HB_SCRIPT_ADLAM,      HB_SCRIPT_HANIFI_ROHINGYA, HB_SCRIPT_SOGDIAN,    HB_SCRIPT_CHORASMIAN,
		HB_SCRIPT_DEVANAGARI, HB_SCRIPT_BENGALI,         HB_SCRIPT_GURMUKHI};
	return std::find(std::begin(kJoined), std::end(kJoined), s) != std::end(kJoined);
}

/// The glyphs of one letter, which move and turn together.
struct Cluster {
	const ShapedItem* item;
	std::size_t begin, end;  ///< glyphs of the item
	double advance;          ///< label units
	double spacing;          ///< blank after it
	double x;                ///< from the left end of the line

	int first() const { return item->glyphs[begin].cluster; }  ///< its first character
};

/// One line with its clusters at their places.
struct SetLine {
	std::vector<Cluster> clusters;
	double width = 0;
};

class Setter {
public:
	Setter(const FontStack& fonts, const LayoutOptions& options) : m_fonts(fonts), m_options(options) {}

	SetLine set(const ShapedLine& line) const
	{
		std::vector<SetLine> segments;
		std::vector<double> starts;
		double at = 0;
		const std::vector<int> letters = LetterStarts(line);
		for (const Items& items : segmentsOf(line)) {
			starts.push_back(at);
			segments.push_back(setSegment(items, line.text, letters));
			at = nextTab(at + segments.back().width);
		}
		SetLine result;
		result.width = starts.back() + segments.back().width;
		for (std::size_t k = 0; k < segments.size(); ++k) {
			const double left = line.rightToLeft ? result.width - starts[k] - segments[k].width : starts[k];
			for (Cluster& cluster : segments[k].clusters) {
				cluster.x += left;
				result.clusters.push_back(cluster);
			}
		}
		return result;
	}

private:
	double nextTab(double at) const
	{
		const double stop = kTabStop * m_fonts.main().spaceAdvance() * m_options.em;
		return stop * (std::floor(at / stop) + 1);
	}

	/// What is between the tabs, each in visual order.
	static std::vector<Items> segmentsOf(const ShapedLine& line)
	{
		std::vector<Items> segments(1);
		for (const ShapedItem& item : line.items) {
			if (item.isTab) segments.emplace_back();
			else segments.back().push_back(&item);
		}
		for (Items& items : segments) OrderVisually(items);
		return segments;
	}

	/// @param[in] letters  first characters of the line's letters, ascending
	SetLine setSegment(const Items& items, const std::u32string& text, const std::vector<int>& letters) const
	{
		SetLine segment;
		for (const ShapedItem* item : items) addClusters(*item, segment.clusters);
		double x = 0;
		for (Cluster& cluster : segment.clusters) {
			const bool isHidden = cluster.advance == 0 && IsHidden(cluster.first(), text, letters);
			if (isHidden) cluster.spacing = 0;
			cluster.x = x;
			x += cluster.advance;
			if (!isHidden) segment.width = x;
			x += cluster.spacing;
		}
		return segment;
	}

	/// Are all characters of a letter such as leave no ink?
	static bool IsHidden(int first, const std::u32string& text, const std::vector<int>& letters)
	{
		const auto next = std::upper_bound(letters.begin(), letters.end(), first);
		const auto begin = text.begin() + first, end = next == letters.end() ? text.end() : text.begin() + *next;
		return std::all_of(begin, end, IsBlank);
	}

	void addClusters(const ShapedItem& item, std::vector<Cluster>& clusters) const
	{
		const double spacing = IsJoined(item.script) ? 0 : m_options.letterSpacing;
		for (std::size_t i = 0; i < item.glyphs.size();) {
			Cluster cluster{&item, i, i, 0, spacing, 0};
			while (cluster.end < item.glyphs.size() && item.glyphs[cluster.end].cluster == item.glyphs[i].cluster)
				cluster.advance += m_options.em * item.glyphs[cluster.end++].advance;
			i = cluster.end;
			clusters.push_back(cluster);
		}
	}

	const FontStack& m_fonts;
	const LayoutOptions& m_options;
};

/// Where a line begins, relative to u = 0.
double LineStart(Align align, double width)
{
	return align == Align::Left ? 0 : align == Align::Right ? -width : -width / 2;
}

/// Place of a cluster: its middle at (0, 0) to its place in the label, turned on an arc.
/// @param[in] x  of the middle of the cluster along the baseline
Affine ClusterPlace(double x, double baseline, double arcRadius)
{
	if (arcRadius == 0) return {1, 0, 0, 1, x, baseline};
	const double radius = arcRadius + baseline;
	const double c = std::cos(x / radius), s = std::sin(x / radius);
	// radius (cos - 1), written so that no digits cancel on a wide arc
	const double sink = -2 * radius * std::pow(std::sin(x / radius / 2), 2);
	return {c, s, -s, c, radius * s, baseline + sink};
}

/// Smallest radius of the first baseline at which a line fits on its arc: it may go round once, and letters that hang
/// in a circle need room for their height.
double LeastRadius(double width, double baseline, bool hanging, double capitalHeight)
{
	const double least = std::max(width / (2 * kPi), hanging ? capitalHeight : 0);
	// below the first line, an arc that is stood on gets tighter, one that is hung in gets wider
	return hanging ? least + baseline : least - baseline;
}

/// Put a cluster's glyphs side by side, its middle where `place` has the origin.
/// @param[in] form  see FormOf
void AddGlyphs(const Cluster& cluster, int letter, const Affine& place, const Affine& form,
               std::vector<PlacedGlyph>& placed)
{
	double pen = -cluster.advance / 2;
	for (std::size_t i = cluster.begin; i < cluster.end; ++i) {
		const ShapedGlyph& g = cluster.item->glyphs[i];
		const vcg::Point2d offset = form({g.dx, g.dy});  // a mark leans with its letter
		const Affine local{1, 0, 0, 1, pen + offset[0], offset[1]};
		placed.push_back({cluster.item->font, g.glyph, letter, IsJoined(cluster.item->script), place.after(local)});
		pen += form.xx * g.advance;
	}
}

}  // namespace

Affine FormOf(const LayoutOptions& options)
{
	return {options.em, options.em * std::tan(options.slant), 0, options.em, 0, 0};
}

std::vector<PlacedGlyph> Layout(const std::vector<ShapedLine>& lines, const FontStack& fonts,
                                const LayoutOptions& options)
{
	const LetterIndex letters = IndexLetters(lines);
	const Setter setter(fonts, options);
	const Affine form = FormOf(options);
	std::vector<PlacedGlyph> placed;
	double leastRadius = 0;
	for (std::size_t k = 0; k < lines.size(); ++k) {
		const SetLine line = setter.set(lines[k]);
		const double baseline = -static_cast<double>(k) * options.lineSpacing * fonts.main().lineHeight() * options.em;
		const double capitalHeight = fonts.main().capitalHeight() * options.em;
		leastRadius = std::max(leastRadius, LeastRadius(line.width, baseline, options.arcRadius < 0, capitalHeight));
		const double start = LineStart(options.align, line.width);
		for (const Cluster& cluster : line.clusters) {
			const Affine place = ClusterPlace(start + cluster.x + cluster.advance / 2, baseline, options.arcRadius);
			const int letter = letters.at({k, cluster.first()});
			AddGlyphs(cluster, letter, place, form, placed);
		}
	}
	if (options.arcRadius != 0 && std::abs(options.arcRadius) < leastRadius)
		throw TextError(TextErrorCode::BadArc).measured(options.arcRadius, leastRadius);
	return placed;
}

vcg::Point2d AnchorOf(const vcg::Box2d& ink, Align align, Anchor anchor)
{
	vcg::Point2d place(0, 0);
	if (align == Align::Left) place[0] = ink.min[0];
	if (align == Align::Center) place[0] = (ink.min[0] + ink.max[0]) / 2;
	if (align == Align::Right) place[0] = ink.max[0];
	if (anchor == Anchor::Middle) place[1] = (ink.min[1] + ink.max[1]) / 2;
	if (anchor == Anchor::Top) place[1] = ink.max[1];
	return place;
}

std::vector<std::string> LettersOf(const std::vector<ShapedLine>& lines)
{
	std::vector<std::string> letters;
	for (const ShapedLine& line : lines) {
		const std::vector<int> starts = LetterStarts(line);
		for (std::size_t i = 0; i < starts.size(); ++i) {
			const auto begin = static_cast<std::size_t>(starts[i]);
			const std::size_t end = i + 1 < starts.size() ? static_cast<std::size_t>(starts[i + 1]) : line.text.size();
			letters.push_back(EncodeUtf8(std::u32string_view(line.text).substr(begin, end - begin)));
		}
	}
	return letters;
}

}  // namespace textlabel
