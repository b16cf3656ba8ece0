// Fonts that are not what they should be: an error each, never a crash, and what is still usable gives sound outlines.

#include "font_face.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <unistd.h>
#include "embedded_font.h"
#include "text_outline.h"
#include "text_refusal.h"
#include "text_support.h"

using namespace textlabel;

namespace {

std::string BuiltIn() { return {reinterpret_cast<const char*>(embeddedFont), embeddedFontSize}; }

/// A file of its own for a test, gone afterwards.
class FontFile {
public:
	explicit FontFile(const std::string& bytes, const std::string& name = "font.ttf")
		: m_path(testing::TempDir() + "/" + std::to_string(getpid()) + "-" + name)
	{
		std::ofstream(m_path, std::ios::binary) << bytes;
	}
	~FontFile() { std::remove(m_path.c_str()); }
	const std::string& path() const { return m_path; }

private:
	std::string m_path;
};

/// Set a text with a font file. @return the error's code, or nothing when the outline is there and sound
std::optional<TextErrorCode> CodeWith(const std::string& file, const std::string& text = "A43")
{
	TextOptions options;
	options.font = file;
	try {
		EXPECT_EQ(text_support::FlawOf(MakeTextOutline(text, options).outline), "");
	} catch (const TextError& e) {
		EXPECT_NE(Sentence(e), "");
		return e.code;
	}
	return std::nullopt;
}

/// Where the table directory has the entry of a table.
std::size_t EntryOf(const std::string& font, const char* tag)
{
	const std::size_t at = font.find(tag);
	EXPECT_LT(at, 400u);
	return at;
}

TEST(FontFace, TheBuiltInFontIsWhole)
{
	const FontFace font(OpenFontLibrary(), {});
	EXPECT_EQ(font.description(), "DejaVu Sans Bold");
	EXPECT_NEAR(font.capitalHeight(), 1493.0 / 2048, 1e-9) << "DejaVu's capitals";
	for (char32_t c = U'!'; c <= U'~'; ++c) EXPECT_TRUE(font.has(c));
}

TEST(FontFace, AFileOfTheBuiltInFontIsTheBuiltInFont)
{
	const FontFile file(BuiltIn());
	TextOptions options;
	options.font = file.path();
	EXPECT_EQ(OutlineToSvg(MakeTextOutline("A43", options)), OutlineToSvg(MakeTextOutline("A43", {})));
}

std::size_t ReadNumber(const std::string& font, std::size_t at, std::size_t bytes)
{
	std::size_t number = 0;
	for (std::size_t i = 0; i < bytes; ++i) number = number << 8 | static_cast<unsigned char>(font[at + i]);
	return number;
}

/// The built-in font with other outlines for some characters.
/// @param[in] outline  bytes of the glyf table in place of theirs, padded with zeros: nothing = a glyph without contours
std::string WithGlyphs(const std::u32string& characters, const std::string& outline)
{
	std::string font = BuiltIn();
	const auto table = [&font](const char* tag) { return ReadNumber(font, EntryOf(font, tag) + 8, 4); };
	const bool isLong = ReadNumber(font, table("head") + 50, 2) != 0;
	const auto offset = [&](unsigned glyph) {
		return isLong ? ReadNumber(font, table("loca") + 4 * glyph, 4)
		              : 2 * ReadNumber(font, table("loca") + 2 * glyph, 2);
	};
	const FontFace whole(OpenFontLibrary(), {});
	for (const char32_t c : characters) {
		hb_codepoint_t glyph = 0;
		EXPECT_TRUE(hb_font_get_nominal_glyph(whole.shaper(), c, &glyph));
		const std::size_t begin = table("glyf") + offset(glyph), length = offset(glyph + 1) - offset(glyph);
		EXPECT_LE(outline.size(), length);
		std::string bytes = outline;
		bytes.resize(length, '\0');
		font.replace(begin, length, bytes);
	}
	return font;
}

/// The characters that a refusal for want of outlines names.
std::u32string WithoutOutline(const FontFile& file, const std::string& text)
{
	TextOptions options;
	options.font = file.path();
	try {
		MakeTextOutline(text, options);
	} catch (const TextError& e) {
		EXPECT_EQ(e.code, TextErrorCode::NoOutlines) << Sentence(e);
		return {e.codePoints.begin(), e.codePoints.end()};
	}
	return {};
}

TEST(BadFont, WithEmptyLettersNamesThem)
{
	const FontFile capitalsOnly(WithGlyphs(U"abc\u0302", {}));
	EXPECT_EQ(WithoutOutline(capitalsOnly, "A"), U"");
	EXPECT_EQ(WithoutOutline(capitalsOnly, "AbAca"), U"bca");
	EXPECT_EQ(WithoutOutline(capitalsOnly, "b"), U"b");
	EXPECT_EQ(WithoutOutline(capitalsOnly, "A\nb \nA"), U"b");
	EXPECT_EQ(WithoutOutline(capitalsOnly, "x\u0302A"), U"") << "a mark without ink";
	EXPECT_EQ(WithoutOutline(capitalsOnly, "A \u00A0\u200E\u00AD\u200B\uFE0F\t\u2060A"), U"") << "no ink on purpose";
}

TEST(BadFont, WithLettersOfBareLinesNamesThem)
{
	// one contour of two points, (0, 0) and (0, 256), both on the curve, and no instructions
	const std::string line("\0\1"
	                       "\0\0\0\0\0\0\1\0"
	                       "\0\1"
	                       "\0\0"
	                       "\1\1"
	                       "\0\0\0\0"
	                       "\0\0\1\0",
	                       24);
	EXPECT_EQ(WithoutOutline(FontFile(WithGlyphs(U"b", line)), "AbA"), U"b");
}

/// A number of two bytes, as fonts have it.
std::string Short(std::size_t number)
{
	return {static_cast<char>(number >> 8 & 0xFF), static_cast<char>(number & 0xFF)};
}

/// The built-in font with a substitution, always on, of one character by many of it.
std::string WithMultiplied(char32_t c, std::size_t times)
{
	hb_codepoint_t glyph = 0;
	EXPECT_TRUE(hb_font_get_nominal_glyph(FontFace(OpenFontLibrary(), {}).shaper(), c, &glyph));
	const std::string scripts =
		Short(1) + "DFLT" + Short(8) + Short(4) + Short(0) + Short(0) + Short(0xFFFF) + Short(1) + Short(0);
	const std::string features = Short(1) + "ccmp" + Short(8) + Short(0) + Short(1) + Short(0);
	const std::string coverage = Short(1) + Short(1) + Short(glyph);
	std::string multiple = Short(1) + Short(8) + Short(1) + Short(8 + coverage.size()) + coverage + Short(times);
	for (std::size_t i = 0; i < times; ++i) multiple += Short(glyph);
	const std::string lookups = Short(1) + Short(4) + Short(2) + Short(0) + Short(1) + Short(8) + multiple;
	const std::size_t header = 10;
	const std::string table = Short(1) + Short(0) + Short(header) + Short(header + scripts.size()) +
	                          Short(header + scripts.size() + features.size()) + scripts + features + lookups;
	std::string font = BuiltIn();
	font.resize((font.size() + 3) / 4 * 4, '\0');
	const auto four = [](std::size_t n) { return Short(n >> 16) + Short(n); };
	font.replace(EntryOf(font, "GSUB") + 8, 8, four(font.size()) + four(table.size()));
	return font + table;
}

TEST(BadFont, ThatMakesThousandsOfOneLetterIsRefusedInTime)
{
	const FontFile few(WithMultiplied(U'A', 3), "few.ttf"), many(WithMultiplied(U'A', 16000), "many.ttf");
	TextOptions options;
	options.font = few.path();
	EXPECT_EQ(MakeTextOutline("A", options).outline.partCount, 3) << "the substitution works";
	options.font = many.path();
	for (const int lines : {25, 5000}) {  // more points than there may be, more glyphs
		std::string text;
		for (int i = 0; i < lines; ++i) text += "A\n";
		try {
			MakeTextOutline(text, options);
			ADD_FAILURE() << lines;
		} catch (const TextError& e) {
			EXPECT_EQ(e.code, TextErrorCode::Unsound);
			EXPECT_NE(e.detail.find(lines == 25 ? "points" : "glyphs"), std::string::npos) << e.detail;
		}
	}
}

TEST(BadFont, IsNamedAsSuch)
{
	EXPECT_EQ(CodeWith(FontFile("").path()), TextErrorCode::NotAFont);
	EXPECT_EQ(CodeWith(FontFile("\x89PNG\r\n\x1a\n0000IHDR some picture").path()), TextErrorCode::NotAFont);
	EXPECT_EQ(CodeWith(FontFile(std::string(100000, 'x')).path()), TextErrorCode::NotAFont);
	// a header that says that it unpacks to 4 GB
	const std::string packed = std::string("wOFF\0\1\0\0", 8) + std::string(8, '\0') + std::string(4, '\xFF');
	const FontFile bomb(packed + std::string(100, '\0'));
	TextOptions options;
	options.font = bomb.path();
	const TextError tooLarge = text_support::ErrorOf("A", options);
	EXPECT_EQ(tooLarge.code, TextErrorCode::NotAFont);
	EXPECT_NE(tooLarge.detail.find("too large"), std::string::npos) << tooLarge.detail;
	const std::string folder = testing::TempDir() + "/" + std::to_string(getpid()) + "-folder.ttf";
	std::filesystem::create_directory(folder);
	EXPECT_EQ(CodeWith(folder), TextErrorCode::NotAFont);
	std::filesystem::remove(folder);
	EXPECT_EQ(CodeWith(folder), TextErrorCode::FontNotFound);
}

TEST(BadFont, WithoutAUnicodeMap)
{
	std::string font = BuiltIn();
	font.replace(EntryOf(font, "cmap"), 4, "cmxx");
	EXPECT_EQ(CodeWith(FontFile(font).path()), TextErrorCode::NoUnicodeMap);
}

TEST(BadFont, WithoutGlyphs)
{
	for (const char* table : {"glyf", "loca", "head", "hhea", "maxp"}) {
		std::string font = BuiltIn();
		font.replace(EntryOf(font, table), 4, "xxxx");
		EXPECT_TRUE(CodeWith(FontFile(font).path()).has_value()) << table;
	}
}

TEST(BadFont, Truncated)
{
	const std::string whole = BuiltIn();
	int errors = 0, count = 0;
	for (std::size_t length = 1; length < whole.size(); length = length * 5 / 4 + 1, ++count)
		errors += CodeWith(FontFile(whole.substr(0, length)).path()).has_value();
	EXPECT_GT(count, 40);
	EXPECT_GT(errors, count - 10) << "only the last few bytes, tables that are not needed, may be missing";
}

TEST(BadFont, Damaged)
{
	std::mt19937 random(5);
	const std::string whole = BuiltIn();
	for (int round = 0; round < 60; ++round) {
		std::string font = whole;
		// hits near the start damage the table directory, the others the tables
		const std::size_t range = round % 2 ? font.size() : 1000;
		for (int hits = 1 << (round % 12); hits > 0; --hits) font[random() % range] = static_cast<char>(random());
		CodeWith(FontFile(font).path(), "A43 %&@ÄgiB8 fi\nעב");
	}
}

TEST(BadFont, RandomBytesAfterAGoodStart)
{
	std::mt19937 random(6);
	std::string font = BuiltIn();
	for (std::size_t i = 400; i < font.size(); ++i) font[i] = static_cast<char>(random());
	EXPECT_TRUE(CodeWith(FontFile(font).path()).has_value());
}

}  // namespace
