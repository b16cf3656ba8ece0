#pragma once
// Parts for the benchmarks, made on the fly: a closed cushion, uniformly fine, and the frame of a label on its top.
//
// The cushion is a box with rounded edges under a smooth warp, so that nothing of it is flat, 100 by 60 by 40 units whatever its
// number of triangles. Vertices are shifted along the surface by a hash of their number: no two edges are in line, as on a scan.
// Coordinates are float32 values. The label lies askew, so that its stems do not run along the mesh.

#include "vcg_ext/label_frame.h"
#include "vcg_ext/validate.h"

#include <cstdint>

namespace bench {

using vcg::textlabel::IndexedMesh;
using vcg::textlabel::LabelFrame;

namespace detail {

constexpr double halfX = 50, halfY = 30, halfZ = 20, rounding = 8;  // units

/// A number in -0.5 .. 0.5 that looks random and is always the same.
inline double Hash(std::uint64_t x)
{
	x = (x ^ (x >> 31)) * 0x9e3779b97f4a7c15ULL;
	x = (x ^ (x >> 29)) * 0xbf58476d1ce4e5b9ULL;
	return double((x ^ (x >> 32)) & 0xffffff) / 0x1000000 - 0.5;
}

/// From the surface of the box to that of the cushion.
inline vcg::Point3d OnCushion(const vcg::Point3d& box)
{
	const double half[3] = {halfX - rounding, halfY - rounding, halfZ - rounding};
	vcg::Point3d inner;
	for (int i = 0; i < 3; ++i) inner[i] = std::clamp(box[i], -half[i], half[i]);
	const vcg::Point3d out = box - inner;
	vcg::Point3d p = inner + out * (rounding / out.Norm());
	p[2] += 0.6 * std::sin(p[0] / 9 + 1) * std::cos(p[1] / 7) - (p[0] * p[0] + p[1] * p[1]) / 1500;
	p[0] += 0.5 * std::sin(p[2] / 8 + p[1] / 11);
	for (int i = 0; i < 3; ++i) p[i] = vcg::textlabel::RoundToFloat(p[i]);
	return p;
}

/// Numbers the lattice points on the surface of a box of nx by ny by nz cells: bottom, rings, top.
struct BoxLattice {
	int nx, ny, nz;

	int ring() const { return 2 * (nx + ny); }
	int plate() const { return (nx + 1) * (ny + 1); }
	int size() const { return 2 * plate() + (nz - 1) * ring(); }
	int at(int i, int j, int k) const
	{
		if (k == 0) return j * (nx + 1) + i;
		if (k == nz) return plate() + (nz - 1) * ring() + j * (nx + 1) + i;
		const int along = j == 0 ? i : i == nx ? nx + j : j == ny ? nx + ny + (nx - i) : 2 * nx + ny + (ny - j);
		return plate() + (k - 1) * ring() + along;
	}
	/// The lattice point at a place of a ring.
	std::array<int, 2> onRing(int along) const
	{
		along %= ring();
		if (along < nx) return {along, 0};
		if (along < nx + ny) return {nx, along - nx};
		if (along < 2 * nx + ny) return {nx - (along - nx - ny), ny};
		return {0, ny - (along - 2 * nx - ny)};
	}
};

class CushionMaker {
public:
	explicit CushionMaker(const BoxLattice& lattice) : lattice_(lattice) {}

	IndexedMesh run()
	{
		const auto& [nx, ny, nz] = lattice_;
		mesh_.positions.resize(size_t(lattice_.size()));
		mesh_.faces.reserve(4 * size_t(nx * ny + ny * nz + nz * nx));
		for (const int k : {0, nz})
			for (int j = 0; j <= ny; ++j)
				for (int i = 0; i <= nx; ++i) place(i, j, k);
		for (int k = 1; k < nz; ++k)
			for (int along = 0; along < lattice_.ring(); ++along)
				place(lattice_.onRing(along)[0], lattice_.onRing(along)[1], k);
		for (int j = 0; j < ny; ++j)
			for (int i = 0; i < nx; ++i) {
				quad(lattice_.at(i, j, 0), lattice_.at(i, j + 1, 0), lattice_.at(i + 1, j + 1, 0),
				     lattice_.at(i + 1, j, 0));
				quad(lattice_.at(i, j, nz), lattice_.at(i + 1, j, nz), lattice_.at(i + 1, j + 1, nz),
				     lattice_.at(i, j + 1, nz));
			}
		for (int k = 0; k < nz; ++k)
			for (int along = 0; along < lattice_.ring(); ++along) {
				const auto [i, j] = lattice_.onRing(along);
				const auto [p, q] = lattice_.onRing(along + 1);
				quad(lattice_.at(i, j, k), lattice_.at(p, q, k), lattice_.at(p, q, k + 1), lattice_.at(i, j, k + 1));
			}
		return std::move(mesh_);
	}

private:
	void place(int i, int j, int k)
	{
		constexpr double shift = 0.4;  // of a cell, both ways together
		const int v = lattice_.at(i, j, k);
		const int cell[3] = {i, j, k}, cells[3] = {lattice_.nx, lattice_.ny, lattice_.nz};
		const double half[3] = {halfX, halfY, halfZ};
		const int onBorders = (i % lattice_.nx == 0) + (j % lattice_.ny == 0) + (k % lattice_.nz == 0);
		vcg::Point3d p;
		for (int axis = 0; axis < 3; ++axis) {
			const bool slides = onBorders == 1 && cell[axis] % cells[axis] != 0;
			const double jitter = slides ? shift * Hash(std::uint64_t(v) * 3 + std::uint64_t(axis)) : 0;
			p[axis] = half[axis] * (2 * (cell[axis] + jitter) / cells[axis] - 1);
		}
		mesh_.positions[size_t(v)] = OnCushion(p);
	}
	void quad(int a, int b, int c, int d)
	{
		if (Hash(mesh_.faces.size()) < 0) {
			mesh_.faces.push_back({a, b, c});
			mesh_.faces.push_back({a, c, d});
		} else {
			mesh_.faces.push_back({b, c, d});
			mesh_.faces.push_back({b, d, a});
		}
	}

	const BoxLattice lattice_;
	IndexedMesh mesh_;
};

}  // namespace detail

/// A closed cushion of about so many triangles.
inline IndexedMesh MakeCushion(double triangles)
{
	using namespace detail;
	const double area = 4 * (halfX * halfY + halfY * halfZ + halfZ * halfX);  // times 2 triangles = of the whole box
	const double cells = std::sqrt(triangles / 4 / (area / 4));               // per unit of half an edge
	const auto count = [&](double half) { return std::max(3, int(std::lround(cells * half))); };
	return CushionMaker({count(halfX), count(halfY), count(halfZ)}).run();
}

/// The same mesh with its vertices and faces in random order, as some exporters leave them.
inline IndexedMesh Shuffled(const IndexedMesh& mesh)
{
	const auto order = [](size_t n) {
		std::vector<int> to(n);
		for (size_t i = 0; i < n; ++i) to[i] = int(i);
		for (size_t i = n; i > 1; --i) std::swap(to[i - 1], to[size_t((detail::Hash(i) + 0.5) * double(i))]);
		return to;
	};
	IndexedMesh out = mesh;
	const std::vector<int> vertex = order(mesh.positions.size()), face = order(mesh.faces.size());
	for (size_t v = 0; v < vertex.size(); ++v) out.positions[size_t(vertex[v])] = mesh.positions[v];
	for (size_t f = 0; f < face.size(); ++f)
		for (size_t k = 0; k < 3; ++k) out.faces[size_t(face[f])][k] = vertex[size_t(mesh.faces[f][k])];
	return out;
}

/// Two shells in one mesh, side by side: the second moved along x.
inline IndexedMesh Beside(const IndexedMesh& a, const IndexedMesh& b, double x)
{
	IndexedMesh out = a;
	for (vcg::Point3d p : b.positions) out.positions.push_back({p[0] + x, p[1], p[2]});
	const int first = int(a.positions.size());
	for (const auto& f : b.faces) out.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
	return out;
}

/// Seen from above, on top of the cushion, reading along `degrees` from x.
inline LabelFrame FrameOnCushion(double degrees = 17)
{
	constexpr double pi = 3.14159265358979323846;
	const double turn = degrees * pi / 180;
	return vcg::textlabel::FrameFromDirection({0, 0, detail::halfZ}, {0, 0, 1}, {-std::sin(turn), std::cos(turn), 0});
}

}  // namespace bench
