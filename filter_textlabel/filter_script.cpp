#include "filter_script.h"
#include "request_error.h"
#include "text_utf8.h"

namespace textlabel {
namespace {

/// One character of an attribute's value; empty when XML 1.0 cannot carry it.
std::string XmlCharacter(char32_t c)
{
	switch (c) {
	case '&': return "&amp;";
	case '<': return "&lt;";
	case '>': return "&gt;";
	case '"': return "&quot;";
	case '\n':
	case '\t':
	case '\r': return "&#" + std::to_string(int(c)) + ";";  // a reader would turn the character itself into a blank
	default: return c < 0x20 || c == 0xFFFE || c == 0xFFFF ? std::string() : EncodeUtf8({&c, 1});
	}
}

std::string Attribute(const Parameter& parameter, const std::string& name, const std::string& value)
{
	const auto fail = [&] { throw RequestError(RequestProblem::UnreadableValue, parameter.name, value); };
	std::string text = " " + name + "=\"";
	try {
		for (const char32_t c : DecodeUtf8(value)) {
			const std::string character = XmlCharacter(c);
			if (character.empty()) fail();
			text += character;
		}
	} catch (const TextError&) {
		fail();
	}
	return text + '"';
}

// ---- type and value of a parameter as attributes, one overload for each type of member

std::string Attributes(const Parameter& p, const std::string& value)
{
	return Attribute(p, "type", p.fileEnding() ? "RichSaveFile" : "RichString") + Attribute(p, "value", value) +
	       (p.fileEnding() ? Attribute(p, "ext", std::string("*.") + p.fileEnding()) : std::string());
}

std::string NumberAttribute(const char* name, double value)
{
	return std::string(" ") + name + "=\"" + NumberText(value) + '"';
}

std::string Attributes(const Parameter&, double value)
{
	return " type=\"RichFloat\"" + NumberAttribute("value", value);
}

std::string Attributes(const Parameter&, bool value)
{
	return std::string(" type=\"RichBool\" value=\"") + (value ? "true" : "false") + '"';
}

std::string Attributes(const Parameter&, const vcg::Point3d& value)
{
	return " type=\"RichPoint3f\"" + NumberAttribute("x", value[0]) + NumberAttribute("y", value[1]) +
	       NumberAttribute("z", value[2]);
}

std::string Attributes(const Parameter&, const Rgb& value)
{
	return " type=\"RichColor\"" + NumberAttribute("r", value[0]) + NumberAttribute("g", value[1]) +
	       NumberAttribute("b", value[2]) + " a=\"255\"";
}

template <class Choice>
std::string Attributes(const Parameter& p, Choice value)
{
	const auto& names = ChoiceNames(value);
	std::string text = " type=\"RichEnum\" value=\"" + std::to_string(int(value)) + "\" enum_cardinality=\"" +
	                   std::to_string(names.size()) + '"';
	for (size_t i = 0; i < names.size(); ++i) text += Attribute(p, "enum_val" + std::to_string(i), names[i]);
	return text;
}

// ---- Python

std::string Quoted(const std::string& text)
{
	std::string quoted = "'";
	for (const char c : text) {
		if (c == '\n') quoted += "\\n";
		else if (c == '\r') quoted += "\\r";
		else {
			if (c == '\'' || c == '\\') quoted += '\\';
			quoted += c;
		}
	}
	return quoted + "'";
}

template <class Type>
std::string PythonValue(const Type& value, const std::string& text)
{
	if constexpr (std::is_same_v<Type, double>)
		return text == "nan" || text == "inf" || text == "-inf" ? "float('" + text + "')" : text;
	else if constexpr (std::is_same_v<Type, bool>) return value ? "True" : "False";
	else if constexpr (std::is_same_v<Type, vcg::Point3d>) return "[" + text + "]";
	else if constexpr (std::is_same_v<Type, Rgb>)
		return "pymeshlab.Color(" + std::to_string(value[0]) + ", " + std::to_string(value[1]) + ", " +
		       std::to_string(value[2]) + ", 255)";
	else return Quoted(text);
}

}  // namespace

std::string ScriptText(const LabelRequest& request)
{
	std::string script =
		"<!DOCTYPE FilterScript>\n<FilterScript>\n <filter name=\"" + std::string(filterName) + "\">\n";
	for (const Parameter& parameter : ParameterTable()) {
		if (parameter.advanced) continue;
		script += "  <Param" + Attribute(parameter, "name", parameter.name);
		VisitMember(parameter, request, [&](const auto& value) { script += Attributes(parameter, value); });
		script += "/>\n";
	}
	const Parameter more{moreName, moreLabel, "", &LabelRequest::text};
	const std::string text = MoreText(request);
	script += "  <Param" + Attribute(more, "name", moreName) + Attributes(more, text) + "/>\n";
	return script + " </filter>\n</FilterScript>\n";
}

std::string PythonCall(const LabelRequest& request)
{
	const LabelRequest defaults;
	std::string call = "ms.apply_filter(" + Quoted(pythonName);
	for (const Parameter& parameter : ParameterTable()) {
		const std::string text = ValueText(parameter, request);
		if (text == ValueText(parameter, defaults) && parameter.name != std::string("text")) continue;
		VisitMember(parameter, request, [&](const auto& value) {
			call += std::string(", ") + parameter.name + "=" + PythonValue(value, text);
		});
	}
	return call + ")";
}

}  // namespace textlabel
