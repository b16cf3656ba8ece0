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

TEST(TextError, CountsAreWhole)
{
	const std::string sentence = Sentence(TextError(TextErrorCode::TextTooLong).measured(10001, 10000));
	EXPECT_NE(sentence.find("10001 characters, at most 10000"), std::string::npos) << sentence;
	const std::string face = Sentence(TextError(TextErrorCode::BadFace).measured(65535, 12345));
	EXPECT_NE(face.find("no face 65535"), std::string::npos) << face;
	EXPECT_NE(face.find("has 12345"), std::string::npos) << face;
}

/// The first number after some words.
double NumberAfter(const std::string& words, const std::string& sentence)
{
	const std::size_t at = sentence.find(words);
	EXPECT_NE(at, std::string::npos) << words << " in " << sentence;
	return at == std::string::npos ? 0 : std::stod(sentence.substr(at + words.size()));
}

TEST(TextError, ALimitThatIsPrintedWillDo)
{
	for (double limit = 1e-3; limit < 1e5; limit *= 1.000913) {
		for (const auto code : {TextErrorCode::BadTolerance, TextErrorCode::BadEmbolden}) {
			const double most = NumberAfter("at most ", Sentence(TextError(code).measured(2 * limit, limit)));
			EXPECT_LE(most, limit);
			EXPECT_GE(most, 0.999 * limit);
		}
		const double tolerance =
			NumberAfter("at least ", Sentence(TextError(TextErrorCode::BadTolerance).measured(limit / 2, limit)));
		const double width =
			NumberAfter("larger than ", Sentence(TextError(TextErrorCode::BadSize, "fitWidth").measured(0.1, limit)));
		for (const double least : {tolerance, width}) {
			EXPECT_GE(least, limit);
			EXPECT_LE(least, 1.0011 * limit);
		}
	}
	EXPECT_EQ(NumberAfter("at most ", Sentence(TextError(TextErrorCode::BadEmbolden).measured(11, 10))), 10);
}

TEST(TextError, AdvisesNothingThatIsDoneAlready)
{
	TextError error(TextErrorCode::MissingGlyphs);
	error.codePoints = {U'x'};
	EXPECT_NE(Sentence(error).find("fallback_fonts=true"), std::string::npos);
	error.hasFallback = true;
	EXPECT_EQ(Sentence(error).find("fallback_fonts"), std::string::npos) << Sentence(error);
}

}  // namespace
