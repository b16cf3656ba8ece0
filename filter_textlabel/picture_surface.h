#pragma once
// How a triangle mesh wants to be shaded: one normal for each corner of each face, and which edges are creases.
//
// CAD meshes carry large flat triangles beside narrow fillets. Plain averages at the vertices bend the light over the flats, so
// faces are first gathered into flat patches and each patch weighs with its whole area: flats stay flat, fillets run into them.

#include "picture.h"
#include "vcg_ext/vertex_point.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace textlabel::detail {

enum class EdgeKind : std::uint8_t { Flat, Smooth, Crease };

struct PictureSurface {
	std::vector<vcg::Point3d> faceNormals;    ///< #F, unit, zero for a face without area
	std::vector<vcg::Point3f> cornerNormals;  ///< 3 #F, unit; corner k of face f is 3 f + k
	std::vector<EdgeKind> edges;              ///< 3 #F; edge k runs from corner k to the next
};

class UnionFind {
public:
	explicit UnionFind(size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
	int find(int i)
	{
		while (parent[size_t(i)] != i) i = parent[size_t(i)] = parent[size_t(parent[size_t(i)])];
		return i;
	}
	void join(int a, int b)
	{
		a = find(a), b = find(b);
		parent[size_t(std::max(a, b))] = std::min(a, b);
	}

private:
	std::vector<int> parent;
};

/// For each position the lowest index of a position that equals it.
inline std::vector<int> MergeEqualPoints(const std::vector<vcg::Point3d>& points)
{
	std::vector<int> order(points.size()), merged(points.size());
	std::iota(order.begin(), order.end(), 0);
	const auto less = [&](int a, int b) {  // those that are not finite, which have no order, first
		const vcg::Point3d &p = points[size_t(a)], &q = points[size_t(b)];
		const bool isP = vcg::textlabel::IsFinite(p), isQ = vcg::textlabel::IsFinite(q);
		if (!isP || !isQ) return isP != isQ ? isQ : a < b;
		return std::tie(p[0], p[1], p[2], a) < std::tie(q[0], q[1], q[2], b);
	};
	std::sort(order.begin(), order.end(), less);
	for (size_t i = 0; i < order.size(); i++) {
		const bool same = i > 0 && points[size_t(order[i])] == points[size_t(order[i - 1])];
		merged[size_t(order[i])] = same ? merged[size_t(order[i - 1])] : order[i];
	}
	return merged;
}

/// The half-edge on the other side of each half-edge, or -1 at a border and where the mesh is not an oriented manifold.
/// Half-edges are sorted by their two vertices: linear memory, no map, whatever the valence.
inline std::vector<int> FindMates(const std::vector<std::array<int, 3>>& triangles, const std::vector<int>& merged)
{
	struct Half {
		int low, high, id;
	};
	std::vector<Half> halves;
	halves.reserve(3 * triangles.size());
	for (size_t f = 0; f < triangles.size(); f++)
		for (size_t k = 0; k < 3; k++) {
			const int a = merged[size_t(triangles[f][k])], b = merged[size_t(triangles[f][(k + 1) % 3])];
			halves.push_back({std::min(a, b), std::max(a, b), int(3 * f + k)});
		}
	std::sort(halves.begin(), halves.end(), [](const Half& p, const Half& q) {
		return std::tie(p.low, p.high, p.id) < std::tie(q.low, q.high, q.id);
	});
	std::vector<int> mates(halves.size(), -1);
	const auto start = [&](const Half& h) { return merged[size_t(triangles[size_t(h.id) / 3][size_t(h.id) % 3])]; };
	const auto sameEdge = [&](size_t i, size_t j) {
		return j < halves.size() && halves[i].low == halves[j].low && halves[i].high == halves[j].high;
	};
	for (size_t i = 0, end = 0; i < halves.size(); i = end) {
		for (end = i + 1; sameEdge(i, end);) end++;
		if (end != i + 2 || start(halves[i]) == start(halves[i + 1])) continue;
		mates[size_t(halves[i].id)] = halves[i + 1].id;
		mates[size_t(halves[i + 1].id)] = halves[i].id;
	}
	return mates;
}

inline std::vector<EdgeKind> ClassifyEdges(const PictureMesh& mesh, const std::vector<int>& mates,
                                           const std::vector<vcg::Point3d>& normals, double creaseAngle)
{
	constexpr double flatCosine = 0.999998;  // 0.1 degrees
	const double creaseCosine = std::cos(creaseAngle * 3.14159265358979323846 / 180);
	std::vector<EdgeKind> kinds(mates.size(), EdgeKind::Crease);
	for (size_t h = 0; h < mates.size(); h++) {
		if (mates[h] < 0) continue;
		const size_t f = h / 3, g = size_t(mates[h]) / 3;
		const double cosine = normals[f] * normals[g];
		if (!mesh.isLabel.empty() && mesh.isLabel[f] != mesh.isLabel[g]) continue;
		kinds[h] = cosine > flatCosine ? EdgeKind::Flat : cosine > creaseCosine ? EdgeKind::Smooth : EdgeKind::Crease;
	}
	return kinds;
}

/// The angle at a corner, radians.
inline double CornerAngle(const PictureMesh& mesh, size_t f, size_t k)
{
	const auto& t = mesh.triangles[f];
	const vcg::Point3d& p = mesh.positions[size_t(t[k])];
	const vcg::Point3d a = mesh.positions[size_t(t[(k + 1) % 3])] - p, b = mesh.positions[size_t(t[(k + 2) % 3])] - p;
	return std::atan2((a ^ b).Norm(), a * b);
}

/// Area of the flat patch that each face belongs to.
inline std::vector<double> PatchAreas(const std::vector<double>& areas, const std::vector<int>& mates,
                                      const std::vector<EdgeKind>& kinds)
{
	UnionFind patches(areas.size());
	for (size_t h = 0; h < mates.size(); h++)
		if (kinds[h] == EdgeKind::Flat) patches.join(int(h / 3), mates[h] / 3);
	std::vector<double> sums(areas.size(), 0), result(areas.size());
	for (size_t f = 0; f < areas.size(); f++) sums[size_t(patches.find(int(f)))] += areas[f];
	for (size_t f = 0; f < areas.size(); f++) result[f] = sums[size_t(patches.find(int(f)))];
	return result;
}

/// Corners around a vertex that are joined by edges without a crease share one normal.
inline std::vector<vcg::Point3f> SmoothNormals(const PictureMesh& mesh, const PictureSurface& surface,
                                               const std::vector<int>& mates, const std::vector<double>& weights)
{
	UnionFind groups(mates.size());
	const auto next = [](int h) { return h % 3 == 2 ? h - 2 : h + 1; };
	for (size_t h = 0; h < mates.size(); h++) {
		if (surface.edges[h] == EdgeKind::Crease || int(h) > mates[h]) continue;
		groups.join(int(h), next(mates[h]));
		groups.join(next(int(h)), mates[h]);
	}
	std::vector<vcg::Point3d> sums(mates.size(), vcg::Point3d(0, 0, 0));
	for (size_t h = 0; h < mates.size(); h++)
		sums[size_t(groups.find(int(h)))] +=
			surface.faceNormals[h / 3] * (weights[h / 3] * CornerAngle(mesh, h / 3, h % 3));
	std::vector<vcg::Point3f> normals(mates.size());
	for (size_t h = 0; h < mates.size(); h++) {
		vcg::Point3d n = sums[size_t(groups.find(int(h)))];
		if (n.SquaredNorm() == 0) n = surface.faceNormals[h / 3];
		normals[h].Import(n.Normalize());
	}
	return normals;
}

/// Normals and creases of the mesh; linear in its size but for sorting.
/// @param[in] creaseAngle  degrees
inline PictureSurface AnalyseSurface(const PictureMesh& mesh, double creaseAngle)
{
	PictureSurface surface;
	std::vector<double> areas;
	for (const auto& t : mesh.triangles) {
		const vcg::Point3d& p = mesh.positions[size_t(t[0])];
		vcg::Point3d n = (mesh.positions[size_t(t[1])] - p) ^ (mesh.positions[size_t(t[2])] - p);
		const double twiceArea = n.Norm();
		areas.push_back(twiceArea / 2);
		surface.faceNormals.push_back(twiceArea > 0 ? n / twiceArea : vcg::Point3d(0, 0, 0));
	}
	const std::vector<int> mates = FindMates(mesh.triangles, MergeEqualPoints(mesh.positions));
	surface.edges = ClassifyEdges(mesh, mates, surface.faceNormals, creaseAngle);
	surface.cornerNormals = SmoothNormals(mesh, surface, mates, PatchAreas(areas, mates, surface.edges));
	return surface;
}

}  // namespace textlabel::detail
