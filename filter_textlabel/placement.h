#pragma once
// Where the label goes: from a request and a part to frames for the library.
//
// A placement gives a list of attempts, best first. A view and a point give one frame; when the size is left to us, it is tried
// from large to small. Automatic placement gives one attempt for each place found.

#include "auto_placement.h"
#include "camera_xml.h"
#include "label_request.h"
#include "surface_line.h"

#include <functional>
#include <optional>
#include <vector>

namespace textlabel {

/// One way to put the label on the part.
struct Attempt {
	vcg::textlabel::LabelFrame frame;  ///< world coordinates; toWorld is left to the caller
	double size = 0;                   ///< capital height
	double wall = 0;                   ///< how thick the part is known to be there; 0: not known
};

/// Triangles in world coordinates.
struct PartGeometry {
	std::vector<vcg::Point3d> positions;        ///< #V by 3
	std::vector<std::array<int, 3>> triangles;  ///< #F by 3, counter-clockwise seen from outside
};

/// What a placement asks of the part.
struct PartProbe {
	vcg::Box3d box;                                                       ///< world coordinates, not null
	std::function<std::vector<SurfaceHit>(const SightLine&)> hitsOnLine;  ///< see surface_line.h
	std::function<PartGeometry()> geometry;
};

/// A request's text at any size; the last outline is kept.
class TextSetter {
public:
	explicit TextSetter(const LabelRequest& request) : request_(request) {}
	/// @throws TextError
	const TextOutline& at(double size);

private:
	const LabelRequest& request_;
	TextOutline outline_;
	double size_ = 0;
};

/// The view that a request names: its camera's XML, or its numbers.
/// @throws RequestError{Camera..., DirectionZero, UpAlongDirection}
Camera RequestedCamera(const LabelRequest& request);

/// Where, and how large, to put the label.
/// @param[in] camera  the view, for Current view and Camera
/// @throws RequestError{DirectionZero, UpAlongDirection, ViewMissesPart, ViewFromInside, PointMissesPart, HiddenPlace, NoPlace}
/// @throws TextError
std::vector<Attempt> PlanAttempts(const LabelRequest& request, const Camera& camera, const PartProbe& part,
                                  TextSetter& text);

}  // namespace textlabel
