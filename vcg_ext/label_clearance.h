#pragma once
// What lies in front of a label and behind it.
//
// A label must be seen whole from its viewpoint, and a sunk one must not come out on the other side of a wall. Both are questions
// about the candidates that overlap the letters in the label plane: the overlap of two triangles is a convex polygon, depth is
// linear over it, so its corners tell the least distance exactly. No sampling.

#include "label_cut.h"
#include "plane_grid.h"
#include "sheet_layer.h"

#include <memory>

namespace vcg::textlabel {

/// The nearest other surface behind the letters along the rays, and where.
struct Clearance {
	double behind =
		std::numeric_limits<double>::infinity();  ///< world units along the ray; infinite when nothing is there
	vcg::Point3d place{0, 0, 0};                  ///< mesh coordinates, on the label's surface
	int face = -1;                                ///< the mesh's face behind
};

/// Measure the room behind the letters and check that nothing hides them.
/// @param[in] resolution  world units; overlaps thinner than this are neighbours that touch
/// @param[in] layer  of the label: its members need no look, since within its box they can't overlap the letters
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

}  // namespace detail

inline Clearance MeasureClearance(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double resolution,
                                  const SheetLayer& layer, double within)
{
	const double farthest = detail::FarthestZ(sheet, cut);
	std::unique_ptr<detail::LetterSurface> letters;  // most labels need none: all else lies deep below them
	std::unique_ptr<PlaneGrid> grid;
	const auto pointOn = [&](int triangle, const vcg::Point2d& p) {
		const vcg::Point3d w = SpaceWeights(space, sheet, triangle, p);
		vcg::Point3d q(0, 0, 0);
		for (int k = 0; k < 3; ++k)
			q += sheet.vertices[size_t(sheet.triangles[size_t(triangle)].vertex[size_t(k)])].label * w[k];
		return q;
	};
	Clearance clearance;
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		if (layer.has(t)) continue;
		// what lies deeper than the best found so far, measured along w, lies deeper along the rays as well
		const double nearest = detail::NearestZ(sheet, t);
		const auto isDeep = [&](double z) { return z - nearest >= std::min(within, clearance.behind); };
		if (isDeep(farthest)) continue;
		if (!letters) {
			letters = std::make_unique<detail::LetterSurface>(sheet, cut);
			grid = std::make_unique<PlaneGrid>(letters->plane);
		}
		const PlaneTriangle corner = detail::CornersInPlane(sheet, t);
		grid->query(corner, 0, [&](int s) {
			if (letters->parent[size_t(s)] == t || isDeep(letters->farthest[size_t(s)])) return;
			const auto& letter = letters->plane[size_t(s)];
			if (detail::AreApart(letter, corner, resolution) || detail::AreApart(corner, letter, resolution)) return;
			detail::SmallPolygon overlap;
			for (const vcg::Point2d& p : corner) overlap.add(p);
			for (size_t k = 0; k < 3 && overlap.size > 0; ++k)
				overlap = overlap.clipped(letter[k], letter[(k + 1) % 3]);
			if (overlap.size < 3 || overlap.area() <= resolution * overlap.perimeter()) return;
			double least = std::numeric_limits<double>::infinity(), most = -least;
			vcg::Point3d place(0, 0, 0);
			for (int i = 0; i < overlap.size; ++i) {
				const vcg::Point3d q = pointOn(letters->parent[size_t(s)], overlap.point[size_t(i)]);
				const double depth = (q - pointOn(t, overlap.point[size_t(i)])) * space.towardsViewer(q);  // > 0 behind
				most = std::max(most, depth);
				if (depth >= least) continue;
				least = depth;
				place = q;
			}
			const bool coincides = std::max(std::abs(least), std::abs(most)) <= resolution;
			if (least + most < 0 || coincides)
				throw Error(ErrorCode::Occluded,
				            coincides ? "another surface in the same place" : "a surface in front of the label")
					.atFace(sheet.triangles[size_t(t)].face)
					.atPlace(space.toMesh(place));
			if (least < clearance.behind)
				clearance = {std::max(least, 0.0), space.toMesh(place), sheet.triangles[size_t(t)].face};
		});
	}
	return clearance;
}

}  // namespace vcg::textlabel
