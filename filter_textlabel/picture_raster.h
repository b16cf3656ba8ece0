#pragma once
// From a mesh to the face that is seen at each point of a grid: camera, scan conversion, depth buffer.
//
// Corners are rounded to 1/256 of a grid step and all tests of coverage are exact in integers, so neighbouring faces leave no gap
// between them and the result does not depend on the compiler.

#include "picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace textlabel::detail {

/// Mesh coordinates to grid coordinates. The perspective is z' = z s with s = distance / (distance - z): it keeps straight lines
/// and planes, so z' may be interpolated linearly over the grid.
struct Camera {
	vcg::Point3d right, up, direction, focus;
	double scale = 1;     ///< grid steps per mesh unit at the focus
	double distance = 0;  ///< 0 = parallel
	double centerX = 0, centerY = 0;

	/// x to the right, y upwards, z towards the viewer, from the focus; mesh units
	vcg::Point3d turn(const vcg::Point3d& v) const { return {v * right, v * up, v * direction}; }
	/// Grid coordinates (x to the right, y down) and z'; NaN beside or behind the camera.
	vcg::Point3d project(const vcg::Point3d& p) const
	{
		constexpr double nearest = 0.95;  // of the way from the focus to the camera
		const vcg::Point3d q = turn(p - focus);
		if (distance > 0 && q[2] > nearest * distance) {
			const double nan = std::numeric_limits<double>::quiet_NaN();
			return {nan, nan, nan};
		}
		const double s = distance > 0 ? distance / (distance - q[2]) : 1;
		return {centerX + q[0] * s * scale, centerY - q[1] * s * scale, q[2] * s};
	}
	/// The perspective's magnification where z' is known.
	double magnification(double zPrime) const { return distance > 0 ? 1 + zPrime / distance : 1; }
	double depth(double zPrime) const { return zPrime / magnification(zPrime); }
};

inline Camera MakeCamera(const PictureView& view, int gridWidth, int gridHeight)
{
	Camera camera;
	camera.direction = vcg::Point3d(view.direction).Normalize();
	camera.right = (view.up ^ camera.direction).Normalize();
	camera.up = camera.direction ^ camera.right;
	camera.focus = view.focus;
	camera.distance = view.distance;
	camera.scale = gridHeight / view.extent;
	camera.centerX = gridWidth / 2.0;
	camera.centerY = gridHeight / 2.0;
	return camera;
}

/// What is seen at each grid point.
struct DepthBuffer {
	int width = 0, height = 0;
	std::vector<float> depth;  ///< z' of the nearest surface
	std::vector<int> face;     ///< its face, -1 = background

	DepthBuffer(int w, int h)
		: width(w), height(h), depth(size_t(w) * size_t(h), -std::numeric_limits<float>::infinity()),
		  face(size_t(w) * size_t(h), -1)
	{}
	size_t index(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
};

/// The grid points of one row that lie on the inner side of an edge: a x + c >= 0 narrows [first, last].
inline void NarrowSpan(std::int64_t a, std::int64_t c, std::int64_t& first, std::int64_t& last)
{
	const auto floorDiv = [](std::int64_t n, std::int64_t d) { return n / d - (n % d < 0 ? 1 : 0); };  // d > 0
	if (a > 0) first = std::max(first, -floorDiv(c, a));
	else if (a < 0) last = std::min(last, floorDiv(c, -a));
	else if (c < 0) last = first - 1;
}

/// Grid steps: keeps the products of ScanFace within 64 bits.
constexpr double kFarthestScanned = 1e6;

inline bool IsWithin(const std::array<vcg::Point3d, 3>& corner, double reach)
{
	return std::all_of(corner.begin(), corner.end(),
	                   [reach](const vcg::Point3d& p) { return std::abs(p[0]) < reach && std::abs(p[1]) < reach; });
}

/// What of a face has grid coordinates up to `reach`: a convex polygon.
inline std::vector<vcg::Point3d> Clipped(const std::array<vcg::Point3d, 3>& corner, double reach)
{
	std::vector<vcg::Point3d> polygon(corner.begin(), corner.end());
	for (int axis = 0; axis < 2; axis++)
		for (const double sign : {-1.0, 1.0}) {
			std::vector<vcg::Point3d> kept;
			for (size_t i = 0; i < polygon.size(); i++) {
				const vcg::Point3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
				const bool isIn = sign * p[axis] <= reach, isNextIn = sign * q[axis] <= reach;
				if (isIn) kept.push_back(p);
				if (isIn == isNextIn) continue;
				// from within outwards, whichever way the face runs: its neighbour gets the same point
				const vcg::Point3d &in = isIn ? p : q, &out = isIn ? q : p;
				kept.push_back(in + (out - in) * ((sign * reach - in[axis]) / (out[axis] - in[axis])));
			}
			polygon = std::move(kept);
		}
	return polygon;
}

/// Scan-convert one face. Points on its edges belong to it; the face that came first keeps what it ties.
/// @param[in] corner  projected corners, up to kFarthestScanned: grid coordinates and z'
inline void ScanFace(DepthBuffer& buffer, int face, const std::array<vcg::Point3d, 3>& corner)
{
	constexpr std::int64_t one = 256;
	std::array<std::int64_t, 3> x{}, y{};
	for (size_t k = 0; k < 3; k++) {
		x[k] = std::llround(corner[k][0] * one) - one / 2;  // grid points lie in the middle of their cells
		y[k] = std::llround(corner[k][1] * one) - one / 2;
	}
	const std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
	if (area == 0) return;
	const double dx1 = double(x[1] - x[0]), dx2 = double(x[2] - x[0]), dy1 = double(y[1] - y[0]),
				 dy2 = double(y[2] - y[0]);
	const double dz1 = corner[1][2] - corner[0][2], dz2 = corner[2][2] - corner[0][2];
	const double slopeX = (dz1 * dy2 - dz2 * dy1) / double(area), slopeY = (dz2 * dx1 - dz1 * dx2) / double(area);
	const auto [yLow, yHigh] = std::minmax({y[0], y[1], y[2]});
	const std::int64_t top = std::max<std::int64_t>(0, (yLow + one - 1) >> 8);
	const std::int64_t bottom = std::min<std::int64_t>(buffer.height - 1, yHigh >> 8);
	for (std::int64_t row = top; row <= bottom; row++) {
		std::int64_t first = 0, last = buffer.width - 1;
		for (size_t k = 0; k < 3; k++) {
			const size_t n = (k + 1) % 3;
			const std::int64_t sign = area > 0 ? 1 : -1, ex = x[n] - x[k], ey = y[n] - y[k];
			NarrowSpan(-sign * ey * one, sign * (ex * (row * one - y[k]) + ey * x[k]), first, last);
		}
		const double z = corner[0][2] + slopeY * double(row * one - y[0]) - slopeX * double(x[0]);
		for (std::int64_t column = first; column <= last; column++) {
			const size_t i = buffer.index(int(column), int(row));
			const float depth = float(z + slopeX * double(column * one));
			if (depth <= buffer.depth[i]) continue;
			buffer.depth[i] = depth;
			buffer.face[i] = face;
		}
	}
}

/// Project all corners; faces with a corner that is not finite, or not before the camera, are left out by ScanMesh.
inline std::vector<vcg::Point3d> ProjectAll(const PictureMesh& mesh, const Camera& camera)
{
	std::vector<vcg::Point3d> projected;
	projected.reserve(mesh.positions.size());
	for (const vcg::Point3d& p : mesh.positions) projected.push_back(camera.project(p));
	return projected;
}

inline DepthBuffer ScanMesh(const PictureMesh& mesh, const std::vector<vcg::Point3d>& projected, int width, int height)
{
	DepthBuffer buffer(width, height);
	for (size_t f = 0; f < mesh.triangles.size(); f++) {
		constexpr double farthest = 1e15;  // beyond it a double does not tell one grid point from the next
		const auto& t = mesh.triangles[f];
		const std::array<vcg::Point3d, 3> corner{projected[size_t(t[0])], projected[size_t(t[1])],
		                                         projected[size_t(t[2])]};
		if (IsWithin(corner, kFarthestScanned)) {
			ScanFace(buffer, int(f), corner);
		} else if (IsWithin(corner, farthest)) {
			const std::vector<vcg::Point3d> polygon = Clipped(corner, kFarthestScanned / 2);
			for (size_t i = 2; i < polygon.size(); i++)
				ScanFace(buffer, int(f), {polygon[0], polygon[i - 1], polygon[i]});
		}
	}
	return buffer;
}

}  // namespace textlabel::detail
