#pragma once
// What a run tells about itself: one line of JSON.

#include "label_request.h"

#include <optional>
#include <utility>
#include <vcg/math/matrix44.h>

namespace textlabel {

/// A mesh in numbers.
struct MeshNumbers {
	int vertices = 0, triangles = 0;
	double volume = 0;         ///< enclosed, world units cubed; of a closed mesh, else of the cone to its box's centre
	bool hasTopology = false;  ///< the numbers below were counted
	int borderEdges = 0, nonManifoldEdges = 0, components = 0;
	std::optional<int> genus;  ///< handles; of an oriented manifold only
};

/// How the label was seen; world coordinates.
struct UsedView {
	vcg::Point3d anchor{0, 0, 0};     ///< on the surface, under the label's anchor
	vcg::Point3d direction{0, 0, 1};  ///< unit, towards the viewer: the label plane's normal
	vcg::Point3d up{0, 1, 0};         ///< unit
	bool perspective = false;
	vcg::Point3d viewpoint{0, 0, 0};  ///< when perspective
	double wrapRadius = 0;            ///< not 0: wrapped round an axis so far behind the anchor
	vcg::Point3d wrapAxis{0, 1, 0};   ///< unit, when wrapped
};

struct LabelReport {
	LabelRequest request;        ///< as it can be run again: a view of a window has become a camera
	double size = 0, depth = 0;  ///< used: capital height; signed height
	std::string font;            ///< used; several are separated by "; "
	MeshNumbers before, after;
	int touchedTriangles = 0;
	double labelArea = 0, surfaceArea = 0;  ///< in the label plane; on the surface, world units squared
	double stretch = 1;                     ///< largest surface length over label length
	double leastStretch = 1;                ///< LabelResult::leastStretch
	double resolution = 0;                  ///< no contour point was moved by more, world units
	double coordinateStep = 0;    ///< between the largest coordinates, world units; the label was checked on it
	bool survivesFloat32 = true;  ///< false: in a file of single precision, as STL, the letters would be spoilt
	double module = 0;            ///< side of a code's squares; 0: there is none
	double thinnestStroke = 0, narrowestGap = 0;
	UsedView view;
	std::vector<std::pair<const char*, double>> milliseconds;  ///< stages in order, and "total"
};

/// The report as one line of JSON without a line break.
std::string ReportJson(const LabelReport& report);

}  // namespace textlabel
