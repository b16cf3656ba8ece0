#pragma once
// What the tests of texts share: a text that must be refused, and with what error.

#include "text_outline.h"

#include <functional>
#include <gtest/gtest.h>

namespace text_support {

using textlabel::TextError;
using textlabel::TextErrorCode;
using textlabel::TextOptions;

/// The error that a call throws, or a failure.
inline TextError ErrorOf(const std::string& text, const TextOptions& options)
{
	try {
		MakeTextOutline(text, options);
	} catch (const TextError& e) {
		EXPECT_GT(Sentence(e).size(), 20u) << "a sentence says what, where and the remedy";
		return e;
	}
	ADD_FAILURE() << "no error for " << text;
	return TextError(TextErrorCode::Unsound);
}

/// The code of that error, with options as `set` makes them.
inline TextErrorCode CodeOf(const std::string& text, const std::function<void(TextOptions&)>& set = {})
{
	TextOptions options;
	if (set) set(options);
	return ErrorOf(text, options).code;
}

/// Is a font to be had under this name?
inline bool IsInstalled(const std::string& font)
{
	TextOptions options;
	options.font = font;
	try {
		MakeTextOutline("x", options);
	} catch (const TextError& e) {
		return e.code != TextErrorCode::FontNotFound && e.code != TextErrorCode::FontSubstituted;
	}
	return true;
}

}  // namespace text_support
