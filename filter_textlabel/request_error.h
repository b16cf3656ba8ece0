#pragma once
// What can be wrong with a request before, beside and after the work of the library.

#include <exception>
#include <string>

namespace textlabel {

enum class RequestProblem {
	UnknownParameter,       ///< parameter: the name
	HasOwnField,            ///< parameter: the name of one that is not for More options
	UnreadableValue,        ///< detail: the text
	NotANumber,             ///< NaN or infinite
	NotWhole,               ///< a number with a fraction
	NeitherPositiveNorFit,  ///< value; -1 would be "chosen to fit"
	LargerThanPart,         ///< value, limit: the part's diagonal
	OutOfRange,             ///< value, limit: the bound that it breaks
	EmptyPart,              ///< no vertex or no face
	CameraNotXml,           ///< detail: what the XML reader says
	CameraMissing,          ///< XML without a camera
	CameraIncomplete,       ///< detail: the attribute that is missing or unreadable
	CameraNotRotation,      ///< the rotation matrix is none
	NoWindow,               ///< Current view without a window
	ViewMissesPart,         ///< the view axis plus offset meets no face
	ViewFromInside,         ///< the first face on the view axis shows its back
	DirectionZero,          ///< parameter
	UpAlongDirection,
	PointMissesPart,  ///< no face that looks to the viewer on the line through the position
	PointSeesBack,    ///< there are faces on it, and all show their backs
	HiddenPlace,      ///< another face lies before the position; value: distance between them
	HiddenByBack,     ///< the same of one that shows its back
	HiddenRound,  ///< of a wrapped label: another face lies between its anchor and where it is seen from; value: as above
	WrapNeedsPlace,  ///< wrapped, and the placement is Automatic
	NoAxis,          ///< the surface bends round no axis at the place
	NoPlace,         ///< Automatic found nothing; value: the size asked, or ChosenToFit
	FileNotWritten,  ///< detail: the path
	OverDrawing,     ///< a file to write is the drawing; detail: the path
};

/// A refusal that is not the library's; the mesh is as it was.
struct RequestError : std::exception {
	RequestProblem problem;
	std::string parameter;  ///< name of the parameter that is to blame, or empty
	std::string detail;     ///< see the problem
	double value = 0;       ///< see the problem
	double limit = 0;       ///< see the problem

	explicit RequestError(RequestProblem p, std::string blamed = {}, std::string more = {})
		: problem(p), parameter(std::move(blamed)), detail(std::move(more))
	{}
	RequestError& measured(double v, double l = 0)
	{
		value = v;
		limit = l;
		return *this;
	}
	const char* what() const noexcept override { return detail.c_str(); }
};

}  // namespace textlabel
