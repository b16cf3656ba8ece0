// Text to outline, end to end: sizes and places measured on the outline, and what every option does. What is wrong with an input is
// in text_outline_error_test.cpp.

#include "text_outline.h"

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <thread>
#include <unistd.h>
#include "text_refusal.h"
#include "text_support.h"
#include "text_utf8.h"

using namespace textlabel;
using text_support::CodeOf;
using text_support::ErrorOf;
using text_support::FlawOf;
using text_support::IsInstalled;
using vcg::Point2d;
using vcg::textlabel::Contour;

namespace {

TextOutline Made(const std::string& text, const std::function<void(TextOptions&)>& set = {})
{
	TextOptions options;
	if (set) set(options);
	TextOutline result = MakeTextOutline(text, options);
	EXPECT_EQ(FlawOf(result.outline), "") << text;
	return result;
}

double Width(const TextOutline& t) { return t.boxMax[0] - t.boxMin[0]; }
double Height(const TextOutline& t) { return t.boxMax[1] - t.boxMin[1]; }

std::size_t PointCount(const TextOutline& t)
{
	std::size_t count = 0;
	for (const Contour& c : t.outline.contours) count += c.points.size();
	return count;
}

TEST(TextOutline, CapitalHeightIsTheSize)
{
	for (const double size : {0.01, 1.0, 10.0, 12345.0}) {
		const TextOutline t = Made("HHEI", [size](TextOptions& o) { o.size = size; });
		EXPECT_NEAR(Height(t), size, 1e-7 * size)
			<< "the letters' ends are straight: the grid's rounding is the only error";
		EXPECT_EQ(t.capitalHeight, size);
	}
	for (const char* font :
	     {"Liberation Serif", "Inter:wght=650", "Roboto", "Amiri", "Noto Sans CJK JP", "osifont", "Routed Gothic"}) {
		if (!IsInstalled(font)) continue;
		const TextOutline t = Made("H", [font](TextOptions& o) { o.font = font, o.anchor = Anchor::Baseline; });
		EXPECT_NEAR(t.boxMax[1], 10, t.tolerance) << font;
	}
}

TEST(TextOutline, CountsWhatA43Has)
{
	const TextOutline t = Made("A43");
	EXPECT_EQ(t.letters, (std::vector<std::string>{"A", "4", "3"}));
	EXPECT_EQ(t.outline.contours.size(), 5u) << "A and 4 have a hole each";
	EXPECT_EQ(t.outline.partCount, 3);
	for (const Contour& c : t.outline.contours) EXPECT_EQ(c.part, c.letter);
	EXPECT_LT(PointCount(t), 120u);
}

TEST(TextOutline, NestedIslandsAreParts)
{
	const TextOutline registered = Made("®");
	EXPECT_EQ(registered.outline.contours.size(), 4u) << "ring, its hole, the R in it, the R's hole";
	EXPECT_EQ(registered.outline.partCount, 2);
	const TextOutline bullseye = Made("◎");
	EXPECT_EQ(bullseye.outline.contours.size(), 4u);
	EXPECT_EQ(bullseye.outline.partCount, 2);
	EXPECT_EQ(Made("i").outline.partCount, 2) << "the dot is a part of its own";
}

TEST(TextOutline, IsCentredOnItsInk)
{
	const TextOutline t = Made("Hxg\nlonger line");
	EXPECT_NEAR(t.boxMin[0] + t.boxMax[0], 0, 2 * t.tolerance);
	EXPECT_NEAR(t.boxMin[1] + t.boxMax[1], 0, 2 * t.tolerance);
}

TEST(TextOutline, AnchorsPutTheInkWhereTheySay)
{
	const TextOutline base = Made("HgH", [](TextOptions& o) { o.anchor = Anchor::Baseline; });
	EXPECT_NEAR(base.boxMax[1], 10, base.tolerance) << "capitals stand on v = 0";
	EXPECT_LT(base.boxMin[1], -1) << "the g hangs below";
	EXPECT_NEAR(Made("HgH", [](TextOptions& o) { o.anchor = Anchor::Top; }).boxMax[1], 0, 1e-6);
	EXPECT_NEAR(Made("HH", [](TextOptions& o) { o.align = Align::Left; }).boxMin[0], 0, 1e-6);
	EXPECT_NEAR(Made("HH", [](TextOptions& o) { o.align = Align::Right; }).boxMax[0], 0, 1e-6);
	EXPECT_NEAR(Made("HH", [](TextOptions& o) { o.align = Align::Right, o.embolden = 0.2; }).boxMax[0], 0, 1e-6);
}

TEST(TextOutline, LinesAreAlignedToEachOther)
{
	const auto lefts = [](Align align) {
		const TextOutline t = Made("HHHH\nH", [align](TextOptions& o) { o.align = align; });
		double upper = 1e9, lower = 1e9;
		for (const Contour& c : t.outline.contours) {
			for (const Point2d& p : c.points)
				(c.letter < 4 ? upper : lower) = std::min(c.letter < 4 ? upper : lower, p[0]);
		}
		return lower - upper;
	};
	EXPECT_NEAR(lefts(Align::Left), 0, 1e-6);
	EXPECT_NEAR(lefts(Align::Right), 2 * lefts(Align::Center), 1e-5);
	EXPECT_GT(lefts(Align::Right), 10);
}

TEST(TextOutline, LineSpacingIsProportional)
{
	const auto height = [](double spacing) {
		return Height(Made("H\nH", [spacing](TextOptions& o) { o.lineSpacing = spacing; }));
	};
	EXPECT_NEAR(height(2) - height(1), height(3) - height(2), 1e-6);
	EXPECT_GT(height(1), 20) << "lines do not touch";
}

TEST(TextOutline, LetterSpacingAddsBetweenLettersOnly)
{
	const auto width = [](double s) { return Width(Made("HHH", [s](TextOptions& o) { o.letterSpacing = s; })); };
	EXPECT_NEAR(width(0.5) - width(0), 2 * 0.5 * 10, 1e-6);
}

TEST(TextOutline, LetterSpacingDoesNotCountWhatIsInvisible)
{
	const auto spaced = [](const std::string& text) {
		return Made(text, [](TextOptions& o) { o.letterSpacing = 0.5, o.align = Align::Left; });
	};
	const double width = Width(spaced("HH"));
	for (const char* hidden : {"\u200E", "\u00AD", "\u200B", "\u2060\uFEFF"}) {
		EXPECT_NEAR(Width(spaced("H" + std::string(hidden) + "H")), width, 1e-6)
			<< CodePointName(DecodeUtf8(hidden)[0]);
		EXPECT_NEAR(Width(spaced(hidden + std::string("HH") + hidden)), width, 1e-6);
		const TextOutline right = Made("HHHH\nH" + std::string(hidden),
		                               [](TextOptions& o) { o.letterSpacing = 0.5, o.align = Align::Right; });
		double lower = -1e9;
		for (const Contour& c : right.outline.contours) {
			for (const Point2d& p : c.points) lower = std::max(lower, c.letter == 4 ? p[0] : lower);
		}
		EXPECT_NEAR(lower, right.boxMax[0], 1e-6) << "at the end, too";
	}
	EXPECT_GT(Width(spaced("H H")), width + 5) << "a blank is a letter";
}

TEST(TextOutline, LetterSpacingUndoesLigatures)
{
	if (!IsInstalled("DejaVu Sans")) GTEST_SKIP() << "DejaVu Sans is not installed";
	const auto letters = [](double s) {
		return Made("ffi", [s](TextOptions& o) { o.font = "DejaVu Sans", o.letterSpacing = s; }).letters;
	};
	EXPECT_EQ(letters(0), std::vector<std::string>{"ffi"});
	EXPECT_EQ(letters(0.2), (std::vector<std::string>{"f", "f", "i"}));
}

TEST(TextOutline, TabsStopAtEqualSteps)
{
	const auto left = [](const std::string& text) { return Made(text, [](TextOptions& o) { o.align = Align::Left; }); };
	const TextOutline one = left("I\tI"), two = left("I\t\tI"), filled = left("HH\tI");
	EXPECT_NEAR(Width(filled), Width(one), 1e-6) << "a tab goes to the next stop, wherever the text before it ends";
	EXPECT_GT(Width(two), 1.5 * Width(one));
	EXPECT_NEAR(Width(left("I\\tI")), Width(one), 1e-6) << "backslash and t is a tab too";
}

TEST(TextOutline, BackslashNAndRealBreaksBreakLines)
{
	const double height = Height(Made("H\nH"));
	for (const char* text : {"H\\nH", "H\r\nH", "H\rH", "H\u2028H", "H  \\nH\t"})
		EXPECT_EQ(Height(Made(text)), height) << text;
	EXPECT_NEAR(Height(Made("H\\\\nH")), Height(Made("\\")), 5) << "a doubled backslash is one, and no break";
	EXPECT_EQ(Made("H\\\\nH").letters, (std::vector<std::string>{"H", "\\", "n", "H"}));
}

// The corners of V and A stand out by more than the distance that they are emboldened by.
TEST(TextOutline, IsAsWideAsAskedWithPointedLettersEmboldened)
{
	for (const double bold : {0.4, 2.0, -0.1})
		for (const bool mirrored : {false, true})
			for (const Align align : {Align::Left, Align::Center, Align::Right}) {
				const TextOutline t = Made("VA1", [&](TextOptions& o) {
					o.fitWidth = 60, o.embolden = bold, o.align = align, o.mirrored = mirrored;
				});
				EXPECT_NEAR(Width(t), 60, 1e-3) << bold;
				const double anchored = align == Align::Center               ? t.boxMin[0] + t.boxMax[0]
				                        : (align == Align::Left) != mirrored ? t.boxMin[0]
				                                                             : t.boxMax[0];
				EXPECT_NEAR(anchored, 0, 1e-9) << bold;
				EXPECT_NEAR(t.boxMin[1] + t.boxMax[1], 0, 1e-9) << bold;
			}
}

TEST(TextOutline, FitsTheWidth)
{
	for (const double bold : {0.0, 0.4}) {
		const TextOutline t = Made("HIT", [bold](TextOptions& o) { o.fitWidth = 77, o.embolden = bold; });
		EXPECT_NEAR(Width(t), 77, 1e-5);
		EXPECT_NEAR(Height(t), t.capitalHeight + 2 * bold, t.tolerance);
	}
	EXPECT_NEAR(Width(Made("Sog", [](TextOptions& o) { o.fitWidth = 5, o.letterSpacing = 0.3, o.slant = 12; })), 5,
	            0.01);
}

TEST(TextOutline, SlantShearsAndKeepsArea)
{
	const TextOutline upright = Made("H"), slanted = Made("H", [](TextOptions&o) { o.slant = 20; });
	EXPECT_NEAR(Area(slanted.outline), Area(upright.outline), 1e-5);
	EXPECT_NEAR(Width(slanted) - Width(upright), 10 * std::tan(20 * 3.14159265358979 / 180), 1e-5);
	EXPECT_NEAR(Height(slanted), 10, 1e-6);
	double top = -1e9, bottom = -1e9;  // furthest right
	for (const Point2d& p : slanted.outline.contours[0].points)
		(p[1] > 0 ? top : bottom) = std::max(p[1] > 0 ? top : bottom, p[0]);
	EXPECT_GT(top, bottom + 3) << "a positive slant leans to the right";
}

TEST(TextOutline, EmboldenMovesTheOutline)
{
	const TextOutline plain = Made("I"), bold = Made("I", [](TextOptions&o) { o.embolden = 0.25; });
	EXPECT_NEAR(Width(bold) - Width(plain), 0.5, 1e-5);
	EXPECT_NEAR(Area(bold.outline), (Width(plain) + 0.5) * 10.5, 1e-4);
}

TEST(TextOutline, MirroredIsTheMirrorImage)
{
	// at the left, so that a label that is not turned over is on the other side
	const auto points = [](bool mirrored) {
		const TextOutline t = Made("R4", [mirrored](TextOptions& o) { o.align = Align::Left, o.mirrored = mirrored; });
		std::vector<Point2d> result;
		for (const Contour& c : t.outline.contours) {
			for (const Point2d& p : c.points) result.push_back(mirrored ? Point2d(-p[0], p[1]) : p);
		}
		return result;
	};
	const std::vector<Point2d> plain = points(false), back = points(true);
	EXPECT_EQ(plain.size(), back.size());
	const auto furthest = [](const std::vector<Point2d>& from, const std::vector<Point2d>& to) {
		double most = 0;
		for (const Point2d& p : from) {
			double least = 1e9;
			for (const Point2d& q : to) least = std::min(least, (p - q).Norm());
			most = std::max(most, least);
		}
		return most;
	};
	EXPECT_LT(furthest(plain, back), 1e-6);
	EXPECT_LT(furthest(back, plain), 1e-6);
}

TEST(TextOutline, OnAnArcEveryLetterStandsOnTheCircle)
{
	for (const double radius : {40.0, -40.0}) {
		const TextOutline t = Made("IIIIIIII", [radius](TextOptions& o) {
			o.arcRadius = radius, o.anchor = Anchor::Baseline, o.letterSpacing = 0.6;
		});
		const Point2d centre((t.boxMin[0] + t.boxMax[0]) / 2, -radius);  // the baseline's top, or bottom, is at v = 0
		for (const Contour& c : t.outline.contours) {
			ASSERT_EQ(c.points.size(), 4u);
			double least = 1e9, most = 0;
			for (const Point2d& p : c.points) {
				least = std::min(least, (p - centre).Norm());
				most = std::max(most, (p - centre).Norm());
			}
			// the middle of a straight foot is on the circle, its corners a bit off
			const double feet = radius > 0 ? least : most, heads = radius > 0 ? most : least;
			EXPECT_NEAR(feet, 40, 0.05);
			EXPECT_NEAR(heads, radius > 0 ? 50 : 30, 0.05);
		}
	}
	const TextOutline flat = Made("Hop"), wide = Made("Hop", [](TextOptions&o) { o.arcRadius = 1e9; });
	EXPECT_NEAR(Width(wide), Width(flat), 1e-5) << "a very wide arc is a straight line";
	EXPECT_NEAR(Height(wide), Height(flat), 1e-5);
}

TEST(TextOutline, AnArcTooTightNamesTheOneThatDoes)
{
	TextOptions options;
	options.arcRadius = 5;
	options.arcRadius = ErrorOf("around and around", options).limit;
	EXPECT_NO_THROW(MakeTextOutline("around and around", options));
	options.arcRadius *= 0.99;
	EXPECT_EQ(ErrorOf("around and around", options).code, TextErrorCode::BadArc);
	options.arcRadius = -5;
	options.arcRadius = -ErrorOf("hang\nlower", options).limit;
	EXPECT_NO_THROW(MakeTextOutline("hang\nlower", options));
}

TEST(TextOutline, OverlappingLettersAreOneContour)
{
	EXPECT_EQ(Made("HH", [](TextOptions& o) { o.letterSpacing = -0.3; }).outline.partCount, 1);
	EXPECT_EQ(Made("Å").outline.partCount, Made("A\u030A").outline.partCount);
	if (!IsInstalled("Amiri")) GTEST_SKIP() << "Amiri is not installed";
	EXPECT_EQ(Made("بسم", [](TextOptions& o) { o.font = "Amiri"; }).outline.partCount, 2)
		<< "joined letters, and a dot";
}

// The fonts let joined letters overlap by less than is taken away here.
TEST(TextOutline, JoinedLettersStayJoinedWhenThinned)
{
	for (const auto& [font, text, thinning, parts] :
	     {std::tuple{"Amiri", "سلام", 0.2, 2}, {"Noto Sans Devanagari", "नमस्ते", 0.4, 1}}) {
		if (!IsInstalled(font)) GTEST_SKIP() << font << " is not installed";
		const auto thinned = [&, font = font](double by) {
			return [font, by](TextOptions& o) { o.size = 10, o.font = font, o.embolden = -by; };
		};
		EXPECT_EQ(Made(text, thinned(0)).outline.partCount, parts) << font;
		EXPECT_EQ(Made(text, thinned(thinning)).outline.partCount, parts) << font;
		EXPECT_EQ(CodeOf(text, thinned(0.5)), TextErrorCode::LetterBroken) << font << ": more than its strokes have";
	}
}

TEST(TextOutline, MeasuresStrokesAndGaps)
{
	const TextOutline i = Made("I");
	EXPECT_NEAR(i.thinnestStroke.width, Width(i), 1e-6);
	EXPECT_EQ(i.narrowestGap.letter, -1) << "a lone stem has no gap";
	const TextOutline two = Made("II"), bold = Made("II", [](TextOptions&o) { o.embolden = 0.1; });
	EXPECT_NEAR(two.narrowestGap.width, Width(two) - 2 * Width(i), 1e-5);
	EXPECT_NEAR(bold.narrowestGap.width, two.narrowestGap.width - 0.2, 1e-5);
	EXPECT_NEAR(bold.thinnestStroke.width, i.thinnestStroke.width + 0.2, 1e-5);
}

TEST(TextOutline, ASlantedStemIsMeasuredAcross)
{
	const double upright = Made("I").thinnestStroke.width;
	for (const double slant : {5.0, 15.0, 25.0, 40.0, -25.0}) {
		const double expected = upright * std::cos(slant * 3.14159265358979 / 180);
		EXPECT_NEAR(Made("I", [slant](TextOptions& o) { o.slant = slant; }).thinnestStroke.width, expected, 1e-5)
			<< slant;
	}
	EXPECT_EQ(CodeOf("I", [](TextOptions& o) { o.slant = 25, o.minStroke = 5; }), TextErrorCode::TooThin);
}

TEST(TextOutline, ToleranceRulesTheNumberOfPoints)
{
	const auto count = [](double tolerance) {
		return PointCount(Made("SO8", [tolerance](TextOptions& o) { o.tolerance = tolerance; }));
	};
	const double ratio = static_cast<double>(count(0.001)) / static_cast<double>(count(0.1));
	EXPECT_NEAR(ratio, 10, 3) << "a hundredth of the error takes ten times the points";
}

TEST(TextOutline, SameInputSameBytesOnEveryThread)
{
	const std::string expected = OutlineToSvg(Made("Grüße ®@&"));
	std::vector<std::string> results(4);
	std::vector<std::thread> threads;
	for (std::string& result : results)
		threads.emplace_back([&result] { result = OutlineToSvg(MakeTextOutline("Grüße ®@&", {})); });
	for (std::thread& thread : threads) thread.join();
	for (const std::string& result : results) EXPECT_EQ(result, expected);
}

/// A locale that writes commas, installed or made for the test. @return was there one?
bool SetCommaLocale()
{
	for (const char* locale : {"de_DE.UTF-8", "de_DE.utf8", "tr_TR.UTF-8", "fr_FR.UTF-8"}) {
		if (std::setlocale(LC_ALL, locale) != nullptr) return true;
	}
	const std::string folder = testing::TempDir() + "/" + std::to_string(getpid()) + "-locales";
	std::filesystem::create_directory(folder);
	const std::string command = "localedef -i de_DE -f UTF-8 '" + folder + "/de_DE.UTF-8' >/dev/null 2>&1";
	const bool isMade = std::system(command.c_str()) == 0 && setenv("LOCPATH", folder.c_str(), 1) == 0 &&
	                    std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
	std::filesystem::remove_all(folder);
	return isMade;
}

TEST(TextOutline, TheLocaleDoesNotMatter)
{
	const auto everything = [] {
		std::string result = OutlineToSvg(Made("1.5 mm"));
		TextOptions thin;
		thin.minStroke = 5.25;
		result += Sentence(ErrorOf("1.5 mm", thin));
		TextOptions variable;
		variable.font = "Inter:wght=650.5";
		if (IsInstalled(variable.font)) result += MakeTextOutline("1.5 mm", variable).fonts[0];
		TextOptions rigid;
		rigid.font = TEXTLABEL_SOURCE_DIR "/filter_textlabel/fonts/DejaVuSans-Bold.ttf:wght=650.5";
		return result + Sentence(ErrorOf("x", rigid));
	};
	const std::string expected = everything();
	EXPECT_NE(expected.find("wght=650.5"), std::string::npos) << expected;
	const std::string before = std::setlocale(LC_ALL, nullptr);
	const bool isSet = SetCommaLocale();
	const bool hasComma = isSet && std::string(std::localeconv()->decimal_point) == ",";
	const std::string actual = everything();
	std::setlocale(LC_ALL, before.c_str());
	if (!hasComma) GTEST_SKIP() << "no locale that writes commas, and none can be made (Debian: locales)";
	EXPECT_EQ(actual, expected);
}

TEST(TextOutline, FallsBackOnlyWhenAsked)
{
	if (!IsInstalled("Noto Sans CJK JP")) GTEST_SKIP() << "no font with CJK is installed";
	TextOptions options;
	const TextError error = ErrorOf("A日本日", options);
	EXPECT_EQ(error.code, TextErrorCode::MissingGlyphs);
	EXPECT_EQ(error.codePoints, (std::vector<char32_t>{U'日', U'本'}));
	EXPECT_FALSE(error.hasFallback);
	EXPECT_NE(Sentence(error).find("U+65E5"), std::string::npos);
	options.fallbackFonts = true;
	const TextOutline t = MakeTextOutline("A日本日", options);
	EXPECT_EQ(FlawOf(t.outline), "");
	EXPECT_EQ(t.fonts.size(), 2u);
	EXPECT_EQ(MakeTextOutline("日 本", options).fonts.size(), 1u) << "no ink is the main font's";
	EXPECT_NE(MakeTextOutline("日 本", options).fonts[0].find("Bold"), std::string::npos)
		<< "as bold as the built-in one";
	EXPECT_TRUE(ErrorOf("\U0010FFFD", options).hasFallback);
}

TEST(TextOutline, LooksForAFallbackOnce)
{
	const auto seconds = [](int count) {
		TextOptions options;
		options.fallbackFonts = true;
		std::string text;
		for (int i = 0; i < count; ++i) text += "\u0378";  // assigned to no character: no font has it
		const std::clock_t start = std::clock();           // of this process: other load does not count
		EXPECT_EQ(ErrorOf(text, options).codePoints.size(), 1u);
		return double(std::clock() - start) / CLOCKS_PER_SEC;
	};
	seconds(1);  // Fontconfig reads its files
	const double once = seconds(1);
	EXPECT_LT(seconds(1000), 100 * (once + 1e-3)) << "and not for each of the thousand";
}

TEST(TextOutline, PicturesOfGlyphsAreNoOutlines)
{
	if (!IsInstalled("Noto Color Emoji")) GTEST_SKIP() << "Noto Color Emoji is not installed";
	EXPECT_EQ(CodeOf("😀", [](TextOptions& o) { o.font = "Noto Color Emoji"; }), TextErrorCode::NoOutlines);
}

}  // namespace
