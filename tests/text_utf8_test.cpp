// UTF-8, line breaks, blanks: every code point there and back, every malformed sequence refused at its byte.

#include "text_utf8.h"

#include <gtest/gtest.h>
#include "text_error.h"

using namespace textlabel;

namespace {

std::size_t BadByteOf(const std::string& utf8)
{
	try {
		DecodeUtf8(utf8);
	} catch (const TextError& e) {
		EXPECT_EQ(e.code, TextErrorCode::BadUtf8);
		return e.offset;
	}
	return std::string::npos;
}

TEST(Utf8, EveryCodePointGoesThereAndBack)
{
	std::u32string all;
	for (char32_t c = 0; c <= 0x10FFFF; ++c) {
		if (c < 0xD800 || c > 0xDFFF) all.push_back(c);
	}
	const std::string utf8 = EncodeUtf8(all);
	EXPECT_EQ(utf8.size(), 0x80u + 2 * (0x800 - 0x80) + 3 * (0x10000 - 0x800 - 0x800) + 4 * 0x100000)
		<< "Unicode, table 3-6";
	EXPECT_EQ(DecodeUtf8(utf8), all);
	EXPECT_EQ(EncodeUtf8(U"aé€😀"), "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
}

TEST(Utf8, MalformedSequencesAreRefusedAtTheirByte)
{
	EXPECT_EQ(BadByteOf("ab\x80"), 2u) << "a continuation that continues nothing";
	EXPECT_EQ(BadByteOf("a\xC3"), 1u) << "cut off";
	EXPECT_EQ(BadByteOf("a\xC3z"), 1u);
	EXPECT_EQ(BadByteOf("\xC1\xBF"), 0u) << "overlong";
	EXPECT_EQ(BadByteOf("\xE0\x9F\xBF"), 0u);
	EXPECT_EQ(BadByteOf("\xF0\x8F\xBF\xBF"), 0u);
	EXPECT_EQ(BadByteOf("\xED\xA0\x80"), 0u) << "a surrogate";
	EXPECT_EQ(BadByteOf("\xF4\x90\x80\x80"), 0u) << "past U+10FFFF";
	EXPECT_EQ(BadByteOf("\xFE"), 0u);
	EXPECT_EQ(BadByteOf("good"), std::string::npos);
}

TEST(Lines, AreSplitAtEveryBreakAndEscape)
{
	const std::vector<std::u32string> abc{U"a", U"b", U"c"};
	for (const char32_t* text : {U"a\nb\nc", U"a\r\nb\rc", U"a\\nb\u2029c", U"a\u0085b\u000Bc", U"a  \\nb\t\nc "})
		EXPECT_EQ(SplitLines(text), abc);
	EXPECT_EQ(SplitLines(U"a\n\nb").size(), 3u) << "an empty line is a line";
	EXPECT_EQ(SplitLines(U"").size(), 1u);
	EXPECT_EQ(SplitLines(U"a\\tb")[0], U"a\tb");
	EXPECT_EQ(SplitLines(U"a\\\\nb\\x\\")[0], U"a\\nb\\x\\");
}

TEST(Blanks, HaveNoInk)
{
	for (const char32_t c : U"\t \u00A0\u200B\u200D\u200F\u3000\u3164\u2800\uFE0F\u0007")
		EXPECT_TRUE(IsBlank(c)) << unsigned(c);
	for (const char32_t c : {U'a', U'.', U'日', U'\u0301', U'\u2588', U'\u1680', U'\u06DD'})
		EXPECT_FALSE(IsBlank(c)) << unsigned(c);
}

}  // namespace
