#include "text_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include "code_outline.h"
#include "drawing_outline.h"
#include "outline_flatten.h"
#include "outline_measure.h"
#include "outline_unite.h"
#include "text_layout.h"
#include "text_shape.h"
#include "text_utf8.h"

namespace textlabel {
namespace {

constexpr double kRadian = 3.14159265358979323846 / 180;
/// A size that fits the width by this share needs no more fitting.
constexpr double kFitted = 1e-6;
constexpr double kMostSlant = 60;                                     ///< degrees
constexpr double kMostLineSpacing = 100;                              ///< times the line height
constexpr double kLeastLetterSpacing = -1, kMostLetterSpacing = 100;  ///< times the capital height
constexpr double kMostEmbolden = 1;                                   ///< times the capital height
/// How far to look for what faces an edge, times the capital height: wider is no narrow place.
constexpr double kMeasureReach = 2;
/// Most characters that may be written for kMostLetters: with the breaks, their backslashes, and blanks at lines' ends.
constexpr std::size_t kMostWritten = 4 * kMostLetters;
/// Most points of all letters, and most pieces of their curves: a font can have tens of thousands in each glyph.
constexpr std::size_t kMostPoints = 4000000;

void RequirePositive(double value, const char* what)
{
	if (!(value > 0) || !std::isfinite(value)) throw TextError(TextErrorCode::BadSize, what).measured(value, 0);
}

void RequireFinite(double value, TextErrorCode code)
{
	if (!std::isfinite(value)) throw TextError(code).measured(value, 0);
}

/// A finite value in a range, or the error.
void Require(double value, double low, double high, TextErrorCode code, const char* what)
{
	if (!(value >= low && value <= high))
		throw TextError(code, what).measured(value, std::max(std::abs(low), high)).notBelow(low);
}

void CheckOptions(const TextOptions& options)
{
	const double infinity = std::numeric_limits<double>::max();
	if (options.fitWidth != 0) RequirePositive(options.fitWidth, "fitWidth");
	else RequirePositive(options.size, "size");
	Require(options.lineSpacing, 0, kMostLineSpacing, TextErrorCode::BadSpacing, "lineSpacing");
	Require(options.letterSpacing, kLeastLetterSpacing, kMostLetterSpacing, TextErrorCode::BadSpacing, "letterSpacing");
	Require(options.slant, -kMostSlant, kMostSlant, TextErrorCode::BadSlant, "");
	RequireFinite(options.arcRadius, TextErrorCode::BadArc);
	RequireFinite(options.embolden, TextErrorCode::BadEmbolden);
	Require(options.minStroke, 0, infinity, TextErrorCode::BadPrintLimit, "minStroke");
	Require(options.minGap, 0, infinity, TextErrorCode::BadPrintLimit, "minGap");
	if (!(options.tolerance >= 0)) throw TextError(TextErrorCode::BadTolerance).measured(options.tolerance, 0);
}

/// Characters, each once, in order of appearance.
std::vector<char32_t> EachOnce(const std::u32string& text)
{
	std::vector<char32_t> result;
	for (const char32_t c : text) {
		if (std::find(result.begin(), result.end(), c) == result.end()) result.push_back(c);
	}
	return result;
}

void CheckLength(std::size_t characters, std::size_t most)
{
	if (characters > most)
		throw TextError(TextErrorCode::TextTooLong).measured(static_cast<double>(characters), kMostLetters);
}

std::vector<ShapedLine> ShapeText(const std::string& utf8, FontStack& fonts, const TextOptions& options)
{
	// what is far too long is not even decoded; each character has one byte that does not continue another
	CheckLength(
		static_cast<std::size_t>(std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xC0) != 0x80; })),
		kMostWritten);
	const std::vector<std::u32string> lines = SplitLines(DecodeUtf8(utf8));
	std::size_t characters = 0;
	bool hasInk = false;
	for (const std::u32string& line : lines) {
		characters += line.size();
		hasInk = hasInk || !std::all_of(line.begin(), line.end(), IsBlank);
	}
	CheckLength(std::max(characters, lines.size()), kMostLetters);
	if (!hasInk) throw TextError(TextErrorCode::EmptyText);
	ShapeOptions shapeOptions{options.language, ParseFeatures(options.features)};
	// letters that are set apart are not to be tied together
	if (options.letterSpacing != 0) {
		for (hb_feature_t& f : ParseFeatures("-liga,-clig"))
			shapeOptions.features.insert(shapeOptions.features.begin(), f);
	}
	std::vector<ShapedLine> shaped;
	std::size_t glyphs = 0;
	for (const std::u32string& line : lines) {
		shaped.push_back(ShapeLine(line, fonts, shapeOptions));
		for (const ShapedItem& item : shaped.back().items) glyphs += item.glyphs.size();
		CheckGlyphCount(glyphs);
	}
	return shaped;
}

void CheckGlyphs(const std::vector<ShapedLine>& lines, const FontStack& fonts)
{
	std::u32string missing, withoutOutline;
	for (const ShapedLine& line : lines) {
		missing += line.missing;
		withoutOutline += line.withoutOutline;
	}
	if (missing.empty() && withoutOutline.empty()) return;
	TextError error(missing.empty() ? TextErrorCode::NoOutlines : TextErrorCode::MissingGlyphs);
	error.hasFallback = fonts.mayFallBack();
	error.ofFont(fonts.main().name()).codePoints = EachOnce(missing.empty() ? withoutOutline : missing);
	throw error;
}

/// The curves of each glyph of a text, loaded once; em.
class Glyphs {
public:
	explicit Glyphs(const FontStack& fonts) : m_fonts(fonts) {}

	const std::vector<CurveContour>& operator()(const PlacedGlyph& g)
	{
		const auto [it, isNew] = m_curves.try_emplace({g.font, g.glyph});
		if (isNew) it->second = m_fonts[g.font].glyph(g.glyph);
		return it->second;
	}

private:
	const FontStack& m_fonts;
	std::map<std::pair<int, unsigned>, std::vector<CurveContour>> m_curves;
};

/// What a text may take of the memory, in points.
class Budget {
public:
	void spend(std::size_t points)
	{
		if (points > m_left)
			throw TextError(TextErrorCode::Unsound, "it takes more than " + std::to_string(kMostPoints) + " points");
		m_left -= points;
	}

private:
	std::size_t m_left = kMostPoints;
};

vcg::Box2d InkBox(const std::vector<PlacedGlyph>& placed, const Affine& form, Glyphs& glyphs)
{
	vcg::Box2d box;
	Budget budget;
	for (const PlacedGlyph& g : placed) {
		const std::vector<CurveContour>& curves = glyphs(g);
		for (const CurveContour& contour : curves) budget.spend(contour.size());
		box.Add(BoxOf(Mapped(curves, g.place.after(form))));
	}
	return box;
}

LayoutOptions LayoutOptionsFor(const TextOptions& options, double size, double em)
{
	LayoutOptions layout;
	layout.em = em;
	layout.align = options.align;
	layout.lineSpacing = options.lineSpacing;
	layout.letterSpacing = options.letterSpacing * size;
	layout.slant = options.slant * kRadian;
	layout.arcRadius = options.arcRadius;
	return layout;
}

/// Capital height that makes the ink, laid straight, as wide as asked for.
/// @param[in] overhang  what emboldening adds to the width
double SizeToFit(const std::vector<ShapedLine>& lines, const FontStack& fonts, Glyphs& glyphs,
                 const TextOptions& options, double overhang)
{
	LayoutOptions layout = LayoutOptionsFor(options, 1, 1 / fonts.main().capitalHeight());
	layout.arcRadius = 0;
	const vcg::Box2d box = InkBox(Layout(lines, fonts, layout), FormOf(layout), glyphs);
	if (box.IsNull()) throw TextError(TextErrorCode::EmptyText);
	const double size = (options.fitWidth - overhang) / box.DimX();
	if (!(size > 0) || !std::isfinite(size))
		throw TextError(TextErrorCode::BadSize, "fitWidth").measured(options.fitWidth, overhang);
	return size;
}

/// Flatten the placed glyphs, letter by letter. A glyph is flattened once and then moved: its chord error moves with
/// it.
std::vector<LetterRings> RingsOf(const std::vector<PlacedGlyph>& placed, const Affine& form, const Affine& last,
                                 Glyphs& glyphs, double tolerance)
{
	std::map<std::pair<int, unsigned>, std::vector<Ring>> flat;
	std::map<int, LetterRings> ofLetter;
	Budget budget;
	for (const PlacedGlyph& g : placed) {
		const auto [it, isNew] = flat.try_emplace({g.font, g.glyph});
		if (isNew) {
			for (const CurveContour& contour : Mapped(glyphs(g), form)) {
				it->second.push_back(Flatten(contour, tolerance));
				budget.spend(it->second.back().size());
			}
		}
		const Affine map = last.after(g.place);
		LetterRings& letter = ofLetter[g.letter];
		letter.isJoined = g.isJoined;
		for (const Ring& ring : it->second) {
			if (ring.empty()) continue;
			budget.spend(ring.size());
			Ring& moved = letter.rings.emplace_back(ring);
			std::transform(moved.begin(), moved.end(), moved.begin(), map);
		}
	}
	std::vector<LetterRings> letters;
	for (auto& [index, letter] : ofLetter) {
		letter.letter = index;
		if (!letter.rings.empty()) letters.push_back(std::move(letter));
	}
	return letters;
}

/// Factor for the letters that brings a width, of which `fixed` does not grow with them, to what was asked for;
/// infinite when none does.
double GrowthFor(double width, double asked, double fixed)
{
	return width > fixed ? (asked - fixed) / (width - fixed) : std::numeric_limits<double>::infinity();
}

void CheckPrintable(const std::vector<LetterWidths>& widths, const TextOutline& text, const TextOptions& options)
{
	TextError error(TextErrorCode::TooThin);
	double growth = 0;
	const auto check = [&](double width, double asked, double fixed, const char* what) {
		if (width == 0 || width >= asked) return false;
		if (growth == 0 || width / asked < error.value / error.limit) error.measured(width, asked).detail = what;
		growth = std::max(growth, GrowthFor(width, asked, fixed));
		return true;
	};
	for (std::size_t i = 0; i < widths.size(); ++i) {
		const bool thin = check(widths[i].stroke, options.minStroke, 2 * options.embolden, "stroke");
		const bool tight = check(widths[i].gap, options.minGap, -2 * options.embolden, "gap");
		if (text.letters.empty()) continue;
		const std::string& letter = text.letters[i];
		const bool isNew = std::find(error.letters.begin(), error.letters.end(), letter) == error.letters.end();
		if ((thin || tight) && isNew) error.letters.push_back(letter);
	}
	if (growth == 0) return;
	error.isCode = text.module > 0;
	error.size = growth * text.capitalHeight;
	const double fixed = 2 * options.embolden;
	if (options.fitWidth > 0) error.fitWidth = fixed + growth * (options.fitWidth - fixed);
	throw error;
}

vcg::Box2d BoxOf(const vcg::textlabel::Outline& outline)
{
	vcg::Box2d box;
	for (const vcg::textlabel::Contour& contour : outline.contours) {
		for (const vcg::Point2d& p : contour.points) box.Add(p);
	}
	return box;
}

void Measure(TextOutline& text, const TextOptions& options)
{
	const auto letterCount = static_cast<int>(text.letters.size());  // of a code and a drawing none: they are one piece
	std::vector<LetterWidths> widths;
	if (text.module > 0) widths = {{text.module + 2 * options.embolden, text.module - 2 * options.embolden}};
	else widths = MeasureWidths(text.outline, std::max(letterCount, 1), kMeasureReach * text.capitalHeight);
	const auto keepLess = [letterCount](Narrowest& least, double width, std::size_t letter) {
		if (width > 0 && (least.width == 0 || width < least.width))
			least = {width, letterCount > 0 ? static_cast<int>(letter) : -1};
	};
	for (std::size_t i = 0; i < widths.size(); ++i) {
		keepLess(text.thinnestStroke, widths[i].stroke, i);
		keepLess(text.narrowestGap, widths[i].gap, i);
	}
	const vcg::Box2d box = BoxOf(text.outline);
	text.boxMin = box.min, text.boxMax = box.max;
	CheckPrintable(widths, text, options);
}

void RequireNone(const std::vector<int>& letters, TextErrorCode code, const TextOutline& text)
{
	if (letters.empty()) return;
	TextError error(code);
	for (const int i : letters) {
		const std::string& letter = text.letters[static_cast<std::size_t>(i)];
		if (std::find(error.letters.begin(), error.letters.end(), letter) == error.letters.end())
			error.letters.push_back(letter);
	}
	throw error;
}

/// A corner that is emboldened stands out by more than the distance: the anchor comes to the ink as it is.
void MoveToAnchor(vcg::textlabel::Outline& outline, const TextOptions& options)
{
	vcg::Box2d ink = BoxOf(outline);
	if (options.mirrored) ink = vcg::Box2d({-ink.max[0], ink.min[1]}, {-ink.min[0], ink.max[1]});
	vcg::Point2d anchor = AnchorOf(ink, options.align, options.anchor);
	if (options.mirrored) anchor[0] = -anchor[0];
	for (vcg::textlabel::Contour& contour : outline.contours) {
		for (vcg::Point2d& p : contour.points) p -= anchor;
	}
}

/// Letters that have nothing left, and those that have come apart.
struct SpoiltLetters {
	std::vector<int> vanished, broken;
};

/// Lay out, unite and anchor a shaped text at a capital height.
/// @param[in,out] text  letters are there
/// @return letters that emboldening has spoilt
SpoiltLetters SetAt(double size, const std::vector<ShapedLine>& lines, const FontStack& fonts, Glyphs& glyphs,
                    const TextOptions& options, TextOutline& text)
{
	text.capitalHeight = size;
	text.tolerance = CheckedTolerance(options.tolerance, size, kDefaultTolerance);
	const LayoutOptions layout = LayoutOptionsFor(options, size, size / fonts.main().capitalHeight());
	const Affine form = FormOf(layout);
	const std::vector<PlacedGlyph> placed = Layout(lines, fonts, layout);
	const vcg::Box2d ink = InkBox(placed, form, glyphs);
	if (ink.IsNull()) throw TextError(TextErrorCode::EmptyText);
	const vcg::Point2d anchor = AnchorOf(ink, options.align, options.anchor);
	const double side = options.mirrored ? -1 : 1;
	const Affine toAnchor{side, 0, 0, 1, -side * anchor[0], -anchor[1]};
	United united =
		UniteLetters(RingsOf(placed, form, toAnchor, glyphs, text.tolerance), {text.tolerance, options.embolden});
	text.outline = std::move(united.outline);
	if (options.embolden != 0 && !text.outline.contours.empty()) MoveToAnchor(text.outline, options);
	return {std::move(united.vanished), std::move(united.broken)};
}

/// The fonts that have a glyph in a text, by their descriptions.
std::vector<std::string> FontsOf(const std::vector<ShapedLine>& lines, const FontStack& fonts)
{
	std::vector<char> isUsed(static_cast<std::size_t>(fonts.size()), 0);
	for (const ShapedLine& line : lines) {
		for (const ShapedItem& item : line.items) {
			for (const ShapedGlyph& g : item.glyphs) {
				if (fonts[item.font].hasInk(g.glyph)) isUsed[static_cast<std::size_t>(item.font)] = 1;
			}
		}
	}
	std::vector<std::string> used;
	for (int i = 0; i < fonts.size(); ++i) {
		if (isUsed[static_cast<std::size_t>(i)]) used.push_back(fonts[i].description());
	}
	return used;
}

TextOutline SetInLetters(const std::string& utf8, const TextOptions& options)
{
	FontStack fonts(options.font, options.fallbackFonts);
	const std::vector<ShapedLine> lines = ShapeText(utf8, fonts, options);
	CheckGlyphs(lines, fonts);
	Glyphs glyphs(fonts);
	TextOutline text;
	text.letters = LettersOf(lines);
	text.fonts = FontsOf(lines, fonts);
	const auto sizeWith = [&](double overhang) { return SizeToFit(lines, fonts, glyphs, options, overhang); };
	const auto checkEmbolden = [&] {
		const double most = kMostEmbolden * text.capitalHeight;
		if (std::abs(options.embolden) > most)
			throw TextError(TextErrorCode::BadEmbolden, "the capital height").measured(options.embolden, most);
	};
	text.capitalHeight = options.fitWidth > 0 ? sizeWith(2 * options.embolden) : options.size;
	checkEmbolden();  // first: what is far out of range takes long
	SpoiltLetters spoilt = SetAt(text.capitalHeight, lines, fonts, glyphs, options, text);
	if (options.fitWidth > 0 && options.embolden != 0 && options.arcRadius == 0) {
		// how far the corners at the ends stand out depends on the font; not on the size, but for which of them are the ends
		constexpr int rounds = 3;
		const double inkWidth = (options.fitWidth - 2 * options.embolden) / text.capitalHeight;  // at size 1
		for (int round = 0; round < rounds && !text.outline.contours.empty(); ++round) {
			const double overhang = BoxOf(text.outline).DimX() - inkWidth * text.capitalHeight;
			const double size = sizeWith(overhang);
			if (std::abs(size - text.capitalHeight) <= kFitted * size) break;
			spoilt = SetAt(size, lines, fonts, glyphs, options, text);
		}
		checkEmbolden();
	}
	RequireNone(spoilt.vanished, TextErrorCode::LetterVanished, text);
	RequireNone(spoilt.broken, TextErrorCode::LetterBroken, text);
	if (text.outline.contours.empty()) throw TextError(TextErrorCode::EmptyText);
	return text;
}

TextOutline SetAndMeasure(const std::string& utf8, const TextOptions& options)
{
	const bool isDrawing = !options.drawing.empty(), isCode = options.code != CodeKind::None;
	TextOutline text = isDrawing ? SetAsDrawing(options)
	                   : isCode  ? SetAsCode(utf8, options)
	                             : SetInLetters(utf8, options);
	Measure(text, options);
	return text;
}

/// Try the size that a refusal names, and a larger one where it does not do: corners that embolden has moved, and gaps on an arc,
/// do not grow with the letters. None is named where none is found.
void ProveSize(const std::string& utf8, TextOptions options, TextError& error)
{
	constexpr int rounds = 8;
	constexpr double more = 1.002;  // so that it is reached, not only come near to
	double& asked = options.fitWidth > 0 ? options.fitWidth : options.size;
	double& named = options.fitWidth > 0 ? error.fitWidth : error.size;
	for (int round = 0; round < rounds && std::isfinite(named) && named > asked; ++round) {
		asked = named;
		try {
			SetAndMeasure(utf8, options);
			return;
		} catch (const TextError& again) {
			if (again.code != TextErrorCode::TooThin) break;
			error.size = more * again.size;
			error.fitWidth = more * again.fitWidth;
		}
	}
	named = error.size = std::numeric_limits<double>::infinity();
}

}  // namespace

TextOutline MakeTextOutline(const std::string& utf8, const TextOptions& options)
{
	CheckOptions(options);
	try {
		return SetAndMeasure(utf8, options);
	} catch (TextError& error) {
		if (error.code == TextErrorCode::TooThin && (options.embolden != 0 || options.arcRadius != 0))
			ProveSize(utf8, options, error);
		throw;
	}
}

}  // namespace textlabel
