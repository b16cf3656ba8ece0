#pragma once
// Where the label goes: from a request and a part to frames for the library.
//
// A placement offers attempts, best first, until one is accepted. A view and a point give one frame; when the size is left to us, it
// is tried from large to small. Automatic placement offers one attempt for each place that it finds, and looks no further than needed.

#include "auto_placement.h"
#include "camera_xml.h"
#include "label_request.h"
#include "surface_line.h"
#include "wrap_axis.h"

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
	std::vector<std::uint32_t> paint;           ///< #F: their colours, where these may be labels; or empty
};

/// What a placement asks of the part.
struct PartProbe {
	vcg::Box3d box;                                                       ///< world coordinates, not null
	std::function<std::vector<SurfaceHit>(const SightLine&)> hitsOnLine;  ///< see surface_line.h
	std::function<PartGeometry()> geometry;
	SurfaceAround surfaceAround = nullptr;  ///< asked for wrapped labels only
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

/// Offer places and sizes for the label.
/// @param[in] camera  the view, for Current view and Camera
/// @param[in] accept  tries one; true ends the search
/// @return false when none was accepted, of one at least
/// @throws what accept throws
/// @throws RequestError{DirectionZero, UpAlongDirection, ViewMissesPart, ViewFromInside, PointMissesPart, PointSeesBack, HiddenPlace,
///         HiddenByBack, HiddenRound, NoAxis, NoPlace}
/// @throws TextError
bool OfferAttempts(const LabelRequest& request, const Camera& camera, const PartProbe& part, TextSetter& text,
                   const std::function<bool(const Attempt&)>& accept);

}  // namespace textlabel
