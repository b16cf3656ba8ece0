#pragma once
// The texts of the benchmarks as outlines, by the project's own text library and its built-in font, flattened as the filter does.

#include "text_outline.h"

namespace bench {

/// Large letters for a short text; a long one as wide as the part takes it.
inline textlabel::TextOptions TextSize(const std::string& text)
{
	constexpr size_t few = 6;
	constexpr double size = 10, width = 76;  // units
	textlabel::TextOptions options;
	options.size = size;
	if (text.size() > few) options.fitWidth = width;
	return options;
}

}  // namespace bench
