#include "placement.h"
#include "placement_part.h"
#include "request_error.h"

#include <algorithm>
#include <cmath>

namespace textlabel {
namespace {

using vcg::textlabel::LabelFrame;

const vcg::Point3d origin(0, 0, 0);

/// Up for a text that is read upright: the world's z, and on a floor or a ceiling its y, as on a sheet on the table.
vcg::Point3d UprightFor(const vcg::Point3d& towardsViewer)
{
	constexpr double level = 0.9659258262890683;  // cosine of 15 degrees
	return std::abs(towardsViewer[2]) > level * towardsViewer.Norm() ? vcg::Point3d(0, 1, 0) : vcg::Point3d(0, 0, 1);
}

/// A parallel frame at the request's position.
/// @param[in] up  finite, not zero
LabelFrame FrameOf(const LabelRequest& request, const vcg::Point3d& direction, const vcg::Point3d& up)
{
	try {
		return vcg::textlabel::FrameFromDirection(request.position, direction, up);
	} catch (const vcg::textlabel::Error&) {  // finite and not zero: only this is left
		throw RequestError(RequestProblem::UpAlongDirection, "up");
	}
}

/// From the request's direction and up.
LabelFrame FrameOf(const LabelRequest& request)
{
	if (request.direction == origin) throw RequestError(RequestProblem::DirectionZero, "direction");
	return FrameOf(request, request.direction, request.up == origin ? UprightFor(request.direction) : request.up);
}

/// As a camera sees it; upright as it is held, unless the request says where up is.
LabelFrame FrameOf(const LabelRequest& request, const Camera& camera)
{
	LabelFrame frame;
	frame.u = camera.right;
	frame.v = camera.up;
	if (request.up != origin) {
		const LabelFrame turned = FrameOf(request, camera.backwards, request.up);
		frame.u = turned.u;
		frame.v = turned.v;
	}
	frame.w = camera.backwards;
	frame.perspective = camera.perspective;
	frame.center = camera.viewpoint;
	return frame;
}

vcg::Point3d OffsetOf(const LabelRequest& request, const LabelFrame& frame)
{
	return frame.u * request.offsetU + frame.v * request.offsetV;
}

/// Whether nothing lies between a viewpoint and a place on the part.
bool IsInSight(const vcg::Point3d& viewpoint, const vcg::Point3d& place, const PartProbe& part)
{
	const vcg::Point3d away = place - viewpoint;
	const double distance = away.Norm();
	for (const SurfaceHit& hit : part.hitsOnLine({viewpoint, away / distance}))
		if (hit.distance > 0) return hit.distance >= distance - sameSurface * part.box.Diag();
	return true;
}

/// The first face that a camera meets along its axis. With a shift, along a line beside it, so that it is as long on the part as it was
/// asked for, however far away that is; in perspective what that line meets first may be out of sight, or show its back.
LabelFrame PlaceInView(const LabelRequest& request, const Camera& camera, const PartProbe& part)
{
	LabelFrame frame = FrameOf(request, camera);
	const vcg::Point3d offset = OffsetOf(request, frame);
	const SightLine line{camera.viewpoint + offset, origin - frame.w};
	const bool isBeside = frame.perspective && offset != origin;
	std::optional<vcg::Point3d> hidden;
	for (const SurfaceHit& hit : part.hitsOnLine(line)) {
		if (frame.perspective && !(hit.distance > 0)) continue;
		if (!hit.facing && isBeside) continue;
		if (!hit.facing) throw RequestError(RequestProblem::ViewFromInside);
		frame.origin = line.origin + line.direction * hit.distance;
		if (!isBeside || IsInSight(frame.center, frame.origin, part)) return frame;
		if (!hidden) hidden = frame.origin;
	}
	if (!hidden) throw RequestError(RequestProblem::ViewMissesPart);
	frame.origin = *hidden;  // the library will say what hides it
	return frame;
}

/// The hit nearest to the line's origin on a face that looks to the viewer, or null.
const SurfaceHit* NearestFacing(const std::vector<SurfaceHit>& hits)
{
	const SurfaceHit* nearest = nullptr;
	for (const SurfaceHit& hit : hits)
		if (hit.facing && (!nearest || std::abs(hit.distance) < std::abs(nearest->distance))) nearest = &hit;
	return nearest;
}

/// How far before a place something else is met on the line of sight to it; 0 where nothing is.
double HiddenBy(const std::vector<SurfaceHit>& hits, double place, const PartProbe& part)
{
	const double hidden = place - hits.front().distance;
	return hidden > sameSurface * part.box.Diag() ? hidden : 0;
}

/// The face that looks to the viewer nearest to the position; a face before it would hide the label, but for one that is wrapped: that
/// is seen from its axis, or towards it.
LabelFrame PlaceAtPoint(const LabelRequest& request, const PartProbe& part)
{
	LabelFrame frame = FrameOf(request);
	const SightLine line{request.position + OffsetOf(request, frame), origin - frame.w};
	const std::vector<SurfaceHit> hits = part.hitsOnLine(line);
	const SurfaceHit* const nearest = NearestFacing(hits);
	if (!nearest)
		throw RequestError(hits.empty() ? RequestProblem::PointMissesPart : RequestProblem::PointSeesBack, "position");
	if (const double hidden = HiddenBy(hits, nearest->distance, part); hidden > 0 && !request.isWrapped()) {
		const RequestProblem by = hits.front().facing ? RequestProblem::HiddenPlace : RequestProblem::HiddenByBack;
		throw RequestError(by, "position").measured(hidden);
	}
	frame.origin = line.origin + line.direction * nearest->distance;
	return frame;
}

void Rotate(LabelFrame& frame, double degrees)
{
	if (degrees == 0) return;
	const double turns = std::remainder(degrees, 360.0), angle = turns * std::acos(-1.0) / 180;
	// right angles exactly: a label along the edges of a box stays along them
	const double c = std::abs(turns) == 90 ? 0 : std::cos(angle), s = std::abs(turns) == 180 ? 0 : std::sin(angle);
	const vcg::Point3d u = frame.u * c + frame.v * s;
	frame.v = frame.v * c - frame.u * s;
	frame.u = u;
}

/// A wrapped frame shifted over its cylinder.
LabelFrame ShiftedRound(const LabelFrame& frame, double right, double up)
{
	if (right == 0 && up == 0) return frame;
	const vcg::textlabel::LabelSpace space(frame);
	LabelFrame shifted = frame;
	shifted.origin = space.toMesh({right, up, 0});
	shifted.u = space.vectorToMesh(shifted.origin, {1, 0, 0});
	shifted.v = space.vectorToMesh(shifted.origin, {0, 1, 0});
	shifted.w = shifted.u ^ shifted.v;
	return shifted;
}

/// What the letters would meet before they come to the anchor of a wrapped label: they are seen on lines across the axis, from far
/// outside or, where they are read from the axis, from there.
/// @param[in] isShifted  else the anchor lies on the surface
/// @throws RequestError{HiddenRound}
void RequireInSightRound(const LabelFrame& frame, bool isShifted, const PartProbe& part)
{
	std::vector<SurfaceHit> hits = part.hitsOnLine({frame.origin, origin - frame.w});
	const auto isBeyondAxis = [&](const SurfaceHit& hit) {
		return frame.wrapRadius < 0 ? hit.distance <= frame.wrapRadius : hit.distance >= frame.wrapRadius;
	};
	hits.erase(std::remove_if(hits.begin(), hits.end(), isBeyondAxis), hits.end());
	const SurfaceHit* const nearest = NearestFacing(hits);
	if (!nearest) return;  // beside the part, or over a hole: there may be no letter
	if (const double hidden = HiddenBy(hits, isShifted ? nearest->distance : 0, part); hidden > 0)
		throw RequestError(RequestProblem::HiddenRound, "position").measured(hidden);
}

/// Length of a box along a direction.
double Extent(const vcg::Box3d& box, const vcg::Point3d& direction)
{
	double sum = 0;
	for (int i = 0; i < 3; ++i) sum += std::abs(direction[i]) * (box.max[i] - box.min[i]);
	return sum;
}

/// How long a part is in a direction of the label plane; for a wrapped label round the axis, as far as the part goes round it.
double ExtentFor(const LabelFrame& frame, const vcg::Box3d& box, const vcg::Point3d& direction)
{
	const double straight = Extent(box, direction), radius = std::abs(frame.wrapRadius);
	if (radius == 0) return straight;
	constexpr double nearlyAll = 0.9;  // of the diameter: facets, and an axis that leans
	const double share = straight / (2 * radius), pi = std::acos(-1.0);
	const double way = 2 * radius * (share < nearlyAll ? std::asin(share) : pi);
	const double along = std::min(std::abs(direction * frame.wrapAxis), 1.0);
	return along * straight + std::sqrt(1 - along * along) * way;
}

/// A text's bounding box at capital height 1, the anchor at (0, 0).
struct TextExtent {
	vcg::Point2d low{0, 0}, high{0, 0};
	double width() const { return high[0] - low[0]; }
	double height() const { return high[1] - low[1]; }
};

/// @param[in] size  capital height, or ChosenToFit
TextExtent ExtentOf(const LabelRequest& request, double size, TextSetter& text)
{
	constexpr double arcShare = 0.2;  // of the radius: a size at which most texts fit on the arc
	constexpr double lessThanFull = 0.99;
	TextExtent extent;
	if (size != ChosenToFit) {
		const TextOutline& outline = text.at(size);
		return {outline.boxMin / size, outline.boxMax / size};
	}
	LabelRequest probe = request;
	probe.tolerance = ChosenToFit;
	probe.embolden = probe.minStroke = probe.minGap = 0;  // lengths, which mean nothing before the size is known
	double probeSize = request.arcRadius == 0 ? 1 : std::abs(request.arcRadius) * arcShare;
	TextOutline outline;
	try {
		outline = MakeTextOutline(probe.text, TextOptionsOf(probe, probeSize));
	} catch (const TextError& error) {  // a long text; the least radius is in proportion to the size
		if (error.code != TextErrorCode::BadArc || !(error.limit > 0)) throw;
		probeSize *= lessThanFull * std::abs(request.arcRadius) / error.limit;
		outline = MakeTextOutline(probe.text, TextOptionsOf(probe, probeSize));
	}
	return {outline.boxMin / probeSize, outline.boxMax / probeSize};
}

/// The capital height that is asked for, or ChosenToFit.
double WantedSize(const LabelRequest& request)
{
	if (!(request.fitWidth > 0)) return request.size;
	TextOptions options = TextOptionsOf(request, 1);
	options.fitWidth = request.fitWidth;
	return MakeTextOutline(request.text, options).capitalHeight;
}

/// Sizes to try: a text of half the part at first, of half the way round when it is wrapped, then smaller.
/// @param[in] largest  of the part's diagonal
std::vector<double> SizesToTry(const TextExtent& extent, double largest, const LabelFrame& frame, const vcg::Box3d& box)
{
	constexpr double share = 0.5, step = 0.7;  // of the part's extent; from one to the next
	constexpr int count = 9;
	double size = box.Diag() * largest;
	if (extent.width() > 0) size = std::min(size, share * ExtentFor(frame, box, frame.u) / extent.width());
	if (extent.height() > 0) size = std::min(size, share * ExtentFor(frame, box, frame.v) / extent.height());
	std::vector<double> sizes;
	for (int i = 0; i < count && size > 0; ++i, size *= step) sizes.push_back(size);
	return sizes;
}

using Accept = std::function<bool(const Attempt&)>;

bool OfferAtPlace(const LabelRequest& request, double size, const Camera& camera, const PartProbe& part,
                  TextSetter& text, const Accept& accept)
{
	constexpr double largestLetters = 0.08, largestWhole = 0.25;  // of a code or a drawing
	LabelRequest unshifted = request;
	if (request.isWrapped()) unshifted.offsetU = unshifted.offsetV = 0;
	LabelFrame frame = request.placement == PlacementKind::PointAndDirection ? PlaceAtPoint(unshifted, part)
	                                                                         : PlaceInView(unshifted, camera, part);
	if (request.isWrapped()) {
		frame = request.wrapRadius != 0 ? WrappedFrame(frame, request.wrapRadius)
		                                : WrappedFrame(frame, part.box.Diag(), part.surfaceAround);
		frame = ShiftedRound(frame, request.offsetU, request.offsetV);
		RequireInSightRound(frame, request.offsetU != 0 || request.offsetV != 0, part);
	}
	Rotate(frame, request.rotation);
	if (size != ChosenToFit) return accept({frame, size, 0});
	const bool isText = request.code == CodeKind::None && request.drawing.empty();
	const double largest = isText ? largestLetters : largestWhole;
	const std::vector<double> sizes = SizesToTry(ExtentOf(request, size, text), largest, frame, part.box);
	if (sizes.empty()) throw RequestError(RequestProblem::NoPlace, "size").measured(size);
	return std::any_of(sizes.begin(), sizes.end(), [&](double s) { return accept({frame, s, 0}); });
}

/// Width and height of the box around the turned text.
vcg::Point2d TurnedExtent(const TextExtent& extent, double degrees)
{
	LabelFrame axes;
	Rotate(axes, degrees);
	const double c = std::abs(axes.u[0]), s = std::abs(axes.u[1]);
	return {extent.width() * c + extent.height() * s, extent.width() * s + extent.height() * c};
}

/// The extent at a size that was chosen: on an arc it is no multiple of that at another size.
TextExtent ExtentOnceChosen(const LabelRequest& request, const TextExtent& guess, double size, TextSetter& text)
{
	if (request.arcRadius == 0) return guess;
	try {
		return ExtentOf(request, size, text);
	} catch (const TextError&) {
		return guess;  // who tries this size will say it
	}
}

bool OfferAnywhere(const LabelRequest& request, double size, const PartProbe& part, TextSetter& text,
                   const Accept& accept)
{
	const TextExtent extent = ExtentOf(request, size, text);
	const vcg::Point2d turned = TurnedExtent(extent, request.rotation);
	PartGeometry geometry = part.geometry();
	PlaceQuery query{geometry.positions, geometry.triangles};
	query.paint = std::move(geometry.paint);
	query.labelWidth = turned[0];
	query.labelHeight = turned[1];
	query.size = size;
	query.up = request.up;
	if (request.depth != ChosenToFit && request.style != LabelStyle::Flat)
		query.depth = request.style == LabelStyle::Engrave ? -request.depth : request.depth;
	bool isAny = false;
	const bool isAccepted = OfferPlaces(query, [&](const Place& place) {
		LabelFrame frame = vcg::textlabel::FrameFromDirection(place.position, place.direction, place.up);
		frame.origin += OffsetOf(request, frame);
		Rotate(frame, request.rotation);
		const TextExtent chosen = ExtentOnceChosen(request, extent, place.size, text);
		const vcg::Point2d center = (chosen.low + chosen.high) * (place.size / 2);
		frame.origin -= frame.u * center[0] + frame.v * center[1];
		if (frame.origin != place.position) {  // the same label, with the anchor on the surface below it
			const SightLine line{frame.origin, origin - frame.w};
			const std::vector<SurfaceHit> hits = part.hitsOnLine(line);
			if (const SurfaceHit* nearest = NearestFacing(hits)) frame.origin += line.direction * nearest->distance;
		}
		isAny = true;
		return accept({frame, place.size, place.wall});
	});
	if (!isAny) throw RequestError(RequestProblem::NoPlace, "size").measured(size);
	return isAccepted;
}

/// The camera of a request without XML: viewpoint `position`, looking against `direction`.
Camera CameraFromNumbers(const LabelRequest& request)
{
	constexpr double parallelBelow = 5;  // degrees, as MeshLab has it
	const LabelFrame frame = FrameOf(request);
	Camera camera;
	camera.viewpoint = request.position;
	camera.right = frame.u;
	camera.up = frame.v;
	camera.backwards = frame.w;
	camera.perspective = request.fieldOfView > parallelBelow;
	return camera;
}

}  // namespace

const TextOutline& TextSetter::at(double size)
{
	if (size != size_) outline_ = MakeTextOutline(request_.text, TextOptionsOf(request_, size));
	size_ = size;
	return outline_;
}

Camera RequestedCamera(const LabelRequest& request)
{
	return request.camera.empty() ? CameraFromNumbers(request) : ReadCamera(request.camera);
}

bool OfferAttempts(const LabelRequest& request, const Camera& camera, const PartProbe& part, TextSetter& text,
                   const std::function<bool(const Attempt&)>& accept)
{
	const double size = WantedSize(request);
	return request.placement == PlacementKind::Automatic ? OfferAnywhere(request, size, part, text, accept)
	                                                     : OfferAtPlace(request, size, camera, part, text, accept);
}

}  // namespace textlabel
