// Shaping and line layout, glyph by glyph against HarfBuzz's own tool hb-shape. What hb-shape does not do, the order of
// runs in a line of mixed directions, is written down by hand: each case lists its runs from left to right as the page
// shows them.

#include "text_shape.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include "font_lookup.h"
#include "text_layout.h"
#include "text_support.h"
#include "text_utf8.h"

using namespace textlabel;

namespace {

struct TextRun {
	const char* text;
	const char* direction;  ///< as hb-shape has it
	const char* script;
};

struct Case {
	const char* name;
	const char* font;
	std::vector<TextRun> runs;  ///< from left to right
	std::vector<int> order;     ///< runs in the order of the text; empty = from left to right
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

struct Glyph {
	unsigned index;
	double x, y;  ///< font units
};

bool HasHbShape() { return std::system("hb-shape --version >/dev/null 2>&1") == 0; }

std::string OutputOf(const std::string& command)
{
	const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
	std::string output;
	for (int c = 0; pipe && (c = std::fgetc(pipe.get())) != EOF;) output.push_back(static_cast<char>(c));
	return output;
}

std::string CommandFor(const TextRun& run, const FontSource& font)
{
	std::string command = "hb-shape --no-glyph-names --language=und --direction=" + std::string(run.direction) +
	                      " --script=" + run.script + " --face-index=" + std::to_string(font.face);
	for (std::size_t i = 0; i < font.axes.size(); ++i)
		command += (i ? "," : " --variations=") + font.axes[i].tag + "=" + std::to_string(font.axes[i].value);
	command += " --font-file='" + font.name + "' --unicodes=";
	for (const char32_t c : DecodeUtf8(run.text)) {
		char hex[16];
		std::snprintf(hex, sizeof hex, "%X,", static_cast<unsigned>(c));
		command += hex;
	}
	command.pop_back();
	return command;
}

/// Read "[index=cluster@x,y+advance|...]" and set it from `pen` on.
std::vector<Glyph> Parsed(const std::string& output, double& pen)
{
	std::vector<Glyph> glyphs;
	const char* at = output.c_str();
	while (*at == '[' || *at == '|') {
		Glyph g{static_cast<unsigned>(std::strtoul(at + 1, const_cast<char**>(&at), 10)), pen, 0};
		std::strtol(at + 1, const_cast<char**>(&at), 10);  // =cluster
		if (*at == '@') {
			g.x += static_cast<double>(std::strtol(at + 1, const_cast<char**>(&at), 10));
			g.y = static_cast<double>(std::strtol(at + 1, const_cast<char**>(&at), 10));
		}
		pen += static_cast<double>(std::strtol(at + 1, const_cast<char**>(&at), 10));
		glyphs.push_back(g);
	}
	return glyphs;
}

class HbShape : public testing::TestWithParam<Case> {};

TEST_P(HbShape, SameGlyphsAtTheSamePlaces)
{
	if (!HasHbShape()) GTEST_SKIP() << "hb-shape (Debian: libharfbuzz-bin) is not installed";
	const Case& c = GetParam();
	FontSource font;
	try {
		font = FindFont(ParseFontRequest(c.font));
	} catch (const TextError& e) {
		GTEST_SKIP() << Sentence(e);
	}
	std::string text;
	if (c.order.empty())
		for (const TextRun& run : c.runs) text += run.text;
	for (const int i : c.order) text += c.runs[static_cast<std::size_t>(i)].text;
	std::vector<Glyph> expected;
	double pen = 0;
	for (const TextRun& run : c.runs) {
		const std::vector<Glyph> glyphs = Parsed(OutputOf(CommandFor(run, font)), pen);
		expected.insert(expected.end(), glyphs.begin(), glyphs.end());
	}

	FontStack fonts(c.font, false);
	const std::vector<ShapedLine> lines{ShapeLine(DecodeUtf8(text), fonts, {})};
	EXPECT_TRUE(lines[0].missing.empty()) << Sentence(TextError(TextErrorCode::MissingGlyphs));
	LayoutOptions options;
	options.em = fonts.main().shaperUnits();
	options.align = Align::Left;
	const std::vector<PlacedGlyph> placed = Layout(lines, fonts, options);
	ASSERT_EQ(placed.size(), expected.size());
	for (std::size_t i = 0; i < placed.size(); ++i) {
		EXPECT_EQ(placed[i].glyph, expected[i].index) << "glyph " << i;
		EXPECT_NEAR(placed[i].place.dx, expected[i].x, 1e-6) << "glyph " << i;
		EXPECT_NEAR(placed[i].place.dy, expected[i].y, 1e-6) << "glyph " << i;
	}
}

INSTANTIATE_TEST_SUITE_P(
	Text, HbShape,
	testing::Values(Case{"kerning_and_ligatures", "DejaVu Sans", {{"AVATAR fi ffl To LT", "ltr", "Latn"}}, {}},
                    Case{"variable_kerning", "Inter:wght=650", {{"AVATAR To. 11:30", "ltr", "Latn"}}, {}},
                    Case{"combining_marks", "DejaVu Sans", {{"e\u0301x\u0323\u0302 A\u030A", "ltr", "Latn"}}, {}},
                    Case{"arabic", "Amiri", {{"السلام عليكم", "rtl", "Arab"}}, {}},
                    Case{"arabic_marks", "Amiri", {{"بِسْمِ ٱللَّهِ", "rtl", "Arab"}}, {}},
                    Case{"arabic_naskh", "Noto Naskh Arabic", {{"مرحبا بالعالم", "rtl", "Arab"}}, {}},
                    Case{"arabic_digits", "Amiri", {{"123", "ltr", "Arab"}, {"رقم ", "rtl", "Arab"}}, {1, 0}},
                    Case{"hebrew_with_numbers",
                         "DejaVu Sans",
                         {{" שלום", "rtl", "Hebr"}, {"03-1234567", "ltr", "Hebr"}, {"טלפון ", "rtl", "Hebr"}},
                         {2, 1, 0}},
                    Case{"hebrew_brackets", "DejaVu Sans", {{"(שלום) עולם", "rtl", "Hebr"}}, {}},
                    Case{"devanagari", "Noto Sans Devanagari", {{"नमस्ते हिन्दी क्षत्रिय", "ltr", "Deva"}}, {}},
                    Case{"thai", "Noto Sans Thai", {{"ภาษาไทย น้ำ ที่นี่", "ltr", "Thai"}}, {}},
                    Case{"japanese",
                         "Noto Sans CJK JP",
                         {{"日本語", "ltr", "Hani"}, {"の", "ltr", "Hira"}, {"テキスト", "ltr", "Kana"}},
                         {}},
                    Case{"left_to_right_with_hebrew_inside",
                         "DejaVu Sans",
                         {{"Part ", "ltr", "Latn"},
                          {"12", "ltr", "Hebr"},
                          {"שלום ", "rtl", "Hebr"},
                          {" ", "ltr", "Hebr"},
                          {"B", "ltr", "Latn"}},
                         {0, 2, 1, 3, 4}}),
	[](const auto& i) { return std::string(i.param.name); });

}  // namespace
