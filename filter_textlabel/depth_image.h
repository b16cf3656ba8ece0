#pragma once
// A part seen in parallel projection as a grid of depths: for each pixel the face that the viewer sees there and how near it is.

#include "placement_part.h"
#include <algorithm>
#include <limits>

namespace textlabel {

/// Where the pixels lie in the plane of a look: pixel (x, y) has its centre at (left + x*pixel, bottom + y*pixel).
struct PixelGrid {
	double left = 0, bottom = 0;  ///< mesh units along right and up, from the part's centre
	double pixel = 1;             ///< side of a pixel, mesh units
	int width = 0, height = 0;

	size_t at(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
};

/// What is seen: depth along `towards` (larger is nearer), and the face; where nothing is, face = -1.
struct DepthImage {
	static constexpr double nothing = -std::numeric_limits<double>::infinity();
	ViewAxes axes;
	PixelGrid grid;
	std::vector<double> depth;
	std::vector<int> face;
};

namespace detail {

constexpr double edgeOn = 1e-9;     // tangent of the angle to the look below which a face has no front
constexpr double edgeReach = 1e-6;  // pixels; a pixel centre on a shared edge must not fall between two triangles

/// Corners of the part in pixels and depth.
inline std::vector<vcg::Point3d> Projected(const Part& part, const ViewAxes& axes, const PixelGrid& grid)
{
	std::vector<vcg::Point3d> out;
	out.reserve(part.points.size());
	for (const vcg::Point3d& p : part.points)
		out.emplace_back((p * axes.right - grid.left) / grid.pixel, (p * axes.up - grid.bottom) / grid.pixel,
		                 p * axes.towards);
	return out;
}

/// An edge in the image, from its lower to its higher end: the same line for the triangles on both its sides.
struct ImageEdge {
	double lowY, highY, lowX, slope;  ///< slope: x per y
	double x(double y) const { return lowX + slope * (y - lowY); }
};

inline ImageEdge MakeEdge(const vcg::Point3d& a, const vcg::Point3d& b)
{
	const bool swapped = b[1] < a[1] || (b[1] == a[1] && b[0] < a[0]);
	const vcg::Point3d &low = swapped ? b : a, &high = swapped ? a : b;
	return {low[1], high[1], low[0], high[1] > low[1] ? (high[0] - low[0]) / (high[1] - low[1]) : 0};
}

/// Call visit(x, y, depth) for each pixel centre of a width x height grid that the triangle a, b, c covers, row by row,
/// border included; a triangle seen edge-on covers nothing.
template <class Visit>
void CoverRows(int width, int height, const vcg::Point3d& a, const vcg::Point3d& b, const vcg::Point3d& c,
               Visit&& visit)
{
	const int lowY = int(std::ceil(std::max(0.0, std::min({a[1], b[1], c[1]}))));
	const int highY = int(std::floor(std::min(height - 1.0, std::max({a[1], b[1], c[1]}))));
	if (lowY > highY) return;
	const vcg::Point3d normal = (b - a) ^ (c - a);
	if (std::abs(normal[2]) <= edgeOn * (std::abs(normal[0]) + std::abs(normal[1]))) return;
	const double slopeX = -normal[0] / normal[2], slopeY = -normal[1] / normal[2];
	const ImageEdge edges[] = {MakeEdge(a, b), MakeEdge(b, c), MakeEdge(c, a)};
	for (int y = lowY; y <= highY; ++y) {
		double left = width, right = -1;
		for (const ImageEdge& edge : edges) {
			if (y < edge.lowY || y > edge.highY || edge.lowY == edge.highY) continue;
			left = std::min(left, edge.x(y) - edgeReach);
			right = std::max(right, edge.x(y) + edgeReach);
		}
		const int last = int(std::floor(std::min(width - 1.0, right)));
		for (int x = int(std::ceil(std::max(0.0, left))); x <= last; ++x)
			visit(x, y, a[2] + slopeX * (x - a[0]) + slopeY * (y - a[1]));
	}
}

/// Call visit(pixel index, depth) for each pixel centre that the triangle a, b, c covers, border included. An upright
/// triangle goes column by column: a needle then costs little, however it lies.
template <class Visit>
void CoverTriangle(const PixelGrid& grid, const vcg::Point3d& a, const vcg::Point3d& b, const vcg::Point3d& c,
                   Visit&& visit)
{
	const double left = std::min({a[0], b[0], c[0]}), right = std::max({a[0], b[0], c[0]});
	const double bottom = std::min({a[1], b[1], c[1]}), top = std::max({a[1], b[1], c[1]});
	if (!(right >= 0 && top >= 0 && left <= grid.width - 1 && bottom <= grid.height - 1)) return;
	if (right - left > top - bottom) {
		CoverRows(grid.width, grid.height, a, b, c, [&](int x, int y, double depth) { visit(grid.at(x, y), depth); });
		return;
	}
	const auto turned = [](const vcg::Point3d& p) { return vcg::Point3d(p[1], p[0], p[2]); };
	CoverRows(grid.height, grid.width, turned(a), turned(b), turned(c),
	          [&](int y, int x, double depth) { visit(grid.at(x, y), depth); });
}

}  // namespace detail

/// Pixels for the whole part: about `pixelCount` of them in the shape of its silhouette's box, with one more all round.
/// The counts are odd, so that the middle of a symmetric part is the centre of a pixel.
inline PixelGrid GridOverPart(const Part& part, const ViewAxes& axes, double pixelCount, double maxSide)
{
	double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
	for (const vcg::Point3d& p : part.points) {
		const double at[2] = {p * axes.right, p * axes.up};
		for (int i = 0; i < 2; ++i) {
			low[i] = std::min(low[i], at[i]);
			high[i] = std::max(high[i], at[i]);
		}
	}
	const double width = high[0] - low[0], height = high[1] - low[1];
	PixelGrid grid;
	grid.pixel = std::max(std::sqrt(width * height / pixelCount), std::max(width, height) / maxSide);
	grid.width = 2 * int(std::ceil(width / grid.pixel / 2)) + 3;
	grid.height = 2 * int(std::ceil(height / grid.pixel / 2)) + 3;
	grid.left = (low[0] + high[0]) / 2 - grid.pixel * (grid.width / 2);
	grid.bottom = (low[1] + high[1]) / 2 - grid.pixel * (grid.height / 2);
	return grid;
}

/// Look at the part: the nearest face for each pixel, whichever of its sides it shows.
/// @post deterministic: of two faces at the same depth the one of smaller index is seen
inline DepthImage Look(const Part& part, const ViewAxes& axes, const PixelGrid& grid)
{
	DepthImage image{axes, grid, {}, {}};
	const size_t count = size_t(grid.width) * size_t(grid.height);
	image.depth.assign(count, DepthImage::nothing);
	image.face.assign(count, -1);
	const std::vector<vcg::Point3d> corners = detail::Projected(part, axes, grid);
	for (size_t f = 0; f < part.faces.size(); ++f) {
		const std::array<int, 3>& face = part.faces[f];
		detail::CoverTriangle(grid, corners[size_t(face[0])], corners[size_t(face[1])], corners[size_t(face[2])],
		                      [&](size_t at, double depth) {
								  if (!(depth > image.depth[at])) return;
								  image.depth[at] = depth;
								  image.face[at] = int(f);
							  });
	}
	return image;
}

/// How far one can go in from what is seen until the next face, at the thinnest pixel; infinite when there is none.
/// @param[in] apart  faces nearer than this behind the seen one are the same surface (mesh units)
inline double ThinnestWall(const Part& part, const DepthImage& seen, double apart)
{
	double thinnest = std::numeric_limits<double>::infinity();
	const std::vector<vcg::Point3d> corners = detail::Projected(part, seen.axes, seen.grid);
	for (const std::array<int, 3>& face : part.faces)
		detail::CoverTriangle(seen.grid, corners[size_t(face[0])], corners[size_t(face[1])], corners[size_t(face[2])],
		                      [&](size_t at, double depth) {
								  const double behind = seen.depth[at] - depth;
								  if (behind > apart) thinnest = std::min(thinnest, behind);
							  });
	return thinnest;
}

}  // namespace textlabel
