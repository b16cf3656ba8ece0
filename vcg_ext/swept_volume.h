#pragma once
// What a label sweeps on its way along normals: does a shell of the part lie wholly within?
//
// Along the rays this can't be: what lies there hides the letters or is behind them, and label_clearance.h finds it. Along normals
// the letters leave the cone in which they were seen. A speck that floats beside the line of sight, or a void in the wall under a
// sunk letter, may then lie between the surface and the tops; no new face crosses it (patch_check.h), but the part that is saved
// has a shell inside a solid letter.
//
// The volume has a closed boundary: the letters' surface as it was, the walls and the tops. Nothing crosses walls and tops, or
// CheckPatch had found it; nothing crosses the surface under the letters, or it would hide them. So a connected piece of what stays
// is wholly inside or wholly outside, and the parity of crossings on the way from one of its vertices to a far point tells which.
// The piece need not be whole: triangles that are neither candidates nor straddling are seen beside the box that holds all the patch
// reaches, hence outside the volume, and then so is all that hangs on them, the piece among the candidates included.

#include "patch_check.h"
#include "rounding.h"

#include <array>
#include <memory>
#include <vcg/space/box3.h>

namespace vcg::textlabel {

/// Find a shell that lies wholly within what a label sweeps.
/// @param[in] position  as RoundedPositions gives them
/// @pre  CheckPatch says that the patch, which is not flat, is sound
/// @return CrossesPart with a face of the shell, and the place of a vertex of it; or Sound
PatchVerdict CheckSweptVolume(const Sheet& sheet, const LabelPatch& patch, const std::vector<vcg::Point3d>& position);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

enum class Passage { Misses, Passes, Unclear };

/// How a segment passes a triangle, exactly; Unclear when it touches the border, starts on it, or lies in its plane.
/// @pre `to` is no point of the triangle
inline Passage PassageOf(const vcg::Point3d& from, const vcg::Point3d& to, const Corners& t)
{
	const int sides = Orient3d(t[0], t[1], t[2], from) * Orient3d(t[0], t[1], t[2], to);
	if (sides > 0) return Passage::Misses;
	const auto [least, most] =
		std::minmax({Orient3d(from, to, t[0], t[1]), Orient3d(from, to, t[1], t[2]), Orient3d(from, to, t[2], t[0])});
	if (least < 0 && most > 0)
		return Passage::Misses;  // the line goes past, or sees a triangle without area from its edge
	return sides < 0 && least * most > 0 ? Passage::Passes : Passage::Unclear;
}

/// Where a point lies; Unclear on the boundary.
enum class Whereabouts { Outside, Inside, Unclear };

/// What the letters sweep, as a closed boundary.
class SweptVolume {
public:
	SweptVolume(const Sheet& sheet, const LabelPatch& patch, const std::vector<vcg::Point3d>& position)
	{
		const int old = int(sheet.vertices.size());
		const auto ground = [&](int v) {  // of a top's vertex: one that has moved, or one over a contour point
			if (v < old) return sheet.vertices[size_t(v)].mesh;
			const int below = patch.vertices[size_t(v - old)].ground;
			return position[size_t(below < 0 ? v : below)];
		};
		for (const PatchFace& f : patch.faces) {
			if (f.kind == FaceKind::Outside) continue;
			boundary_.push_back(CornersOf(position, f.vertex));
			if (f.kind == FaceKind::Top)
				boundary_.push_back({ground(f.vertex[0]), ground(f.vertex[1]), ground(f.vertex[2])});
		}
		for (const Corners& t : boundary_)
			for (const vcg::Point3d& p : t) box_.Add(p);
		reach_ = std::ldexp(1.0, std::ilogb(box_.Diag()) + 1);
		for (int k = 0; k < 3; ++k)
			slack_ = std::max(
				{slack_, kFarAboveRounding * std::abs(box_.min[k]), kFarAboveRounding * std::abs(box_.max[k])});
	}
	/// Whether the box of the volume holds a point.
	bool mayHold(const vcg::Point3d& p) const { return box_.IsIn(p); }
	/// @pre mayHold(p)
	Whereabouts find(const vcg::Point3d& p)
	{
		for (size_t i = 0; i < directions.size(); ++i) {
			const Whereabouts found = findAlong(p, i);
			if (found != Whereabouts::Unclear) return found;
		}
		return Whereabouts::Unclear;
	}
	/// @param[in] direction  index into `directions`
	Whereabouts findAlong(const vcg::Point3d& p, size_t direction)
	{
		const auto& d = directions[direction];
		const vcg::Point3d beyond = p + vcg::Point3d(d[0], d[1], d[2]) * reach_;
		if (!seen_[direction]) seen_[direction] = std::make_unique<PlaneGrid>(boundarySeen(direction));
		const vcg::Point2d at = seenAlong(direction, p);
		bool isInside = false, isUnclear = false;
		seen_[direction]->query({at, at, at}, slack_, [&](int i) {
			const Corners& t = boundary_[size_t(i)];
			if (isUnclear || !BoxesMeet({p, beyond, beyond}, t)) return;
			const Passage passage = PassageOf(p, beyond, t);
			isUnclear = passage == Passage::Unclear;
			if (passage == Passage::Passes) isInside = !isInside;
		});
		return isUnclear ? Whereabouts::Unclear : isInside ? Whereabouts::Inside : Whereabouts::Outside;
	}

	/// To points beyond the box, in the order in which they are tried: aslant to the planes that parts are made of.
	static constexpr std::array<std::array<double, 3>, 8> directions = {
		{{5, 7, 11}, {-11, 5, 7}, {7, -11, 5}, {5, 7, -11}, {13, -3, 8}, {-4, -13, 9}, {-9, 14, -17}, {-19, -6, -15}}};

private:
	/// Where a point is seen along a direction.
	static vcg::Point2d seenAlong(size_t direction, const vcg::Point3d& p)
	{
		const auto& d = directions[direction];
		return {p[0] - p[2] * (d[0] / d[2]), p[1] - p[2] * (d[1] / d[2])};
	}
	std::vector<PlaneTriangle> boundarySeen(size_t direction) const
	{
		std::vector<PlaneTriangle> seen;
		seen.reserve(boundary_.size());
		for (const Corners& t : boundary_)
			seen.push_back({seenAlong(direction, t[0]), seenAlong(direction, t[1]), seenAlong(direction, t[2])});
		return seen;
	}

	std::vector<Corners> boundary_;
	vcg::Box3d box_;
	double reach_;      ///< longer than the box; a power of two, which keeps round coordinates round
	double slack_ = 0;  ///< more than a coordinate is off when it is seen along a direction
	std::array<std::unique_ptr<PlaneGrid>, directions.size()>
		seen_;  ///< the boundary along each direction, once one has asked
};

/// The shells of what stays, joined by vertices that the patch does not touch.
class ShellSearch {
public:
	ShellSearch(const Sheet& sheet, const LabelPatch& patch, const std::vector<vcg::Point3d>& position)
		: sheet_(sheet), position_(position), volume_(sheet, patch, position), shell_(sheet.vertices.size(), Away)
	{
		for (size_t v = 0; v < shell_.size(); ++v)
			if (volume_.mayHold(position[v])) shell_[v] = Unseen;
		for (const int t : patch.removed)
			for (const int v : sheet.triangles[size_t(t)].vertex)
				if (shell_[size_t(v)] == Unseen) shell_[size_t(v)] = OfPatch;
		for (size_t t = 0; t < sheet.straddling.size(); ++t)
			for (const int v : sheet.straddling[t].inSheet) straddling_.emplace_back(v, t);
		std::sort(straddling_.begin(), straddling_.end());
	}
	PatchVerdict run()
	{
		for (size_t v = 0; v < shell_.size(); ++v)
			if (shell_[v] == Unseen && collect(int(v)) && isInside())
				return {PatchFault::CrossesPart, position_[v], face_};
		return {};
	}

private:
	enum Mark : int { Away = -2, OfPatch = -1, Unseen = 0 };  // else the number of a shell

	/// The shell of a vertex. @return false once it is seen to leave the box, or when it is no surface
	bool collect(int start)
	{
		member_ = {start};
		face_ = -1;
		shell_[size_t(start)] = ++shells_;
		for (size_t i = 0; i < member_.size(); ++i) {
			const size_t v = size_t(member_[i]);
			for (int f = sheet_.vertexStart[v]; f < sheet_.vertexStart[v + 1]; ++f) {
				const SheetTriangle& t = sheet_.triangles[size_t(sheet_.vertexFan[size_t(f)])];
				if (!add(t.vertex, t.face)) return false;
			}
			for (auto s = std::lower_bound(straddling_.begin(), straddling_.end(), std::make_pair(int(v), size_t(0)));
			     s != straddling_.end() && s->first == int(v); ++s) {
				const StraddlingTriangle& t = sheet_.straddling[s->second];
				if (!add(t.inSheet, t.face)) return false;
			}
		}
		return face_ >= 0;
	}
	/// A triangle of the shell at hand. @return false when it leaves the box
	bool add(const IndexTriangle& corners, int face)
	{
		if (IsCollinear(CornersOf(position_, corners))) return true;  // may reach through a wall: Contact::NoArea
		if (face_ < 0) face_ = face;
		for (const int w : corners) {
			int& mark = shell_[size_t(w)];
			if (mark == Away || (mark > Unseen && mark != shells_)) return false;
			if (mark != Unseen) continue;
			mark = shells_;
			member_.push_back(w);
		}
		return true;
	}
	/// Of the shell collected last: the first vertex that is not on the boundary tells.
	bool isInside()
	{
		for (const int v : member_) {
			const Whereabouts found = volume_.find(position_[size_t(v)]);
			if (found != Whereabouts::Unclear) return found == Whereabouts::Inside;
		}
		return true;  // what can't be told is not promised
	}

	const Sheet& sheet_;
	const std::vector<vcg::Point3d>& position_;
	SweptVolume volume_;
	std::vector<int> shell_;  ///< #Sheet::vertices: a Mark, or the shell it belongs to
	std::vector<int> member_;
	std::vector<std::pair<int, size_t>> straddling_;  ///< (vertex, index into Sheet::straddling), sorted
	int shells_ = 0, face_ = -1;                      ///< how many; a face of the mesh that belongs to the last
};

}  // namespace detail

inline PatchVerdict CheckSweptVolume(const Sheet& sheet, const LabelPatch& patch,
                                     const std::vector<vcg::Point3d>& position)
{
	return detail::ShellSearch(sheet, patch, position).run();
}

}  // namespace vcg::textlabel
