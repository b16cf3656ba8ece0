// Font names: how they are read, and that no family is taken for another.

#include "font_lookup.h"

#include <gtest/gtest.h>
#include "text_error.h"
#include "text_outline.h"
#include "text_support.h"

using namespace textlabel;

namespace {

/// The font's description, or the error's name of the substitute.
std::string Found(const std::string& name)
{
	TextOptions options;
	options.font = name;
	try {
		return MakeTextOutline("x", options).fonts[0];
	} catch (const TextError& e) {
		return e.code == TextErrorCode::FontSubstituted ? "instead: " + e.substitute : Sentence(e);
	}
}

bool IsMissing(const std::string& family)
{
	try {
		FindFont(ParseFontRequest(family));
	} catch (const TextError&) {
		return true;
	}
	return false;
}

#define SKIP_WITHOUT(family)                                                                                           \
	if (IsMissing(family)) GTEST_SKIP() << family << " is not installed"

TEST(FontRequest, IsTakenApart)
{
	EXPECT_TRUE(ParseFontRequest("  ").family.empty());
	const FontRequest family = ParseFontRequest("DejaVu Sans:Bold Oblique");
	EXPECT_EQ(family.family, "DejaVu Sans");
	EXPECT_EQ(family.style, "Bold Oblique");
	const FontRequest variable = ParseFontRequest("Inter:wght=650, opsz=32:Italic");
	EXPECT_EQ(variable.style, "Italic");
	ASSERT_EQ(variable.axes.size(), 2u);
	EXPECT_EQ(variable.axes[1].tag, "opsz");
	EXPECT_EQ(variable.axes[1].value, 32);
	const FontRequest file = ParseFontRequest("/a/b c.ttc#2:wght=3e2");
	EXPECT_EQ(file.file, "/a/b c.ttc");
	EXPECT_EQ(file.face, 2);
	EXPECT_EQ(file.axes[0].value, 300);
	EXPECT_EQ(ParseFontRequest("font.otf").file, "font.otf") << "looks like a file, though it is not there";
	EXPECT_EQ(ParseFontRequest("X:GRAD=-5").axes[0].value, -5);
	EXPECT_EQ(ParseFontRequest("X:a=1").axes[0].tag, "a   ") << "tags have four characters";
	for (const char* bad : {"X:wght=", "X:wght=1x", "X:=5", "X:weight=5", "/f.ttf:Bold"})
		EXPECT_THROW(ParseFontRequest(bad), TextError) << bad;
	EXPECT_THROW(ParseFontRequest(std::string("a\0b", 3)), TextError);
}

TEST(FindFont, ByFamilyWeightAndStyle)
{
	SKIP_WITHOUT("DejaVu Sans");
	EXPECT_EQ(Found("DejaVu Sans").substr(0, 16), "DejaVu Sans Book");
	EXPECT_EQ(Found("dejavu sans").substr(0, 16), "DejaVu Sans Book");
	EXPECT_EQ(Found("DejaVu Sans:Regular").substr(0, 16), "DejaVu Sans Book");
	EXPECT_EQ(Found("DejaVu Sans:Bold").substr(0, 16), "DejaVu Sans Bold");
	SKIP_WITHOUT("DejaVu Sans:Bold Oblique");
	EXPECT_EQ(Found("DejaVu Sans:Bold Oblique").substr(0, 24), "DejaVu Sans Bold Oblique");
	EXPECT_EQ(Found("DejaVu Sans:bold italic").substr(0, 24), "DejaVu Sans Bold Oblique") << "another word for it";
	EXPECT_EQ(Found("DejaVu Sans:Condensed Bold").substr(0, 31), "DejaVu Sans Condensed Bold (/us");
}

TEST(FindFont, ByTheNameOfTheFontItself)
{
	SKIP_WITHOUT("DejaVu Sans:Bold");
	for (const char* name : {"DejaVu Sans Bold", "dejavu sans bold", "DejaVuSans-Bold"})
		EXPECT_EQ(Found(name), Found("DejaVu Sans:Bold")) << name;
	EXPECT_EQ(Found("DejaVu Sans Bold:Oblique").substr(0, 9), "instead: ") << "a style goes with a family";
	EXPECT_EQ(Found("DejaVu Sans Extrabold").substr(0, 9), "instead: ");
	for (const char* name : {"Sans-Serif", "Monospace", "SERIF"})
		EXPECT_NE(Found(name).substr(0, 9), "instead: ") << name << " stands for any";
}

TEST(FindFont, NeverTakesASubstituteInSilence)
{
	SKIP_WITHOUT("DejaVu Sans");
	for (const char* name :
	     {"Helvetica Neue Nonesuch", "DejaVu Sans:Black", "DejaVu Serif:Demilight", "DejaVu Sans:Poster"})
		EXPECT_EQ(Found(name).substr(0, 9), "instead: ") << name;
	EXPECT_NE(Found("sans-serif").substr(0, 9), "instead: ") << "which stands for any";
}

TEST(FindFont, TakesNoStyleThatFontconfigOnlyCallsSo)
{
	SKIP_WITHOUT("osifont");  // it has one face
	for (const char* name : {"osifont:Bold", "osifont:Italic"})
		EXPECT_EQ(Found(name).substr(0, 9), "instead: ") << name;
}

TEST(FindFallback, GoesOnToTheNextFont)
{
	std::vector<std::string> tried;
	const auto take = [&tried](const FontSource& source) {
		tried.push_back(source.name + "#" + std::to_string(source.face));
		if (tried.size() == 1) throw TextError(TextErrorCode::NotAFont);
		return tried.size() == 3;
	};
	const bool isFound = FindFallback(U"A", ParseFontRequest("sans-serif"), take);
	if (tried.empty()) GTEST_SKIP() << "no font is installed";
	EXPECT_EQ(isFound, tried.size() == 3) << "with one that is broken and one that will not do";
	if (tried.size() < 3) GTEST_SKIP() << "only " << tried.size() << " fonts are installed";
	EXPECT_NE(tried[0], tried[1]);
	EXPECT_NE(tried[1], tried[2]);
	EXPECT_FALSE(FindFallback(U"A\U0010FFFD", ParseFontRequest("sans-serif"), take));
	EXPECT_EQ(tried.size(), 3u) << "none has both";
	EXPECT_FALSE(FindFallback(U"\uE000", ParseFontRequest("sans-serif"), take));
	EXPECT_EQ(tried.size(), 3u) << "of private use: another font means another sign";
}

TEST(FindFont, ByAxisOfAVariableFont)
{
	SKIP_WITHOUT("Inter:wght=650");
	TextOptions light, heavy, bold;
	light.font = "Inter:wght=100", heavy.font = "Inter:wght=900", bold.font = "Inter:Bold";
	const double thin = MakeTextOutline("I", light).thinnestStroke.width;
	const double middle = MakeTextOutline("I", bold).thinnestStroke.width;
	const double thick = MakeTextOutline("I", heavy).thinnestStroke.width;
	EXPECT_LT(2 * thin, middle);
	EXPECT_LT(middle, thick);
	TextOptions same = bold;
	same.font = "Inter:wght=700";
	const double area = Area(MakeTextOutline("Rag", same).outline);
	EXPECT_NEAR(Area(MakeTextOutline("Rag", bold).outline), area, 0.01 * area)
		<< "a style of a variable font is a place on its axes";
}

TEST(FindFont, ByFaceOfACollection)
{
	SKIP_WITHOUT("Noto Sans CJK KR");
	const FontSource korean = FindFont(ParseFontRequest("Noto Sans CJK KR"));
	const FontSource japanese = FindFont(ParseFontRequest("Noto Sans CJK JP"));
	EXPECT_EQ(korean.name, japanese.name) << "one file";
	EXPECT_NE(korean.face, japanese.face);
	TextOptions byName, byFace;
	byName.font = "Noto Sans CJK KR";
	byFace.font = korean.name + "#" + std::to_string(korean.face);
	EXPECT_EQ(OutlineToSvg(MakeTextOutline("刃직", byName)), OutlineToSvg(MakeTextOutline("刃직", byFace)));
	TextOptions other;
	other.font = "Noto Sans CJK JP";
	EXPECT_NE(OutlineToSvg(MakeTextOutline("刃", byName)), OutlineToSvg(MakeTextOutline("刃", other)))
		<< "the same character looks different in Japan";
	byFace.font = korean.name + "#99";
	EXPECT_THROW(MakeTextOutline("x", byFace), TextError);
}

}  // namespace
