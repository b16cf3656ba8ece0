#include "label_request.h"

#include <algorithm>

namespace textlabel {

const std::vector<std::string>& ChoiceNames(LabelStyle)
{
	static const std::vector<std::string> names{"Emboss", "Engrave", "Flat"};
	return names;
}

const std::vector<std::string>& ChoiceNames(PlacementKind)
{
	static const std::vector<std::string> names{"Current view", "Camera", "Point and direction", "Automatic"};
	return names;
}

const std::vector<std::string>& ChoiceNames(ExtrudeDirection)
{
	static const std::vector<std::string> names{"Viewpoint", "Label normal", "Surface normal"};
	return names;
}

const std::vector<std::string>& ChoiceNames(Align)
{
	static const std::vector<std::string> names{"Left", "Center", "Right"};
	return names;
}

const std::vector<std::string>& ChoiceNames(Anchor)
{
	static const std::vector<std::string> names{"Baseline", "Middle", "Top"};
	return names;
}

const std::vector<std::string>& ChoiceNames(CodeKind)
{
	static const std::vector<std::string> names = [] {
		std::vector<std::string> each;
		for (int kind = 0; kind <= int(CodeKind::Code128); ++kind) each.emplace_back(CodeName(CodeKind(kind)));
		return each;
	}();
	return names;
}

const std::vector<Parameter>& ParameterTable()
{
	using R = LabelRequest;
	using Use = ParameterUse;
	constexpr bool advanced = true;
	static const std::vector<Parameter> table{
		{"text", "Text",
	     "The text of the label, in any language. Write \\n to break a line and \\t for a tab; \\\\n and \\\\t stand "
	     "for "
	     "themselves, as in C:\\\\temp.",
	     &R::text},
		{"font", "Font",
	     "A font family (DejaVu Sans:Bold) or a font file (.ttf, .otf, .ttc; font.ttc#1 is its second face). Axes of a "
	     "variable font follow a colon: Inter:wght=650, font.ttf:wght=650,opsz=32. Empty: DejaVu Sans Bold, which is "
	     "inside this filter.",
	     &R::font, Use::FontName},
		{"size", "Size (capital height, mesh units)",
	     "Height of a capital letter (of the whole, for a code or a drawing), in the units of the mesh, as its layer's "
	     "matrix "
	     "scales it. -1: chosen so that "
	     "the text fits.",
	     &R::size},
		{"depth", "Depth (mesh units)",
	     "How far the letters stand out (Emboss) or sink in (Engrave), in the units of the mesh; Flat ignores "
	     "it. -1: chosen from the size.",
	     &R::depth},
		{"style", "Style",
	     "Emboss: the letters stand out of the surface. Engrave: they sink into it. Flat: the surface keeps "
	     "its shape, the letters are coloured and selected. MeshLab's window shows the colour of faces only where "
	     "Color: Face is chosen in the pane beside it.",
	     &R::style},
		{"placement", "Placement",
	     "Current view: where the centre of the window meets the part, as you see it when you press Apply. "
	     "Camera: the same with a copied camera. Point and direction: on the surface at a point, seen in "
	     "parallel. Automatic: on the largest flat region that holds the text.",
	     &R::placement},
		{"camera", "Camera (as text)",
	     "For the placement Camera: what 'Copy camera settings to clipboard' gives. Empty: the viewpoint is "
	     "the position below, looking against the direction below.",
	     &R::camera},
		{"position", "Position",
	     "For Point and direction: the point to label, in world coordinates; it is moved onto the surface "
	     "along the direction. For Camera without text: the viewpoint.",
	     &R::position, Use::Place},
		{"direction", "Direction to the viewer",
	     "From the surface to the one who reads, of any length but zero. For Point and direction, and for "
	     "Camera without text.",
	     &R::direction, Use::Direction},
		{"up", "Up",
	     "Where the top of the letters points, across the line of sight. 0 0 0: chosen so that the text "
	     "reads upright; in a view, as you hold it.",
	     &R::up, Use::Direction},
		{"field_of_view", "Field of view (degrees)",
	     "Of a Camera without text. 5 and less is a parallel view, as in MeshLab.", &R::fieldOfView, Use::Value,
	     advanced},
		{"offset_u", "Shift right (mesh units)",
	     "Moves the label to the right, as the viewer sees it and before it is rotated; round the part when it is "
	     "wrapped.",
	     &R::offsetU},
		{"offset_v", "Shift up (mesh units)",
	     "Moves the label upwards, as the viewer sees it and before it is rotated.", &R::offsetV},
		{"rotation", "Rotation (degrees)", "Turns the label counter-clockwise, as the viewer sees it.", &R::rotation},
		{"wrap", "Wrap round the part",
	     "Runs the label round the part, as on a bottle, a ring or a shaft: every letter looks straight away from the "
	     "axis, or towards it inside a pipe. The axis is found from the surface at the place; the text reads round it "
	     "or along it, whichever is nearer to how it would be flat. Not for the placement Automatic.",
	     &R::wrap},
		{"wrap_radius", "Distance to the axis (mesh units)",
	     "Wraps the label round an axis so far straight behind the place, with the direction of up; negative: towards "
	     "the "
	     "viewer, for the inside of a pipe. 0: none, or, with Wrap round the part, the one that the surface has.",
	     &R::wrapRadius, Use::Value, advanced},
		{"extrude_along", "Extrude along",
	     "Viewpoint: along the lines of sight; this never folds. Label normal: straight out of the label's "
	     "plane. Surface normal: along the smoothed normals of the surface.",
	     &R::extrudeAlong},
		{"tolerance", "Tolerance (mesh units)",
	     "Largest distance between the font's curves and the polygons that are cut. -1: fine for the size.",
	     &R::tolerance},
		{"code", "Code",
	     "Mark the text as a code that a camera reads, instead of in letters. The size is then the height of the whole "
	     "symbol; font, language, spacing, slant, arc and tolerance do not count. A GS1 Data Matrix has its "
	     "identifiers in "
	     "brackets: "
	     "[01]09506000134352[21]0042. Leave a margin around it: four modules (the "
	     "squares it is made of) for a QR Code, ten for Code 128, one or two for the others.",
	     &R::code, Use::Value, advanced},
		{"drawing", "Drawing (SVG file)",
	     "Cut the drawing of this file instead of the text, as a logo. The size is then its height. All that it paints "
	     "is "
	     "ink, whatever the colour, but white, which takes away what is below it. Of what belongs to the text only the "
	     "width "
	     "to fit, the tolerance, alignment, Embolden and Mirrored count. Empty: none.",
	     &R::drawing, Use::DrawingName, advanced},
		{"align", "Align", "Which end of the lines of text comes to the place.", &R::align},
		{"anchor", "Anchor", "Which height of the text comes to the place.", &R::anchor, Use::Value, advanced},
		{"fit_width", "Width to fit (mesh units)",
	     "Width of the whole text (on an arc: before it is bent); the size is ignored, it follows from this. 0: the "
	     "size "
	     "counts.",
	     &R::fitWidth, Use::Value, advanced},
		{"line_spacing", "Line spacing", "Distance between lines, times the font's own.", &R::lineSpacing, Use::Value,
	     advanced},
		{"letter_spacing", "Letter spacing", "Space added between letters, in capital heights.", &R::letterSpacing,
	     Use::Value, advanced},
		{"slant", "Slant (degrees)", "Leans the letters to the right.", &R::slant, Use::Value, advanced},
		{"embolden", "Embolden (mesh units)", "Moves the outlines outwards; negative numbers thin the letters.",
	     &R::embolden, Use::Value, advanced},
		{"arc_radius", "Arc radius (mesh units)",
	     "Sets the text on a circle. Positive: on top of it. Negative: hanging in it. 0: straight.", &R::arcRadius,
	     Use::Value, advanced},
		{"mirrored", "Mirrored", "Left and right swapped, for moulds and stamps.", &R::mirrored, Use::Value, advanced},
		{"language", "Language", "For letter forms that differ by language, as ja, zh-Hant or sr. Empty: none.",
	     &R::language, Use::Value, advanced},
		{"features", "OpenType features", "Comma-separated, as tnum,ss01,-liga.", &R::features, Use::Value, advanced},
		{"fallback_fonts", "Fallback fonts",
	     "Take characters that the font lacks from other installed fonts, instead of refusing the text.",
	     &R::fallbackFonts, Use::Value, advanced},
		{"min_stroke", "Thinnest stroke (mesh units)",
	     "Refuse the text when a stroke is thinner than this, of a wrapped label where the part is thinnest. 0: not "
	     "checked.",
	     &R::minStroke, Use::Value, advanced},
		{"min_gap", "Narrowest gap (mesh units)",
	     "Refuse the text when a gap is narrower than this, of a wrapped label where the part is thinnest. 0: not "
	     "checked.",
	     &R::minGap, Use::Value, advanced},
		{"tint", "Colour raised and sunk letters", "Colour the faces of an embossed or engraved label too.", &R::tint},
		{"color", "Colour", "Face colour of a flat label, and of others when Colour raised and sunk letters is on.",
	     &R::color},
		{"max_stretch", "Largest stretch",
	     "A surface that is steep to the view stretches the letters. The label is refused where a length on "
	     "the surface is more than so many times the length in the label; a wrapped one also where it is so many times "
	     "less.",
	     &R::maxStretch, Use::Value, advanced},
		{"file_digits", "Digits of the file",
	     "For a file format that keeps fewer digits than single precision has: the label is made so that it is right "
	     "there, too, or refused. 6: six significant digits (DAE, X3D, VRML), 7 (OFF of MeshLab 2020.09). -6: six "
	     "decimals (3MF, and OBJ of "
	     "MeshLab 2020.09). 0: the file keeps all (STL, PLY).",
	     &R::fileDigits, Use::Value, advanced},
		{"report", "Report file", "Write the report (JSON) to this file. Empty: it is logged only.", &R::report,
	     Use::JsonFile, advanced},
		{"picture", "Picture file", "Write a picture (PNG) of the labelled part to this file. Empty: none.",
	     &R::picture, Use::ImageFile, advanced},
		{"picture_back", "Picture from behind",
	     "The picture shows the label from behind: on an open surface a sunk label stands out there.", &R::pictureBack,
	     Use::Value, advanced},
		{"outline", "Outline file", "Write the flat label (SVG) to this file. Empty: none.", &R::outline,
	     Use::VectorFile, advanced},
	};
	return table;
}

const Parameter* FindParameter(const std::string& name)
{
	const auto& table = ParameterTable();
	const auto row = std::find_if(table.begin(), table.end(), [&](const Parameter& p) { return name == p.name; });
	return row == table.end() ? nullptr : &*row;
}

}  // namespace textlabel
