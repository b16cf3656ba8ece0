#pragma once
// What lies in front of a label and behind it.
//
// A label must be seen whole from its viewpoint, and a sunk one must not come out on the other side of a wall. Both are questions
// about the candidates that overlap the letters in the label plane: the overlap of two triangles is a convex polygon, depth is
// linear over it, so its corners tell the least distance exactly. No sampling.

#include "label_cut.h"
#include "plane_grid.h"
#include "sheet_layer.h"
#include "surface_point.h"

#include <memory>

namespace vcg::textlabel {

/// The nearest other surface behind the letters along the rays, and where.
struct Clearance {
	double behind =
		std::numeric_limits<double>::infinity();  ///< world units along the ray; infinite when nothing is there
	vcg::Point3d place{0, 0, 0};                  ///< mesh coordinates, on the label's surface
	int face = -1;                                ///< the mesh's face behind
};

/// Measure the room behind the letters and check that nothing hides them, no triangle that reaches behind the camera either.
/// @param[in] resolution  world units; overlaps thinner than this are neighbours that touch
/// @param[in] layer  of the label: its members are looked at only where it does not keep them apart from the letters
/// @param[in] within  world units: what lies deeper below the letters is not looked for
/// @throws Error{Occluded} naming the face in front, and the place
Clearance MeasureClearance(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double resolution,
                           const SheetLayer& layer = {}, double within = std::numeric_limits<double>::infinity());

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// The corners of a candidate in the label plane, counter-clockwise also when it shows its back.
inline PlaneTriangle CornersInPlane(const Sheet& sheet, int triangle)
{
	const SheetTriangle& t = sheet.triangles[size_t(triangle)];
	const vcg::Point2d &a = sheet.plane(t.vertex[0]), &b = sheet.plane(t.vertex[1]), &c = sheet.plane(t.vertex[2]);
	if (t.facing) return {a, b, c};
	return {a, c, b};
}

/// Label space: the largest z of a candidate, which no point of it exceeds.
inline double NearestZ(const Sheet& sheet, int triangle)
{
	const auto& v = sheet.triangles[size_t(triangle)].vertex;
	const auto z = [&](size_t k) { return sheet.vertices[size_t(v[k])].label[2]; };
	return std::max({z(0), z(1), z(2)});
}

/// A convex polygon of at most 3+3 corners: two triangles' overlap.
struct SmallPolygon {
	std::array<vcg::Point2d, 9> point;
	int size = 0;

	void add(const vcg::Point2d& p) { point[size_t(size++)] = p; }
	double area() const
	{
		double sum = 0;
		for (int i = 1; i + 1 < size; ++i) sum += (point[size_t(i)] - point[0]) ^ (point[size_t(i) + 1] - point[0]);
		return sum / 2;
	}
	double perimeter() const
	{
		double sum = 0;
		for (int i = 0; i < size; ++i) sum += (point[size_t((i + 1) % size)] - point[size_t(i)]).Norm();
		return sum;
	}
	/// Keep what lies to the left of a-b (Sutherland and Hodgman).
	SmallPolygon clipped(const vcg::Point2d& a, const vcg::Point2d& b) const
	{
		SmallPolygon out;
		for (int i = 0; i < size; ++i) {
			const vcg::Point2d &p = point[size_t(i)], &q = point[size_t((i + 1) % size)];
			const double dp = (b - a) ^ (p - a), dq = (b - a) ^ (q - a);
			if (dp >= 0) out.add(p);
			if ((dp < 0) != (dq < 0)) out.add(p + (q - p) * (dp / (dp - dq)));
		}
		return out;
	}
};

/// Whether an edge of one triangle keeps the other one beyond it, `sliver` of overlap forgiven. @pre both counter-clockwise
inline bool AreApart(const PlaneTriangle& s, const PlaneTriangle& t, double sliver)
{
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point2d edge = s[(k + 1) % 3] - s[k];
		const double inside = std::max({edge ^ (t[0] - s[k]), edge ^ (t[1] - s[k]), edge ^ (t[2] - s[k])});
		if (inside <= 0 || inside * inside <= sliver * sliver * edge.SquaredNorm()) return true;
	}
	return false;
}

/// What is seen of a triangle that reaches behind the centre of projection, as triangles of the label plane.
inline std::vector<PlaneTriangle> SeenOfStraddling(const LabelSpace& space, const StraddlingTriangle& t)
{
	constexpr double safely = 1e-3;  // of the distance from the centre to the plane behind which nothing is projected
	const double limit = space.nearestZ() - safely * (space.center()[2] - space.nearestZ());
	std::vector<vcg::Point2d> corner;
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point3d &a = t.label[k], &b = t.label[(k + 1) % 3];
		if (a[2] <= limit) corner.push_back(space.project(a));
		if ((a[2] <= limit) == (b[2] <= limit)) continue;
		vcg::Point3d q = a + (b - a) * ((limit - a[2]) / (b[2] - a[2]));
		q[2] = limit;
		corner.push_back(space.project(q));
	}
	std::vector<PlaneTriangle> seen;
	for (size_t k = 2; k < corner.size(); ++k) {
		PlaneTriangle piece = {corner[0], corner[k - 1], corner[k]};
		const int turn = Orient2d(piece[0], piece[1], piece[2]);
		if (turn < 0) std::swap(piece[1], piece[2]);
		if (turn != 0) seen.push_back(piece);
	}
	return seen;
}

/// Label space: the least z of the letters' surface.
inline double FarthestZ(const Sheet& sheet, const CutLabel& cut)
{
	double least = std::numeric_limits<double>::infinity();
	const auto add = [&](const IndexTriangle& t) {
		for (const int v : t) least = std::min(least, cut.points.at(sheet, v).label[2]);
	};
	for (const CutTriangle& t : cut.triangles)
		if (t.side == Side::Inside) add(t.point);
	for (const int t : cut.within) add(sheet.triangles[size_t(t)].vertex);
	return least;
}

/// The letters' surface as triangles of the label plane.
struct LetterSurface {
	std::vector<PlaneTriangle> plane;
	std::vector<int> parent;       ///< sheet triangle that each is a piece of
	std::vector<double> farthest;  ///< label space: least z of each

	LetterSurface(const Sheet& sheet, const CutLabel& cut)
	{
		for (const CutTriangle& t : cut.triangles)
			if (t.side == Side::Inside) add(sheet, cut, t.point, t.parent);
		for (const int t : cut.within) add(sheet, cut, sheet.triangles[size_t(t)].vertex, t);
	}
	void add(const Sheet& sheet, const CutLabel& cut, const IndexTriangle& t, int from)
	{
		const SheetPoint &a = cut.points.at(sheet, t[0]), &b = cut.points.at(sheet, t[1]),
						 &c = cut.points.at(sheet, t[2]);
		plane.push_back({a.plane, b.plane, c.plane});
		parent.push_back(from);
		farthest.push_back(std::min({a.label[2], b.label[2], c.label[2]}));
	}
};

/// Compares other surfaces with that of the letters, where they overlap in the label plane.
class ClearanceSearch {
public:
	ClearanceSearch(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double resolution, double within)
		: space_(space), sheet_(sheet), cut_(cut), resolution_(resolution), within_(within),
		  farthest_(FarthestZ(sheet, cut))
	{}

	/// @param[in] corner  of the other surface, counter-clockwise
	/// @param[in] parent  the sheet triangle that it is, or -1
	/// @param[in] face  of the mesh
	/// @param[in] nearest  label space: its largest z
	/// @param[in] pointOn  gives where it is seen at a point of the label plane, label space
	/// @param[in] without  says of a box of the label plane that the letters are not overlapped there
	/// @throws Error{Occluded}
	template <class PointOn, class Without>
	void compare(const PlaneTriangle& corner, int parent, int face, double nearest, const PointOn& pointOn,
	             const Without& without)
	{
		// what lies deeper than the best found so far, measured along w, lies deeper along the rays as well
		const auto isDeep = [&](double z) { return z - nearest >= std::min(within_, found_.behind); };
		if (isDeep(farthest_)) return;
		if (!letters_) {
			letters_ = std::make_unique<LetterSurface>(sheet_, cut_);
			grid_ = std::make_unique<PlaneGrid>(letters_->plane);
		}
		const auto compareWith = [&](int s) {
			if (letters_->parent[size_t(s)] == parent || isDeep(letters_->farthest[size_t(s)])) return;
			const PlaneTriangle& letter = letters_->plane[size_t(s)];
			if (AreApart(letter, corner, resolution_) || AreApart(corner, letter, resolution_)) return;
			SmallPolygon overlap;
			for (const vcg::Point2d& p : corner) overlap.add(p);
			for (size_t k = 0; k < 3 && overlap.size > 0; ++k)
				overlap = overlap.clipped(letter[k], letter[(k + 1) % 3]);
			if (overlap.size < 3 || overlap.area() <= resolution_ * overlap.perimeter()) return;
			double least = std::numeric_limits<double>::infinity(), most = -least;
			vcg::Point3d place(0, 0, 0);
			for (int i = 0; i < overlap.size; ++i) {
				const vcg::Point2d& p = overlap.point[size_t(i)];
				const vcg::Point3d q = PointOnTriangle(space_, sheet_, letters_->parent[size_t(s)], p);
				const double depth = (q - pointOn(p)) * space_.towardsViewer(q);  // > 0 behind
				most = std::max(most, depth);
				if (depth >= least) continue;
				least = depth;
				place = q;
			}
			const bool coincides = std::max(std::abs(least), std::abs(most)) <= resolution_;
			if (least + most < 0 || coincides)
				throw Error(ErrorCode::Occluded,
				            coincides ? "another surface in the same place" : "a surface in front of the label")
					.atFace(face)
					.atPlace(space_.toMesh(place));
			if (least < found_.behind) found_ = {std::max(least, 0.0), space_.toMesh(place), face};
		};
		grid_->query(corner, 0, compareWith, without);
	}
	const Clearance& found() const { return found_; }

private:
	const LabelSpace& space_;
	const Sheet& sheet_;
	const CutLabel& cut_;
	const double resolution_, within_, farthest_;
	std::unique_ptr<LetterSurface> letters_;  // most labels need none: all else lies deep below them
	std::unique_ptr<PlaneGrid> grid_;
	Clearance found_;
};

}  // namespace detail

inline Clearance MeasureClearance(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double resolution,
                                  const SheetLayer& layer, double within)
{
	detail::ClearanceSearch search(space, sheet, cut, resolution, within);
	const auto nowhere = [](const PlaneBox&) { return false; };
	const auto inLayer = [&](const PlaneBox& box) { return layer.holds(box); };
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		if (layer.has(t) && layer.isWhole()) continue;  // the letters are within its box
		const PlaneTriangle corners = detail::CornersInPlane(sheet, t);
		const auto pointOn = [&](const vcg::Point2d& p) { return PointOnTriangle(space, sheet, t, p); };
		const auto compare = [&](const auto& without) {
			search.compare(corners, t, sheet.triangles[size_t(t)].face, detail::NearestZ(sheet, t), pointOn, without);
		};
		if (!layer.has(t)) compare(nowhere);
		else if (!layer.holds(BoxOfTriangle(corners))) compare(inLayer);
	}
	if (!space.perspective())
		return search.found();  // what the axis goes through is not seen; patch_check.h looks at it
	for (const StraddlingTriangle& t : sheet.straddling) {
		const vcg::Point3d &c = space.center(), normal = (t.label[1] - t.label[0]) ^ (t.label[2] - t.label[0]);
		const auto pointOn = [&](const vcg::Point2d& p) {
			const vcg::Point3d ray = vcg::Point3d(p[0], p[1], 0) - c;
			return c + ray * ((normal * (t.label[0] - c)) / (normal * ray));
		};
		for (const PlaneTriangle& piece : detail::SeenOfStraddling(space, t))
			search.compare(piece, -1, t.face, std::numeric_limits<double>::infinity(), pointOn, nowhere);
	}
	return search.found();
}

}  // namespace vcg::textlabel
