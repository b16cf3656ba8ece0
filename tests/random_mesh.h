#pragma once
// Random and adversarial meshes for the fuzzers, as positions and faces.

#include "random_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace vcg::textlabel::test {

/// A coordinate as float32 holds it. By way of memory: GCC 12 drops the rounding from a vectorised double(float(x)).
inline double ToFloat32(double x)
{
	volatile float stored = float(x);
	return double(stored);
}

/// An indexed triangle mesh. Faces counter-clockwise from outside.
struct Soup {
	std::vector<vcg::Point3d> vertices;     ///< #V by 3
	std::vector<std::array<int, 3>> faces;  ///< #F by 3

	int add(const vcg::Point3d& p)
	{
		vertices.push_back(p);
		return int(vertices.size()) - 1;
	}
	void addQuad(int a, int b, int c, int d, bool otherDiagonal)
	{
		if (otherDiagonal) {
			faces.push_back({a, b, d});
			faces.push_back({b, c, d});
		} else {
			faces.push_back({a, b, c});
			faces.push_back({a, c, d});
		}
	}
	vcg::Point3d normal(int f) const
	{
		const auto& t = faces[size_t(f)];
		const vcg::Point3d& a = vertices[size_t(t[0])];
		return (vertices[size_t(t[1])] - a) ^ (vertices[size_t(t[2])] - a);
	}
};

/// How the quads of a grid are halved.
enum class Diagonals { One, Other, Alternating, Random };

inline bool IsOtherDiagonal(Diagonals kind, int i, int j, Random& random)
{
	switch (kind) {
	case Diagonals::One: return false;
	case Diagonals::Other: return true;
	case Diagonals::Alternating: return (i + j) % 2 != 0;
	default: return random.chance(0.5);
	}
}

/// A grid of quads over two parameters, points shared where a direction is closed.
/// @param[in] at  (i, j) to the index of the vertex there
inline void AddGrid(Soup& soup, int nu, int nv, Diagonals kind, Random& random, const std::function<int(int, int)>& at)
{
	for (int i = 0; i < nu; ++i)
		for (int j = 0; j < nv; ++j)
			soup.addQuad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), IsOtherDiagonal(kind, i, j, random));
}

/// A closed slab of nx by ny cells of the given size: a top with heights, a flat bottom, sides of one quad for
/// each cell.
inline Soup MakeSlab(int nx, int ny, double cell, double thickness, Diagonals kind, Random& random,
                     const std::function<double(int, int)>& heightAt)
{
	Soup s;
	const auto x = [&](int i) { return (i - nx / 2) * cell; };
	const auto y = [&](int j) { return (j - ny / 2) * cell; };
	for (int j = 0; j <= ny; ++j)
		for (int i = 0; i <= nx; ++i) s.add({x(i), y(j), heightAt(i, j)});
	const int under = int(s.vertices.size());
	for (int j = 0; j <= ny; ++j)
		for (int i = 0; i <= nx; ++i) s.add({x(i), y(j), -thickness});
	const auto top = [&](int i, int j) { return j * (nx + 1) + i; };
	const auto bottom = [&](int i, int j) { return under + top(i, j); };
	AddGrid(s, nx, ny, kind, random, top);
	AddGrid(s, ny, nx, kind, random, [&](int i, int j) { return bottom(j, i); });
	for (int i = 0; i < nx; ++i) {
		s.addQuad(bottom(i, 0), bottom(i + 1, 0), top(i + 1, 0), top(i, 0), false);
		s.addQuad(bottom(i + 1, ny), bottom(i, ny), top(i, ny), top(i + 1, ny), false);
	}
	for (int j = 0; j < ny; ++j) {
		s.addQuad(bottom(0, j + 1), bottom(0, j), top(0, j), top(0, j + 1), false);
		s.addQuad(bottom(nx, j), bottom(nx, j + 1), top(nx, j + 1), top(nx, j), false);
	}
	return s;
}

inline Soup MakeBox(double x, double y, double z)
{
	Random unused(0);
	Soup s = MakeSlab(1, 1, 1, 1, Diagonals::One, unused, [](int, int) { return 0.0; });
	for (vcg::Point3d& p : s.vertices) p = {(p[0] - 0.5) * x, (p[1] - 0.5) * y, p[2] * z};
	return s;
}

/// Around the z axis: rows of `around` points between two poles.
inline Soup MakeLathe(int around, int rows, Diagonals kind, Random& random,
                      const std::function<vcg::Point2d(int)>& profile)
{
	Soup s;
	const int south = s.add({0, 0, profile(0)[1]});
	for (int r = 1; r < rows; ++r)
		for (int i = 0; i < around; ++i) {
			const double angle = 2 * M_PI * i / around;
			const vcg::Point2d p = profile(r);
			s.add({p[0] * std::cos(angle), p[0] * std::sin(angle), p[1]});
		}
	const int north = s.add({0, 0, profile(rows)[1]});
	const auto at = [&](int i, int r) { return 1 + (r - 1) * around + i % around; };
	for (int i = 0; i < around; ++i) {
		s.faces.push_back({south, at(i + 1, 1), at(i, 1)});
		s.faces.push_back({north, at(i, rows - 1), at(i + 1, rows - 1)});
	}
	AddGrid(s, around, rows - 2, kind, random, [&](int i, int r) { return at(i, r + 1); });
	return s;
}

inline Soup MakeSphere(int around, int rows, Diagonals kind, Random& random)
{
	return MakeLathe(around, rows, kind, random, [rows](int r) {
		const double angle = M_PI * (double(r) / rows - 0.5);
		return vcg::Point2d(std::cos(angle), std::sin(angle));
	});
}

/// Also a fan of high valence: its two lids are.
inline Soup MakeCylinder(int around, int rows, double radius, double height, Random& random)
{
	return MakeLathe(around, rows + 2, Diagonals::One, random, [=](int r) {
		return vcg::Point2d(radius, height * (std::clamp(r - 1, 0, rows) / double(rows) - 0.5));
	});
}

inline Soup MakeTorus(int around, int across, double tube, Diagonals kind, Random& random)
{
	Soup s;
	for (int j = 0; j < across; ++j)
		for (int i = 0; i < around; ++i) {
			const double a = 2 * M_PI * i / around, b = 2 * M_PI * j / across, r = 1 + tube * std::cos(b);
			s.add({r * std::cos(a), r * std::sin(a), tube * std::sin(b)});
		}
	AddGrid(s, around, across, kind, random, [=](int i, int j) { return (j % across) * around + i % around; });
	return s;
}

inline Soup MakeIcosphere(int levels)
{
	const double g = (1 + std::sqrt(5.0)) / 2;
	Soup s;
	s.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
	              {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
	s.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
	           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
	           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
	for (int level = 0; level < levels; ++level) {
		std::map<std::pair<int, int>, int> middle;
		const auto halve = [&](int a, int b) {
			const auto found = middle.emplace(std::minmax(a, b), int(s.vertices.size()));
			if (found.second) s.add((s.vertices[size_t(a)] + s.vertices[size_t(b)]) / 2);
			return found.first->second;
		};
		std::vector<std::array<int, 3>> faces;
		for (const auto& f : s.faces) {
			const int a = halve(f[0], f[1]), b = halve(f[1], f[2]), c = halve(f[2], f[0]);
			for (const auto& t : {std::array<int, 3>{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}})
				faces.push_back(t);
		}
		s.faces.swap(faces);
	}
	for (vcg::Point3d& p : s.vertices) p /= p.Norm();
	return s;
}

/// Split faces at random points; `closest` (a fraction of the face) says how near to its border, which makes slivers.
inline void SplitFaces(Soup& s, int count, double closest, Random& random)
{
	for (int i = 0; i < count; ++i) {
		const size_t f = size_t(random.below(int(s.faces.size())));
		const auto t = s.faces[f];
		double w[3] = {random.logReal(closest, 1), random.logReal(closest, 1), 1};
		std::swap(w[random.below(3)], w[2]);
		const double sum = w[0] + w[1] + w[2];
		const vcg::Point3d &a = s.vertices[size_t(t[0])], &b = s.vertices[size_t(t[1])], &c = s.vertices[size_t(t[2])];
		const int p = s.add(a + (b - a) * (w[1] / sum) + (c - a) * (w[2] / sum));
		s.faces[f] = {t[0], t[1], p};
		s.faces.push_back({t[1], t[2], p});
		s.faces.push_back({t[2], t[0], p});
	}
}

/// Split edges, near an end when `closest` is small: the two faces beside become four.
inline void SplitEdges(Soup& s, int count, double closest, Random& random)
{
	for (int i = 0; i < count; ++i) {
		const size_t f = size_t(random.below(int(s.faces.size())));
		const size_t k = size_t(random.below(3));
		const int a = s.faces[f][k], b = s.faces[f][(k + 1) % 3];
		const double along = random.logReal(closest, 0.5);
		const int p = s.add(s.vertices[size_t(a)] + (s.vertices[size_t(b)] - s.vertices[size_t(a)]) * along);
		for (size_t g = 0, n = s.faces.size(); g < n; ++g)
			for (size_t j = 0; j < 3; ++j) {
				auto& t = s.faces[g];
				if (std::minmax(t[j], t[(j + 1) % 3]) != std::minmax(a, b)) continue;
				const std::array<int, 3> rest = {p, t[(j + 1) % 3], t[(j + 2) % 3]};
				t = {t[j], p, t[(j + 2) % 3]};
				s.faces.push_back(rest);
				break;
			}
	}
}

/// Remove faces that have become lines or have turned round, with what hangs on them: the mesh may open.
inline void RemoveFaces(Soup& s, int count, Random& random)
{
	for (int i = 0; i < count && !s.faces.empty(); ++i)
		s.faces.erase(s.faces.begin() + random.below(int(s.faces.size())));
}

/// Append another mesh as a shell of its own.
inline void Append(Soup& s, const Soup& other)
{
	const int base = int(s.vertices.size());
	s.vertices.insert(s.vertices.end(), other.vertices.begin(), other.vertices.end());
	for (const auto& f : other.faces) s.faces.push_back({f[0] + base, f[1] + base, f[2] + base});
}

}  // namespace vcg::textlabel::test
