#pragma once
// The plan of a label: everything between reading the mesh and writing it, on candidates alone.
//
// Resolution. Coordinates are stored, or saved, with float32; `ulp` is the step between them at the largest coordinate near the
// label. What is closer than `snapUlps` of them is the same point. Letters whose strokes are thinner than `strokeUlps` can't be
// carried and are refused with the numbers. Where a placement runs into a coincidence that snapping can't express (a contour that
// comes back to a vertex where another has been, a face that rounding turns round), the whole label is shifted by a few ulps and laid
// again, in a fixed spiral, so that the same input always gives the same bytes. No point of a contour moves by more than
// `resolution`, which is what the result states. No vertex of the mesh moves to make room for a contour.

#include "contour_check.h"
#include "cut_repair.h"
#include "label_clearance.h"
#include "label_seed.h"
#include "overhang.h"
#include "rounding.h"
#include "surface_measure.h"
#include "surface_point.h"
#include "swept_volume.h"

#include <functional>

namespace vcg::textlabel {

struct LabelOptions {
	double height = 0;  ///< world units: > 0 raised, < 0 sunk, 0 flat
	ExtrudeAlong along = ExtrudeAlong::Viewpoint;
	double maxStretch = 8;  ///< refuse where a letter gets this much longer on the surface than in the plane
	/// Refuse a wrapped label where the part is so much thinner than its cylinder: LabelResult::leastStretch.
	double minStretch = 0.125;
	bool measureRoom = false;  ///< look for the next surface behind the letters however deep it lies: LabelResult::room
	int fileDigits = 0;        ///< Precision::fileDigits
	std::function<bool(int percent)> progress;  ///< may be null; false cancels
};

struct LabelPlan {
	CutLabel cut;
	LabelPatch patch;
	SurfaceMeasure surface;
	double room = 0;        ///< to the next surface behind the letters, world units; infinite if none was found
	double resolution = 0;  ///< world units: no point of a contour was moved by more
	double coordinateStep =
		0;             ///< world units: between coordinates, where they are largest; what the label was checked on
	int attempts = 0;  ///< placements tried
};

/// Plan a label on the candidates of a mesh.
/// @param[in] outline  in the label plane
/// @throws Error
class LabelPlanner {
public:
	/// @param[in,out] sheet  caps under the letters may be flipped away (cut_repair.h)
	/// @param[in] distant  null where the candidates are all there is
	LabelPlanner(const LabelSpace& space, Sheet& sheet, Precision precision, const LabelOptions& options,
	             FindDistant distant = nullptr);

	/// World units: LabelPlan::resolution, if it takes the last attempt.
	double worstResolution() const { return resolutionAt(mostAttempts - 1); }
	/// World units: the least width of stroke that the coordinates carry here.
	double leastStroke() const { return strokeUlps * ulp_; }
	LabelPlan plan(const Outline& outline);

private:
	static constexpr double snapUlps = 4, strokeUlps = 24, shiftUlps = 3, shortestUlps = 2, capUlps = 6;
	static constexpr double apartSnaps = 4;  ///< points of a contour that are closer are one
	static constexpr int mostAttempts = 8;
	static constexpr int bisections = 10;

	/// Snapped, thinned, and shifted once more for each attempt.
	double resolutionAt(int attempt) const { return ((1 + apartSnaps) * snapUlps + shiftUlps * attempt) * ulp_; }
	Outline prepared(const Outline& outline, const vcg::Point2d& shift) const;
	std::vector<vcg::Point2d> thinned(const std::vector<vcg::Point2d>& points) const;
	void requireSheetSurvives();
	bool attempt(const Outline& outline, bool last, LabelPlan& plan, PlacementConflict& conflict);
	void finish(LabelPlan& plan, bool last) const;
	void checkRoom(LabelPlan& plan) const;
	bool staysOnRays() const;
	void requireOutward(const LabelPatch& patch) const;
	[[noreturn]] void refuseHeight(const LabelPlan& plan, const PatchVerdict& verdict) const;
	PatchVerdict check(const LabelPatch& patch, double height) const;
	std::vector<int> capsFor(const Outline& outline, int face) const;
	void report(int percent) const;

	const LabelSpace& space_;
	Sheet& sheet_;
	Precision precision_;
	const LabelOptions& options_;
	const FindDistant distant_;
	double meshUlp_, ulp_, snap_;
	bool isRepresentable_ = true;  ///< rounding changes no vertex of the part
	SheetLayer layer_;             ///< of the attempt at hand
};

// ---------------------------------------------------------------------------------------------------------------------------

inline LabelPlanner::LabelPlanner(const LabelSpace& space, Sheet& sheet, Precision precision,
                                  const LabelOptions& options, FindDistant distant)
	: space_(space), sheet_(sheet), precision_(precision), options_(options), distant_(std::move(distant)),
	  meshUlp_(precision.ulp(sheet.largestCoordinate)), ulp_(meshUlp_ * space.scale()), snap_(snapUlps * ulp_)
{}

inline void LabelPlanner::report(int percent) const
{
	if (options_.progress && !options_.progress(percent)) throw Error(ErrorCode::Cancelled, "the caller said stop");
}

/// The outline shifted, without points that the resolution can't tell apart: none closer than a few snaps to the one before,
/// none that lies within `flat` of the line between its neighbours (a chain of such points is straight once rounded, and
/// triangles between its points have no area).
inline Outline LabelPlanner::prepared(const Outline& outline, const vcg::Point2d& shift) const
{
	Outline out;
	out.partCount = outline.partCount;
	for (const Contour& c : outline.contours) {
		out.contours.push_back({thinned(c.points), c.part, c.letter});
		std::vector<vcg::Point2d>& points = out.contours.back().points;
		for (vcg::Point2d& p : points) p += shift;
		double perimeter = 0;
		for (size_t i = 0; i < c.points.size(); ++i)
			perimeter += (c.points[i] - c.points[(i + 1) % c.points.size()]).Norm();
		const double width = perimeter > 0 ? std::abs(TwiceSignedArea(c.points)) / perimeter : 0;
		if (points.size() < 3 || !(width >= leastStroke()))
			throw Error(ErrorCode::TooFine, "a contour is finer than the coordinates")
				.atLetter(c.letter)
				.measured(width, leastStroke());
	}
	return out;
}

inline std::vector<vcg::Point2d> LabelPlanner::thinned(const std::vector<vcg::Point2d>& points) const
{
	constexpr double flat = 0.5;         // of snap
	constexpr size_t mostSkipped = 100;  // in a row, for all of them are looked at again with each one more
	const auto isOnLine = [&](const vcg::Point2d& a, const vcg::Point2d& b, size_t first, size_t last) {
		const vcg::Point2d d = b - a;
		for (size_t i = first; i < last; ++i) {
			const vcg::Point2d x = points[i] - a;
			if (std::abs(d ^ x) > flat * snap_ * d.Norm() || d * x < 0 || d * x > d.SquaredNorm()) return false;
		}
		return true;
	};
	std::vector<vcg::Point2d> kept;
	size_t skipped = 0;  // the first point after the last one kept
	for (size_t i = 0; i < points.size(); ++i) {
		const vcg::Point2d& next = points[(i + 1) % points.size()];
		if (!kept.empty() && (points[i] - kept.back()).Norm() <= apartSnaps * snap_) continue;
		const bool maySkip = !kept.empty() && i - skipped < mostSkipped;
		if (maySkip && isOnLine(kept.back(), next, skipped, i + 1)) continue;
		kept.push_back(points[i]);
		skipped = i + 1;
	}
	while (kept.size() > 1 && (kept.front() - kept.back()).Norm() <= apartSnaps * snap_) kept.pop_back();
	return kept;
}

/// A double mesh may be finer than float32: then no label on it survives float32.
inline void LabelPlanner::requireSheetSurvives()
{
	const auto rounded = [&](vcg::Point3d p) {
		for (int k = 0; k < 3; ++k) p[k] = precision_.round(p[k]);
		return p;
	};
	if (precision_.keepsStored()) return;
	isRepresentable_ = std::all_of(sheet_.vertices.begin(), sheet_.vertices.end(),
	                               [&](const SheetVertex& v) { return rounded(v.mesh) == v.mesh; });
	if (isRepresentable_) return;
	std::vector<std::pair<vcg::Point3d, int>> order;
	for (const SheetVertex& v : sheet_.vertices) order.emplace_back(rounded(v.mesh), int(order.size()));
	std::sort(order.begin(), order.end());
	for (size_t i = 1; i < order.size(); ++i) {
		const SheetVertex &a = sheet_.vertices[size_t(order[i - 1].second)],
						  &b = sheet_.vertices[size_t(order[i].second)];
		if (order[i].first == order[i - 1].first && a.mesh != b.mesh)
			throw Error(ErrorCode::TooFine, "the part itself is finer than float32")
				.atPlace(a.mesh)
				.measured((a.label - b.label).Norm(), ulp_);
	}
}

inline LabelPlan LabelPlanner::plan(const Outline& outline)
{
	requireSheetSurvives();
	PlacementConflict conflict{"", {0, 0}};
	for (int i = 0; i < mostAttempts; ++i) {
		constexpr double golden = 2.399963229728653;  // radians; a spiral that never repeats a direction
		const vcg::Point2d shift = vcg::Point2d(std::cos(golden * i), std::sin(golden * i)) * (shiftUlps * i * ulp_);
		LabelPlan plan;
		plan.attempts = i + 1;
		plan.resolution = resolutionAt(i);
		plan.coordinateStep = ulp_;
		if (attempt(prepared(outline, shift), i + 1 == mostAttempts, plan, conflict)) return plan;
		report(10);
	}
	const double height = std::abs(options_.height);
	if (conflict.code == ErrorCode::TooFine && height > 0 && height <= snap_)
		throw Error(ErrorCode::BadHeight, "finer than the coordinates").measured(height, snap_);
	throw Error(conflict.code, conflict.why).atPlace(SeenAt(space_, sheet_, conflict.place)).measured(0, leastStroke());
}

/// Lay the label once, and once more without the caps that it met when they stand in its way.
inline bool LabelPlanner::attempt(const Outline& outline, bool last, LabelPlan& plan, PlacementConflict& conflict)
{
	constexpr int rounds = 4;  // a flip may leave a lower cap beside it
	for (int round = 0; round < rounds; ++round) {
		const std::vector<int> seeds = FindSeeds(space_, sheet_, outline, snap_);
		LabelCutter cutter(space_, sheet_, snap_);
		try {
			plan.cut = cutter.cut(outline, seeds);
			layer_ = FindLayer(sheet_, outline, seeds);
			finish(plan, last);
			return true;
		} catch (const PlacementConflict& c) {
			conflict = c;
		} catch (const Error& e) {  // a triangle without area has no front: it looks like a horizon
			if (e.code != ErrorCode::Silhouette || !FlipCaps(sheet_, capsFor(outline, e.face), capUlps * meshUlp_))
				throw;
			conflict = {"a cap below a cap", space_.project(space_.toLabel(e.place)), e.code};
			continue;
		}
		if (!FlipCaps(sheet_, cutter.visited(), capUlps * meshUlp_)) break;
	}
	return false;
}

/// Where to look for caps when a letter seems to meet a horizon at a face: beside it, and all within the letters that hang together
/// with it over what faces the viewer and over other caps: an edge with many vertices on one side has as many caps in a row.
inline std::vector<int> LabelPlanner::capsFor(const Outline& outline, int face) const
{
	const std::vector<PlaneBox> boxes = detail::BoxesOfContours(outline);
	const auto isInLetter = [&](int t) {
		const auto& v = sheet_.triangles[size_t(t)].vertex;
		const vcg::Point2d middle = (sheet_.plane(v[0]) + sheet_.plane(v[1]) + sheet_.plane(v[2])) / 3;
		return detail::WindingAround(outline, boxes, outline.contours.size(), middle) > 0;
	};
	const auto isThin = [&](int t) {
		return detail::HeightOver(sheet_, detail::LongestSide(sheet_, t)) < capUlps * meshUlp_;
	};
	std::vector<int> caps, stack;
	std::vector<char> seen(sheet_.triangles.size(), 0);
	const auto visit = [&](int t) {
		if (!std::exchange(seen[size_t(t)], 1)) stack.push_back(t);
	};
	for (int t = 0; t < int(sheet_.triangles.size()); ++t) {
		if (sheet_.triangles[size_t(t)].face != face) continue;
		caps.push_back(t);
		visit(t);
		for (int h = 3 * t; h < 3 * t + 3; ++h)
			if (sheet_.twin[size_t(h)] >= 0) caps.push_back(sheet_.twin[size_t(h)] / 3);
	}
	while (!stack.empty()) {
		const int t = stack.back();
		stack.pop_back();
		for (int h = 3 * t; h < 3 * t + 3; ++h) {
			const int across = sheet_.twin[size_t(h)] < 0 ? -1 : sheet_.twin[size_t(h)] / 3;
			if (across < 0 || seen[size_t(across)]) continue;
			if (sheet_.triangles[size_t(across)].facing) {
				visit(across);
			} else if (isThin(across)) {
				visit(across);
				if (isInLetter(across)) caps.push_back(across);
			}
		}
	}
	return caps;
}

/// From the cut to a patch that is sound on rounded coordinates.
inline void LabelPlanner::finish(LabelPlan& plan, bool last) const
{
	report(40);
	plan.surface = MeasureSurface(space_, sheet_, plan.cut, snap_, {options_.maxStretch, options_.minStretch});
	checkRoom(plan);
	report(60);
	plan.patch = RaiseLabel(space_, sheet_, plan.cut, options_.height, options_.along);
	if (!staysOnRays()) requireOutward(plan.patch);
	PatchVerdict verdict = check(plan.patch, options_.height);
	if (verdict.fault != PatchFault::Sound) {
		CollapseShortEdges(sheet_, plan.cut, shortestUlps * meshUlp_);
		plan.patch = RaiseLabel(space_, sheet_, plan.cut, options_.height, options_.along);
		verdict = check(plan.patch, options_.height);
	}
	// each removed face leaves a slot to be filled
	const bool fits = plan.patch.faces.size() >= plan.patch.removed.size();
	if (verdict.fault == PatchFault::Sound && fits) return;
	// On the rays a raised letter can't meet itself, and what is shifted as a whole does not turn round: what looks like it is
	// rounding, and a shift may help. Otherwise, a raised vertex may also fall on another by the height alone; to tell costs a
	// search, so only when no shift has helped.
	const bool mayMeet = !staysOnRays(), mayTurn = options_.along == ExtrudeAlong::SurfaceNormal;
	const bool byHeight = verdict.fault == PatchFault::CrossesPart ||
	                      (mayTurn && verdict.fault == PatchFault::Folded) ||
	                      (mayMeet && (verdict.fault == PatchFault::CrossesSelf || last));
	if (options_.height != 0 && byHeight) refuseHeight(plan, verdict);
	throw PlacementConflict{"rounded coordinates spoil the label", space_.project(space_.toLabel(verdict.place))};
}

inline void LabelPlanner::checkRoom(LabelPlan& plan) const
{
	constexpr double margin = 2;  // of snap: what must stay of a wall
	const bool isSunk = staysOnRays() && options_.height < 0;
	const double needed = (isSunk ? -options_.height : 0) + margin * snap_;
	const double within = options_.measureRoom ? std::numeric_limits<double>::infinity() : needed;
	const Clearance clearance = MeasureClearance(space_, sheet_, plan.cut, snap_, layer_, within);
	plan.room = clearance.behind;
	const double left = clearance.behind + options_.height;
	if (isSunk && left < margin * snap_)
		throw Error(ErrorCode::HitsSurface, "the floor comes out behind")
			.atFace(clearance.face)
			.atPlace(clearance.place)
			.measured(-options_.height, std::max(clearance.behind - margin * snap_, 0.0));
}

/// Whether all that is raised stays on the line of sight through it, and what is straight there is straight in the label's space.
inline bool LabelPlanner::staysOnRays() const
{
	if (space_.wraps()) return false;
	return options_.along == ExtrudeAlong::Viewpoint ||
	       (options_.along == ExtrudeAlong::LabelNormal && !space_.perspective());
}

/// What is seen from the front may turn its back to the direction in which it is raised: there, up would be into the part.
/// @throws Error{Grazing} with an infinite stretch
inline void LabelPlanner::requireOutward(const LabelPatch& patch) const
{
	const int old = int(sheet_.vertices.size());
	std::vector<vcg::Point3d> rise(size_t(old) + patch.vertices.size(), vcg::Point3d(0, 0, 0));  // label space
	const auto riseOver = [&](const vcg::Point3d& from, const vcg::Point3d& to) {
		return (space_.toLabel(to) - space_.toLabel(from)) * std::copysign(1.0, options_.height);
	};
	for (const auto& [v, to] : patch.moved) rise[size_t(v)] = riseOver(sheet_.vertices[size_t(v)].mesh, to);
	for (size_t i = 0; i < patch.vertices.size(); ++i) {
		const int ground = patch.vertices[i].ground;
		if (ground < 0) continue;
		const vcg::Point3d& from =
			ground < old ? sheet_.vertices[size_t(ground)].mesh : patch.vertices[size_t(ground - old)].mesh;
		rise[size_t(old) + i] = riseOver(from, patch.vertices[i].mesh);
	}
	for (const PatchFace& f : patch.faces) {
		if (f.kind != FaceKind::Top || patch.isFlat) continue;
		const SheetTriangle& birth = sheet_.triangles[size_t(f.parent)];
		const vcg::Point3d& a = sheet_.vertices[size_t(birth.vertex[0])].label;
		const vcg::Point3d normal =
			(sheet_.vertices[size_t(birth.vertex[1])].label - a) ^ (sheet_.vertices[size_t(birth.vertex[2])].label - a);
		for (const int v : f.vertex)
			if (!(normal * rise[size_t(v)] > 0))
				throw Error(ErrorCode::Grazing, "a letter would be raised into the surface")
					.atFace(birth.face)
					.atPlace(sheet_.vertices[size_t(birth.vertex[0])].mesh)
					.measured(std::numeric_limits<double>::infinity(), options_.maxStretch);
	}
}

inline PatchVerdict LabelPlanner::check(const LabelPatch& patch, double height) const
{
	const bool sweeps = !patch.isFlat && !staysOnRays();
	const Overhang overhang(sheet_, patch.removed, precision_, worstResolution());
	const auto checkAs = [&](const Precision& as) {
		const std::vector<vcg::Point3d> position =
			RoundedPositions(sheet_, patch, [&](double x) { return as.round(x); });
		Suspects suspects;
		if (!space_.wraps() && (isRepresentable_ || as.isExact()))
			suspects = FindSuspects(space_, sheet_, layer_, patch, position, !sweeps, height, snap_);
		PatchVerdict verdict = CheckPatch(space_, sheet_, patch, position, suspects);
		if (distant_ && verdict.fault == PatchFault::Sound && !overhang.triangles().empty())
			verdict = CheckOverhang(sheet_, patch, position, as, overhang, distant_(overhang));
		return !sweeps || verdict.fault != PatchFault::Sound ? verdict : CheckSweptVolume(sheet_, patch, position);
	};
	const PatchVerdict verdict = checkAs(precision_);
	return precision_.keepsStored() || verdict.fault != PatchFault::Sound
	           ? verdict
	           : checkAs({!precision_.storesDouble, precision_.storesDouble});
}

/// Find the largest height that works, for the message.
inline void LabelPlanner::refuseHeight(const LabelPlan& plan, const PatchVerdict& verdict) const
{
	const auto worksAt = [&](double part) {
		const LabelPatch lower = RaiseLabel(space_, sheet_, plan.cut, options_.height * part, options_.along);
		return check(lower, options_.height * part).fault == PatchFault::Sound;
	};
	const double least = std::ldexp(1.0, -bisections);  // where not even this works, the rest need not be tried
	double works = worksAt(least) ? least : 0, fails = 1;
	for (int i = 0; i < bisections && works > 0; ++i) {
		report(60 + 3 * i);
		const double middle = (works + fails) / 2;
		(worksAt(middle) ? works : fails) = middle;
	}
	if (works == 0)
		throw PlacementConflict{"rounded coordinates spoil the label", space_.project(space_.toLabel(verdict.place))};
	const double height = std::abs(options_.height);
	const bool hitsItself = verdict.fault == PatchFault::CrossesSelf || verdict.fault == PatchFault::Folded;
	throw Error(hitsItself ? ErrorCode::HitsItself : ErrorCode::HitsSurface, "the extrusion meets a surface")
		.atFace(verdict.face)
		.atPlace(verdict.place)
		.measured(height, height * works);
}

}  // namespace vcg::textlabel
