#include "text_error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <iterator>
#include "text_utf8.h"
#if TEXTLABEL_ICU
#include <unicode/uchar.h>
#endif

namespace textlabel {
namespace {

/// Most characters or letters that a sentence lists.
constexpr std::size_t kMostListed = 20;

std::string Number(double value)
{
	constexpr int kDigits = 4;
	char text[32];
	return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::general, kDigits).ptr};
}

/// Half of the last of four digits, relative to the smallest number that has them.
constexpr double kHalfDigit = 1.0005;

/// A number to stay above: rounded up, so that what is printed will do.
std::string NumberAbove(double value) { return Number(value * kHalfDigit); }

/// A number not to exceed: rounded down where rounding to the nearest would exceed it.
std::string NumberBelow(double value)
{
	std::string text = Number(value);
	double printed = 0;
	std::from_chars(text.data(), text.data() + text.size(), printed);
	return printed <= value ? text : Number(value / kHalfDigit);
}

/// A number of things.
std::string Count(double value) { return std::to_string(static_cast<long long>(value)); }

template <class Items, class Show>
std::string Listed(const Items& items, Show show)
{
	std::string text;
	for (std::size_t i = 0; i < items.size(); ++i) {
		if (i == kMostListed) return text + " and " + std::to_string(items.size() - i) + " more";
		text += (i ? ", " : "") + show(items[i]);
	}
	return text;
}

std::string Quoted(const std::string& s) { return "\"" + s + "\""; }

std::string Characters(const TextError& e)
{
	return Listed(e.codePoints, [](char32_t c) {
		return (IsBlank(c) ? std::string() : Quoted(EncodeUtf8({&c, 1})) + " ") + CodePointName(c);
	});
}

/// The letters that are wrong; of a drawing, which has none, the drawing.
std::string Letters(const TextError& e) { return e.letters.empty() ? "the drawing" : Listed(e.letters, Quoted); }

/// What there is a bolder one of.
std::string Kind(const TextError& e) { return e.letters.empty() ? "drawing" : "font"; }

std::string Font(const TextError& e) { return e.font.empty() ? "the built-in font" : "font " + Quoted(e.font); }

std::string Because(const TextError& e) { return e.detail.empty() ? "" : " (" + e.detail + ")"; }

std::string TextSentence(const TextError& e)
{
	switch (e.code) {
	case TextErrorCode::EmptyText:
		return "The text has nothing to cut, only blanks: write at least one visible letter.";
	case TextErrorCode::BadUtf8:
		return "The text is not UTF-8 at byte " + std::to_string(e.offset) + ": save it, or send it, as UTF-8.";
	case TextErrorCode::TextTooLong:
		return "The text has " + Count(e.value) + " characters, at most " + Count(e.limit) + " can be set: shorten it.";
	case TextErrorCode::MissingGlyphs:
		return "No glyph in " + Font(e) + (e.hasFallback ? ", nor in any other that is installed," : "") + " for " +
		       Characters(e) + ": choose a font that has them, or " +
		       (e.hasFallback ? "write the text without them." : "set fallback_fonts=true.");
	case TextErrorCode::NoOutlines:
		return "There are no outlines to cut in " + Font(e) +
		       (e.codePoints.empty()
		            ? std::string(", only bitmaps")
		            : " for " + Characters(e) + ", but a picture (bitmap or colour layers), a bare line or nothing") +
		       ": choose a font with outlines.";
	case TextErrorCode::BadCode:
		return "The text cannot be written as " + e.substitute + Because(e) + ": shorten it, or choose another code.";
	default: return {};
	}
}

std::string DrawingSentence(const TextError& e)
{
	const std::string drawing = e.drawing.empty() ? "drawing" : "drawing " + Quoted(e.drawing);
	switch (e.code) {
	case TextErrorCode::DrawingUnreadable:
		return "Cannot read the " + drawing + Because(e) + ": give an SVG file that is whole.";
	case TextErrorCode::DrawingUnsupported:
		return "The " + drawing + " has " + e.detail + " on line " + Count(e.value) +
		       ", which cannot be cut: turn it into plain filled paths in the program that drew it.";
	case TextErrorCode::DrawingEmpty:
		return "The " + drawing +
		       " paints nothing that could be cut: give one with shapes that are filled or drawn as lines.";
	case TextErrorCode::DrawingAndCode:
		return "A drawing and a code are asked for at once: leave one of them away, and put it on as a label of its "
			   "own.";
	default: return {};
	}
}

std::string FontSentence(const TextError& e)
{
	switch (e.code) {
	case TextErrorCode::FontNotFound:
		return "Found no " + Font(e) + Because(e) + ": check the name; fc-list shows the installed families.";
	case TextErrorCode::FontSubstituted:
		return "No " + Font(e) + " is installed; the nearest is " + Quoted(e.substitute) +
		       ": install it, or write the name of an installed one (fc-list shows them).";
	case TextErrorCode::NotAFont:
		return "Cannot read " + Font(e) + Because(e) + ": give a TrueType, OpenType or Type 1 file that is whole.";
	case TextErrorCode::NoUnicodeMap:
		return "In " + Font(e) + " nothing says which glyph is which character: choose a font with a Unicode map.";
	case TextErrorCode::BadFace:
		return "There is no face " + (e.detail.empty() ? Count(e.value) : e.detail) + " in " + Font(e) +
		       (e.limit > 0 ? ", which has " + Count(e.limit) + ", counted from 0" : "") +
		       ": change the number after #.";
	case TextErrorCode::BadAxis:
		return "The setting " + Quoted(e.detail) + (e.font.empty() ? "" : " does not fit " + Font(e)) + ": " +
		       (e.substitute.empty() ? "write axis=number for an axis that the font varies in, as in Inter:wght=650."
		                             : "it varies in " + e.substitute + ".");
	default: return {};
	}
}

std::string OptionSentence(const TextError& e)
{
	const std::string value = Number(e.value), limit = Number(e.limit);
	switch (e.code) {
	case TextErrorCode::BadSize:
		return "The " + std::string(e.detail == "fitWidth" ? "width to fit" : "size") + " is " + value +
		       ": give a positive length" + (e.limit > 0 ? ", larger than " + NumberAbove(e.limit) + " here." : ".");
	case TextErrorCode::BadTolerance:
		return "The tolerance " + value + " does not suit this text" + Because(e) + ": " +
		       (e.limit > 0 ? std::string(e.value < e.limit ? "at least " + NumberAbove(e.limit)
		                                                    : "at most " + NumberBelow(e.limit)) +
		                          " does."
		                    : "give a length that is not negative; 0 chooses one.");
	case TextErrorCode::BadSpacing:
		return "The " + std::string(e.detail == "lineSpacing" ? "line" : "letter") + " spacing is " + value +
		       ": give a factor from " + Number(e.least) + " to " + limit + ".";
	case TextErrorCode::BadSlant: return "The slant is " + value + " degrees: give at most " + limit + " either way.";
	case TextErrorCode::BadEmbolden:
		return "Emboldening by " + value + " is out of range: give " +
		       (e.limit > 0 ? "at most " + NumberBelow(e.limit) + (e.detail.empty() ? "" : ", " + e.detail + ",") +
		                          " either way."
		                    : "a length.");
	case TextErrorCode::BadArc:
		if (!(e.limit > 0)) return "The radius of the arc is " + value + ": give a length; 0 is a straight line.";
		return "The text does not fit on an arc of radius " + value + ": give a radius of " +
		       (e.value < 0 ? "-" + NumberAbove(e.limit) + " or below" : NumberAbove(e.limit) + " or more") +
		       ", or make the text smaller.";
	case TextErrorCode::BadFeature:
		return Quoted(e.detail) + " is no OpenType feature setting: write them as in tnum,ss01,-liga.";
	case TextErrorCode::BadPrintLimit:
		return "The smallest " + std::string(e.detail == "minStroke" ? "stroke" : "gap") + " is " + value +
		       ": give a length that is not negative; 0 does not check.";
	default: return {};
	}
}

/// The text that is large enough, as an advice before another one.
std::string LargerText(const TextError& e)
{
	if (!std::isfinite(e.size)) return {};
	return e.fitWidth > 0 ? "fit_width=" + NumberAbove(e.fitWidth) + " or "
	                      : "a size of " + NumberAbove(e.size) + " or ";
}

std::string ResultSentence(const TextError& e)
{
	switch (e.code) {
	case TextErrorCode::TooThin:
		if (e.isCode)
			return "The " + std::string(e.detail == "gap" ? "light" : "dark") + " modules of the code measure " +
			       Number(e.value) + ", where " + Number(e.limit) + " is asked for: " + LargerText(e) +
			       "a shorter text would do.";
		return "The narrowest " + e.detail + " measures " + Number(e.value) + ", where " + Number(e.limit) +
		       " is asked for (too narrow in " + Letters(e) + "): " + LargerText(e) + "a " +
		       (e.detail == "gap" ? "lighter " : "bolder ") + Kind(e) + " would do.";
	case TextErrorCode::LetterBroken:
		return "Thinning takes " + Letters(e) + " apart: thin less (embolden), or choose a bolder " + Kind(e) + ".";
	case TextErrorCode::LetterVanished:
		return "Nothing is left of " + Letters(e) +
		       " at this tolerance and weight: give a finer tolerance, or thin less.";
	case TextErrorCode::Unsound:
		return "The outline could not be made clean" + Because(e) + ": try another " +
		       (e.drawing.empty() ? "font, size or tolerance." : "size or tolerance, or a simpler drawing.");
	default: return {};
	}
}

}  // namespace

std::string Sentence(const TextError& error)
{
	for (const auto sentence : {TextSentence, DrawingSentence, FontSentence, OptionSentence, ResultSentence}) {
		std::string text = sentence(error);
		if (!text.empty()) return text;
	}
	return error.detail;
}

std::string CodePointName(char32_t codePoint)
{
	char text[16];
	std::snprintf(text, sizeof text, "U+%04X", static_cast<unsigned>(codePoint));
	std::string name = text;
#if TEXTLABEL_ICU
	constexpr int kLongestName = 128;
	char words[kLongestName];
	UErrorCode status = U_ZERO_ERROR;
	const int length = u_charName(static_cast<UChar32>(codePoint), U_EXTENDED_CHAR_NAME, words, kLongestName, &status);
	if (U_SUCCESS(status) && length > 0) name += " " + std::string(words);
#endif
	return name;
}

}  // namespace textlabel
