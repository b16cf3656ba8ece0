#pragma once
// Text to outlines: a text and a font in, simple polygons in the label plane out.
//
// The text is set as a text editor sets it: bidirectional order by FriBidi, shaping by HarfBuzz, fonts by FreeType and
// Fontconfig. The curves are flattened at the final size, the letters united into one clean outline. Free of Qt and
// MeshLab, thread-safe; the same input gives the same bytes.

#include <string>
#include <vector>
#include "code_symbol.h"
#include "text_error.h"
#include "vcg_ext/contour.h"

namespace textlabel {

enum class Align { Left, Center, Right };
enum class Anchor { Baseline, Middle, Top };  ///< baseline of the first line; middle or top of the ink

/// How to set a text. Lengths are in mesh units unless said otherwise; 0 stands for "as it is" or "choose".
struct TextOptions {
	/// What to write with; empty = the built-in font.
	///   family:    "DejaVu Sans", "DejaVu Sans:Bold Oblique", "Inter:wght=650" (design axes of a variable font)
	///   file:      "/path/font.ttf", "/path/font.ttc#1" (second face), "/path/font.ttf:wght=650,opsz=32"
	std::string font;
	std::string language;        ///< BCP 47, for forms that differ by language: "ja", "zh-Hant", "sr"; empty = none
	std::string features;        ///< OpenType features, HarfBuzz syntax, comma-separated: "tnum,ss01,-liga"
	bool fallbackFonts = false;  ///< take characters that the font lacks from other installed fonts

	/// In letters, or as a code; then font, language, features, spacing, slant, arc and tolerance play no part.
	CodeKind code = CodeKind::None;

	/// An SVG file that is cut instead of the text; then of these only size, width, tolerance, alignment, embolden and mirrored count.
	std::string drawing;

	double size = 10;      ///< height of the capital letters, of the code's symbol or of the drawing
	double fitWidth = 0;   ///< > 0: width of the ink; the size follows from it (on an arc: along the baseline)
	double tolerance = 0;  ///< largest distance of a curve from its chords; 0 = size / kDefaultTolerance

	Align align = Align::Center;     ///< of the lines to each other, and of the text to the anchor at u = 0
	Anchor anchor = Anchor::Middle;  ///< what is at v = 0
	double lineSpacing = 1;          ///< times the font's own line height
	double letterSpacing = 0;        ///< added between letters, times the capital height
	double slant = 0;                ///< degrees, positive leans to the right
	double embolden = 0;             ///< outline moved outwards by so much; negative thins
	double arcRadius = 0;   ///< of the baseline; positive: letters stand on the circle, negative: they hang in it
	bool mirrored = false;  ///< left and right swapped, for moulds and stamps

	double minStroke = 0;  ///< > 0: refuse letters with a thinner stroke
	double minGap = 0;     ///< > 0: refuse letters with a narrower gap
};

/// Default capital height / tolerance: a circle of capital height gets 32 points.
constexpr double kDefaultTolerance = 400;
/// Longest text, in letters.
constexpr int kMostLetters = 10000;

/// A narrowest place: how wide, in which letter.
struct Narrowest {
	double width = 0;  ///< mesh units; 0 = there is none (one round dot has no gap)
	int letter = -1;   ///< index into TextOutline::letters, or -1
};

/// A text as polygons in the label plane, the anchor at (0, 0), u in reading direction, v up.
struct TextOutline {
	/// Simple, pairwise disjoint (they do not touch either), nested, oriented; no repeated and no redundant point;
	/// each contour starts at its leftmost, then lowest point; parts in reading order of their letters.
	vcg::textlabel::Outline outline;
	/// The clusters of the text that are shaped as one (a letter with its marks, a ligature, a blank), UTF-8, in the
	/// order of the text; Contour::letter is an index into it. A code and a
	/// drawing have none.
	std::vector<std::string> letters;
	vcg::Point2d boxMin{0, 0}, boxMax{0, 0};
	std::vector<std::string> fonts;  ///< those with ink in it, the main one first: "DejaVu Sans Bold (file, wght=650)"
	double capitalHeight = 0;        ///< mesh units: the size asked for, or the one that fits the width
	double tolerance = 0;            ///< the one used
	double module = 0;               ///< of a code: the side of its squares, mesh units; else 0
	Narrowest thinnestStroke, narrowestGap;
};

/// Set a text, or cut a drawing.
/// @param[in] utf8  the text; a line break, or a backslash followed by n, breaks a line; a tab, or a backslash followed
///                  by t, goes to the next tab stop (8 blanks); a doubled backslash before n or t stands for itself
/// @throws TextError
/// @throws std::bad_alloc
TextOutline MakeTextOutline(const std::string& utf8, const TextOptions& options);

/// A picture of the flat label, as a file of its own: the letters black, one millimetre for one mesh unit.
std::string OutlineToSvg(const TextOutline& text);

}  // namespace textlabel
