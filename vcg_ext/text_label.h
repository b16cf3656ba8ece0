#pragma once
// TextLabel: cut a label into a triangle mesh, and raise it, sink it or leave it flat. The one header that a host includes.
//
// Source: G. Slabaugh, V. Mihalef, G. Unal, "A Contour-Based Approach to 3D Text Labeling on Triangulated Surfaces", 3DIM 2005.
// The way of a label: contours in the label plane and a frame -> the candidates of the mesh (collect_sheet.h) -> contours marched over them
// (edge_march.h) -> triangles cut by the contour walk (triangle_cutter.h, label_cut.h) -> what lies before and behind
// (label_clearance.h) -> raised (label_raise.h) -> checked on rounded coordinates (patch_check.h) -> written (patch_commit.h).
// Until the last step the mesh is only read.

#include "collect_sheet.h"
#include "contour_check.h"
#include "label_plan.h"
#include "patch_commit.h"

#include <optional>
#include <type_traits>

namespace vcg::textlabel {

struct LabelResult {
	std::vector<int> topFaces;      ///< faces of the letters: tops, floors, or flat
	std::vector<int> wallFaces;     ///< faces between them and the surface
	std::vector<int> outsideFaces;  ///< pieces of cut triangles outside the letters, and caps flipped beside these
	int touchedFaces = 0;           ///< triangles of the mesh that were cut or flipped, or lie within a letter
	int newVertices = 0, newFaces = 0;
	int firstNewVertex = 0;  ///< index of the first new vertex; the rest follow
	double labelArea = 0;    ///< in the label plane, world units squared
	double surfaceArea = 0;  ///< of the letters on the surface before raising, world units squared
	double addedVolume = 0;  ///< after minus before, mesh units cubed
	double stretch = 1;      ///< largest ratio of surface length to label length under the letters
	double leastStretch =
		1;  ///< of a wrapped label: least distance of the letters from the axis over the radius; at most 1
	double room =
		0;  ///< to the next surface behind the letters along the rays, world units; infinite when there is none, and
			///< when none lies within the depth and LabelOptions::measureRoom is off
	vcg::Box3d
		movedFrom;  ///< where old vertices were that moved with the letters; mesh coordinates, null when none did
	vcg::Box3d newPlaces;   ///< where these and the new vertices are now; mesh coordinates
	double resolution = 0;  ///< world units, in the label plane: no point of a contour was moved by more
	double coordinateStep =
		0;             ///< world units: between coordinates, where they are largest; what the label was checked on
	int attempts = 1;  ///< placements tried within the resolution
	bool survivesFloat32 = true;  ///< false: a double mesh whose letters only double coordinates carry
};

/// Half-edges are numbered with ints, those of a label's new faces too.
/// @throws Error{TooLarge}
inline void RequireCountable(size_t vertices, size_t faces)
{
	constexpr size_t most = size_t(std::numeric_limits<int>::max()) / 4;
	if (std::max(vertices, faces) > most)
		throw Error(ErrorCode::TooLarge).measured(double(std::max(vertices, faces)), double(most));
}

/// Put a label on a mesh.
/// @param[in,out] m  triangles; some may be marked as parts of polygons by faux edges; untouched when an Error is thrown
/// @param[in] outline  simple, disjoint, nested contours in the label plane (contour.h)
/// @param[in] frame  where the label plane lies and from where it is projected
/// @post  same topology class; the surface outside the letters is the same set of points; faces that no letter touches are the same
///        bit for bit, but for faux edges that they had in common with touched ones; valid also after rounding to float32 and
///        merging equal points, unless survivesFloat32 says otherwise
/// @note  for the caller to bring up to date, as after any of VCGlib's algorithms that add faces: normals, the bounding box, FF and VF
///        adjacency and border flags of what is new (LabelResult lists it). Flags, colours and the like of a new face are those of
///        the one that it is a piece of, or stands on; so are its custom attributes. A new vertex has those of the corner that weighs most in it
/// @throws Error
template <class MeshType>
LabelResult LabelMesh(MeshType& m, const Outline& outline, const LabelFrame& frame, const LabelOptions& options = {});

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

inline PlaneBox CheckedBox(const Outline& outline)
{
	PlaneBox box;
	for (const Contour& c : outline.contours) {
		if (c.points.size() < 3) throw Error(ErrorCode::BadContour, "fewer than three points").atLetter(c.letter);
		for (const vcg::Point2d& p : c.points) {
			if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
				throw Error(ErrorCode::BadContour, "a point is not finite").atLetter(c.letter);
			box.add(p);
		}
	}
	if (outline.contours.empty()) throw Error(ErrorCode::EmptyLabel, "no contour");
	return box;
}

/// The middle of an outline; of one that CheckedBox refuses, anything.
inline vcg::Point2d MiddleOf(const Outline& outline)
{
	PlaneBox box;
	for (const Contour& c : outline.contours)
		for (const vcg::Point2d& p : c.points) box.add(p);
	const vcg::Point2d middle = (box.low + box.high) / 2;
	return std::isfinite(middle[0] + middle[1]) ? middle : vcg::Point2d(0, 0);
}

/// Whether a box leaves room for the cut opposite to a wrapped label.
inline bool LeavesCut(const LabelSpace& space, const PlaneBox& box)
{
	return !space.wraps() || space.unrolledBox(box).width() < space.circumference();
}

/// The volume between two sets of faces with the same border, about one of their points.
inline double VolumeChange(const Sheet& sheet, const LabelPatch& patch, bool mirrors)
{
	const auto position = RoundedPositions(sheet, patch, [](double x) { return x; });
	const vcg::Point3d origin = sheet.vertices[size_t(sheet.triangles[size_t(patch.removed[0])].vertex[0])].mesh;
	double sum = 0;
	for (const PatchFace& f : patch.faces) {
		const Corners c = CornersOf(position, f.vertex);
		sum += (c[0] - origin) * ((c[1] - origin) ^ (c[2] - origin));
	}
	for (const int t : patch.removed) {
		const auto& v = sheet.triangles[size_t(t)].vertex;
		const auto at = [&](size_t k) { return sheet.vertices[size_t(v[k])].mesh - origin; };
		sum -= at(0) * (at(1) ^ at(2));
	}
	return (mirrors ? -sum : sum) / 6;
}

/// The letter of a place that went wrong: that of the contour which comes nearest to it.
inline int NearestLetter(const LabelSpace& space, const Outline& outline, const vcg::Point3d& mesh)
{
	const vcg::Point2d p = space.project(space.toLabel(mesh));
	double nearest = std::numeric_limits<double>::infinity();
	int letter = -1;
	for (const Contour& c : outline.contours)
		for (size_t i = 0, j = c.points.size() - 1; i < c.points.size(); j = i++) {
			const vcg::Point2d &a = c.points[j], d = c.points[i] - a;
			const double length = d.SquaredNorm(), along = length > 0 ? std::clamp((p - a) * d / length, 0.0, 1.0) : 0;
			const double distance = (a + d * along - p).SquaredNorm();
			if (!(distance < nearest)) continue;
			nearest = distance;
			letter = c.letter;
		}
	return letter;
}

/// The box of all that a patch changes, in the label plane.
inline PlaneBox ReachOf(const LabelSpace& space, const LabelPatch& patch)
{
	PlaneBox box;
	for (const PatchVertex& v : patch.vertices) box.add(space.project(space.toLabel(v.mesh)));
	for (const auto& [vertex, p] : patch.moved) box.add(space.project(space.toLabel(p)));
	return box;
}

/// A plan and the candidates it was made on.
struct PlannedLabel {
	Sheet sheet;
	LabelPlan plan;
	bool survivesFloat32 = true;
};

/// What the candidates are collected in.
struct PlanBox {
	PlaneBox plane;
	double room = 0;         ///< world units: between the outline and the border of the box
	bool isForCaps = false;  ///< it was made larger for Sheet::capReach

	void grow(double margin)
	{
		plane.grow(margin);
		room += margin;
	}
};

/// Plan on the candidates of a box.
/// @param[in] seesAll  also on what shows its back deeper than the label may reach
template <class MeshType>
PlannedLabel PlanInBox(const MeshType& m, const LabelSpace& space, const Outline& outline, PlanBox box,
                       const LabelOptions& options, bool seesAll, Precision precision)
{
	PlannedLabel p;
	p.survivesFloat32 = precision.isFloat;
	for (;;) {
		if (!LeavesCut(space, box.plane))
			throw Error(ErrorCode::TooLong, "longer than the way round the axis")
				.measured(space.unrolledBox(box.plane).width(), space.circumference());
		const bool isDeep = seesAll || space.wraps();  // corners don't tell how deep a bent triangle is
		const double depth = isDeep ? std::numeric_limits<double>::infinity() : std::abs(options.height) + 2 * box.room;
		p.sheet = CollectSheet(m, space, box.plane, depth);
		const double most = LabelPlanner(space, p.sheet, precision, options).worstResolution();
		if (!(most > box.room)) break;
		box.grow(2 * most);  // a contour may move to an edge, whose other faces must be there too
	}
	if (p.sheet.isEmpty) throw Error(ErrorCode::EmptyMesh, "no face with finite corners");
	double diagonal = 0;
	if (ExceedsPart(m, space, p.sheet, std::abs(options.height), diagonal))
		throw Error(ErrorCode::BadHeight, "larger than the part").measured(std::abs(options.height), diagonal);
	try {
		p.plan = LabelPlanner(space, p.sheet, precision, options, DistantFinder(m, p.sheet)).plan(outline);
	} catch (const Error& e) {
		if (e.code == ErrorCode::OffSurface && p.sheet.isShallow)  // or over a back
			return PlanInBox(m, space, outline, box, options, true, precision);
		const bool mayBeCap = e.code == ErrorCode::Silhouette || e.code == ErrorCode::TooFine;
		if (!mayBeCap || box.isForCaps || !(p.sheet.capReach > 0)) throw;
		constexpr double more = 1.001;  // so that what is asked for is not on the border
		box.plane.grow(more * p.sheet.capReach);
		if (!LeavesCut(space, box.plane)) throw;
		box.isForCaps = true;
		return PlanInBox(m, space, outline, box, options, seesAll, precision);
	}
	return p;
}

/// On float32 coordinates; where these can't carry the label, and the mesh has better ones, on those.
template <class MeshType>
PlannedLabel PlanInBox(const MeshType& m, const LabelSpace& space, const Outline& outline, const PlanBox& box,
                       const LabelOptions& options)
{
	constexpr bool isDouble = std::is_same_v<typename MeshType::ScalarType, double>;
	const auto planWith = [&](bool isFloat) {
		return PlanInBox(m, space, outline, box, options, options.measureRoom,
		                 Precision{isFloat, isDouble, options.fileDigits});
	};
	std::optional<Error> refusal;
	try {
		return planWith(true);
	} catch (const Error& e) {
		// where coordinates are coarse, a thin wall has no room and surfaces that are close coincide
		const bool mayBeCoarse = e.code == ErrorCode::TooFine || e.code == ErrorCode::Occluded ||
		                         e.code == ErrorCode::HitsSurface || e.code == ErrorCode::HitsItself ||
		                         (e.code == ErrorCode::BadHeight && e.value <= e.limit);
		if (!isDouble || !mayBeCoarse) throw;
		refusal = e;
	}
	try {
		return planWith(false);
	} catch (const Error& e) {
		const bool isByHeight = e.code == ErrorCode::HitsSurface || e.code == ErrorCode::HitsItself;
		if (isByHeight && refusal->code == e.code && refusal->limit > 0) throw *refusal;  // its depth survives float32
		throw;
	}
}

/// What the label would reach if it were raised by no more than a refusal says will do; empty when that can't be told.
template <class MeshType>
PlaneBox ReachAtLimit(const MeshType& m, const LabelSpace& space, const Outline& outline, const PlanBox& box,
                      LabelOptions options, const Error& refusal)
{
	const bool isByHeight = refusal.code == ErrorCode::HitsSurface || refusal.code == ErrorCode::HitsItself;
	if (!isByHeight || !(refusal.limit > 0)) return {};
	options.height = std::copysign(refusal.limit, options.height);
	try {
		return ReachOf(space, PlanInBox(m, space, outline, box, options).plan.patch);
	} catch (const Error& e) {
		if (e.code == ErrorCode::Cancelled) throw;
		return {};
	}
}

/// Plan on candidates that hold all that the label may meet: where a wide-angle view sees the raised letters beside the flat ones, or
/// letters on a coarse cylinder lie beside where its corners unroll to, the candidates are collected once more; so are they when a
/// refusal says how far the letters may rise, and that is beside them.
template <class MeshType>
PlannedLabel PlanOnMesh(const MeshType& m, const LabelSpace& space, const Outline& outline, const LabelOptions& options)
{
	constexpr double margin = 1e-3;  // of the box: room for shifts and rounding
	PlanBox box{CheckedBox(outline)};
	const bool straightUp =
		options.along == ExtrudeAlong::Viewpoint || (space.wraps() && options.along == ExtrudeAlong::LabelNormal);
	const bool staysInSight = (straightUp || !space.perspective()) && !space.wraps();
	box.grow((box.plane.width() + box.plane.height()) * margin);
	if (!straightUp) box.plane.grow(std::abs(options.height));
	if (staysInSight) return PlanInBox(m, space, outline, box, options);
	for (;;) {
		PlaneBox reach;
		try {
			PlannedLabel p = PlanInBox(m, space, outline, box, options);
			reach = ReachOf(space, p.plan.patch);
			if (box.plane.holds(reach)) return p;
		} catch (const Error& e) {
			reach = ReachAtLimit(m, space, outline, box, options, e);
			if (box.plane.holds(reach)) throw;
		}
		box.plane.add(reach.low);
		box.plane.add(reach.high);
	}
}

template <class MeshType>
LabelResult LabelMeshOrThrow(MeshType& m, const Outline& outline, const LabelFrame& frame, const LabelOptions& options)
{
	if (m.vn == 0 || m.fn == 0) throw Error(ErrorCode::EmptyMesh, "no faces");
	RequireCountable(m.vert.size(), m.face.size());
	if (!std::isfinite(options.height)) throw Error(ErrorCode::BadHeight, "height is not finite");
	const LabelSpace space(frame, MiddleOf(outline));
	PlannedLabel planned;
	LabelOptions forwards = options;  // what is tried again does not set the progress back
	int furthest = 0;
	if (options.progress)
		forwards.progress = [&](int percent) { return options.progress(furthest = std::max(furthest, percent)); };
	try {
		planned = PlanOnMesh(m, space, outline, forwards);
	} catch (Error& e) {
		if (e.code == ErrorCode::Cancelled) throw;
		RequireGoodOutline(outline);  // a wrong outline runs into anything; a good one needs no look
		if (e.letter < 0 && e.hasPlace) e.letter = NearestLetter(space, outline, e.place);
		throw;
	}
	const LabelPlan& plan = planned.plan;
	const LabelPatch& patch = plan.patch;

	LabelResult result;
	result.addedVolume = VolumeChange(planned.sheet, patch, space.mirrors());
	result.survivesFloat32 = planned.survivesFloat32;
	result.labelArea = plan.cut.insideArea;
	result.surfaceArea = plan.surface.area;
	result.stretch = plan.surface.stretch;
	result.leastStretch = plan.surface.leastStretch;
	result.room = plan.room;
	result.resolution = plan.resolution;
	result.coordinateStep = plan.coordinateStep;
	result.attempts = plan.attempts;
	result.touchedFaces = int(patch.removed.size());
	result.newVertices = int(patch.vertices.size());
	result.newFaces = int(patch.faces.size()) - int(patch.removed.size());
	for (const auto& [v, p] : patch.moved) {
		result.movedFrom.Add(planned.sheet.vertices[size_t(v)].mesh);
		result.newPlaces.Add(p);
	}
	for (const PatchVertex& v : patch.vertices) result.newPlaces.Add(v.mesh);
	for (std::vector<int>* list : {&result.topFaces, &result.wallFaces, &result.outsideFaces})
		list->reserve(patch.faces.size());
	if (options.progress && !options.progress(95)) throw Error(ErrorCode::Cancelled, "the caller said stop");
	const CommitResult commit = CommitPatch(m, space, planned.sheet, patch);
	result.firstNewVertex = commit.firstNewVertex;
	for (size_t i = 0; i < patch.faces.size(); ++i) {
		const FaceKind kind = patch.faces[i].kind;
		(kind == FaceKind::Top    ? result.topFaces
		 : kind == FaceKind::Wall ? result.wallFaces
		                          : result.outsideFaces)
			.push_back(commit.faces[i]);
	}
	return result;
}

}  // namespace detail

template <class MeshType>
LabelResult LabelMesh(MeshType& m, const Outline& outline, const LabelFrame& frame, const LabelOptions& options)
{
	try {
		return detail::LabelMeshOrThrow(m, outline, frame, options);
	} catch (const std::bad_alloc&) {
		throw Error(ErrorCode::OutOfMemory);  // no words: they would need memory
	}
}

}  // namespace vcg::textlabel
