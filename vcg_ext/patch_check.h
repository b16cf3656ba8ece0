#pragma once
// The check before the commit: is the patch still a surface once its coordinates are rounded?
//
// A patch is right by construction in exact arithmetic; what can spoil it is the rounding of coordinates to float32, by the mesh
// itself or by the STL file it is saved to, where equal points are one point. So the check is made on rounded coordinates:
//  - no two vertices fall together and no face becomes a line;
//  - every piece of a cut triangle still faces its viewer: seen from there the patch is a triangulation with an unchanged border
//    and only counter-clockwise triangles, which can't overlap itself;
//  - no new face meets another face, new or old, in more than what they share: exact, among the candidates.
// What the input had wrong before (a part that crosses itself elsewhere under the label) is not held against the patch.

#include "crossing_search.h"
#include "label_raise.h"

namespace vcg::textlabel {

/// What is wrong with a patch; Sound is the only good one.
enum class PatchFault {
	Sound,
	Merged,       ///< two vertices have the same rounded coordinates
	Collapsed,    ///< a face without area, or turned round by rounding
	Folded,       ///< a raised face points away from where the surface pointed
	CrossesSelf,  ///< two faces of the label meet
	CrossesPart   ///< a face of the label meets another part of the surface
};

struct PatchVerdict {
	PatchFault fault = PatchFault::Sound;
	vcg::Point3d place{0, 0, 0};  ///< mesh coordinates
	int face = -1;                ///< face of the mesh that is met (CrossesPart)
};

/// Check a patch on rounded coordinates.
/// @param[in] round  mesh coordinate to the coordinate as it will be read back
template <class Round>
PatchVerdict CheckPatch(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch, Round&& round);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Rounded positions of all vertices of a patch: those of the sheet (moved), then the new ones.
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

inline Corners CornersOf(const std::vector<vcg::Point3d>& position, const IndexTriangle& t)
{
	return {position[size_t(t[0])], position[size_t(t[1])], position[size_t(t[2])]};
}

/// Two vertices of the patch, at least one of them new or moved, that rounding has made one; or -1.
inline int FindMerged(const Sheet& sheet, const LabelPatch& patch, const std::vector<vcg::Point3d>& position)
{
	std::vector<int> order(position.size());
	for (size_t i = 0; i < order.size(); ++i) order[i] = int(i);
	std::sort(order.begin(), order.end(), [&](int a, int b) { return position[size_t(a)] < position[size_t(b)]; });
	std::vector<char> changed(position.size(), 0);
	for (size_t i = sheet.vertices.size(); i < position.size(); ++i) changed[i] = 1;
	for (const auto& m : patch.moved) changed[size_t(m.first)] = 1;
	for (size_t i = 1; i < order.size(); ++i)
		if (position[size_t(order[i])] == position[size_t(order[i - 1])] &&
		    (changed[size_t(order[i])] || changed[size_t(order[i - 1])]))
			return order[i];
	return -1;
}

/// Whether a piece of a cut triangle has kept its orientation.
inline bool KeepsOrientation(const LabelSpace& space, const Sheet& sheet, const PatchFace& f, const Corners& c)
{
	const SheetTriangle& birth = sheet.triangles[size_t(f.parent)];
	if (f.kind == FaceKind::Outside && birth.facing) {
		std::array<vcg::Point2d, 3> p;
		for (size_t k = 0; k < 3; ++k) p[k] = space.project(space.toLabel(c[k]));
		return Orient2d(p[0], p[1], p[2]) > 0;
	}
	const auto& v = birth.vertex;
	const vcg::Point3d& a = sheet.vertices[size_t(v[0])].mesh;
	const vcg::Point3d before = (sheet.vertices[size_t(v[1])].mesh - a) ^ (sheet.vertices[size_t(v[2])].mesh - a);
	return ((c[1] - c[0]) ^ (c[2] - c[0])) * before > 0;
}

/// Whether a pair that crosses crossed before the label: a piece of a triangle and what that triangle already met.
inline bool CrossedBefore(const std::vector<vcg::Point3d>& position, const Sheet& sheet, const PatchFace& a, int other)
{
	if (a.parent == other) return false;
	return IsCrossing(ContactOf(CornersOf(position, sheet.triangles[size_t(a.parent)].vertex),
	                            CornersOf(position, sheet.triangles[size_t(other)].vertex)));
}

inline PatchVerdict CheckCrossings(const Sheet& sheet, const LabelPatch& patch,
                                   const std::vector<vcg::Point3d>& position)
{
	std::vector<Corners> mine, others;
	std::vector<int> otherTriangle;
	for (const PatchFace& f : patch.faces) mine.push_back(CornersOf(position, f.vertex));
	for (int t = 0, next = 0; t < int(sheet.triangles.size()); ++t) {
		if (next < int(patch.removed.size()) && patch.removed[size_t(next)] == t) {
			++next;
			continue;
		}
		others.push_back(CornersOf(position, sheet.triangles[size_t(t)].vertex));
		otherTriangle.push_back(t);
	}
	const auto onSurface = [&](int face) {
		return patch.faces[size_t(face)].kind == FaceKind::Outside || patch.isFlat;
	};
	CrossingOptions options;
	options.stopAtFirst = true;
	options.ignore = [&](int first, int second, bool secondIsOther) {
		if (!onSurface(first) || !(secondIsOther || onSurface(second))) return false;
		const int other = secondIsOther ? otherTriangle[size_t(second)] : patch.faces[size_t(second)].parent;
		return CrossedBefore(position, sheet, patch.faces[size_t(first)], other);
	};
	for (const FacePair& pair : FindCrossings(mine, others, options)) {
		const vcg::Point3d& place = position[size_t(patch.faces[size_t(pair.first)].vertex[0])];
		if (!pair.secondIsOther) return {PatchFault::CrossesSelf, place, -1};
		return {PatchFault::CrossesPart, place, sheet.triangles[size_t(otherTriangle[size_t(pair.second)])].face};
	}
	return {};
}

}  // namespace detail

template <class Round>
PatchVerdict CheckPatch(const LabelSpace& space, const Sheet& sheet, const LabelPatch& patch, Round&& round)
{
	const std::vector<vcg::Point3d> position = detail::RoundedPositions(sheet, patch, round);
	const int merged = detail::FindMerged(sheet, patch, position);
	if (merged >= 0) return {PatchFault::Merged, position[size_t(merged)]};
	for (const PatchFace& f : patch.faces) {
		const Corners c = detail::CornersOf(position, f.vertex);
		if (IsCollinear(c)) return {PatchFault::Collapsed, c[0]};
		if (f.kind != FaceKind::Wall && !detail::KeepsOrientation(space, sheet, f, c))
			return {f.kind == FaceKind::Top && !patch.isFlat ? PatchFault::Folded : PatchFault::Collapsed, c[0]};
	}
	return detail::CheckCrossings(sheet, patch, position);
}

}  // namespace vcg::textlabel
