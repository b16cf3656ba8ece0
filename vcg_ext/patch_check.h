#pragma once
// The check before the commit: is the patch still a surface once its coordinates are rounded?
//
// A patch is right by construction in exact arithmetic; what can spoil it is the rounding of coordinates to float32, by the mesh
// itself or by the STL file it is saved to, where equal points are one point. So the check is made on rounded coordinates:
//  - no two vertices fall together and no face becomes a line;
//  - every piece of a cut triangle still faces its viewer: seen from there the patch is a triangulation with an unchanged border
//    and only counter-clockwise triangles, which can't overlap itself; a wrapped label's pieces keep to the side of their triangle;
//  - a wrapped label's faces are less than half the way round and off the axis: what they could meet is among the candidates;
//  - no new face meets another face, new or old, in more than what they share: exact, among the candidates, for all faces that
//    could at all (patch_suspects.h).
// What the input had wrong before (a part that crosses itself elsewhere under the label) is not held against the patch.

#include "crossing_search.h"
#include "patch_suspects.h"
#include "place_table.h"
#include "rounding.h"

namespace vcg::textlabel {

/// What is wrong with a patch; Sound is the only good one.
enum class PatchFault {
	Sound,
	Merged,       ///< two vertices have the same rounded coordinates
	Collapsed,    ///< a face without area, or turned round by rounding
	Folded,       ///< a raised face points away from where the surface pointed
	CrossesSelf,  ///< two faces of the label meet
	CrossesPart,  ///< a face of the label meets another part of the surface
	SpoilsBeside  ///< a piece of the surface, once rounded, meets a face far beside the label (overhang.h)
};

struct PatchVerdict {
	PatchFault fault = PatchFault::Sound;
	vcg::Point3d place{0, 0, 0};  ///< mesh coordinates
	int face = -1;                ///< face of the mesh that is met (CrossesPart)
};

/// Rounded positions of all vertices of a patch: those of the sheet (moved), then the new ones.
/// @param[in] round  mesh coordinate to the coordinate as it will be read back
template <class Round>
std::vector<vcg::Point3d> RoundedPositions(const Sheet& sheet, const LabelPatch& patch, Round&& round);

/// Check a patch on rounded coordinates.
/// @param[in] position  as RoundedPositions gives them
/// @param[in] suspects  what to look at; all by default
/// @throws Error{NonManifold} where the part touches itself in a vertex that moves
PatchVerdict CheckPatch(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch,
                        const std::vector<vcg::Point3d>& position, const Suspects& suspects = {});

// ---------------------------------------------------------------------------------------------------------------------------

template <class Round>
std::vector<vcg::Point3d> RoundedPositions(const Sheet& sheet, const LabelPatch& patch, Round&& round)
{
	std::vector<vcg::Point3d> position;
	position.reserve(sheet.vertices.size() + patch.vertices.size());
	for (const SheetVertex& v : sheet.vertices) position.push_back(v.mesh);
	for (const auto& [v, p] : patch.moved) position[size_t(v)] = p;
	for (const PatchVertex& v : patch.vertices) position.push_back(v.mesh);
	for (vcg::Point3d& p : position)
		for (int i = 0; i < 3; ++i) p[i] = round(p[i]);
	return position;
}

namespace detail {

inline Corners CornersOf(const std::vector<vcg::Point3d>& position, const IndexTriangle& t)
{
	return {position[size_t(t[0])], position[size_t(t[1])], position[size_t(t[2])]};
}

/// A vertex that rounding has made one with another; or -1. Only pairs of which one is marked are looked at.
/// @param[in] marked  #position
inline int FindMerged(const std::vector<vcg::Point3d>& position, const std::vector<char>& marked)
{
	PlaceTable table(position, size_t(std::count(marked.begin(), marked.end(), 1)));
	for (size_t i = 0; i < marked.size(); ++i)
		if (marked[i] && table.add(int(i)) >= 0) return int(i);
	for (size_t i = 0; i < marked.size(); ++i)
		if (const int found = marked[i] ? -1 : table.find(int(i)); found >= 0) return found;
	return -1;
}

/// The vertices to look at: new and moved ones, of suspects only where these are known.
inline std::vector<char> MarkVertices(const Sheet& sheet, const LabelPatch& patch, const Suspects& suspects)
{
	std::vector<char> marked(sheet.vertices.size() + patch.vertices.size(), 0);
	for (size_t i = sheet.vertices.size(); i < marked.size(); ++i) marked[i] = 1;
	for (const auto& m : patch.moved) marked[size_t(m.first)] = 1;
	if (suspects.all || !suspects.pairs.empty()) return marked;
	std::vector<char> ofSuspects(marked.size(), 0);
	for (size_t f = 0; f < patch.faces.size(); ++f)
		for (const int v : patch.faces[f].vertex)
			if (suspects.face[f]) ofSuspects[size_t(v)] = marked[size_t(v)];
	return ofSuspects;
}

/// A vertex that moves with a letter must not lie where another one stays: two sheets that touch there would come apart.
inline void RequireOwnPlaces(const Sheet& sheet, const LabelPatch& patch)
{
	if (patch.moved.empty()) return;
	std::vector<char> moves(sheet.vertices.size(), 0);
	for (const auto& moved : patch.moved) moves[size_t(moved.first)] = 1;
	std::vector<vcg::Point3d> place;
	for (const SheetVertex& v : sheet.vertices) place.push_back(v.mesh);
	const int shared = FindMerged(place, moves);
	if (shared >= 0) throw Error(ErrorCode::NonManifold, "two sheets touch in a vertex").atPlace(place[size_t(shared)]);
}

/// Whether a piece of a cut triangle has kept its orientation.
inline bool KeepsOrientation(const LabelSpace& space, const Sheet& sheet, const PatchFace& f, const Corners& c)
{
	const SheetTriangle& birth = sheet.triangles[size_t(f.parent)];
	if (f.kind == FaceKind::Outside && birth.facing && !space.wraps()) {
		std::array<vcg::Point2d, 3> p;
		for (size_t k = 0; k < 3; ++k) p[k] = space.project(space.toLabel(c[k]));
		return Orient2d(p[0], p[1], p[2]) > 0;
	}
	const auto& v = birth.vertex;
	const vcg::Point3d& a = sheet.vertices[size_t(v[0])].mesh;
	const vcg::Point3d before = (sheet.vertices[size_t(v[1])].mesh - a) ^ (sheet.vertices[size_t(v[2])].mesh - a);
	return ((c[1] - c[0]) ^ (c[2] - c[0])) * before > 0;
}

/// All faces that could meet, under one number each: those of the patch, the candidates that stay, the straddling triangles.
class CrossingCheck {
public:
	/// @param[in] unrolled  of a wrapped label: LabelSpace::unrolled of all positions
	CrossingCheck(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch,
	              const std::vector<vcg::Point3d>& position, const std::vector<vcg::Point3d>& unrolled)
		: space_(space), sheet_(sheet), patch_(patch), position_(position), unrolled_(unrolled)
	{}

	PatchVerdict run(const Suspects& suspects) const
	{
		std::vector<int> mine, others;
		for (int f = 0; f < int(patch_.faces.size()); ++f)
			(suspects.all || suspects.face[size_t(f)] ? mine : others).push_back(f);
		if (!mine.empty()) {
			others = withRest(std::move(others));
			if (!suspects.all && mine.size() < others.size()) others = thoseNear(mine, others);
			const PatchVerdict found = search(mine, others);
			if (found.fault != PatchFault::Sound) return found;
		}
		return suspects.all || suspects.pairs.empty() ? PatchVerdict() : searchPairs(suspects.pairs);
	}

private:
	int patchFaces() const { return int(patch_.faces.size()); }
	int firstStraddling() const { return patchFaces() + int(sheet_.triangles.size()); }
	const StraddlingTriangle& straddling(int number) const
	{
		return sheet_.straddling[size_t(number - firstStraddling())];
	}
	const IndexTriangle& vertices(int number) const
	{
		return number < patchFaces() ? patch_.faces[size_t(number)].vertex
		                             : sheet_.triangles[size_t(number - patchFaces())].vertex;
	}
	Corners corners(int number) const
	{
		return number < firstStraddling() ? CornersOf(position_, vertices(number)) : straddling(number).mesh;
	}
	Corners unrolledCorners(int number) const
	{
		if (number < firstStraddling()) return CornersOf(unrolled_, vertices(number));
		const Corners& c = straddling(number).mesh;
		return {space_.unrolled(c[0]), space_.unrolled(c[1]), space_.unrolled(c[2])};
	}
	/// Whether `holds` is true for the corners that a face had before the label: of a piece, those of what it was cut from.
	template <class Holds>
	bool anyBefore(int number, const Holds& holds) const
	{
		return number < firstStraddling() ? sheet_.anyBefore(parent(number), holds) : holds(straddling(number).mesh);
	}
	int parent(int number) const
	{
		return number < patchFaces() ? patch_.faces[size_t(number)].parent : number - patchFaces();
	}
	/// The numbers given, and those of the candidates that stay.
	std::vector<int> withRest(std::vector<int> numbers) const
	{
		for (int t = 0, next = 0; t < int(sheet_.triangles.size()); ++t) {
			if (next < int(patch_.removed.size()) && patch_.removed[size_t(next)] == t) ++next;
			else numbers.push_back(patchFaces() + t);
		}
		for (int i = 0; i < int(sheet_.straddling.size()); ++i) numbers.push_back(firstStraddling() + i);
		return numbers;
	}
	/// Those that are seen in the same place as one of mine: the others can't meet them.
	std::vector<int> thoseNear(const std::vector<int>& mine, const std::vector<int>& others) const
	{
		std::vector<vcg::Point2d> plane;
		plane.reserve(position_.size());
		for (const SheetVertex& v : sheet_.vertices) plane.push_back(v.plane);
		const auto see = [&](int v) { return space_.project(space_.toLabel(position_[size_t(v)])); };
		for (const auto& m : patch_.moved) plane[size_t(m.first)] = see(m.first);
		while (plane.size() < position_.size()) plane.push_back(see(int(plane.size())));
		double largest = 0;
		for (const vcg::Point2d& p : plane) largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
		const auto seen = [&](int number) {
			const IndexTriangle& v = vertices(number);
			return PlaneTriangle{plane[size_t(v[0])], plane[size_t(v[1])], plane[size_t(v[2])]};
		};
		std::vector<PlaneTriangle> triangles;
		for (const int i : mine) triangles.push_back(seen(i));
		PlaneGrid grid(triangles);
		std::vector<int> near;
		for (const int i : others) {
			bool isNear = false;
			grid.query(seen(i), kFarAboveRounding * largest, [&](int) { isNear = true; });
			if (isNear) near.push_back(i);
		}
		return near;
	}
	/// Where a face lies along the frame's axes: in space the boxes of all walls meet that rise along a slanting direction.
	/// @pre !space_.wraps()
	SearchBox boxInFrame(int number) const
	{
		const vcg::Point3d origin = space_.toMesh({0, 0, 0});
		SearchBox box;
		double reach = 0;
		for (const vcg::Point3d& p : corners(number)) {
			const vcg::Point3d q = space_.toLabel(p), d = p - origin;
			for (size_t i = 0; i < 3; ++i) {
				box.low[i] = std::min(box.low[i], q[int(i)]);
				box.high[i] = std::max(box.high[i], q[int(i)]);
				reach = std::max(reach, std::abs(d[int(i)]));
			}
		}
		box.grow(kFarAboveRounding * reach * space_.scale());
		return withinDomain(box);
	}
	/// Where a face lies round the axis, along it and off it: in space the boxes of all that runs along a slanting axis meet.
	/// @pre space_.wraps()
	SearchBox boxRoundAxis(int number) const
	{
		const Corners c = corners(number), at = unrolledCorners(number);
		SearchBox box;
		double reach = 0, nearest = std::numeric_limits<double>::infinity();  // of the coordinates; to the axis
		for (size_t k = 0; k < 3; ++k) {
			for (size_t i = 0; i < 3; ++i) {
				box.low[i] = std::min(box.low[i], at[k][int(i)]);
				box.high[i] = std::max(box.high[i], at[k][int(i)]);
				reach = std::max(reach, std::abs(c[k][int(i)]));
			}
			nearest = std::min(nearest, space_.distanceFromAxis(at[k][2]));
		}
		// between its corners a face comes nearer to the axis, but not by more than the chord of its arc does
		const double half = (box.high[0] - box.low[0]) / space_.circumference() * std::acos(-1.0);
		const double slack = kFarAboveRounding * (reach * space_.scale() + space_.circumference());
		const bool isAtCut = box.low[0] <= space_.cutAt(-1) + slack || box.high[0] >= space_.cutAt(1) - slack;
		const bool isWhole = number < firstStraddling() && space_.isInOnePiece(at);
		const double nearer = isWhole ? nearest * (1 - std::cos(half)) : nearest;
		if (!isWhole || isAtCut) {
			box.low[0] = 2 * space_.cutAt(-1) - space_.cutAt(1);
			box.high[0] = 2 * space_.cutAt(1) - space_.cutAt(-1);
		}
		box.low[2] -= nearer;
		box.high[2] += nearer;
		box.grow(slack);
		return withinDomain(box);
	}
	/// Nothing for what is beyond the domain of the predicates.
	static SearchBox withinDomain(const SearchBox& box)
	{
		for (size_t k = 0; k < 3; ++k)
			if (!std::isfinite(box.high[k] - box.low[k])) return {};
		return box;
	}
	bool isOnSurface(int face) const { return patch_.faces[size_t(face)].kind == FaceKind::Outside || patch_.isFlat; }
	/// Two pieces of the surface that crossed before they were cut are not the label's fault.
	bool crossedBefore(int face, int other) const
	{
		if (!isOnSurface(face) || (other < patchFaces() && !isOnSurface(other))) return false;
		if (other < firstStraddling() && parent(face) == parent(other)) return false;
		return anyBefore(face, [&](const Corners& first) {
			return anyBefore(
				other, [&](const Corners& second) { return first != second && IsCrossing(ContactOf(first, second)); });
		});
	}
	PatchVerdict verdict(int face, int other) const
	{
		const vcg::Point3d& place = position_[size_t(patch_.faces[size_t(face)].vertex[0])];
		if (other < patchFaces()) return {PatchFault::CrossesSelf, place, -1};
		return {PatchFault::CrossesPart, place,
		        other < firstStraddling() ? sheet_.triangles[size_t(parent(other))].face : straddling(other).face};
	}
	PatchVerdict search(const std::vector<int>& mine, const std::vector<int>& others) const
	{
		std::vector<Corners> myCorners, otherCorners;
		for (const int i : mine) myCorners.push_back(corners(i));
		for (const int i : others) otherCorners.push_back(corners(i));
		const auto numberOf = [&](int second, bool isOther) { return (isOther ? others : mine)[size_t(second)]; };
		CrossingOptions options;
		options.stopAtFirst = true;
		options.ignore = [&](int first, int second, bool isOther) {
			return crossedBefore(mine[size_t(first)], numberOf(second, isOther));
		};
		options.boxOf = [&](int face, bool isOther) {
			const int number = numberOf(face, isOther);
			return space_.wraps() ? boxRoundAxis(number) : boxInFrame(number);
		};
		for (const FacePair& pair : FindCrossings(myCorners, otherCorners, options))
			return verdict(mine[size_t(pair.first)], numberOf(pair.second, pair.secondIsOther));
		return {};
	}
	/// The pieces of one candidate against the other candidate or its pieces.
	PatchVerdict searchPairs(const std::vector<std::array<int, 2>>& pairs) const
	{
		std::vector<std::vector<int>> pieces(sheet_.triangles.size());
		for (int f = 0; f < patchFaces(); ++f) pieces[size_t(patch_.faces[size_t(f)].parent)].push_back(f);
		for (const auto& [changed, other] : pairs) {
			std::vector<int> second = pieces[size_t(other)];
			if (!std::binary_search(patch_.removed.begin(), patch_.removed.end(), other))
				second.push_back(patchFaces() + other);
			for (const int f : pieces[size_t(changed)])
				for (const int g : second)
					if (IsCrossing(ContactOf(corners(f), corners(g))) && !crossedBefore(f, g)) return verdict(f, g);
		}
		return {};
	}

	const LabelSpace& space_;
	const Sheet& sheet_;
	const LabelPatch& patch_;
	const std::vector<vcg::Point3d>& position_;
	const std::vector<vcg::Point3d>& unrolled_;
};

}  // namespace detail

inline PatchVerdict CheckPatch(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch,
                               const std::vector<vcg::Point3d>& position, const Suspects& suspects)
{
	if (suspects.none()) return {};
	detail::RequireOwnPlaces(sheet, patch);
	const int merged = detail::FindMerged(position, detail::MarkVertices(sheet, patch, suspects));
	if (merged >= 0) return {PatchFault::Merged, position[size_t(merged)]};
	std::vector<vcg::Point3d> unrolled;
	if (space.wraps())
		for (const vcg::Point3d& p : position) unrolled.push_back(space.unrolled(p));
	for (size_t i = 0; i < patch.faces.size(); ++i) {
		if (!suspects.all && !suspects.face[i]) continue;
		const PatchFace& f = patch.faces[i];
		const Corners c = detail::CornersOf(position, f.vertex);
		if (IsCollinear(c)) return {PatchFault::Collapsed, c[0]};
		if (space.wraps() && !space.isInOnePiece(detail::CornersOf(unrolled, f.vertex)))
			return {PatchFault::CrossesSelf, c[0]};
		if (f.kind != FaceKind::Wall && !detail::KeepsOrientation(space, sheet, f, c))
			return {f.kind == FaceKind::Top && !patch.isFlat ? PatchFault::Folded : PatchFault::Collapsed, c[0]};
	}
	return detail::CrossingCheck(space, sheet, patch, position, unrolled).run(suspects);
}

}  // namespace vcg::textlabel
