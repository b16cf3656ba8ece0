// Every error has a sentence of its own with its data in it.

#include "text_error.h"

#include <gtest/gtest.h>
#include <set>

using namespace textlabel;

namespace {

TEST(TextError, EveryCodeHasASentenceOfItsOwn)
{
	std::set<std::string> sentences;
	const int count = static_cast<int>(TextErrorCode::Unsound) + 1;
	for (int code = 0; code < count; ++code) {
		TextError error(static_cast<TextErrorCode>(code));
		const std::string sentence = Sentence(error.ofFont("Font.ttf").measured(3.25, 7.5));
		EXPECT_GT(sentence.size(), 30u) << code;
		EXPECT_EQ(sentence.back(), '.') << sentence;
		EXPECT_NE(sentence.find(':'), std::string::npos) << "the remedy comes after a colon: " << sentence;
		sentences.insert(sentence);
	}
	EXPECT_EQ(static_cast<int>(sentences.size()), count);
}

TEST(TextError, MissingGlyphsAreListed)
{
	TextError error(TextErrorCode::MissingGlyphs);
	error.ofFont("F").codePoints = {U'Ж', 0x7, 0x10FFFD};
	const std::string sentence = Sentence(error);
	EXPECT_NE(sentence.find("\"Ж\" U+0416"), std::string::npos) << sentence;
	EXPECT_NE(sentence.find(" U+0007"), std::string::npos) << sentence;
	EXPECT_NE(sentence.find("U+10FFFD"), std::string::npos) << sentence;
	error.codePoints.assign(500, U'Ж');
	EXPECT_LT(Sentence(error).size(), 2000u);
	EXPECT_NE(Sentence(error).find("and 480 more"), std::string::npos);
}

TEST(TextError, DataIsInTheSentence)
{
	TextError thin(TextErrorCode::TooThin, "stroke");
	thin.letters = {"i", "ß"};
	thin.size = 23.5;
	const std::string sentence = Sentence(thin.measured(0.31, 0.4));
	for (const char* datum : {"stroke", "0.31", "0.4", "\"i\", \"ß\"", "23.51"})
		EXPECT_NE(sentence.find(datum), std::string::npos) << datum << " in " << sentence;
	TextError wide(TextErrorCode::BadSpacing, "letterSpacing");
	EXPECT_NE(Sentence(wide.measured(-2, 100).notBelow(-1)).find("from -1 to 100"), std::string::npos);
	EXPECT_NE(Sentence(TextError(TextErrorCode::EmptyText).ofFont("")).find("blank"), std::string::npos);
}

}  // namespace
