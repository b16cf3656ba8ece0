// Every refusal has a sentence that says what, where and what to do.

#include "filter_textlabel/error_text.h"

#include <gtest/gtest.h>
#include <set>

using namespace textlabel;
using vcg::textlabel::Error;
using vcg::textlabel::ErrorCode;

namespace {

/// At least a statement and a remedy: two sentences, each with an end, none that is cut off; no line break.
void ExpectReadable(const std::string& text)
{
	EXPECT_GE(text.size(), 30u) << text;
	EXPECT_EQ(text.find('\n'), std::string::npos) << text;
	EXPECT_TRUE(text.back() == '.' || text.back() == ')') << text;
	EXPECT_TRUE((text[0] >= 'A' && text[0] <= 'Z') || text[0] == '\'') << text;
	EXPECT_EQ(text.find("  "), std::string::npos) << text;
	EXPECT_EQ(text.find(".."), std::string::npos) << text;
	EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

// A letter that would be raised into the surface is no matter of stretch: no figure, another remedy.
TEST(ErrorText, GrazingFromBehind)
{
	using namespace vcg::textlabel;
	const Error error = Error(ErrorCode::Grazing).measured(std::numeric_limits<double>::infinity(), 8);
	const std::string text = textlabel::ErrorText(error, {});
	EXPECT_NE(text.find("extrude_along"), std::string::npos) << text;
	EXPECT_EQ(text.find("inf"), std::string::npos) << text;
	EXPECT_EQ(text.find("8"), std::string::npos) << text;
}

// What is raised to the camera is too high; a surface that reaches behind it is another matter.
TEST(ErrorText, BehindTheCamera)
{
	using namespace vcg::textlabel;
	const std::string raised = textlabel::ErrorText(Error(ErrorCode::BehindCamera).measured(12, 0), {}),
					  surface = textlabel::ErrorText(Error(ErrorCode::BehindCamera), {});
	EXPECT_NE(raised.find("smaller depth"), std::string::npos) << raised;
	EXPECT_EQ(surface.find("depth"), std::string::npos) << surface;
	ExpectReadable(raised);
}

}  // namespace

TEST(ErrorText, EveryCodeOfTheLibraryHasItsOwn)
{
	std::set<std::string> texts;
	for (int code = 0; code <= int(ErrorCode::OutOfMemory); ++code) {
		const std::string text = ErrorText(Error(ErrorCode(code), "detail"));
		ExpectReadable(text);
		EXPECT_TRUE(texts.insert(text).second) << "twice: " << text;
	}
	ErrorContext wrapped;
	wrapped.isWrapped = true;
	for (const Error& error :
	     {Error(ErrorCode::BehindCamera), Error(ErrorCode::BehindCamera).measured(-2, 0),
	      Error(ErrorCode::BehindCamera).measured(2, 0), Error(ErrorCode::Silhouette), Error(ErrorCode::Occluded),
	      Error(ErrorCode::FacesAway), Error(ErrorCode::TooLong).measured(12, 10),
	      Error(ErrorCode::Squeezed).measured(0.1, 0.125), Error(ErrorCode::Grazing).measured(9, 8),
	      Error(ErrorCode::Grazing).measured(INFINITY, 8)}) {
		const std::string text = ErrorText(error, wrapped);
		ExpectReadable(text);
		EXPECT_EQ(text.find("ook at the p"), std::string::npos) << text;
		EXPECT_EQ(text.find("camera"), std::string::npos) << text;
		EXPECT_EQ(text.find("from the viewpoint"), std::string::npos) << text;
	}
}

TEST(ErrorText, SaysWhichLetterAndWhere)
{
	const ErrorContext context{{"A", "ß", "漢"}, 0.5};
	for (int code = int(ErrorCode::OffSurface); code <= int(ErrorCode::HitsItself); ++code) {
		EXPECT_TRUE(DependsOnPlace(ErrorCode(code)));
		const std::string text = ErrorText(Error(ErrorCode(code)).atLetter(2).atPlace({1.5, -2, 1e6}), context);
		EXPECT_NE(text.find("'漢'"), std::string::npos) << text;
		EXPECT_NE(text.find("(1.5, -2, 1e+06)"), std::string::npos) << text;
		EXPECT_NO_THROW(ErrorText(Error(ErrorCode(code)).atLetter(99), context));
	}
	EXPECT_FALSE(DependsOnPlace(ErrorCode::BadHeight));
	EXPECT_FALSE(DependsOnPlace(ErrorCode::Cancelled));
}

TEST(ErrorText, GivesTheNumbers)
{
	const ErrorContext context{{"A"}, -0.5};
	const std::string wall = ErrorText(Error(ErrorCode::HitsSurface).atLetter(0).measured(0.5, 0.125), context);
	EXPECT_NE(wall.find("depth 0.5;"), std::string::npos) << wall;
	EXPECT_NE(wall.find("room for 0.125"), std::string::npos) << wall;
	EXPECT_NE(wall.find("below 0.125"), std::string::npos) << wall;
	const std::string steep = ErrorText(Error(ErrorCode::Grazing).measured(12.25, 8), context);
	EXPECT_NE(steep.find("12.25"), std::string::npos) << steep;
	EXPECT_NE(steep.find("8 is allowed"), std::string::npos) << steep;
	const std::string fine = ErrorText(Error(ErrorCode::TooFine).measured(1e-5, 2e-4), context);
	EXPECT_NE(fine.find("1e-05"), std::string::npos) << fine;
	EXPECT_NE(fine.find("0.0002"), std::string::npos) << fine;
	EXPECT_EQ(ErrorText(Error(ErrorCode::HitsSurface), context).find("room"),
	          std::string::npos);  // when it is not known
}

// What a sentence tells to give must be allowed: figures are rounded to that side.
TEST(ErrorText, LimitsAreRoundedToTheSideThatWorks)
{
	const auto numberAfter = [](const std::string& text, const std::string& words) {
		return std::stod(text.substr(text.find(words) + words.size()));
	};
	for (const double limit : {1183.2156, 25.1196437, 0.1, 9.9999996, 0.00010000049, 123456.51}) {
		const std::string most = ErrorText(RequestError(RequestProblem::OutOfRange, "fit_width").measured(5e6, limit));
		EXPECT_LE(numberAfter(most, "at most "), limit) << most;
		EXPECT_GE(numberAfter(most, "at most "), limit * (1 - 2e-5)) << most;
		const std::string least = ErrorText(RequestError(RequestProblem::OutOfRange, "fit_width").measured(0, limit));
		EXPECT_GE(numberAfter(least, "at least "), limit) << least;
		EXPECT_LE(numberAfter(least, "at least "), limit * (1 + 2e-5)) << least;
		const std::string steep = ErrorText(Error(ErrorCode::Grazing).measured(limit, limit / 2));
		EXPECT_GE(numberAfter(steep, "stretched "), limit) << steep;
	}
}

TEST(ErrorText, EveryProblemOfARequestHasItsOwn)
{
	std::set<std::string> texts;
	for (int problem = 0; problem <= int(RequestProblem::FileNotWritten); ++problem) {
		const std::string text = ErrorText(RequestError(RequestProblem(problem), "size", "detail").measured(3, 2));
		ExpectReadable(text);
		EXPECT_TRUE(texts.insert(text).second) << "twice: " << text;
	}
	const std::string style = ErrorText(RequestError(RequestProblem::UnreadableValue, "style", "raised"));
	EXPECT_NE(style.find("'raised' of style"), std::string::npos) << style;
	EXPECT_NE(style.find("Give one of Emboss, Engrave, Flat."), std::string::npos) << style;
	const std::string large = ErrorText(RequestError(RequestProblem::LargerThanPart, "depth").measured(30, 13.5));
	EXPECT_NE(large.find("depth is 30"), std::string::npos) << large;
	EXPECT_NE(large.find("13.5"), std::string::npos) << large;
}
