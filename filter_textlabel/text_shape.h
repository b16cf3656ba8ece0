#pragma once
// Shaping: which glyphs of which font, in which order, how far apart.
//
// A line is a paragraph of the Unicode bidirectional algorithm (FriBidi). It is cut into items of one direction, one
// script and one font, and HarfBuzz shapes each of them in the sight of its neighbours.

#include <memory>
#include <set>
#include <string>
#include <vector>
#include "font_face.h"
#include "font_source.h"

namespace textlabel {

/// The fonts of a text: the one asked for, and those that had to help.
class FontStack {
public:
	/// @throws TextError for a font that cannot be used
	FontStack(const std::string& font, bool fallback);

	const FontFace& operator[](int i) const { return *m_fonts[static_cast<std::size_t>(i)]; }
	const FontFace& main() const { return *m_fonts[0]; }
	int size() const { return static_cast<int>(m_fonts.size()); }
	bool mayFallBack() const { return m_fallback; }
	/// A font for the characters, other than those already tried: loaded before, or installed.
	/// @return index of the font, or -1
	int fallbackFor(const std::u32string& characters);

private:
	std::shared_ptr<FT_LibraryRec_> m_library;
	FontRequest m_request;
	bool m_fallback;
	std::vector<std::unique_ptr<FontFace>> m_fonts;
	std::set<std::u32string> m_hopeless;  ///< what no installed font has, not to search for it again
};

/// One glyph at its place in an item; lengths in em.
struct ShapedGlyph {
	unsigned glyph = 0;
	int cluster = 0;     ///< index into the line of the first character it stands for
	double advance = 0;  ///< to the next glyph
	double dx = 0, dy = 0;
};

/// A piece of a line with one font, direction and script; or a tab.
struct ShapedItem {
	int begin = 0, end = 0;  ///< characters of the line
	int level = 0;           ///< of the bidirectional algorithm; odd = right to left
	int font = 0;
	hb_script_t script = HB_SCRIPT_COMMON;
	bool isTab = false;
	std::vector<ShapedGlyph> glyphs;  ///< from left to right
};

struct ShapedLine {
	std::u32string text;
	std::vector<ShapedItem> items;  ///< in the order of the text
	bool rightToLeft = false;       ///< as a paragraph
	std::u32string missing;         ///< characters that no font of the stack has
	std::u32string withoutOutline;  ///< characters that the font has as bitmaps or colour layers only, or empty
};

struct ShapeOptions {
	std::string language;  ///< BCP 47, or empty
	std::vector<hb_feature_t> features;
};

/// Most glyphs of a text: some for each letter. A font can make thousands of one.
constexpr std::size_t kMostGlyphs = 500000;

/// @throws TextError{Unsound} for more than kMostGlyphs
void CheckGlyphCount(std::size_t glyphs);

/// @throws TextError{BadFeature}
std::vector<hb_feature_t> ParseFeatures(const std::string& text);

/// Shape one line. What cannot be shown is listed in the result.
/// @throws TextError{NotAFont} for a broken glyph
/// @throws TextError{Unsound} for more than kMostGlyphs
ShapedLine ShapeLine(const std::u32string& text, FontStack& fonts, const ShapeOptions& options);

}  // namespace textlabel
