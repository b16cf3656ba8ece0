#pragma once
// What the tests of drawings share: a drawing as text, its outline, and what is wrong with it.

#include "text_outline.h"

#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include "text_support.h"

namespace drawing_case {

using textlabel::TextError;
using textlabel::TextErrorCode;
using textlabel::TextOptions;
using textlabel::TextOutline;

/// A drawing's document around its elements.
inline std::string Document(const std::string& elements, const std::string& attributes = "")
{
	return "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" " + attributes +
	       ">" + elements + "</svg>";
}

/// A file of the running test that holds these bytes.
inline std::string FileOf(const std::string& bytes)
{
	const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
	std::string name = std::string(test->test_suite_name()) + "." + test->name() + ".svg";
	std::replace(name.begin(), name.end(), '/', '_');
	const std::string file = ::testing::TempDir() + name;
	std::ofstream(file, std::ios::binary) << bytes;
	return file;
}

using SetOptions = std::function<void(TextOptions&)>;

/// The outline of a document; sound in every case.
inline TextOutline Made(const std::string& document, const SetOptions& set = {})
{
	TextOptions options;
	options.drawing = FileOf(document);
	if (set) set(options);
	TextOutline made = MakeTextOutline("ignored", options);
	EXPECT_EQ(text_support::FlawOf(made.outline), "");
	return made;
}

/// The error of a document, which has a sentence.
inline TextError ErrorOf(const std::string& document, const SetOptions& set = {})
{
	try {
		Made(document, set);
	} catch (const TextError& error) {
		EXPECT_GT(Sentence(error).size(), 20u);
		EXPECT_EQ(Sentence(error).find("font"), std::string::npos) << Sentence(error);
		return error;
	}
	ADD_FAILURE() << "no error";
	return TextError(TextErrorCode::Unsound);
}

inline double AreaOf(const TextOutline& text)
{
	double area = 0;
	for (const auto& contour : text.outline.contours) area += vcg::textlabel::TwiceSignedArea(contour.points) / 2;
	return area;
}

}  // namespace drawing_case
