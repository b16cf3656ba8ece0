#include "text_utf8.h"

#include <algorithm>
#include <hb.h>
#include "text_error.h"

namespace textlabel {
namespace {

constexpr char32_t kLastCodePoint = 0x10FFFF;

bool IsSurrogate(char32_t c) { return c >= 0xD800 && c <= 0xDFFF; }

/// Length of the sequence that a byte begins; 0 for a byte that begins none.
std::size_t SequenceLength(unsigned char lead)
{
	if (lead < 0x80) return 1;
	if (lead >= 0xC2 && lead < 0xE0) return 2;
	if (lead >= 0xE0 && lead < 0xF0) return 3;
	if (lead >= 0xF0 && lead < 0xF5) return 4;
	return 0;
}

/// Code point of the sequence at `at`, or a surrogate when it is none.
char32_t DecodeOne(const std::string& utf8, std::size_t at, std::size_t length)
{
	constexpr char32_t kNone = 0xD800;
	static constexpr char32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
	if (length == 0 || at + length > utf8.size()) return kNone;
	const auto lead = static_cast<unsigned char>(utf8[at]);
	char32_t c = length == 1 ? lead : lead & (0x7Fu >> length);
	for (std::size_t i = 1; i < length; ++i) {
		const auto next = static_cast<unsigned char>(utf8[at + i]);
		if ((next & 0xC0) != 0x80) return kNone;
		c = (c << 6) | (next & 0x3Fu);
	}
	return c < kLeast[length] || c > kLastCodePoint ? kNone : c;
}

bool IsLineBreak(char32_t c) { return (c >= 0x0A && c <= 0x0D) || c == 0x85 || c == 0x2028 || c == 0x2029; }

constexpr char32_t oghamStroke = 0x1680;  // by its category a space, yet it has ink

bool IsSpace(char32_t c)
{
	const auto category = hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
	return c == '\t' || (c != oghamStroke && category == HB_UNICODE_GENERAL_CATEGORY_SPACE_SEPARATOR);
}

}  // namespace

std::u32string DecodeUtf8(const std::string& utf8)
{
	std::u32string text;
	for (std::size_t at = 0; at < utf8.size();) {
		const std::size_t length = SequenceLength(static_cast<unsigned char>(utf8[at]));
		const char32_t c = DecodeOne(utf8, at, length);
		if (IsSurrogate(c)) {
			TextError error(TextErrorCode::BadUtf8);
			error.offset = at;
			throw error;
		}
		text.push_back(c);
		at += length;
	}
	return text;
}

std::string EncodeUtf8(std::u32string_view text)
{
	std::string utf8;
	const auto put = [&utf8](char32_t byte) { utf8.push_back(static_cast<char>(static_cast<unsigned char>(byte))); };
	for (const char32_t c : text) {
		if (c < 0x80) {
			put(c);
			continue;
		}
		const int tail = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
		put((0xFF00u >> (tail + 1) & 0xFFu) | c >> (6 * tail));
		for (int i = tail - 1; i >= 0; --i) put(0x80u | (c >> (6 * i) & 0x3Fu));
	}
	return utf8;
}

std::vector<std::u32string> SplitLines(std::u32string_view text)
{
	std::vector<std::u32string> lines(1);
	const auto is = [text](std::size_t i, char32_t c) { return i < text.size() && text[i] == c; };
	for (std::size_t i = 0; i < text.size(); ++i) {
		if (is(i, '\\') && is(i + 1, '\\') && (is(i + 2, 'n') || is(i + 2, 't'))) {
			lines.back() += {text[i], text[i + 2]};
			i += 2;
		} else if (is(i, '\\') && is(i + 1, 'n')) {
			lines.emplace_back();
			++i;
		} else if (is(i, '\\') && is(i + 1, 't')) {
			lines.back() += '\t';
			++i;
		} else if (IsLineBreak(text[i])) {
			if (is(i, '\r') && is(i + 1, '\n')) ++i;
			lines.emplace_back();
		} else lines.back() += text[i];
	}
	for (std::u32string& line : lines) {
		while (!line.empty() && IsSpace(line.back())) line.pop_back();
	}
	return lines;
}

bool IsBlank(char32_t c)
{
	// Not separators, yet without ink: the Hangul fillers and the braille cell without dots.
	static constexpr char32_t kFillers[] = {0x115F, 0x1160, 0x2800, 0x3164, 0xFFA0};
	// By their category without ink, yet with it: this, and signs that stand before or around a number.
	static constexpr char32_t kVisible[] = {oghamStroke, 0x600, 0x601, 0x602, 0x603, 0x604,   0x605,
	                                        0x6DD,       0x70F, 0x890, 0x891, 0x8E2, 0x110BD, 0x110CD};
	if (std::find(std::begin(kVisible), std::end(kVisible), c) != std::end(kVisible)) return false;
	switch (hb_unicode_general_category(hb_unicode_funcs_get_default(), c)) {
	case HB_UNICODE_GENERAL_CATEGORY_CONTROL:
	case HB_UNICODE_GENERAL_CATEGORY_FORMAT:
	case HB_UNICODE_GENERAL_CATEGORY_SPACE_SEPARATOR:
	case HB_UNICODE_GENERAL_CATEGORY_LINE_SEPARATOR:
	case HB_UNICODE_GENERAL_CATEGORY_PARAGRAPH_SEPARATOR: return true;
	default: break;
	}
	const bool variationSelector = (c >= 0xFE00 && c <= 0xFE0F) || c == 0x34F;
	// places that Unicode keeps free for characters to ignore
	const bool ignored = (c >= 0xFFF0 && c <= 0xFFF8) || (c >= 0xE0000 && c <= 0xE0FFF);
	return variationSelector || ignored || std::find(std::begin(kFillers), std::end(kFillers), c) != std::end(kFillers);
}

bool IsMark(char32_t c)
{
	const auto category = hb_unicode_general_category(hb_unicode_funcs_get_default(), c);
	return category == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
	       category == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK ||
	       category == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK;
}

}  // namespace textlabel
