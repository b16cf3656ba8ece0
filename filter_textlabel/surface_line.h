#pragma once
// Where a line of sight meets a part.
//
// One linear pass, no search structure. In the plane across the line every vertex gets a code for its side of two axes; a face
// whose corners are all on one side is skipped. Whether the line goes through one of the few faces left is decided exactly,
// so it cannot slip through between two of them.

#include "vcg_ext/label_frame.h"
#include "vcg_ext/parallel_chunks.h"
#include "vcg_ext/predicates.h"
#include "vcg_ext/vertex_point.h"

#include <cstdint>
#include <vector>
#include <vcg/math/matrix44.h>

namespace textlabel {

/// A line that is run along `direction`, away from the viewer; world coordinates.
struct SightLine {
	vcg::Point3d origin{0, 0, 0};
	vcg::Point3d direction{0, 0, -1};  ///< any length but zero
};

/// Where a line meets a face.
struct SurfaceHit {
	double distance = 0;  ///< from the line's origin, away from the viewer, world units; negative before the origin
	int face = -1;
	bool facing = false;  ///< the face shows its outside to the one who looks along the line
};

namespace detail {

enum LineSide : std::uint8_t { LeftOfLine = 1, RightOfLine = 2, BelowLine = 4, AboveLine = 8, NotFinite = 16 };

/// Side of a point in a space whose z axis is the line. Without branches: that is not to be predicted.
inline std::uint8_t SideOfLine(const vcg::Point3d& q)
{
	return std::uint8_t(LeftOfLine * (q[0] < 0) | RightOfLine * (q[0] > 0) | BelowLine * (q[1] < 0) |
	                    AboveLine * (q[1] > 0) | NotFinite * !std::isfinite(q[0] + q[1] + q[2]));
}

/// +1 or -1 when the z axis goes through the triangle, or through its border, and the triangle is counter-clockwise or clockwise
/// seen from +z; 0 when it misses it, or the triangle is seen edge-on.
inline int TurnAroundAxis(const vcg::Point3d (&q)[3])
{
	vcg::Point2d p[3];
	for (int k = 0; k < 3; ++k) p[k] = {q[k][0], q[k][1]};
	const int turn = vcg::textlabel::Orient2d(p[0], p[1], p[2]);
	for (int k = 0; k < 3; ++k)
		if (vcg::textlabel::Orient2d({0, 0}, p[k], p[(k + 1) % 3]) == -turn) return 0;
	return turn;
}

/// Where the z axis goes through a triangle: between its corners, however near to edge-on it is seen.
/// @param[in] turn  as TurnAroundAxis gives it, not 0
inline double HeightOnAxis(const vcg::Point3d (&q)[3], int turn)
{
	double sum = 0, weights = 0;
	for (int k = 0; k < 3; ++k) {
		const vcg::Point3d &a = q[(k + 1) % 3], &b = q[(k + 2) % 3];
		const double weight = std::max((a[0] * b[1] - a[1] * b[0]) * turn, 0.0);  // rounding may have turned it round
		sum += weight * q[k][2];
		weights += weight;
	}
	return weights > 0 ? sum / weights : (q[0][2] + q[1][2] + q[2][2]) / 3;
}

}  // namespace detail

/// All faces that a line meets, nearest to the viewer first; faces seen edge-on and those that are not finite are left out.
/// @param[in] toWorld  mesh coordinates to world coordinates; affine, regular, may mirror
/// @throws vcg::textlabel::Error{BadFrame} when the line is not finite or has no direction
template <class MeshType>
std::vector<SurfaceHit> HitsOnLine(const MeshType& m, const vcg::Matrix44d& toWorld, const SightLine& line)
{
	const vcg::Point3d towards = vcg::Point3d(0, 0, 0) - line.direction;
	const bool isNearerToY = std::abs(towards[0]) < std::abs(towards[1]);
	auto frame = vcg::textlabel::FrameFromDirection(line.origin, towards,
	                                                isNearerToY ? vcg::Point3d(1, 0, 0) : vcg::Point3d(0, 1, 0));
	frame.toWorld = toWorld;
	const vcg::textlabel::LabelSpace space(frame);
	using vcg::textlabel::EachChunk, vcg::textlabel::ChunkCount, vcg::textlabel::PointOf;
	const auto inSpace = [&](const auto& v) { return space.toLabel(PointOf(v)); };
	std::vector<std::uint8_t> sides(m.vert.size(), detail::NotFinite);
	EachChunk(m.vert.size(), ChunkCount(m.vert.size()), [&](size_t, size_t first, size_t last) {
		for (size_t i = first; i < last; ++i)
			if (!m.vert[i].IsD()) sides[i] = detail::SideOfLine(inSpace(m.vert[i]));
	});

	const auto addHit = [&](size_t f, std::vector<SurfaceHit>& hits) {
		const vcg::Point3d q[3] = {inSpace(*m.face[f].cV(0)), inSpace(*m.face[f].cV(1)), inSpace(*m.face[f].cV(2))};
		const int turn = detail::TurnAroundAxis(q);
		if (turn != 0) hits.push_back({-detail::HeightOnAxis(q, turn), int(f), (turn > 0) != space.mirrors()});
	};
	std::vector<std::vector<SurfaceHit>> found(ChunkCount(m.face.size()));
	EachChunk(m.face.size(), found.size(), [&](size_t chunk, size_t first, size_t last) {
		const auto* const vertices = m.vert.data();
		const std::uint8_t* const sideOf = sides.data();
		for (size_t f = first; f < last; ++f) {
			const auto& face = m.face[f];
			if (face.IsD()) continue;
			const int a = sideOf[face.cV(0) - vertices], b = sideOf[face.cV(1) - vertices],
					  c = sideOf[face.cV(2) - vertices];
			if (!(a & b & c) && !((a | b | c) & detail::NotFinite)) addHit(f, found[chunk]);
		}
	});
	std::vector<SurfaceHit> hits;
	for (const std::vector<SurfaceHit>& part : found) hits.insert(hits.end(), part.begin(), part.end());
	std::sort(hits.begin(), hits.end(), [](const SurfaceHit& a, const SurfaceHit& b) {
		return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
	});
	return hits;
}

}  // namespace textlabel
