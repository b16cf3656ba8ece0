#pragma once
// Parts for the tests of automatic placement: block parts whose inside is known cell by cell, and round parts in closed form.

#include "filter_textlabel/auto_placement.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>
#include <vcg/space/point3.h>

namespace textlabel::test {

using vcg::Point3d;

/// The first places that are offered, at most so many.
inline std::vector<Place> FirstPlaces(const PlaceQuery& query, size_t most = 3)
{
	std::vector<Place> places;
	OfferPlaces(query, [&](const Place& place) {
		places.push_back(place);
		return places.size() == most;
	});
	return places;
}

struct Triangles {
	std::vector<Point3d> positions;
	std::vector<std::array<int, 3>> triangles;
};

/// A part made of unit cells: solid(x, y, z) says whether the cell with the lower corner (x, y, z) is full.
struct BlockPart {
	std::array<int, 3> size;
	std::function<bool(int, int, int)> solid;

	bool isSolid(int x, int y, int z) const
	{
		const bool inBounds = x >= 0 && y >= 0 && z >= 0 && x < size[0] && y < size[1] && z < size[2];
		return inBounds && solid(x, y, z);
	}
	bool contains(const Point3d& p) const
	{
		return isSolid(int(std::floor(p[0])), int(std::floor(p[1])), int(std::floor(p[2])));
	}
};

/// Two triangles for each cell side between full and empty, corners shared.
inline Triangles SurfaceOf(const BlockPart& part)
{
	Triangles out;
	std::map<std::array<int, 3>, int> known;
	const auto vertex = [&](const std::array<int, 3>& p) {
		const auto [at, isNew] = known.try_emplace(p, int(out.positions.size()));
		if (isNew) out.positions.emplace_back(p[0], p[1], p[2]);
		return at->second;
	};
	const auto addSide = [&](std::array<int, 3> cell, size_t axis, bool isUpper) {
		std::array<int, 3> corner = cell;
		if (isUpper) ++corner[axis];
		const size_t first = (axis + (isUpper ? 1 : 2)) % 3, second = (axis + (isUpper ? 2 : 1)) % 3;
		std::array<int, 3> a = corner, b = corner, c = corner;
		++a[first];
		++b[first];
		++b[second];
		++c[second];
		out.triangles.push_back({vertex(corner), vertex(a), vertex(b)});
		out.triangles.push_back({vertex(corner), vertex(b), vertex(c)});
	};
	for (int x = 0; x < part.size[0]; ++x)
		for (int y = 0; y < part.size[1]; ++y)
			for (int z = 0; z < part.size[2]; ++z) {
				if (!part.isSolid(x, y, z)) continue;
				for (size_t axis = 0; axis < 3; ++axis)
					for (int step : {-1, 1}) {
						std::array<int, 3> next{x, y, z};
						next[axis] += step;
						if (!part.isSolid(next[0], next[1], next[2])) addSide({x, y, z}, axis, step > 0);
					}
			}
	return out;
}

inline BlockPart Box(int x, int y, int z)
{
	return {{x, y, z}, [](int, int, int) { return true; }};
}

constexpr double fullTurn = 2 * 3.14159265358979323846;

/// A grid that is closed in u and goes from v = 0 to v = 1: point(u, v), the outside where u x v points to.
inline Triangles RoundGrid(int rows, int columns, const std::function<Point3d(double, double)>& point)
{
	Triangles out;
	for (int i = 0; i < rows; ++i)
		for (int j = 0; j <= columns; ++j) out.positions.push_back(point(double(i) / rows, double(j) / columns));
	for (int i = 0; i < rows; ++i)
		for (int j = 0; j < columns; ++j) {
			const int here = i * (columns + 1) + j, next = (i + 1) % rows * (columns + 1) + j;
			out.triangles.push_back({here, next, next + 1});
			out.triangles.push_back({here, next + 1, here + 1});
		}
	return out;
}

/// A torus about Z.
inline Triangles Torus(double ring, double tube)
{
	return RoundGrid(96, 48, [=](double u, double v) {
		const double out = ring + tube * std::cos(fullTurn * v);
		return Point3d(out * std::cos(fullTurn * u), out * std::sin(fullTurn * u), tube * std::sin(fullTurn * v));
	});
}

inline Triangles Sphere(double radius)
{
	return RoundGrid(96, 96, [=](double u, double v) {
		const double longitude = fullTurn * u, latitude = fullTurn * (v - 0.5) / 2;
		const double out = radius * std::cos(latitude);
		return Point3d(out * std::cos(longitude), out * std::sin(longitude), radius * std::sin(latitude));
	});
}

}  // namespace textlabel::test
