#pragma once
// How large the letters are on the surface, and whether it draws them out or squeezes them too much.

#include "label_raise.h"
#include "surface_point.h"

namespace vcg::textlabel {

/// The letters of a cut on the surface, before they are raised.
struct SurfaceMeasure {
	double area = 0;     ///< world units squared
	double stretch = 1;  ///< largest ratio of surface length to label length under the letters
	double leastStretch =
		1;  ///< of a wrapped label: least distance of the letters from the axis over the radius; at most 1
};

/// What a label is refused beyond.
struct StretchLimits {
	double most, least;  ///< for SurfaceMeasure::stretch and SurfaceMeasure::leastStretch
};

/// Measure the letters of a cut.
/// @param[in] snap  label units: a triangle thinner than twice that has no steepness
/// @throws Error{Grazing, Squeezed}
SurfaceMeasure MeasureSurface(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double snap,
                              const StretchLimits& limits);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// @throws Error{Grazing} with the steepest triangle under a letter
inline double MostStretch(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double snap, double limit)
{
	std::vector<char> isParent(sheet.triangles.size(), 0);
	for (const int t : cut.within) isParent[size_t(t)] = 1;
	for (const CutTriangle& t : cut.triangles)
		if (t.side == Side::Inside) isParent[size_t(t.parent)] = 1;
	double most = 1;
	Error steepest(ErrorCode::Grazing, "the surface is steep to the view");
	for (size_t t = 0; t < isParent.size(); ++t) {
		if (!isParent[t]) continue;
		const auto& v = sheet.triangles[t].vertex;
		const vcg::Point3d &a = sheet.vertices[size_t(v[0])].label, &b = sheet.vertices[size_t(v[1])].label,
						   &c = sheet.vertices[size_t(v[2])].label, middle = (a + b + c) / 3;
		const vcg::Point3d normal = (b - a) ^ (c - a);
		const double longest =
			std::sqrt(std::max({(b - a).SquaredNorm(), (c - b).SquaredNorm(), (a - c).SquaredNorm()}));
		if (normal.Norm() <= 2 * snap * longest) continue;  // thinner than the resolution: its normal says nothing
		const double stretch =
			space.wraps() ? StretchOver(space, sheet, sheet.triangles[t]) : StretchOf(space, middle, normal);
		if (stretch > std::max(most, limit))
			steepest.atFace(sheet.triangles[t].face).atPlace(space.toMesh(middle)).measured(stretch, limit);
		most = std::max(most, stretch);
	}
	if (steepest.hasPlace) throw steepest;
	return most;
}

/// World units squared.
inline double SurfaceArea(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut,
                          const std::vector<IndexTriangle>& inside)
{
	const auto unbent = [&](int point) {  // world units, along the axes of the frame
		const SheetPoint& p = cut.points.at(sheet, point);
		return space.wraps() ? space.inFrame(p.mesh) : p.label;
	};
	double area = 0;
	for (const IndexTriangle& t : inside) {
		const vcg::Point3d a = unbent(t[0]);
		area += ((unbent(t[1]) - a) ^ (unbent(t[2]) - a)).Norm() / 2;
	}
	return area;
}

/// Where the part is thinner than the label's cylinder, the way round is shorter, and so are the letters.
/// @pre space.wraps()
/// @throws Error{Squeezed}
inline double LeastStretch(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut,
                           const std::vector<IndexTriangle>& inside, double limit)
{
	double least = 1;
	const SheetPoint* thinnest = nullptr;
	for (const IndexTriangle& t : inside)
		for (const int point : t) {
			const SheetPoint& p = cut.points.at(sheet, point);
			const double stretch = space.distanceFromAxis(p.label[2]) / space.distanceFromAxis(0);
			if (!(stretch < least)) continue;
			least = stretch;
			thinnest = &p;
		}
	if (least < limit)
		throw Error(ErrorCode::Squeezed, "the part is thinner than where the label was measured")
			.atPlace(thinnest->mesh)
			.measured(least, limit);
	return least;
}

}  // namespace detail

inline SurfaceMeasure MeasureSurface(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double snap,
                                     const StretchLimits& limits)
{
	SurfaceMeasure measure;
	measure.stretch = detail::MostStretch(space, sheet, cut, snap, limits.most);
	const std::vector<IndexTriangle> inside = detail::InsideTriangles(sheet, cut);
	measure.area = detail::SurfaceArea(space, sheet, cut, inside);
	if (space.wraps()) measure.leastStretch = detail::LeastStretch(space, sheet, cut, inside, limits.least);
	return measure;
}

}  // namespace vcg::textlabel
