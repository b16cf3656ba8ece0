#include "font_source.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include "text_error.h"
#include "text_file.h"
#include "text_words.h"

namespace textlabel {
namespace {

namespace fs = std::filesystem;

bool Exists(const std::string& path)
{
	std::error_code ignored;
	return fs::exists(fs::u8path(path), ignored);
}

AxisSetting ParseAxis(const std::string& text)
{
	constexpr std::size_t kTagLength = 4;
	const std::size_t equals = text.find('=');
	if (equals == std::string::npos) throw TextError(TextErrorCode::BadAxis, text);
	AxisSetting axis{Trimmed(text.substr(0, equals)), 0};
	const std::string number = Trimmed(text.substr(equals + 1));
	const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), axis.value);
	if (axis.tag.empty() || axis.tag.size() > kTagLength || error != std::errc() ||
	    end != number.data() + number.size())
		throw TextError(TextErrorCode::BadAxis, text);
	axis.tag.resize(kTagLength, ' ');
	return axis;
}

/// Where the file's name ends: the longest piece before a colon or a number sign that exists, else before the first of
/// them that follows the last slash.
std::size_t FileNameLength(const std::string& text)
{
	for (std::size_t end = text.size(); end != std::string::npos && end > 0; end = text.find_last_of(":#", end - 1)) {
		if (Exists(text.substr(0, end))) return end;
	}
	const std::size_t slash = text.find_last_of('/');
	return std::min(text.find_first_of(":#", slash == std::string::npos ? 0 : slash), text.size());
}

void ParseFile(const std::string& text, FontRequest& request)
{
	const std::size_t end = FileNameLength(text);
	request.file = text.substr(0, end);
	std::string rest = text.substr(end);
	if (!rest.empty() && rest[0] == '#') {
		const char* last = rest.data() + rest.size();
		const auto [after, error] = std::from_chars(rest.data() + 1, last, request.face);
		if (error != std::errc() || (after != last && *after != ':'))
			throw TextError(TextErrorCode::BadFace, rest).ofFont(request.file);
		rest.erase(0, static_cast<std::size_t>(after - rest.data()));
	}
	if (rest.size() > 1) request.axes = ParseAxes(rest.substr(1));
}

void ParseFamily(const std::string& text, FontRequest& request)
{
	const std::size_t colon = std::min(text.find(':'), text.size());
	request.family = Trimmed(text.substr(0, colon));
	if (colon == text.size()) return;
	for (const std::string& piece : Split(text.substr(colon + 1), ":,")) {
		constexpr char kStyle[] = "style=";
		if (piece.rfind(kStyle, 0) == 0) request.style = piece.substr(sizeof kStyle - 1);
		else if (piece.find('=') != std::string::npos) request.axes.push_back(ParseAxis(piece));
		else if (!piece.empty()) request.style += (request.style.empty() ? "" : " ") + piece;
	}
}

}  // namespace

std::vector<AxisSetting> ParseAxes(const std::string& text)
{
	std::vector<AxisSetting> axes;
	for (const std::string& piece : Split(text, ":,")) {
		if (!piece.empty()) axes.push_back(ParseAxis(piece));
	}
	return axes;
}

FontRequest ParseFontRequest(const std::string& text)
{
	FontRequest request;
	request.text = text;
	const std::string name = Trimmed(text);
	if (name.empty()) return request;
	// A NUL would cut the name short in the systems below, and open another file than the one written.
	if (name.find('\0') != std::string::npos) throw TextError(TextErrorCode::FontNotFound, "NUL").ofFont(name.c_str());
	static const char* const kEndings[] = {".ttf", ".otf", ".ttc", ".otc", ".pfb", ".pfa", ".woff", ".woff2"};
	const bool endsLikeFile = std::any_of(std::begin(kEndings), std::end(kEndings), [&name](const std::string& e) {
		const std::size_t at = name.rfind(e);
		return at != std::string::npos &&
		       (at + e.size() == name.size() || name[at + e.size()] == '#' || name[at + e.size()] == ':');
	});
	std::error_code ignored;
	if (name.find('/') != std::string::npos || endsLikeFile || fs::is_regular_file(fs::u8path(name), ignored))
		ParseFile(name, request);
	else ParseFamily(name, request);
	if (request.file.empty() && request.family.empty()) throw TextError(TextErrorCode::FontNotFound).ofFont(text);
	return request;
}

std::shared_ptr<const std::string> ReadFontFile(const std::string& file)
{
	FileBytes read = ReadWholeFile(file, kLargestFont);
	if (!read.bytes)
		throw TextError(read.exists ? TextErrorCode::NotAFont : TextErrorCode::FontNotFound, read.why).ofFont(file);
	return std::move(read.bytes);
}

}  // namespace textlabel
