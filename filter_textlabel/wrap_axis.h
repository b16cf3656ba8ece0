#pragma once
// The axis that a label runs round: found from the surface under it, or given by its distance.
//
// A turned part shows its axis twice: the normals of the surface lie across it, and a cut across it is a circle. From the normals of
// what is seen around the place come some directions, the label's own are others; for each the surface is cut across it at the place,
// and a circle is laid through the cut. The roundest cut wins, the label's up when it is as good as any. Vertices of a coarse part lie
// on the circle, wherever its facets are, and so do the points where edges are cut.

#include "vcg_ext/label_frame.h"
#include "vcg_ext/surface_point.h"

#include <array>
#include <functional>
#include <vector>

namespace textlabel {

/// A piece of surface around a place; world coordinates.
struct SurfacePatch {
	std::vector<std::array<vcg::Point3d, 3>> triangles;  ///< counter-clockwise seen from outside
	bool isWhole = false;                                ///< a larger one would hold no more
};

/// The surface that hangs together around the origin of a parallel frame, as far as it faces the viewer and a square reaches.
/// @param[in] halfSide  world units
using SurfaceAround =
	std::function<SurfacePatch(const vcg::textlabel::LabelFrame& frame, double halfSide)>;

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

template <class MeshType>
SurfacePatch CollectSurface(const MeshType& m, const vcg::textlabel::LabelFrame& frame, double halfSide)
{
	constexpr double leastCosine = 0.2;  // what is steeper is an end, or a step
	const vcg::textlabel::LabelSpace space(frame);
	vcg::textlabel::PlaneBox box;
	box.add({-halfSide, -halfSide});
	box.add({halfSide, halfSide});
	const vcg::textlabel::Sheet sheet = vcg::textlabel::CollectSheet(m, space, box);
	const auto corner = [&](int t, size_t k) -> const vcg::Point3d& {
		return sheet.vertices[size_t(sheet.triangles[size_t(t)].vertex[k])].label;
	};
	const auto faces = [&](int t) {
		const vcg::Point3d n = (corner(t, 1) - corner(t, 0)) ^ (corner(t, 2) - corner(t, 0));
		return sheet.triangles[size_t(t)].facing && n[2] > leastCosine * n.Norm();
	};
	int start = -1;  // the one that holds the origin
	double nearest = std::numeric_limits<double>::infinity();
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		if (!faces(t)) continue;
		const vcg::Point3d weight = vcg::textlabel::SpaceWeights(space, sheet, t, {0, 0});
		const double outside = std::max(0.0, -std::min({weight[0], weight[1], weight[2]}));
		const double far = std::abs(vcg::textlabel::MixCorners(sheet, t, weight)[2]) + outside * halfSide;
		if (outside > 1e-6 || !(far < nearest)) continue;
		nearest = far;
		start = t;
	}
	SurfacePatch patch;
	if (start < 0) return patch;
	patch.isWhole = true;
	std::vector<char> seen(sheet.triangles.size(), 0);
	std::vector<int> stack{start};
	seen[size_t(start)] = 1;
	while (!stack.empty()) {
		const int t = stack.back();
		stack.pop_back();
		patch.triangles.emplace_back();
		for (size_t k = 0; k < 3; ++k) {
			patch.triangles.back()[k] = frame.origin + frame.u * corner(t, k)[0] + frame.v * corner(t, k)[1] + frame.w * corner(t, k)[2];
			const int h = 3 * t + int(k), across = sheet.facingAcross(h);
			const bool leaves = sheet.twin[size_t(h)] == vcg::textlabel::BorderEdge;  // of the square, or of the part
			patch.isWhole = patch.isWhole && !leaves;
			if (across < 0 || seen[size_t(across)] || !faces(across)) continue;
			seen[size_t(across)] = 1;
			stack.push_back(across);
		}
	}
	return patch;
}

}  // namespace textlabel
