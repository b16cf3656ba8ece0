#pragma once
// Words of parameters and files, whose letters beyond ASCII stay as they are, in every locale.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace textlabel {

constexpr const char* kBlanks = " \t\r\n\f";

/// Without blanks at its ends.
inline std::string Trimmed(std::string_view text)
{
	const std::size_t first = text.find_first_not_of(kBlanks), last = text.find_last_not_of(kBlanks);
	return first == std::string_view::npos ? std::string() : std::string(text.substr(first, last - first + 1));
}

/// The pieces between separators, trimmed, the empty ones too.
inline std::vector<std::string> Split(std::string_view text, const char* separators)
{
	std::vector<std::string> pieces;
	for (std::size_t at = 0; at <= text.size();) {
		const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
		pieces.push_back(Trimmed(text.substr(at, end - at)));
		at = end + 1;
	}
	return pieces;
}

inline std::string LowerCase(std::string text)
{
	for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
	return text;
}

}  // namespace textlabel
