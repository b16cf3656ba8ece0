// Text to outline: every wrong input is the error that says so, and what is too thin says what would do.

#include "text_outline.h"

#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include "text_refusal.h"
#include "text_support.h"

using namespace textlabel;
using text_support::CodeOf;
using text_support::ErrorOf;
using text_support::IsInstalled;

namespace {

TEST(TextOutline, TooThinNamesLettersAndTheSizeThatDoes)
{
	TextOptions options;
	const TextOutline t = MakeTextOutline("I8", options);
	options.minStroke = 1.2 * t.thinnestStroke.width;
	const TextError error = ErrorOf("I8", options);
	EXPECT_EQ(error.code, TextErrorCode::TooThin);
	EXPECT_EQ(error.letters, std::vector<std::string>{"8"}) << "the stem of the I is thicker";
	EXPECT_NEAR(error.size, 12, 0.1);
	options.size = 1.01 * error.size;
	EXPECT_NO_THROW(MakeTextOutline("I8", options));
}

TEST(TextOutline, TooThinTellsTheWorseOfStrokeAndGap)
{
	const TextOutline t = MakeTextOutline("8", {});
	TextOptions options;
	options.minStroke = t.thinnestStroke.width / 0.3;
	options.minGap = t.narrowestGap.width / 0.9;
	EXPECT_EQ(ErrorOf("8", options).detail, "stroke");
	options.minStroke = t.thinnestStroke.width / 0.9;
	options.minGap = t.narrowestGap.width / 0.3;
	EXPECT_EQ(ErrorOf("8", options).detail, "gap");
}

TEST(TextOutline, TooThinNamesTheWidthToFitThatDoes)
{
	for (const double embolden : {0.0, 0.3}) {
		TextOptions options;
		options.fitWidth = 30;
		options.embolden = embolden;
		options.minStroke = 1.5 * MakeTextOutline("I8", options).thinnestStroke.width;
		const TextError error = ErrorOf("I8", options);
		EXPECT_NE(Sentence(error).find("fit_width"), std::string::npos) << Sentence(error);
		options.fitWidth = 0.98 * error.fitWidth;
		EXPECT_EQ(ErrorOf("I8", options).code, TextErrorCode::TooThin);
		options.fitWidth = 1.01 * error.fitWidth;
		EXPECT_NO_THROW(MakeTextOutline("I8", options)) << embolden;
	}
}

// What embolden adds and an arc bends does not grow with the letters: the size that is named has been tried.
TEST(TextOutline, TooThinNamesTheSizeThatDoesWhereNotAllGrows)
{
	int named = 0;
	for (const double embolden : {0.02, 0.1, -0.01})
		for (const double arcRadius : {0.0, 8.0, -8.0})
			for (const double fitWidth : {0.0, 6.0})
				for (double TextOptions::*least : {&TextOptions::minStroke, &TextOptions::minGap}) {
					TextOptions options;
					options.size = 1;
					options.fitWidth = fitWidth;
					options.embolden = embolden;
					options.arcRadius = arcRadius;
					options.*least = 0.4;
					TextError error(TextErrorCode::EmptyText);
					try {
						MakeTextOutline("DN 25", options);
						continue;
					} catch (const TextError& thin) {
						error = thin;
					}
					ASSERT_EQ(error.code, TextErrorCode::TooThin);
					const std::string sentence = Sentence(error);
					if (!std::isfinite(error.size)) {
						EXPECT_EQ(sentence.find("a size of"), std::string::npos) << sentence;
						EXPECT_EQ(sentence.find("fit_width"), std::string::npos) << sentence;
						continue;
					}
					++named;
					(fitWidth > 0 ? options.fitWidth : options.size) = fitWidth > 0 ? error.fitWidth : error.size;
					EXPECT_NO_THROW(MakeTextOutline("DN 25", options)) << sentence;
				}
	EXPECT_GT(named, 12);
}

TEST(TextErrors, OfTheText)
{
	for (const char* text : {"", "   ", "\n\n", "\t \u200B\u00A0", "\u200D"})
		EXPECT_EQ(CodeOf(text), TextErrorCode::EmptyText);
	for (const char* text : {"a\x80", "\xC3", "\xC0\x80", "\xED\xA0\x80", "\xF5\x80\x80\x80", "a\xFF"})
		EXPECT_EQ(CodeOf(text), TextErrorCode::BadUtf8);
	TextOptions options;
	EXPECT_EQ(ErrorOf("ab\xFFz", options).offset, 2u);
	EXPECT_EQ(CodeOf(std::string(20000, 'x')), TextErrorCode::TextTooLong);
	EXPECT_EQ(CodeOf(std::string(20000, '\n') + "x"), TextErrorCode::TextTooLong);
	EXPECT_EQ(ErrorOf("x" + std::string(100000, ' '), options).value, 100001)
		<< "counted before anything is made of it";
	options.tolerance = 2e-6 * options.size;
	EXPECT_NE(ErrorOf(std::string(9999, '8'), options).detail.find("points"), std::string::npos)
		<< "for all to be held";
	EXPECT_EQ(CodeOf("a\x07z"), TextErrorCode::MissingGlyphs);
	EXPECT_EQ(CodeOf(std::string("a\0z", 3)), TextErrorCode::MissingGlyphs);
}

TEST(TextErrors, OfTheFont)
{
	const auto code = [](const char* font) { return CodeOf("x", [font](TextOptions& o) { o.font = font; }); };
	EXPECT_EQ(code("/no/such/font.ttf"), TextErrorCode::FontNotFound);
	EXPECT_EQ(code("nosuchfont.otf"), TextErrorCode::FontNotFound);
	EXPECT_EQ(code("/"), TextErrorCode::NotAFont);
	EXPECT_EQ(code("/dev/zero"), TextErrorCode::NotAFont);
	EXPECT_EQ(code(TEXTLABEL_SOURCE_DIR "/tests/text_outline_test.cpp"), TextErrorCode::NotAFont);
	EXPECT_EQ(code(TEXTLABEL_SOURCE_DIR "/filter_textlabel/fonts/DejaVuSans-Bold.ttf#3"), TextErrorCode::BadFace);
	EXPECT_EQ(code(TEXTLABEL_SOURCE_DIR "/filter_textlabel/fonts/DejaVuSans-Bold.ttf:wght=3"), TextErrorCode::BadAxis);
	const TextErrorCode unknown = code("No Such Family At All");
	EXPECT_TRUE(unknown == TextErrorCode::FontSubstituted || unknown == TextErrorCode::FontNotFound);
	if (!IsInstalled("DejaVu Sans")) GTEST_SKIP() << "DejaVu Sans is not installed";
	EXPECT_EQ(code("DejaVu Sans:Thin"), TextErrorCode::FontSubstituted);
	EXPECT_EQ(code("DejaVu Sans:wght"), TextErrorCode::FontSubstituted) << "a style of that name";
	EXPECT_EQ(code("DejaVu Sans:wght=x"), TextErrorCode::BadAxis);
}

TEST(TextErrors, OfTheOptions)
{
	const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
	const auto code = [](double TextOptions::*option, double value) {
		return CodeOf("x", [=](TextOptions& o) { o.*option = value; });
	};
	for (const double bad : {0.0, -1.0, nan, infinity})
		EXPECT_EQ(code(&TextOptions::size, bad), TextErrorCode::BadSize);
	for (const double bad : {-1.0, nan, infinity}) EXPECT_EQ(code(&TextOptions::fitWidth, bad), TextErrorCode::BadSize);
	for (const double bad : {-1.0, nan, infinity, 5.0, 1e-9})
		EXPECT_EQ(code(&TextOptions::tolerance, bad), TextErrorCode::BadTolerance);
	for (const double bad : {-1.0, nan, infinity, 1000.0})
		EXPECT_EQ(code(&TextOptions::lineSpacing, bad), TextErrorCode::BadSpacing);
	for (const double bad : {-2.0, nan, infinity})
		EXPECT_EQ(code(&TextOptions::letterSpacing, bad), TextErrorCode::BadSpacing);
	for (const double bad : {-61.0, nan, 90.0}) EXPECT_EQ(code(&TextOptions::slant, bad), TextErrorCode::BadSlant);
	for (const double bad : {-11.0, nan, infinity})
		EXPECT_EQ(code(&TextOptions::embolden, bad), TextErrorCode::BadEmbolden);
	for (const double bad : {nan, infinity, 1e-3}) EXPECT_EQ(code(&TextOptions::arcRadius, bad), TextErrorCode::BadArc);
	for (const double bad : {-1.0, nan}) EXPECT_EQ(code(&TextOptions::minStroke, bad), TextErrorCode::BadPrintLimit);
	TextOptions bent;
	bent.arcRadius = infinity;
	EXPECT_NE(Sentence(ErrorOf("x", bent)).find("give a length"), std::string::npos);
	EXPECT_EQ(CodeOf("x", [](TextOptions& o) { o.features = "liga,=,"; }), TextErrorCode::BadFeature);
	EXPECT_EQ(code(&TextOptions::embolden, -5), TextErrorCode::LetterVanished);
}

}  // namespace
