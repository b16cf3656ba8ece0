#pragma once
// What a host can ask for: one struct, and one table that says how each host names, explains and stores its members.
//
// MeshLab's dialogs, scripts (.mlx), PyMeshLab's keywords and the command line are all built from this table and read back
// through it, so a parameter is written down once. Plain C++: no Qt, no MeshLab.

#include "text_outline.h"

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>
#include <vcg/space/box3.h>
#include <vcg/space/point3.h>

namespace textlabel {

enum class LabelStyle { Emboss, Engrave, Flat };
enum class PlacementKind { CurrentView, Camera, PointAndDirection, Automatic };
enum class ExtrudeDirection { Viewpoint, LabelNormal, SurfaceNormal };

using Rgb = std::array<std::uint8_t, 3>;  ///< sRGB

/// For size, depth and tolerance: the filter chooses. Zero and every other negative number is an error.
constexpr double ChosenToFit = -1;

/// Everything that a host can ask; lengths, places and directions in world coordinates, which are the mesh's own but for a layer with
/// a matrix.
struct LabelRequest {
	std::string text = "A43";    ///< UTF-8; a newline, or \n as two characters, breaks a line
	std::string font;            ///< family, or font file; empty: the font inside the plugin
	double size = ChosenToFit;   ///< capital height, or the height of a code or a drawing
	double depth = ChosenToFit;  ///< height of the relief, always positive
	LabelStyle style = LabelStyle::Emboss;
	PlacementKind placement = PlacementKind::Automatic;
	std::string camera;               ///< MeshLab's camera as XML; empty: the numbers below
	vcg::Point3d position{0, 0, 0};   ///< the point to label; for Camera without XML: the viewpoint
	vcg::Point3d direction{0, 0, 1};  ///< towards the viewer, any length
	vcg::Point3d up{0, 0, 0};         ///< top of the letters; zero: chosen so that it reads upright
	double fieldOfView = 60;          ///< degrees, for Camera without XML
	double offsetU = 0, offsetV = 0;  ///< shift in the label plane
	double rotation = 0;              ///< degrees, counter-clockwise as the viewer sees it
	bool wrap = false;                ///< round the axis that the surface has there
	double wrapRadius = 0;            ///< not 0: round an axis so far behind the place, negative towards the viewer
	ExtrudeDirection extrudeAlong = ExtrudeDirection::Viewpoint;
	double tolerance = ChosenToFit;  ///< chord error of curves
	CodeKind code = CodeKind::None;
	std::string drawing;  ///< SVG file that is cut instead of the text; empty: none
	Align align = Align::Center;
	Anchor anchor = Anchor::Middle;
	double fitWidth = 0;               ///< > 0: width of the text, the size follows
	double lineSpacing = 1;            ///< times the font's own
	double letterSpacing = 0;          ///< added between letters, in capital heights
	double slant = 0;                  ///< degrees to the right
	double embolden = 0;               ///< outlines moved outwards
	double arcRadius = 0;              ///< of the baseline; 0: straight
	bool mirrored = false;             ///< for moulds and stamps
	std::string language, features;    ///< see TextOptions
	bool fallbackFonts = false;        ///< see TextOptions
	double minStroke = 0, minGap = 0;  ///< > 0: refuse letters below it
	bool tint = false;                 ///< colour the faces of a raised or sunk label too
	Rgb color{230, 60, 20};
	double maxStretch = 8;     ///< largest surface length over label length
	double fileDigits = 0;     ///< of the file: > 0 significant ones, < 0 decimals; 0: single precision
	std::string report;        ///< file for the report (JSON); empty: none
	std::string picture;       ///< file for a picture (PNG); empty: none
	bool pictureBack = false;  ///< the picture shows the label from behind (open surfaces)
	std::string outline;       ///< file for the flat label (SVG); empty: none

	bool isWrapped() const { return wrap || wrapRadius != 0; }
};

/// How a host's dialog should offer a parameter, beyond its type.
enum class ParameterUse { Value, FontName, DrawingName, Place, Direction, JsonFile, ImageFile, VectorFile };

/// A member of LabelRequest.
using ParameterField = std::variant<std::string LabelRequest::*, double LabelRequest::*, bool LabelRequest::*,
                                    vcg::Point3d LabelRequest::*, Rgb LabelRequest::*, LabelStyle LabelRequest::*,
                                    PlacementKind LabelRequest::*, ExtrudeDirection LabelRequest::*,
                                    Align LabelRequest::*, Anchor LabelRequest::*, CodeKind LabelRequest::*>;

/// One row of the table.
struct Parameter {
	const char* name;   ///< in scripts and as Python keyword: a contract, never renamed
	const char* label;  ///< in dialogs, with the unit
	const char* help;
	ParameterField field;
	ParameterUse use = ParameterUse::Value;
	bool advanced = false;  ///< folded away in dialogs; in MeshLab 2020.09, which cannot, a part of `more`

	/// Ending of the file that this parameter names and the filter writes, or null.
	const char* fileEnding() const
	{
		switch (use) {
		case ParameterUse::JsonFile: return "json";
		case ParameterUse::ImageFile: return "png";
		case ParameterUse::VectorFile: return "svg";
		default: return nullptr;
		}
	}
};

/// All parameters in the order of the dialog.
const std::vector<Parameter>& ParameterTable();

/// The row of a name, or nullptr.
const Parameter* FindParameter(const std::string& name);

/// Names of an enumeration's values as hosts show and store them, in order of their numbers.
const std::vector<std::string>& ChoiceNames(LabelStyle);
const std::vector<std::string>& ChoiceNames(PlacementKind);
const std::vector<std::string>& ChoiceNames(ExtrudeDirection);
const std::vector<std::string>& ChoiceNames(Align);
const std::vector<std::string>& ChoiceNames(Anchor);
const std::vector<std::string>& ChoiceNames(CodeKind);

/// Call visitor(member) with a reference to the member that the parameter describes, in its own type.
template <class Request, class Visitor>
void VisitMember(const Parameter& parameter, Request& request, Visitor&& visitor)
{
	std::visit([&](const auto field) { visitor(request.*field); }, parameter.field);
}

/// The shortest text that reads back to the same number; independent of the locale.
std::string NumberText(double value);

/// A member's value as text: numbers shortest and exact, points as x,y,z, colours as rrggbb, choices by their names.
std::string ValueText(const Parameter& parameter, const LabelRequest& request);

/// Set a member from such a text; choices also in lower case, as a beginning of the name, or as number.
/// @throws RequestError{UnreadableValue} with the parameter's name
void SetValue(const Parameter& parameter, LabelRequest& request, const std::string& text);

/// What a parameter takes, in words that go on from "Give": "a number", "one of Emboss, Engrave, Flat".
/// @param[in] name  of any row, or moreName
std::string TakenText(const std::string& name);

/// Every parameter as a person reads it: name, what it takes, default, help.
std::string ParameterHelp();

/// Where a host has one text for all advanced parameters (MeshLab 2020.09, whose dialog would outgrow the screen): its name.
constexpr const char* moreName = "more";
constexpr const char* moreLabel = "More options";
/// How to write it, and what there is.
std::string MoreHelp();

/// The advanced parameters that are not at their defaults: "slant=12; mirrored=true". A backslash stands before a semicolon or
/// a backslash within a value.
std::string MoreText(const LabelRequest& request);

/// Set advanced parameters from such a text.
/// @throws RequestError{UnknownParameter, HasOwnField, UnreadableValue}
void SetMore(LabelRequest& request, const std::string& text);

/// How the text is to be set at a capital height.
TextOptions TextOptionsOf(const LabelRequest& request, double size);

/// How thin a part may be under a wrapped label (LabelOptions::minStretch): so that letters keep the strokes and gaps that are asked
/// for, and shrink no more than they may stretch.
double LeastStretch(const LabelRequest& request, const TextOutline& outline);

/// Defaults for a part in a window: a size and a depth to start from, the point of view that the user sees.
/// Without a window the defaults are those of LabelRequest: all that depends on the part is chosen when the filter runs.
/// @param[in] box  the part's, world coordinates; may be null
LabelRequest WindowDefaults(const vcg::Box3d& box);

/// Reject what no part could take, before any work is done.
/// @param[in] box  the part's bounding box in world coordinates, not null
/// @throws RequestError with the parameter's name and the numbers
void CheckRequest(const LabelRequest& request, const vcg::Box3d& box);

}  // namespace textlabel
