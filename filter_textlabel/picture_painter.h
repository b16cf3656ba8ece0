#pragma once
// Light: what colour a pixel of a view gets, from the mesh's faces, their normals and the two depth buffers.

#include "picture_raster.h"
#include "picture_surface.h"
#include "vcg_ext/parallel_chunks.h"

#include <cmath>
#include <thread>

namespace textlabel::detail {

using vcg::Point3d;

inline double ToLinear(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4); }
inline double ToSrgb(double linear)
{
	return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}
inline Point3d ToLinear(const PictureColor& c)
{
	static const std::array<double, 256> table = [] {
		std::array<double, 256> t{};
		for (size_t i = 0; i < t.size(); i++) t[i] = ToLinear(double(i) / 255);
		return t;
	}();
	return {table[c[0]], table[c[1]], table[c[2]]};
}

/// Directions that spread evenly however many of them are taken from the first on: multiples of the golden angle.
inline std::vector<std::array<double, 2>> SpreadDirections(int count)
{
	constexpr double goldenAngle = 2.39996322972865332;  // radians
	std::vector<std::array<double, 2>> directions;
	for (int i = 0; i < count; i++) directions.push_back({std::cos(goldenAngle * i), std::sin(goldenAngle * i)});
	return directions;
}

/// Rows are independent of each other, so the pixels do not depend on the number of threads.
template <class Draw>
void ForEachRow(int rows, const Draw& draw)
{
	const size_t chunks = std::clamp<size_t>(std::thread::hardware_concurrency(), 1, vcg::textlabel::kMostChunks);
	vcg::textlabel::EachChunk(size_t(rows), chunks, [&](size_t, size_t first, size_t last) {
		for (size_t row = first; row < last; ++row) draw(int(row));
	});
}

/// A part of the picture that shows one view.
struct Panel {
	int x = 0, y = 0, width = 0, height = 0;
};

/// Draws one view. A light's buffer, filled as if the light were a viewer, tells what lies in the shadow.
class PanelPainter {
public:
	PanelPainter(const PictureMesh& m, const PictureSurface& s, const PictureView& view, const PictureOptions& o,
	             Panel p)
		: mesh(m), surface(s), options(o), panel(p),
		  camera(MakeCamera(view, p.width * o.samples, p.height * o.samples)), projected(ProjectAll(m, camera)),
		  seen(ScanMesh(m, projected, p.width * o.samples, p.height * o.samples)), depths(middleDepths()),
		  spread(SpreadDirections(std::max(sightProbes, lightProbes))), extent(view.extent),
		  lightCamera(makeLightCamera(view)), lit(1, 1)
	{
		const int side = lightMapSide;
		if (options.shaded && options.shadows) lit = ScanMesh(m, ProjectAll(m, lightCamera), side, side);
	}

	void paint(Picture& picture) const
	{
		ForEachRow(panel.height, [&](int y) {
			std::vector<Shaded> scratch;
			for (int x = 0; x < panel.width; x++) {
				const Point3d linear = pixel(x, y, scratch);
				const size_t at = 3 * (size_t(panel.y + y) * size_t(picture.width) + size_t(panel.x + x));
				for (int c = 0; c < 3; c++)
					picture.rgb[at + size_t(c)] =
						std::uint8_t(std::lround(255 * std::clamp(ToSrgb(linear[c]), 0.0, 1.0)));
			}
		});
	}

private:
	static constexpr int lightMapSide = 2048;
	static constexpr int sightProbes = 24;
	static constexpr int lightProbes = 12;

	struct Sample {
		int face;
		int x, y;  // grid point
		double depth, magnification;
		Point3d weights;  // barycentric, in the mesh
		Point3d normal;   // camera coordinates, towards the viewer
	};
	struct Shaded {
		int face;
		Point3d color;
	};

	/// Light is computed once for each face that a pixel shows, its edges at each sample.
	Point3d pixel(int px, int py, std::vector<Shaded>& shaded) const
	{
		shaded.clear();
		Point3d sum(0, 0, 0);
		const double t = (py + 0.5) / panel.height;
		const Point3d background = ToLinear(options.backgroundTop) * (1 - t) + ToLinear(options.backgroundBottom) * t;
		for (int number = 0; number < options.samples * options.samples; number++) {
			const int x = px * options.samples + number % options.samples;
			const int y = py * options.samples + number / options.samples;
			const int face = seen.face[seen.index(x, y)];
			const auto sameFace = [&](const Shaded& s) { return s.face == face; };
			auto found = std::find_if(shaded.begin(), shaded.end(), sameFace);
			if (found == shaded.end())
				found = shaded.insert(found, {face, face < 0 ? background : shade(sampleAt(face, x, y))});
			sum += found->color * (face < 0 ? 1 : line(face, x, y));
		}
		return sum / (options.samples * options.samples);
	}

	/// Barycentric coordinates of a grid point in the picture of a face.
	Point3d weightsAt(int face, int x, int y) const
	{
		const auto& t = mesh.triangles[size_t(face)];
		const Point3d &a = projected[size_t(t[0])], &b = projected[size_t(t[1])], &c = projected[size_t(t[2])];
		const double gx = x + 0.5, gy = y + 0.5;
		const double area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
		if (area == 0) return {1, 0, 0};
		const double u = ((gx - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (gy - a[1])) / area;
		const double v = ((b[0] - a[0]) * (gy - a[1]) - (gx - a[0]) * (b[1] - a[1])) / area;
		const double inU = std::clamp(u, 0.0, 1.0), inV = std::clamp(v, 0.0, 1 - inU);
		return {1 - inU - inV, inU, inV};
	}

	Sample sampleAt(int face, int x, int y) const
	{
		Sample s{face, x, y, 0, 1, weightsAt(face, x, y), {}};
		const auto& t = mesh.triangles[size_t(face)];
		for (int k = 0; k < 3; k++) s.weights[k] *= camera.magnification(projected[size_t(t[size_t(k)])][2]);
		s.weights /= s.weights[0] + s.weights[1] + s.weights[2];
		const double zPrime = seen.depth[seen.index(x, y)];
		s.depth = camera.depth(zPrime);
		s.magnification = camera.magnification(zPrime);
		Point3d n(0, 0, 0);
		for (int k = 0; k < 3; k++) n += Point3d::Construct(surface.cornerNormals[size_t(3 * face + k)]) * s.weights[k];
		s.normal = camera.turn(n).Normalize();
		const bool back = camera.turn(surface.faceNormals[size_t(face)]) * toViewer(s) < 0;
		if (back) s.normal = -s.normal;
		return s;
	}

	/// From the surface to the eye, camera coordinates, not of unit length.
	Point3d toViewer(const Sample& s) const
	{
		if (camera.distance <= 0) return {0, 0, 1};
		const double unit = camera.scale * s.magnification;
		return {-(s.x + 0.5 - camera.centerX) / unit, (s.y + 0.5 - camera.centerY) / unit, camera.distance - s.depth};
	}

	Point3d shade(const Sample& s) const
	{
		const size_t face = size_t(s.face);
		const bool label = !mesh.isLabel.empty() && mesh.isLabel[face];
		const Point3d base = ToLinear(!mesh.colors.empty() ? mesh.colors[face] : label ? options.label : options.part);
		if (!options.shaded) return base;
		const Point3d key = keyLight(), fill = Point3d(0.85, 0.05, 0.5).Normalize();
		const Point3d half = (key + Point3d(toViewer(s)).Normalize()).Normalize();
		const double open = openness(s), light = sunlight(s);
		const double sky = 0.5 + 0.5 * s.normal[1];
		const double shine = 0.78 * (0.35 + 0.65 * light);  // what lies in the shadow can still be read
		const double diffuse =
			open * (0.20 + 0.24 * sky + 0.26 * std::max(0.0, s.normal * fill)) + shine * std::max(0.0, s.normal * key);
		const double gloss = 0.10 * light * std::pow(std::max(0.0, s.normal * half), 30.0);
		return base * diffuse + Point3d(gloss, gloss, gloss);
	}

	/// Camera coordinates: from the upper left.
	static Point3d keyLight() { return Point3d(-0.50, 0.62, 0.80).Normalize(); }

	/// What a drawn edge leaves of the light at a grid point: 1 away from edges.
	double line(int face, int x, int y) const
	{
		if (options.edges == PictureEdges::None) return 1;
		const auto& t = mesh.triangles[size_t(face)];
		const Point3d here(x + 0.5, y + 0.5, 0);
		double left = 1;
		for (size_t k = 0; k < 3; k++) {
			const EdgeKind kind = surface.edges[3 * size_t(face) + k];
			const bool crease = kind == EdgeKind::Crease;
			if (!crease && options.edges != PictureEdges::All) continue;
			const Point3d &a = projected[size_t(t[k])], &b = projected[size_t(t[(k + 1) % 3])];
			const double width = (crease ? 0.7 : 0.4) * options.samples;  // on this side of the edge
			if (FlatDistance(here, a, b) >= width) continue;
			if (crease) return 0.30;
			const double height = FlatDistance(projected[size_t(t[(k + 2) % 3])], a, b) / options.samples;
			left = std::min(left, 1 - 0.55 * std::clamp(height / 8, 0.1, 1.0));  // fine triangles must not turn to ink
		}
		return left;
	}

	/// Distance from p to the segment ab, on the grid.
	static double FlatDistance(const Point3d& p, const Point3d& a, const Point3d& b)
	{
		const double x = b[0] - a[0], y = b[1] - a[1], px = p[0] - a[0], py = p[1] - a[1];
		const double length = x * x + y * y;
		const double t = length > 0 ? std::clamp((px * x + py * y) / length, 0.0, 1.0) : 0;
		return std::sqrt((px - t * x) * (px - t * x) + (py - t * y) * (py - t * y));
	}

	/// Depth at the middle of each pixel, -infinity for the background: a small map is probed much faster than all samples.
	std::vector<float> middleDepths() const
	{
		std::vector<float> map;
		map.reserve(size_t(panel.width) * size_t(panel.height));
		const int middle = options.samples / 2;
		for (int y = 0; y < panel.height; y++)
			for (int x = 0; x < panel.width; x++) {
				const size_t i = seen.index(x * options.samples + middle, y * options.samples + middle);
				map.push_back(seen.face[i] < 0 ? seen.depth[i] : float(camera.depth(seen.depth[i])));
			}
		return map;
	}

	/// How much of the sky a point sees: probes into the depths around it.
	double openness(const Sample& s) const
	{
		const double radius = 0.055 * extent, pixel = options.samples / (camera.scale * s.magnification);
		const double px = (s.x + 0.5) / options.samples, py = (s.y + 0.5) / options.samples;
		double hidden = 0;
		for (int i = 0; i < sightProbes; i++) {
			const double r = radius / pixel * (i + 0.5) / sightProbes;
			const auto& way = spread[size_t(i)];
			const int x = int(std::floor(px + r * way[0])), y = int(std::floor(py - r * way[1]));
			if (x < 0 || y < 0 || x >= panel.width || y >= panel.height || (x == int(px) && y == int(py))) continue;
			const float depth = depths[size_t(y) * size_t(panel.width) + size_t(x)];
			if (std::isinf(depth)) continue;
			const Point3d there((x + 0.5 - px) * pixel, (py - y - 0.5) * pixel, depth - s.depth);
			const double along = s.normal * there;
			if (along <= 0) continue;
			const double distance = there.Norm();
			hidden += std::max(0.0, along / distance - 0.06) * std::max(0.0, 1 - distance / (1.5 * radius));
		}
		return std::max(0.15, 1 - 2.8 * hidden / sightProbes);
	}

	PictureView lightView(const PictureView& view) const
	{
		const Point3d key = keyLight();
		PictureView light;
		light.direction = camera.right * key[0] + camera.up * key[1] + camera.direction * key[2];
		light.up = camera.direction;
		light.focus = view.focus;
		light.extent = 1.3 * view.extent * std::hypot(1.0, double(panel.width) / panel.height);
		return light;
	}
	Camera makeLightCamera(const PictureView& view) const
	{
		return MakeCamera(lightView(view), lightMapSide, lightMapSide);
	}

	/// Share of the key light that reaches a point, 0 to 1, soft at the shadow's border.
	double sunlight(const Sample& s) const
	{
		if (!options.shadows || s.normal * keyLight() <= 0) return options.shadows ? 0 : 1;
		const auto& t = mesh.triangles[size_t(s.face)];
		Point3d p(0, 0, 0);
		for (int k = 0; k < 3; k++) p += mesh.positions[size_t(t[size_t(k)])] * s.weights[k];
		const double texel = 1 / lightCamera.scale;
		const Point3d n = camera.right * s.normal[0] + camera.up * s.normal[1] + camera.direction * s.normal[2];
		const Point3d q = lightCamera.project(p + n * (2.5 * texel));
		const double radius = 0.006 * extent / texel;
		double open = 0;
		for (int i = 0; i < lightProbes; i++) {
			const double r = radius * std::sqrt((i + 0.5) / lightProbes);
			const auto& way = spread[size_t(i)];
			const int x = int(std::floor(q[0] + r * way[0])), y = int(std::floor(q[1] + r * way[1]));
			const bool outside = x < 0 || y < 0 || x >= lit.width || y >= lit.height;
			if (outside || lit.depth[lit.index(x, y)] <= q[2] + (r + 1) * texel) open++;
		}
		return open / lightProbes;
	}

	const PictureMesh& mesh;
	const PictureSurface& surface;
	const PictureOptions& options;
	Panel panel;
	Camera camera;
	std::vector<Point3d> projected;
	DepthBuffer seen;
	std::vector<float> depths;
	std::vector<std::array<double, 2>> spread;
	double extent;
	Camera lightCamera;
	DepthBuffer lit;
};

}  // namespace textlabel::detail
