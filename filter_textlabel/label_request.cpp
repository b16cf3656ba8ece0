#include "label_request.h"
#include "request_error.h"
#include "text_words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace textlabel {
namespace {

bool ReadNumber(const std::string& text, double& value)
{
	const char* first = text.data();
	if (!text.empty() && text[0] == '+') ++first;
	const char* const last = text.data() + text.size();
	const auto [end, error] = std::from_chars(first, last, value);
	return error == std::errc() && end == last;
}

/// The items between semicolons, blank ones left out; a backslash takes the meaning from the character behind it.
std::vector<std::string> SplitItems(const std::string& text)
{
	std::vector<std::string> items{""};
	for (size_t i = 0; i < text.size(); ++i) {
		if (text[i] == ';') items.emplace_back();
		else if (text[i] == '\\' && i + 1 < text.size()) items.back() += text[++i];
		else items.back() += text[i];
	}
	items.erase(
		std::remove_if(items.begin(), items.end(), [](const std::string& item) { return Trimmed(item).empty(); }),
		items.end());
	return items;
}

// ---- text of a value, one overload for each type of member

std::string TextOf(const std::string& value) { return value; }
std::string TextOf(double value) { return NumberText(value); }
std::string TextOf(bool value) { return value ? "true" : "false"; }
std::string TextOf(const vcg::Point3d& p) { return NumberText(p[0]) + "," + NumberText(p[1]) + "," + NumberText(p[2]); }

std::string TextOf(const Rgb& color)
{
	static const char* const digits = "0123456789abcdef";
	std::string text;
	for (const unsigned part : color) {
		text += digits[part / 16];
		text += digits[part % 16];
	}
	return text;
}

template <class Choice>
std::string TextOf(Choice value)
{
	return ChoiceNames(value)[size_t(value)];
}

// ---- what a person may write, one overload for each type of member

std::string Taken(const std::string&) { return "printable UTF-8 text"; }
std::string Taken(double) { return "a number"; }
std::string Taken(bool) { return "true or false"; }
std::string Taken(const vcg::Point3d&) { return "three numbers, as 0,0,1"; }
std::string Taken(const Rgb&) { return "a colour, as ff8000"; }

template <class Choice>
std::string Taken(Choice value)
{
	std::string text;
	for (const std::string& name : ChoiceNames(value)) text += (text.empty() ? "one of " : ", ") + name;
	return text;
}

// ---- value of a text; false: unreadable

bool Read(const std::string& text, std::string& value)
{
	value = text;
	return true;
}

bool Read(const std::string& text, double& value) { return ReadNumber(text, value); }

bool Read(const std::string& text, bool& value)
{
	value = text == "true" || text == "1";
	return value || text == "false" || text == "0";
}

bool Read(const std::string& text, vcg::Point3d& value)
{
	const auto parts = Split(text, ",");
	if (parts.size() != 3) return false;
	for (int i = 0; i < 3; ++i)
		if (!ReadNumber(parts[size_t(i)], value[i])) return false;
	return true;
}

bool Read(const std::string& text, Rgb& value)
{
	const std::string digits = !text.empty() && text[0] == '#' ? text.substr(1) : text;
	if (digits.size() != 6) return false;
	for (size_t i = 0; i < 3; ++i) {
		const char* const first = digits.data() + 2 * i;
		const auto [end, error] = std::from_chars(first, first + 2, value[i], 16);
		if (error != std::errc() || end != first + 2) return false;
	}
	return true;
}

template <class Choice>
bool Read(const std::string& text, Choice& value)
{
	const auto& names = ChoiceNames(value);
	const std::string wanted = LowerCase(text);
	int meant = 0;
	for (size_t i = 0; i < names.size(); ++i) {
		const bool begins = !wanted.empty() && LowerCase(names[i]).compare(0, wanted.size(), wanted) == 0;
		if (!begins && wanted != std::to_string(i)) continue;
		value = Choice(i);
		++meant;
	}
	return meant == 1;  // more than one begin like this
}

// ---- checks

void CheckFinite(const Parameter& parameter, const LabelRequest& request)
{
	const auto check = [&](double value) {
		if (!std::isfinite(value)) throw RequestError(RequestProblem::NotANumber, parameter.name).measured(value);
	};
	VisitMember(parameter, request, [&](const auto& value) {
		using Type = std::decay_t<decltype(value)>;
		if constexpr (std::is_same_v<Type, double>) check(value);
		else if constexpr (std::is_same_v<Type, vcg::Point3d>)
			for (int i = 0; i < 3; ++i) check(value[i]);
	});
}

void CheckLength(const char* name, double value, double largest)
{
	if (value == ChosenToFit) return;
	if (!(value > 0)) throw RequestError(RequestProblem::NeitherPositiveNorFit, name).measured(value);
	if (value > largest) throw RequestError(RequestProblem::LargerThanPart, name).measured(value, largest);
}

void CheckRange(const char* name, double value, double low, double high)
{
	if (value < low) throw RequestError(RequestProblem::OutOfRange, name).measured(value, low);
	if (value > high) throw RequestError(RequestProblem::OutOfRange, name).measured(value, high);
}

/// What a label writes must not replace the drawing that it was made of.
void CheckDrawingStays(const LabelRequest& request)
{
	namespace fs = std::filesystem;
	for (const Parameter& parameter : ParameterTable()) {
		if (!parameter.fileEnding()) continue;
		const std::string path = ValueText(parameter, request);
		std::error_code ignored;  // of a file that is not there
		if (!path.empty() && fs::equivalent(fs::u8path(path), fs::u8path(request.drawing), ignored))
			throw RequestError(RequestProblem::OverDrawing, parameter.name, path);
	}
}

/// Two significant digits, so that a dialog shows the number as it is.
double Rounded(double value)
{
	if (!(value > 0) || !std::isfinite(value)) return 1;
	const double step = std::pow(10, std::floor(std::log10(value)) - 1);
	return std::round(value / step) * step;
}

}  // namespace

std::string NumberText(double value)
{
	char buffer[32];
	const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
	return {buffer, end};
}

std::string ValueText(const Parameter& parameter, const LabelRequest& request)
{
	std::string text;
	VisitMember(parameter, request, [&](const auto& value) { text = TextOf(value); });
	return text;
}

void SetValue(const Parameter& parameter, LabelRequest& request, const std::string& text)
{
	VisitMember(parameter, request, [&](auto& value) {
		if (!Read(text, value)) throw RequestError(RequestProblem::UnreadableValue, parameter.name, text);
	});
}

std::string TakenText(const std::string& name)
{
	const Parameter* const parameter = FindParameter(name);
	if (!parameter) return "name=value; name=value";
	if (parameter->fileEnding()) return std::string("the name of a .") + parameter->fileEnding() + " file";
	const LabelRequest defaults;
	std::string text;
	VisitMember(*parameter, defaults, [&](const auto& value) { text = Taken(value); });
	return text;
}

std::string ParameterHelp()
{
	const LabelRequest defaults;
	std::string help;
	for (const Parameter& p : ParameterTable()) {
		const std::string value = ValueText(p, defaults);
		help += std::string(p.name) + "  " + TakenText(p.name) + "; default " + (value.empty() ? "empty" : value) +
		        "\n    " + p.label + ". " + p.help + "\n";
	}
	return help;
}

std::string MoreHelp()
{
	std::string help = "Written as name=value; name=value, with \\; for a semicolon within a value. There are:";
	for (const Parameter& p : ParameterTable())
		if (p.advanced) help += std::string(" <b>") + p.name + "</b> (" + p.label + "): " + p.help;
	return help;
}

std::string MoreText(const LabelRequest& request)
{
	const LabelRequest defaults;
	std::string text;
	for (const Parameter& p : ParameterTable()) {
		const std::string value = ValueText(p, request);
		if (!p.advanced || value == ValueText(p, defaults)) continue;
		text += (text.empty() ? "" : "; ") + std::string(p.name) + "=";
		for (const char c : value) {
			if (c == ';' || c == '\\') text += '\\';
			text += c;
		}
	}
	return text;
}

void SetMore(LabelRequest& request, const std::string& text)
{
	for (const std::string& item : SplitItems(text)) {
		const size_t equals = item.find('=');
		const std::string name = Trimmed(item.substr(0, equals));
		const Parameter* const parameter = FindParameter(name);
		if (!parameter || equals == std::string::npos) throw RequestError(RequestProblem::UnknownParameter, name);
		if (!parameter->advanced) throw RequestError(RequestProblem::HasOwnField, name);
		SetValue(*parameter, request, Trimmed(item.substr(equals + 1)));
	}
}

TextOptions TextOptionsOf(const LabelRequest& request, double size)
{
	TextOptions options;
	options.font = request.font;
	options.language = request.language;
	options.features = request.features;
	options.fallbackFonts = request.fallbackFonts;
	options.code = request.code;
	options.drawing = request.drawing;
	options.size = size;
	options.tolerance = request.tolerance == ChosenToFit ? 0 : request.tolerance;
	options.align = request.align;
	options.anchor = request.anchor;
	options.lineSpacing = request.lineSpacing;
	options.letterSpacing = request.letterSpacing;
	options.slant = request.slant;
	options.embolden = request.embolden;
	options.arcRadius = request.arcRadius;
	options.mirrored = request.mirrored;
	options.minStroke = request.minStroke;
	options.minGap = request.minGap;
	return options;
}

double LeastStretch(const LabelRequest& request, const TextOutline& outline)
{
	constexpr double rounding = 1e-4;  // of coordinates: a label where it was measured is none the thinner for it
	const auto needed = [](double asked, const Narrowest& has) {
		return asked > 0 && has.width > 0 ? (1 - rounding) * asked / has.width : 0;
	};
	return std::max({1 / request.maxStretch, needed(request.minStroke, outline.thinnestStroke),
	                 needed(request.minGap, outline.narrowestGap)});
}

LabelRequest WindowDefaults(const vcg::Box3d& box)
{
	constexpr double sizeOfDiagonal = 0.05, depthOfSize = 0.1;
	LabelRequest request;
	request.placement = PlacementKind::CurrentView;
	if (box.IsNull()) return request;
	request.size = Rounded(box.Diag() * sizeOfDiagonal);
	request.depth = Rounded(request.size * depthOfSize);
	request.position = {(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2, box.max[2]};
	return request;
}

void CheckRequest(const LabelRequest& request, const vcg::Box3d& box)
{
	for (const Parameter& parameter : ParameterTable()) CheckFinite(parameter, request);
	if (request.fitWidth == 0) CheckLength("size", request.size, box.Diag());
	if (request.style != LabelStyle::Flat) CheckLength("depth", request.depth, box.Diag());
	CheckLength("tolerance", request.tolerance, box.Diag());
	constexpr double wayRound = 3.15;  // of the diagonal: no circle within a part is longer
	CheckRange("fit_width", request.fitWidth, 0, box.Diag() * (request.isWrapped() ? wayRound : 1));
	CheckRange("field_of_view", request.fieldOfView, 0, 180);
	constexpr double farthest = 1e3;  // of the diagonal: what is less bent is flat
	CheckRange("wrap_radius", request.wrapRadius, -farthest * box.Diag(), farthest * box.Diag());
	if (request.isWrapped() && request.placement == PlacementKind::Automatic)
		throw RequestError(RequestProblem::WrapNeedsPlace, "wrap");
	CheckRange("max_stretch", request.maxStretch, 1, INFINITY);
	constexpr double mostDigits = 15;  // of a double
	CheckRange("file_digits", request.fileDigits, -mostDigits, mostDigits);
	if (request.fileDigits != std::trunc(request.fileDigits))
		throw RequestError(RequestProblem::NotWhole, "file_digits").measured(request.fileDigits);
	if (!request.drawing.empty()) CheckDrawingStays(request);
}

}  // namespace textlabel
