#pragma once
// Points of the label plane on the surface: where the line of sight through them meets a triangle, and how steeply.

#include "sheet.h"

namespace vcg::textlabel {

/// Perspective-correct weights of a triangle's corners for a point of the label plane.
/// @return weights in space, summing to 1; negative outside the triangle
inline vcg::Point3d SpaceWeights(const LabelSpace& space, const Sheet& sheet, int triangle, const vcg::Point2d& p)
{
	const auto& v = sheet.triangles[size_t(triangle)].vertex;
	vcg::Point3d weight;
	for (int k = 0; k < 3; ++k) {
		const vcg::Point2d a = sheet.plane(v[size_t((k + 1) % 3)]) - p, b = sheet.plane(v[size_t((k + 2) % 3)]) - p;
		weight[k] = (a ^ b) * space.magnification(sheet.vertices[size_t(v[size_t(k)])].label);
	}
	return weight / (weight[0] + weight[1] + weight[2]);
}

/// Mix a triangle's corners.
/// @return label space
inline vcg::Point3d MixCorners(const Sheet& sheet, int triangle, const vcg::Point3d& weight)
{
	vcg::Point3d q(0, 0, 0);
	for (int k = 0; k < 3; ++k)
		q += sheet.vertices[size_t(sheet.triangles[size_t(triangle)].vertex[size_t(k)])].label * weight[k];
	return q;
}

/// Where a point of the label plane is seen on a triangle, or on its plane beside it.
/// @return label space
inline vcg::Point3d PointOnTriangle(const LabelSpace& space, const Sheet& sheet, int triangle, const vcg::Point2d& p)
{
	return MixCorners(sheet, triangle, SpaceWeights(space, sheet, triangle, p));
}

/// Where a point of the label plane is seen first on the candidates; on the label plane itself where none lies under it.
/// @return mesh coordinates
inline vcg::Point3d SeenAt(const LabelSpace& space, const Sheet& sheet, const vcg::Point2d& p)
{
	vcg::Point3d seen(p[0], p[1], 0);
	double nearest = -std::numeric_limits<double>::infinity();
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		if (!sheet.triangles[size_t(t)].facing) continue;
		const vcg::Point3d w = SpaceWeights(space, sheet, t, p);
		if (!(std::min({w[0], w[1], w[2]}) >= 0)) continue;
		const vcg::Point3d q = MixCorners(sheet, t, w);
		if (!(q[2] > nearest)) continue;
		nearest = q[2];
		seen = q;
	}
	return space.toMesh(seen);
}

namespace detail {

/// The largest singular value of the map that takes the label plane's axes to u and v.
inline double LargestStretch(const vcg::Point3d& u, const vcg::Point3d& v)
{
	const double mean = (u * u + v * v) / 2, half = (u * u - v * v) / 2;
	return std::sqrt(mean + std::hypot(half, u * v));
}

}  // namespace detail

/// How many times as long as in the label plane a length can be on the surface: the largest singular value of the projection back.
/// @param[in] at  label space
/// @param[in] normal  of the surface there, any length
inline double StretchOf(const LabelSpace& space, const vcg::Point3d& at, const vcg::Point3d& normal)
{
	const vcg::Point3d towards = space.towardsViewer(at);
	const double cosine = normal * towards;
	if (!(cosine > 0)) return std::numeric_limits<double>::infinity();
	// a step along u or v in the label plane, scaled to this depth and carried along the ray to the surface
	const vcg::Point3d u = vcg::Point3d(1, 0, 0) - towards * (normal[0] / cosine),
					   v = vcg::Point3d(0, 1, 0) - towards * (normal[1] / cosine);
	return detail::LargestStretch(u, v) / space.magnification(at);
}

/// The same of a wrapped label, over a triangle: unrolled, it is as wide as its corners are far round the axis.
inline double StretchOver(const LabelSpace& space, const Sheet& sheet, const SheetTriangle& t)
{
	const auto vertex = [&](size_t k) -> const SheetVertex& { return sheet.vertices[size_t(t.vertex[k])]; };
	const vcg::Point3d a = space.inFrame(vertex(0).mesh), b = space.inFrame(vertex(1).mesh) - a,
					   c = space.inFrame(vertex(2).mesh) - a;
	const vcg::Point2d p = vertex(1).plane - vertex(0).plane, q = vertex(2).plane - vertex(0).plane;
	const double area = p ^ q;
	if (!(area > 0)) return std::numeric_limits<double>::infinity();
	return detail::LargestStretch((b * q[1] - c * p[1]) / area, (c * p[0] - b * q[0]) / area);
}

}  // namespace vcg::textlabel
