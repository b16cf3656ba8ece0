#pragma once
// UTF-8 in, code points out, and back; lines; what is blank.

#include <string>
#include <string_view>
#include <vector>

namespace textlabel {

/// @throws TextError{BadUtf8, offset} for overlong forms, surrogates, values past U+10FFFF and truncated sequences too
std::u32string DecodeUtf8(const std::string& utf8);

std::string EncodeUtf8(std::u32string_view text);

/// The lines of a text, without what ends them: any Unicode line break, or the two characters \n. Also turns the two
/// characters \t into a tab; a doubled backslash before n or t stands for itself. Blanks at the end of a line are cut
/// off.
/// @return at least one line
std::vector<std::u32string> SplitLines(std::u32string_view text);

/// Leaves no ink on purpose: spaces, controls, joiners and other characters that Unicode says to ignore by default.
bool IsBlank(char32_t c);

/// Combining mark, which a font may draw with its letter.
bool IsMark(char32_t c);

}  // namespace textlabel
