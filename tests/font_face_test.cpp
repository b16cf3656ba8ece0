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

TEST(BadFont, IsNamedAsSuch)
{
	EXPECT_EQ(CodeWith(FontFile("").path()), TextErrorCode::NotAFont);
	EXPECT_EQ(CodeWith(FontFile("\x89PNG\r\n\x1a\n0000IHDR some picture").path()), TextErrorCode::NotAFont);
	EXPECT_EQ(CodeWith(FontFile(std::string(100000, 'x')).path()), TextErrorCode::NotAFont);
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
