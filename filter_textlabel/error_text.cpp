#include "error_text.h"
#include "label_request.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace textlabel {
namespace {

using vcg::textlabel::Error;
using vcg::textlabel::ErrorCode;

std::string Place(const vcg::Point3d& p)
{
	return "(" + Figure(p[0]) + ", " + Figure(p[1]) + ", " + Figure(p[2]) + ")";
}

std::string Letter(const Error& error, const ErrorContext& context)
{
	const bool known = error.letter >= 0 && size_t(error.letter) < context.letters.size();
	return known ? "the letter '" + context.letters[size_t(error.letter)] + "'" : "the label";
}

std::string Capital(std::string text)
{
	if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = char(text[0] - 'a' + 'A');
	return text;
}

/// The nearest figure that is not below a number, or not above it: one that is told as a limit has to work.
std::string FigureBeyond(double value, double direction)
{
	constexpr double halfDigit = 5e-6;  // relative, of the six that a figure has
	const std::string figure = Figure(value);
	double printed = 0;
	std::from_chars(figure.data(), figure.data() + figure.size(), printed);
	return (printed - value) * direction >= 0 ? figure : Figure(value + direction * std::abs(value) * halfDigit);
}

std::string FigureAbove(double value) { return FigureBeyond(value, 1); }
std::string FigureBelow(double value) { return FigureBeyond(value, -1); }

std::string Where(const Error& error) { return error.hasPlace ? " near " + Place(error.place) : std::string(); }

/// How much room there is, or "" when the library could not say.
std::string Room(const Error& error)
{
	return error.limit > 0 && std::isfinite(error.limit) ? "; there is room for " + Figure(error.limit) : std::string();
}

std::string UseDepth(const Error& error)
{
	return error.limit > 0 && std::isfinite(error.limit) ? "Use a depth below " + Figure(error.limit)
	                                                     : "Use a smaller depth";
}

const char* const moveIt =
	"Move the label (position, offset_u, offset_v), turn it (rotation), or make it smaller (size).";

// MeshLab's own filters, by the names that its menus have.
const std::string invertFaces = "'Invert Faces Orientation'";
const std::string mergeVertices = "'Remove Duplicate Vertices'";
#if MESHLAB_API == 2025
const std::string orientFaces = "'Re-Orient all faces coherently'";
#else
const std::string orientFaces = "'Re-Orient all faces coherentely'";
#endif
#if MESHLAB_API == 2020
const std::string repairEdges = "'Repair non Manifold Edges by removing faces'";
#else
const std::string repairEdges = "'Repair non Manifold Edges'";
#endif

/// What else helps where coordinates are too coarse.
std::string FinerFile(const ErrorContext& context)
{
	return context.fileDigits == 0 ? "" : " Or save it in a format with more digits, as .ply or .stl.";
}

/// Refusals that name a letter and a place.
std::string PlaceText(const Error& error, const ErrorContext& context)
{
	const std::string letter = Capital(Letter(error, context)), where = Where(error);
	switch (error.code) {
	case ErrorCode::OffSurface: return letter + " lies beside the surface" + where + ". " + moveIt;
	case ErrorCode::FacesAway:
		return letter + " meets the back of the surface" + where +
		       (context.isWrapped
		            ? ". It runs over a hole or a step: move it. Or it lies on the wrong side of its axis: it is read "
		              "from outside, in a pipe from the axis (direction, or the sign of wrap_radius). Or the part's "
		              "faces are turned inside out: then run "
		            : ". Look at the part from outside; when it looks right there, its faces are turned inside "
		              "out: run ") +
		       orientFaces + " or " + invertFaces + " first.";
	case ErrorCode::Border:
		if (context.isWrapped)
			return letter + " runs over an end, a border or a hole of the surface, or to where it cannot be unrolled" +
			       where + ". " + moveIt + " Where none is to be seen, run " + mergeVertices + " first.";
		return letter + " runs over a border or a hole of the surface" + where + ". " + moveIt +
		       " Or close the hole first; where none is to be seen, the triangles do not hang together: run " +
		       mergeVertices + ".";
	case ErrorCode::Silhouette:
		if (context.isWrapped)
			return letter +
			       " runs over an edge where the part turns away from the axis, or where something stands on it" +
			       where + ". " + moveIt;
		return letter + " runs over the horizon of the part as seen from the viewpoint" + where + ". " + moveIt;
	case ErrorCode::NonManifold:
		return letter +
		       " lies on an edge that is not manifold (three or more faces, or faces of opposite orientation)" + where +
		       ". Move the label, or repair the part first (" + repairEdges + ", " + orientFaces + ").";
	case ErrorCode::Occluded:
		return letter + " is partly hidden from the viewer by another surface" + where +
		       (context.isWrapped ? ". Move the label round the part or along it, or make it smaller (size)."
		                          : ". Look at the place from another side, or move the label.");
	case ErrorCode::TooLong:
		return letter + where + " is " + FigureAbove(error.value) +
		       " long with its margins, and the way round the part is " + FigureBelow(error.limit) +
		       ". Make the text smaller (size) or shorter, or move the axis (wrap_radius).";
	case ErrorCode::BehindCamera:
		if (context.isWrapped && error.value != 0)
			return letter + " would reach the axis that it runs round" + where + ". Use a smaller depth.";
		if (context.isWrapped)
			return letter + " meets a face that cannot be unrolled" + where +
			       ": one that reaches to the axis, as the end of a turned part does, or one on the far side where the "
			       "two ends of the label come near each other. " +
			       moveIt;
		if (error.value > 0)
			return letter + " would rise to the camera" + where +
			       ". Use a smaller depth, or move the camera away from the part.";
		return letter + " lies on a surface that reaches behind the camera" + where +
		       ". Move the camera away from the part.";
	case ErrorCode::Grazing:
		if (!std::isfinite(error.value))
			return letter + " lies on a surface that turns its back to the direction in which the label is extruded" +
			       where + ". Extrude along the viewpoint (extrude_along), or " +
			       (context.isWrapped ? "move the label." : "look at the place more from the front.");
		return letter + " lies on a surface that is too steep to the " + (context.isWrapped ? "axis" : "view") + where +
		       ": it would be stretched " + FigureAbove(error.value) + " times, " + Figure(error.limit) +
		       " is allowed. " +
		       (context.isWrapped ? "Move the label, or give another axis (up, wrap_radius)"
		                          : "Look at the place more from the front") +
		       ", or raise max_stretch.";
	case ErrorCode::Squeezed:
		return letter + " lies nearer to the axis than the place of the label" + where + ": it would be " +
		       FigureBelow(error.value) + " times as wide as it was measured, and has to be " +
		       FigureAbove(error.limit) +
		       " times. Move the label to where the part is as thick. Or, where min_stroke or min_gap ask for it, make "
		       "the text larger (size) or lower them; else raise max_stretch.";
	case ErrorCode::TooFine:
		if (!(error.value > 0))
			return letter + " meets corners or edges of the mesh" + where +
			       " in a way that its coordinates cannot carry (details below " + Figure(error.limit) +
			       " are lost). Move the label a little (offset_u, offset_v), make the text larger, or move the part "
			       "nearer to the origin." +
			       FinerFile(context);
		return letter + " has details of " + Figure(error.value) + where +
		       ", finer than the coordinates of the mesh can carry (" + Figure(error.limit) +
		       "). Make the text larger, the tolerance coarser, or move the part nearer to the origin." +
		       FinerFile(context);
	case ErrorCode::HitsSurface:
		return letter + " would run into another part of the surface" + where + " at depth " +
		       Figure(std::abs(context.depth)) + Room(error) + ". " + UseDepth(error) + ", or move the label.";
	case ErrorCode::HitsItself:
		return letter + " would fold or cut itself" + where + " at depth " + Figure(std::abs(context.depth)) +
		       Room(error) + ". " + UseDepth(error) +
		       (context.isAlongView ? "." : ", or extrude along the viewpoint (extrude_along).");
	default: return letter + " was refused" + where + ".";
	}
}

std::string CameraText(const RequestError& error)
{
	const std::string copy = " In MeshLab, use 'Copy camera settings to clipboard' (Ctrl+C) and paste all of it.";
	switch (error.problem) {
	case RequestProblem::CameraNotXml:
		return "The camera is not XML: " + error.detail + ", line " + Figure(error.value) + ", column " +
		       Figure(error.limit) + "." + copy;
	case RequestProblem::CameraMissing: return "The camera's text holds no VCGCamera." + copy;
	case RequestProblem::CameraIncomplete: return "The camera's " + error.detail + " is missing or unreadable." + copy;
	default: return "The camera's RotationMatrix is not a rotation." + copy;
	}
}

std::string NumberSentence(const RequestError& error)
{
	const std::string is = "The parameter " + error.parameter + " is " + Figure(error.value);
	switch (error.problem) {
	case RequestProblem::NotANumber: return is + ". Give a finite number.";
	case RequestProblem::NotWhole: return is + ". Give a whole number.";
	case RequestProblem::NeitherPositiveNorFit:
		return is + ". Give a number above 0 in the units of the mesh, or -1 to have one chosen.";
	case RequestProblem::LargerThanPart:
		return is + ", larger than the part, whose diagonal is " + Figure(error.limit) +
		       ". Give a smaller number, in the units of the mesh.";
	default:
		return is + ". Give a number of " +
		       (error.value < error.limit ? "at least " + FigureAbove(error.limit)
		                                  : "at most " + FigureBelow(error.limit)) +
		       ".";
	}
}

}  // namespace

std::string Figure(double value)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.6g", value);
	for (char& c : text)
		if (c == ',') c = '.';  // a host's locale
	return text;
}

bool DependsOnPlace(ErrorCode code) { return code >= ErrorCode::OffSurface && code <= ErrorCode::HitsItself; }

std::string ErrorText(const Error& error, const ErrorContext& context)
{
	switch (error.code) {
	case ErrorCode::EmptyLabel: return "The text has nothing to cut. Give a text with at least one visible letter.";
	case ErrorCode::BadContour:
		return Capital(Letter(error, context)) +
		       " has an outline that is not a simple polygon. Try another font, or a finer tolerance.";
	case ErrorCode::BadFrame:
		return "The label's place is not well defined (" + error.message +
		       "). Give a finite position, a direction that is not zero, an up "
		       "that is not parallel to it, a camera outside the part, and a layer whose matrix moves, turns and "
		       "scales only.";
	case ErrorCode::BadHeight:
		if (error.value > 0 && error.value <= error.limit)
			return "The depth " + Figure(error.value) + " is finer than the coordinates of the mesh can carry here (" +
			       Figure(error.limit) + "). Use a larger depth, or move the part nearer to the origin." +
			       FinerFile(context);
		return "The depth " + Figure(context.depth) + " is not possible here" + Room(error) +
		       ". Give a finite depth smaller than the part.";
	case ErrorCode::EmptyMesh:
		return "The mesh has no faces: it is empty or a point cloud. Load a surface, or reconstruct one first.";
	case ErrorCode::TooLarge:
		return "The mesh has " + Figure(error.value) + " vertices or faces, more than can be numbered (" +
		       Figure(error.limit) + "). Label a piece of it, or simplify it first.";
	case ErrorCode::Cancelled: return "Cancelled; the mesh is as it was.";
	case ErrorCode::OutOfMemory:
		return "Not enough memory; the mesh is as it was. Close other layers, or make the tolerance coarser.";
	default: return PlaceText(error, context);
	}
}

std::string ErrorText(const TextError& error) { return Sentence(error); }

std::string ErrorText(const RequestError& error)
{
	switch (error.problem) {
	case RequestProblem::UnknownParameter:
		return "There is no parameter '" + error.parameter +
		       "'. The filter's help and label.sh --parameters have the names.";
	case RequestProblem::HasOwnField:
		return "The parameter " + error.parameter + " has a field of its own. Set it there, not in More options.";
	case RequestProblem::UnreadableValue:
		return "The value '" + error.detail + "' of " + error.parameter + " cannot be read. Give " +
		       TakenText(error.parameter) + ".";
	case RequestProblem::EmptyPart:
		return "The mesh has no faces: it is empty or a point cloud. Load a surface, or reconstruct one first.";
	case RequestProblem::CameraNotXml:
	case RequestProblem::CameraMissing:
	case RequestProblem::CameraIncomplete:
	case RequestProblem::CameraNotRotation: return CameraText(error);
	case RequestProblem::NoWindow:
		return "The placement Current view needs MeshLab's window. In scripts use the placement Automatic, Point and "
			   "direction, or Camera.";
	case RequestProblem::ViewMissesPart:
		return "The centre of the view, with its offset, meets no part of the surface. Turn or move the view so that "
			   "the place of the "
			   "label is in its centre, or change offset_u and offset_v.";
	case RequestProblem::ViewFromInside:
		return "The camera is inside the part, or the part's faces are turned inside out: the first face in the view "
		       "shows its back. Move "
		       "the camera outside, or run " +
		       invertFaces + " first.";
	case RequestProblem::DirectionZero:
		return "The direction is zero. Give a vector from the surface to the viewer, for example 0 0 1 for a label "
			   "read from above.";
	case RequestProblem::UpAlongDirection:
		return "The parameter up points along the line of sight. Give an up that points across it, or 0 0 0 to have "
			   "one chosen.";
	case RequestProblem::PointMissesPart:
		return "No face looks to the viewer on the line through the position along the direction. Move the position "
			   "over the part, or "
			   "turn the direction to the side that the label should be on.";
	case RequestProblem::PointSeesBack:
		return "The surface at the position shows its back to the viewer. Turn the direction to the side that the "
		       "label should be on. If it points there already, the part's faces are turned inside out: run " +
		       invertFaces + " first.";
	case RequestProblem::HiddenPlace:
		return "Another surface lies " + Figure(error.value) +
		       " in front of the position, so the viewer would not see the label. Move "
		       "the position to that surface, or look from another direction.";
	case RequestProblem::HiddenByBack:
		return "The first surface on the line to the position shows its back, " + Figure(error.value) +
		       " in front of the nearest one that faces the viewer. The part's faces are turned inside out: run " +
		       invertFaces + " first. Or, if they are not, look from another direction.";
	case RequestProblem::HiddenRound:
		return "Another surface lies " + Figure(error.value) +
		       " before the place of the label, seen towards the axis (in a pipe, from the axis), and the letters "
		       "would land on it. Move the label to that surface, or to where nothing is before it; or label the "
		       "place without wrapping, from a direction that shows it. In a pipe, wrap_radius is negative.";
	case RequestProblem::WrapNeedsPlace:
		return "A label that is wrapped needs a place. Give a position and a direction (in the dialog and in scripts "
			   "with the placement Point and direction), or a view.";
	case RequestProblem::NoAxis:
		return "The surface at the place bends round no axis that can be measured. Move the place to where the part is "
		       "round, look at it more from the side, or say how far behind the place the axis is (wrap_radius) and "
		       "that it points upwards in the label (up). If the triangles do not hang together, run " +
		       mergeVertices + " first.";
	case RequestProblem::NoPlace:
		return "No place on the part holds the text" +
		       (error.value > 0
		            ? " at size " + Figure(error.value) + ". Make it smaller, or use size -1 to have one chosen."
		            : ". Make the text shorter, or choose a place yourself (placement Point and direction).") +
		       " If the part's faces are turned inside out, run " + invertFaces + " first.";
	case RequestProblem::FileNotWritten:
		return "The file '" + error.detail + "' (" + error.parameter +
		       ") cannot be written. Choose a folder that exists, may be written to, and has room.";
	case RequestProblem::OverDrawing:
		return "The " + error.parameter + " would be written over the drawing '" + error.detail +
		       "'. Give it a name of its own.";
	default: return NumberSentence(error);
	}
}

}  // namespace textlabel
