#pragma once
// The axis that a label runs round: found from the surface under it, or given by its distance.
//
// A turned part shows its axis: every normal of its surface meets it. The axis is the line that comes nearest to the normals around a
// place. They are taken on the edges over which the surface bends, halfway between the two faces: at the middle of such an edge they
// meet the axis of a coarse part, too. At its ends they do so when it runs along the part, but only nearly when it runs round it; the
// ends have a small say, which decides where all middles are at one height, as on a nut or a cone of a single row of facets.
// Source: H. Pottmann, T. Randrup, "Rotational and helical surface approximation for reverse engineering", Computing 60 (1998).

#include "vcg_ext/collect_sheet.h"
#include "vcg_ext/label_frame.h"
#include "vcg_ext/surface_point.h"

#include <functional>
#include <utility>
#include <vector>

namespace textlabel {

/// A point of an edge over which the surface bends; world coordinates.
struct FoldPoint {
	vcg::Point3d point;
	vcg::Point3d normal;  ///< unit, halfway between those of the two faces
	double weight = 0;    ///< the area of the two faces, less of it the less these bend
	bool isEnd = false;   ///< else the middle
};

/// A piece of surface around a place.
struct SurfacePatch {
	std::vector<FoldPoint> folds;
	std::vector<vcg::Point3d>
		facet;  ///< corners of the triangles around the place that lie in one plane; world coordinates
	vcg::Point3d facetNormal{0, 0, 1};  ///< unit
	bool isWhole = false;               ///< a larger one would hold no more
};

/// The surface that hangs together around the origin of a parallel frame, as far as it faces the viewer and a square reaches.
/// @param[in] halfSide  world units
using SurfaceAround = std::function<SurfacePatch(const vcg::textlabel::LabelFrame& frame, double halfSide)>;

/// Wrap a label round the axis that the surface has there.
/// @param[in] frame  where it would be flat; its origin is on the surface
/// @param[in] diagonal  of the part, world units
/// @return a frame at the same origin whose w is across the axis, and whose up is along the axis or round it, whichever is nearer
/// @throws RequestError{NoAxis}
vcg::textlabel::LabelFrame WrappedFrame(const vcg::textlabel::LabelFrame& frame, double diagonal,
                                        const SurfaceAround& surface);

/// Wrap a label round the axis along its up at a distance behind its origin, or before it when negative.
vcg::textlabel::LabelFrame WrappedFrame(const vcg::textlabel::LabelFrame& frame, double radius);

/// SurfaceAround of a mesh; one linear pass.
template <class MeshType>
SurfacePatch CollectSurface(const MeshType& m, const vcg::textlabel::LabelFrame& frame, double halfSide);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// The candidates of a square, and which of them face the viewer.
struct SeenSurface {
	vcg::textlabel::Sheet sheet;
	std::vector<vcg::Point3d> normal;  ///< #triangles: label space, as long as twice the area

	template <class MeshType>
	SeenSurface(const MeshType& m, const vcg::textlabel::LabelSpace& space, double halfSide)
	{
		vcg::textlabel::PlaneBox box;
		box.add({-halfSide, -halfSide});
		box.add({halfSide, halfSide});
		sheet = vcg::textlabel::CollectSheet(m, space, box);
		for (const auto& t : sheet.triangles) {
			const vcg::Point3d& a = at(t.vertex[0]);
			normal.push_back((at(t.vertex[1]) - a) ^ (at(t.vertex[2]) - a));
		}
	}
	const vcg::Point3d& at(int vertex) const { return sheet.vertices[size_t(vertex)].label; }
	/// What is steeper is an end, or a step.
	bool faces(int t) const
	{
		constexpr double leastCosine = 0.2;
		return sheet.triangles[size_t(t)].facing && normal[size_t(t)][2] > leastCosine * normal[size_t(t)].Norm();
	}
	/// The triangles around one that lie in its plane, as far as rounded coordinates tell, and slivers between them.
	std::vector<int> facetOf(int start) const
	{
		constexpr double alike = 0.02, sliver = 1e-6;  // radians; of the area
		std::vector<int> facet{start};
		std::vector<char> isSeen(sheet.triangles.size(), 0);
		isSeen[size_t(start)] = 1;
		const vcg::Point3d& n = normal[size_t(start)];
		for (size_t i = 0; i < facet.size(); ++i)
			for (int h = 3 * facet[i]; h < 3 * facet[i] + 3; ++h) {
				const int t = sheet.twin[size_t(h)] / 3;
				if (sheet.twin[size_t(h)] < 0 || isSeen[size_t(t)]) continue;
				const vcg::Point3d& other = normal[size_t(t)];
				const bool isSliver = other.Norm() < sliver * n.Norm();
				if (!isSliver && !(n * other > 0 && (n ^ other).Norm() < alike * (n * other))) continue;
				isSeen[size_t(t)] = 1;
				facet.push_back(t);
			}
		return facet;
	}
	/// The triangle that holds the origin, or -1.
	int start(const vcg::textlabel::LabelSpace& space) const
	{
		constexpr double beside = 1e-6;  // of the triangle
		int nearest = -1;
		double least = std::numeric_limits<double>::infinity();
		for (int t = 0; t < int(sheet.triangles.size()); ++t) {
			if (!faces(t)) continue;
			const vcg::Point3d weight = vcg::textlabel::SpaceWeights(space, sheet, t, {0, 0});
			const double depth = std::abs(vcg::textlabel::MixCorners(sheet, t, weight)[2]);
			if (!(std::min({weight[0], weight[1], weight[2]}) >= -beside) || !(depth < least)) continue;
			least = depth;
			nearest = t;
		}
		return nearest;
	}
};

}  // namespace detail

template <class MeshType>
SurfacePatch CollectSurface(const MeshType& m, const vcg::textlabel::LabelFrame& frame, double halfSide)
{
	constexpr double flat = 1e-4, sharp = 1.35;  // radians: rounding; the corner of a box, or the end of a part
	constexpr double bent = 0.01;                // radians: a fold that bends so much has a quarter of its weight
	const vcg::textlabel::LabelSpace space(frame);
	const detail::SeenSurface seen(m, space, halfSide);
	const auto& sheet = seen.sheet;
	SurfacePatch patch;
	std::vector<int> found;
	std::vector<char> isFound(sheet.triangles.size(), 0);
	const auto visit = [&](int t) {
		if (!std::exchange(isFound[size_t(t)], 1)) found.push_back(t);
	};
	const auto toWorld = [&](const vcg::Point3d& d) { return frame.u * d[0] + frame.v * d[1] + frame.w * d[2]; };
	if (const int start = seen.start(space); start >= 0) {
		visit(start);
		patch.facetNormal = toWorld(seen.normal[size_t(start)] / seen.normal[size_t(start)].Norm());
		for (const int t : seen.facetOf(start))
			for (const int v : sheet.triangles[size_t(t)].vertex)
				patch.facet.push_back(frame.origin + toWorld(seen.at(v)));
	}
	patch.isWhole = !found.empty();
	for (size_t i = 0; i < found.size(); ++i)
		for (int h = 3 * found[i]; h < 3 * found[i] + 3; ++h) {
			const int twin = sheet.twin[size_t(h)];
			if (twin == vcg::textlabel::BorderEdge) patch.isWhole = false;  // of the square, or of the part
			if (twin < 0) continue;
			if (seen.faces(twin / 3)) visit(twin / 3);
			if (twin < h && isFound[size_t(twin / 3)]) continue;
			const vcg::Point3d &p = seen.normal[size_t(h / 3)], &q = seen.normal[size_t(twin / 3)];
			const double turn = std::atan2((p ^ q).Norm(), p * q);
			if (!(turn > flat && turn < sharp)) continue;
			const vcg::Point3d n = p / p.Norm() + q / q.Norm();
			const vcg::Point3d &from = seen.at(sheet.from(h)), &to = seen.at(sheet.to(h));
			// a diagonal that rounding has bent has the facet's own normal, wherever it lies on it
			const double worth = turn / (turn + bent) * (turn / (turn + bent));
			for (const double along : {0.0, 0.5, 1.0})
				patch.folds.push_back({frame.origin + toWorld(from + (to - from) * along), toWorld(n / n.Norm()),
				                       (p.Norm() + q.Norm()) / 2 * worth, along != 0.5});
		}
	return patch;
}

}  // namespace textlabel
