#pragma once
// What can be wrong with a text, its font or its options.
//
// MakeTextOutline throws a TextError: a code with the data that belongs to it. Sentence() says in one place what is
// wrong, where, and what to do about it.

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace textlabel {

enum class TextErrorCode {
	// the text
	EmptyText,      ///< nothing to cut: no character, or only blanks
	BadUtf8,        ///< `offset`: first byte that is not UTF-8
	TextTooLong,    ///< `value` letters, `limit` allowed
	MissingGlyphs,  ///< `codePoints`: characters that `font` does not have
	BadCode,        ///< the code `substitute` cannot hold the text; `detail` says why
	NoOutlines,  ///< `codePoints`: characters that `font` has as pictures only, or empty (`codePoints` empty: all of them)
	// the drawing
	DrawingUnreadable,   ///< no such file, no SVG, or not as its grammar has it: `detail` says why
	DrawingUnsupported,  ///< it holds `detail`, "text" or "a mask", on line `value`, which cannot be cut as it looks
	DrawingEmpty,        ///< it paints nothing
	DrawingAndCode,      ///< both were asked for
	// the font
	FontNotFound,     ///< no such file, or Fontconfig knows no font at all
	FontSubstituted,  ///< no such family or style; `substitute` is what Fontconfig would take instead
	NotAFont,         ///< a file, or folder, that FreeType cannot read as a font; `detail` says why
	NoUnicodeMap,     ///< a font that does not say which glyph is which character
	BadFace,          ///< face number `value` of a file that has `limit` faces
	BadAxis,  ///< `detail`: a design axis or a value that the font does not have; `substitute`: those that it has
	// the options
	BadSize,       ///< capital height or width to fit not a positive finite number: `value`
	BadTolerance,  ///< chord error negative, not a number, or too coarse for the letters: `value`, `limit`
	BadSpacing,    ///< line or letter spacing not finite or out of range: `value`, `least`, `limit`
	BadSlant,      ///< degrees: `value`, at most `limit` either way
	BadEmbolden,   ///< `value` larger than `limit`, which is `detail`, or not finite (`limit` 0)
	BadArc,      ///< radius `value`: not finite (`limit` 0), or the text does not fit; `limit` is the least that works
	BadFeature,  ///< `detail`: not an OpenType feature setting
	BadPrintLimit,  ///< smallest stroke or gap asked for is negative or not a number: `value`
	// the result
	TooThin,  ///< `letters` have strokes or gaps below what was asked; `value` measured, `limit` asked, `size` or `fitWidth` would do
	LetterBroken,    ///< `letters` come apart, or lose a piece, when they are thinned so much
	LetterVanished,  ///< `letters` have nothing left after thinning them or at so coarse a tolerance
	Unsound          ///< the outline could not be made simple polygons
};

/// What is wrong, with the data to say it.
struct TextError : std::exception {
	TextErrorCode code;
	std::string font;                  ///< as asked for, or the file that was read; empty = the built-in font
	std::string drawing;               ///< the drawing's file
	std::string substitute;            ///< see the code
	std::string detail;                ///< the piece of input, or what a library said
	std::vector<char32_t> codePoints;  ///< each once, in order of appearance
	std::vector<std::string> letters;  ///< UTF-8, each once; of a code and a drawing none
	std::size_t offset = 0;            ///< byte of the text
	double value = 0, limit = 0;       ///< measured and allowed, see the code
	double least = 0;                  ///< lowest allowed, of BadSpacing; `limit` is the highest
	double size = 0;                   ///< capital height that would do, mesh units; infinite = none
	double fitWidth = 0;               ///< width to fit that would do, where one was asked for; else 0
	bool hasFallback = false;          ///< other installed fonts were searched too
	bool isCode = false;               ///< what is too thin are the modules of a code

	explicit TextError(TextErrorCode c, std::string d = {}) : code(c), detail(std::move(d)) {}
	TextError& ofFont(std::string f)
	{
		font = std::move(f);
		return *this;
	}
	TextError& ofDrawing(std::string file)
	{
		drawing = std::move(file);
		return *this;
	}
	TextError& insteadOf(std::string s)
	{
		substitute = std::move(s);
		return *this;
	}
	TextError& measured(double v, double l)
	{
		value = v;
		limit = l;
		return *this;
	}
	TextError& notBelow(double l)
	{
		least = l;
		return *this;
	}
	const char* what() const noexcept override { return detail.c_str(); }
};

/// The error as text for a person: what is wrong, where, and the remedy.
std::string Sentence(const TextError& error);

/// "U+0041 LATIN CAPITAL LETTER A"; without the name where it is not at hand.
std::string CodePointName(char32_t codePoint);

}  // namespace textlabel
