#include "drawing_style.h"

#include <algorithm>
#include <cmath>
#include "drawing_scan.h"
#include "text_words.h"

namespace textlabel {
namespace {

constexpr double kRadian = 3.14159265358979323846 / 180;
/// From this share on a colour is white.
constexpr double kWhite = 0.98;

/// The pieces between separators that are not empty.
std::vector<std::string> Words(const std::string& text, const char* separators)
{
	std::vector<std::string> words = Split(text, separators);
	words.erase(std::remove(words.begin(), words.end(), ""), words.end());
	return words;
}

// ---- colours

int HexDigit(char c) { return Scanner::IsDigit(c) ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1; }

/// #rgb, #rgba, #rrggbb or #rrggbbaa
Paint HexPaint(const std::string& digits)
{
	const std::size_t each = digits.size() > 4 ? 2 : 1;
	bool isWhite = true;
	for (std::size_t i = 0; i + each <= digits.size(); i += each) {
		const int value = HexDigit(digits[i]) * (each == 1 ? 17 : 16) + (each == 2 ? HexDigit(digits[i + 1]) : 0);
		const bool isAlpha = i / each == 3;
		if (isAlpha && value < (isWhite ? kCovering * 255 : 1)) return Paint::None;
		isWhite = isWhite && (isAlpha || value >= kWhite * 255);
	}
	return isWhite ? Paint::White : Paint::Ink;
}

/// rgb(), rgba(), hsl() and hsla(), with numbers or percentages.
Paint FunctionPaint(const std::string& text)
{
	const bool isHsl = text.compare(0, 3, "hsl") == 0;
	Scanner scanner(std::string_view(text).substr(text.find('(') + 1));
	std::vector<double> shares;
	while (shares.size() < 4) {
		const auto number = scanner.number();
		if (!number) break;
		const bool isPercent = scanner.word() == "%";
		const bool isAlpha = shares.size() == 3;
		shares.push_back(isPercent ? *number / 100 : isAlpha ? *number : *number / 255);
		if (scanner.peek() == '/') scanner.take();
	}
	if (shares.size() < 3) return Paint::Ink;
	const bool isWhite = isHsl ? shares[2] >= kWhite : std::min({shares[0], shares[1], shares[2]}) >= kWhite;
	if (shares.size() == 4 && (shares[3] <= 0 || (isWhite && shares[3] < kCovering))) return Paint::None;
	return isWhite ? Paint::White : Paint::Ink;
}

Paint ParsePaint(const std::string& value, Paint inherited, Paint color)
{
	const std::string text = LowerCase(value);
	if (text == "inherit") return inherited;
	if (text == "none" || text == "transparent") return Paint::None;
	if (text == "currentcolor") return color;
	if (text == "white") return Paint::White;
	if (text[0] == '#') return HexPaint(text.substr(1));
	if (text.find('(') != std::string::npos && text.compare(0, 3, "url") != 0) return FunctionPaint(text);
	return Paint::Ink;  // another name, a gradient, a pattern
}

// ---- properties

/// An opacity as a share.
double ParseOpacity(const std::string& value, double otherwise)
{
	Scanner scanner(value);
	const auto number = scanner.number();
	if (!number) return otherwise;
	return std::clamp(scanner.word() == "%" ? *number / 100 : *number, 0.0, 1.0);
}

FillRule ParseRule(const std::string& value, FillRule otherwise)
{
	return value == "evenodd" ? FillRule::EvenOdd : value == "nonzero" ? FillRule::NonZero : otherwise;
}

void SetLine(const std::string& property, const std::string& value, DrawnStyle& style)
{
	if (property == "stroke-linejoin")
		style.line.join = value == "round" ? LineJoin::Round : value == "bevel" ? LineJoin::Bevel : LineJoin::Miter;
	if (property == "stroke-linecap")
		style.line.cap = value == "round" ? LineCap::Round : value == "square" ? LineCap::Square : LineCap::Butt;
	if (property == "stroke-miterlimit")
		style.line.miterLimit = Scanner(value).number().value_or(style.line.miterLimit);
	if (property == "stroke-width") style.lineWidth = value;
	if (property == "stroke-dasharray")  // zeros are no dashes
		style.isDashed = value.find_first_of("123456789") != std::string::npos;
}

/// What is no property of ours, or "inherit", changes nothing.
void SetProperty(const std::string& property, const std::string& value, DrawnStyle& style)
{
	if (value.empty()) return;
	if (property == "color") style.color = ParsePaint(value, style.color, style.color);
	else if (property == "fill") style.fill = ParsePaint(value, style.fill, style.color);
	else if (property == "stroke") style.stroke = ParsePaint(value, style.stroke, style.color);
	else if (property == "fill-opacity") style.fillOpacity = ParseOpacity(value, style.fillOpacity);
	else if (property == "stroke-opacity") style.strokeOpacity = ParseOpacity(value, style.strokeOpacity);
	else if (property == "fill-rule") style.fillRule = ParseRule(value, style.fillRule);
	else if (property == "clip-rule") style.clipRule = ParseRule(value, style.clipRule);
	else if (property == "visibility") style.isVisible = value == "inherit" ? style.isVisible : value == "visible";
	else if (property == "display") style.isDisplayed = value != "none";
	else if (property == "opacity") style.opacity = ParseOpacity(value, style.opacity);
	else if (property == "vector-effect") style.keepsLineWidth = value == "non-scaling-stroke";
	else if (property == "overflow") style.mayOverflow = value == "visible" || value == "auto";
	else if (property == "clip-path") style.clip = value;
	else if (property == "mask") style.mask = value;
	else if (property == "transform") style.transform = value;
	else if (property == "transform-origin") style.hasOrigin = value.find_first_of("123456789cbr") != std::string::npos;
	else if (property.compare(0, 6, "marker") == 0) style.hasMarkers = value != "none" && value != "inherit";
	else if (value != "inherit") SetLine(property, value, style);
}

/// Style sheets without their comments.
std::string WithoutComments(const std::string& css)
{
	std::string rest;
	for (std::size_t at = 0; at < css.size();) {
		const std::size_t begin = std::min(css.find("/*", at), css.size());
		rest += css.substr(at, begin - at);
		const std::size_t end = begin == css.size() ? std::string::npos : css.find("*/", begin + 2);
		at = end == std::string::npos ? css.size() : end + 2;
	}
	return rest;
}

}  // namespace

DrawnStyle DrawnStyle::inherited() const
{
	DrawnStyle style = *this;
	const DrawnStyle initial;
	style.isDisplayed = initial.isDisplayed;
	style.opacity = initial.opacity;
	style.hasOrigin = initial.hasOrigin;
	style.keepsLineWidth = initial.keepsLineWidth;
	style.mayOverflow = initial.mayOverflow;
	style.clip = style.mask = style.transform = "";
	return style;
}

StyleSheet::StyleSheet(const SvgNode& root)
{
	collect(root);
	std::stable_sort(m_rules.begin(), m_rules.end(),
	                 [](const Rule& a, const Rule& b) { return a.selector.weight() < b.selector.weight(); });
}

void StyleSheet::collect(const SvgNode& node)
{
	if (node.name == "style") parse(WithoutComments(node.text));
	for (const SvgNode& child : node.children) collect(child);
}

void StyleSheet::parse(const std::string& css)
{
	for (std::size_t at = 0; at < css.size();) {
		const std::size_t open = css.find('{', at);
		if (open == std::string::npos) return;
		std::size_t close = open + 1;
		for (int depth = 1; close < css.size() && depth > 0; ++close)
			depth += css[close] == '{' ? 1 : css[close] == '}' ? -1 : 0;
		// a statement such as @charset stands before a rule; @media and its like are passed over with all that is in them
		std::string head = css.substr(at, open - at);
		head = Trimmed(head.substr(head.rfind(';') + 1));
		if (head.empty() || head[0] != '@') {
			const Declarations declarations = ParseDeclarations(css.substr(open + 1, close - open - 2));
			for (const std::string& text : Words(head, ","))
				if (auto selector = ParseSelector(text)) m_rules.push_back({std::move(*selector), declarations});
		}
		at = close;
	}
}

StyleSheet::Declarations StyleSheet::ParseDeclarations(const std::string& text)
{
	Declarations declarations;
	for (const std::string& piece : Words(text, ";")) {
		const std::size_t colon = piece.find(':');
		if (colon == std::string::npos) continue;
		std::string value = piece.substr(colon + 1);
		value.erase(std::min(value.find('!'), value.size()));  // !important
		declarations.emplace_back(LowerCase(Trimmed(piece.substr(0, colon))), Trimmed(value));
	}
	return declarations;
}

std::optional<StyleSheet::Selector> StyleSheet::ParseSelector(const std::string& text)
{
	if (text.find_first_of(" \t\r\n>+~:[") != std::string::npos) return std::nullopt;
	Selector selector;
	for (std::size_t at = 0; at < text.size();) {
		const std::size_t end = std::min(text.find_first_of(".#", at + 1), text.size());
		const std::string piece = text.substr(at, end - at);
		if (piece[0] == '.') selector.classes.push_back(piece.substr(1));
		else if (piece[0] == '#') selector.id = piece.substr(1);
		else if (piece != "*") selector.element = piece;
		at = end;
	}
	return selector;
}

bool StyleSheet::Selector::matches(const SvgNode& node, const std::vector<std::string>& classesOfNode) const
{
	const auto isOfNode = [&](const std::string& name) {
		return std::find(classesOfNode.begin(), classesOfNode.end(), name) != classesOfNode.end();
	};
	return (element.empty() || element == node.name) && (id.empty() || id == node["id"]) &&
	       std::all_of(classes.begin(), classes.end(), isOfNode);
}

/// As CSS has it: any id before any number of classes, any class before an element.
int StyleSheet::Selector::weight() const
{
	constexpr int ofId = 1000000, ofClass = 1000;
	return (id.empty() ? 0 : ofId) + ofClass * static_cast<int>(classes.size()) + (element.empty() ? 0 : 1);
}

void StyleSheet::apply(const SvgNode& node, DrawnStyle& style) const
{
	// what a colour refers to comes first
	const auto setAll = [&](const auto& declarations) {
		for (const bool isColor : {true, false})
			for (const auto& [property, value] : declarations)
				if ((property == "color") == isColor) SetProperty(property, Trimmed(value), style);
	};
	setAll(node.attributes);
	const std::vector<std::string> classes = Words(node["class"], kBlanks);
	for (const Rule& rule : m_rules)
		if (rule.selector.matches(node, classes)) setAll(rule.declarations);
	setAll(ParseDeclarations(node["style"]));
}

std::optional<double> ParseLength(const std::string& text, double whole)
{
	constexpr double inch = 96;  // user units, as CSS has it
	struct Unit {
		const char* name;
		double size;
	};
	const Unit units[] = {{"", 1},          {"px", 1},           {"pt", inch / 72},
	                      {"pc", inch / 6}, {"mm", inch / 25.4}, {"cm", inch / 2.54},
	                      {"in", inch},     {"q", inch / 101.6}, {"%", whole / 100},
	                      {"em", 16},       {"rem", 16},         {"ex", 8}};
	Scanner scanner(text);
	const auto number = scanner.number();
	if (!number) return std::nullopt;
	const std::string name = LowerCase(scanner.word());
	for (const Unit& unit : units)
		if (name == unit.name && scanner.atEnd()) return *number * unit.size;
	return std::nullopt;
}

std::optional<Affine> ParseTransform(const std::string& text)
{
	Affine all;
	Scanner scanner(text);
	while (!scanner.atEnd()) {
		const std::string name = LowerCase(scanner.word());
		if (name == "none") continue;
		if (scanner.take() != '(') return std::nullopt;
		std::vector<double> n;
		while (scanner.peek() != ')') {
			const auto number = scanner.number();
			if (!number || n.size() == 6) return std::nullopt;
			n.push_back(*number);
			const std::string unit = LowerCase(scanner.word());  // those of style sheets
			if (!unit.empty() && unit != "px" && unit != "deg") return std::nullopt;
		}
		scanner.take();
		const auto has = [&](std::size_t least, std::size_t most) { return n.size() >= least && n.size() <= most; };
		const auto nth = [&](std::size_t i, double otherwise) { return i < n.size() ? n[i] : otherwise; };
		Affine map;
		if (name == "matrix" && has(6, 6)) {
			map = {n[0], n[2], n[1], n[3], n[4], n[5]};
		} else if (name == "translate" && has(1, 2)) {
			map = {1, 0, 0, 1, n[0], nth(1, 0)};
		} else if (name == "scale" && has(1, 2)) {
			map = {n[0], 0, 0, nth(1, n[0]), 0, 0};
		} else if (name == "rotate" && (has(1, 1) || has(3, 3))) {
			const double c = std::cos(n[0] * kRadian), s = std::sin(n[0] * kRadian), x = nth(1, 0), y = nth(2, 0);
			map = {c, -s, s, c, x - c * x + s * y, y - s * x - c * y};
		} else if (name == "skewx" && has(1, 1)) {
			map.xy = std::tan(n[0] * kRadian);
		} else if (name == "skewy" && has(1, 1)) {
			map.yx = std::tan(n[0] * kRadian);
		} else {
			return std::nullopt;
		}
		all = all.after(map);
	}
	return all;
}

std::string ReferenceOf(const std::string& value)
{
	if (value.compare(0, 4, "url(") != 0) return {};
	std::string inner = Trimmed(value.substr(4, value.find(')') - 4));
	if (inner.size() >= 2 && (inner[0] == '"' || inner[0] == '\'')) inner = inner.substr(1, inner.size() - 2);
	return !inner.empty() && inner[0] == '#' ? inner.substr(1) : std::string();
}

}  // namespace textlabel
