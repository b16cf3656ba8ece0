#include "request_parameters.h"
#include "request_error.h"

#include <QColor>
#include <charconv>
#include <memory>

namespace textlabel {
namespace {

#if MESHLAB_API == 2020
using RichPlace = RichPoint3f;
using RichDirectionTo = RichPoint3f;
using RichFileToWrite = RichSaveFile;
#else
using RichPlace = RichPosition;
using RichDirectionTo = RichDirection;
#if MESHLAB_API == 2022
using RichFileToRead = RichOpenFile;
using RichFileToWrite = RichSaveFile;
#else
using RichFileToRead = RichFileOpen;
using RichFileToWrite = RichFileSave;
#endif
#endif

using OwnedParameter = std::unique_ptr<RichParameter>;

template <class Rich, class... Arguments>
OwnedParameter Make(const Parameter& p, Arguments&&... arguments)
{
	const QString label = QString::fromUtf8(p.label), help = QString::fromUtf8(p.help);
#if MESHLAB_API == 2020
	return std::make_unique<Rich>(p.name, std::forward<Arguments>(arguments)..., label, help);
#else
	return std::make_unique<Rich>(p.name, std::forward<Arguments>(arguments)..., label, help, p.advanced);
#endif
}

// ---- one parameter with its value, by the type of the member

OwnedParameter ParameterOf(const Parameter& p, const std::string& value)
{
	const QString text = QString::fromStdString(value);
	if (p.fileEnding()) return Make<RichFileToWrite>(p, text, QStringLiteral("*.") + p.fileEnding());
#if MESHLAB_API != 2020  // there the file widget takes no typed text, so a family could not be given in it
	if (p.use == ParameterUse::FontName)
		return Make<RichFileToRead>(p, text, QStringList{"*.ttf", "*.otf", "*.ttc", "*.*"});
	if (p.use == ParameterUse::DrawingName) return Make<RichFileToRead>(p, text, QStringList{"*.svg"});
#endif
	return Make<RichString>(p, text);
}

OwnedParameter ParameterOf(const Parameter& p, double value) { return Make<RichFloat>(p, Scalarm(value)); }
OwnedParameter ParameterOf(const Parameter& p, bool value) { return Make<RichBool>(p, value); }
OwnedParameter ParameterOf(const Parameter& p, const Rgb& value)
{
	return Make<RichColor>(p, QColor(value[0], value[1], value[2]));
}

OwnedParameter ParameterOf(const Parameter& p, const vcg::Point3d& value)
{
	const Point3m point{Scalarm(value[0]), Scalarm(value[1]), Scalarm(value[2])};
	return p.use == ParameterUse::Place ? Make<RichPlace>(p, point) : Make<RichDirectionTo>(p, point);
}

template <class Choice>
OwnedParameter ParameterOf(const Parameter& p, Choice value)
{
	QStringList names;
	for (const std::string& name : ChoiceNames(value)) names << QString::fromStdString(name);
	return Make<RichEnum>(p, int(value), names);
}

// ---- reading

/// The decimal number that a person wrote: 0.1 where single precision holds 0.100000001. So that a label is the same whether its
/// numbers came in single or in double precision.
template <class Number>
double Written(Number value)
{
	char text[32];
	const char* const end = std::to_chars(text, text + sizeof text, value).ptr;
	double number = 0;
	std::from_chars(text, end, number);
	return number;
}

/// PyMeshLab takes each number as single precision and hands it on as double.
[[maybe_unused]] double Written(double value)
{
	const auto single = static_cast<float>(value);
	return static_cast<double>(single) == value ? Written<float>(single) : value;
}

/// A script may hold another type under our name; reading it would end the program.
void Require(bool hasType, const Parameter& p)
{
	if (!hasType) throw RequestError(RequestProblem::UnreadableValue, p.name, "a value of another type");
}

const Value& Held(const RichParameterList& list, const char* name)
{
	if (!list.hasParameter(name)) throw RequestError(RequestProblem::UnknownParameter, name);
	return list.getParameterByName(name).value();
}

#if MESHLAB_API == 2020
bool IsFile(const Value& value) { return value.isFileName(); }
bool IsChoice(const Value& value) { return value.isEnum(); }
#else
bool IsFile(const Value& value) { return value.isString(); }
bool IsChoice(const Value& value) { return value.isInt(); }
#endif
#if MESHLAB_API == 2025
bool IsPoint(const Value& value) { return value.isPoint3(); }
#else
bool IsPoint(const Value& value) { return value.isPoint3f(); }
#endif

void ReadMember(const RichParameterList& list, const Parameter& p, const Value& held, std::string& value)
{
	Require(p.fileEnding() ? IsFile(held) : held.isString(), p);
	value = (p.fileEnding() ? list.getSaveFileName(p.name) : held.getString()).toStdString();
}

void ReadMember(const RichParameterList& list, const Parameter& p, const Value& held, double& value)
{
	Require(held.isFloat(), p);
	value = Written(list.getFloat(p.name));
}

void ReadMember(const RichParameterList& list, const Parameter& p, const Value& held, bool& value)
{
	Require(held.isBool(), p);
	value = list.getBool(p.name);
}

void ReadMember(const RichParameterList& list, const Parameter& p, const Value& held, vcg::Point3d& value)
{
	Require(IsPoint(held), p);
	const Point3m point = list.getPoint3m(p.name);
	for (int i = 0; i < 3; ++i) value[i] = Written(point[i]);
}

void ReadMember(const RichParameterList& list, const Parameter& p, const Value& held, Rgb& value)
{
	Require(held.isColor(), p);
	const QColor color = list.getColor(p.name);
	value = {std::uint8_t(color.red()), std::uint8_t(color.green()), std::uint8_t(color.blue())};
}

template <class Choice>
void ReadMember(const RichParameterList& list, const Parameter& p, const Value& held, Choice& value)
{
	Require(IsChoice(held), p);
	const int number = list.getEnum(p.name);
	if (number < 0 || size_t(number) >= ChoiceNames(value).size())
		throw RequestError(RequestProblem::UnreadableValue, p.name, std::to_string(number));
	value = Choice(number);
}

#if MESHLAB_API == 2020
/// Its dialog cannot fold parameters away and would outgrow the screen.
bool IsListed(const Parameter& p) { return !p.advanced; }

void AddMore(const LabelRequest& request, RichParameterList& list)
{
	const QString help = QString::fromStdString(MoreHelp());
	list.addParam(RichString(moreName, QString::fromStdString(MoreText(request)), moreLabel, help));
}

void ReadMore(const RichParameterList& list, LabelRequest& request)
{
	const Value& held = Held(list, moreName);
	if (!held.isString()) throw RequestError(RequestProblem::UnreadableValue, moreName, "a value of another type");
	SetMore(request, held.getString().toStdString());
}
#else
bool IsListed(const Parameter&) { return true; }
void AddMore(const LabelRequest&, RichParameterList&) {}
void ReadMore(const RichParameterList&, LabelRequest&) {}
#endif

}  // namespace

void AddParameters(const LabelRequest& request, RichParameterList& list)
{
	for (const Parameter& p : ParameterTable())
		if (IsListed(p)) VisitMember(p, request, [&](const auto& value) { list.addParam(*ParameterOf(p, value)); });
	AddMore(request, list);
}

LabelRequest ReadParameters(const RichParameterList& list)
{
	LabelRequest request;
	for (const Parameter& p : ParameterTable())
		if (IsListed(p)) VisitMember(p, request, [&](auto& value) { ReadMember(list, p, Held(list, p.name), value); });
	ReadMore(list, request);
	return request;
}

void StoreParameter(const LabelRequest& request, const char* name, RichParameterList& list)
{
	const Parameter& p = *FindParameter(name);
	VisitMember(p, request, [&](const auto& value) { list.setValue(p.name, ParameterOf(p, value)->value()); });
}

}  // namespace textlabel
