#pragma once
// The frame of a label: where its plane lies and from where it is projected.
//
// All geometry happens in label space: x along the reading direction, y up, z towards the viewer, world units, origin on the
// surface, so that parts at offsets of 1e6 or sizes of 1e-5 lose nothing. The label plane is z = 0. A point is projected to it from
// the centre of projection C (perspective) or along -z (parallel). Both keep straight lines straight, so every decision about
// contours and triangles is taken in the plane: the plane through C, V_i and V_i+1 of the paper is the line through two points.
// A wrapped label runs round an axis: label space is then unrolled. Along the way round stands the length of an arc of the cylinder
// through the origin, z is the distance from that cylinder, and the projection along -z runs towards the axis. Unrolling bends straight
// lines, so it is applied to the vertices of the mesh alone: a triangle is straight between its unrolled corners, and a point of it
// has the same weights of the corners here and there. So each facet of a coarse cylinder is unrolled as a flat piece, neighbours stay
// neighbours, and what is decided in the plane holds on the surface.
// Source: Slabaugh et al., section 3.1; wrapped labels are new.

#include "label_error.h"
#include "plane_box.h"
#include "vertex_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vcg/math/matrix44.h>
#include <vcg/space/point2.h>
#include <vcg/space/point3.h>

namespace vcg::textlabel {

/// Where the label's plane lies and from where it is projected; world coordinates throughout.
struct LabelFrame {
	vcg::Point3d origin{0, 0, 0};  ///< on the surface, under the label's anchor
	vcg::Point3d u{1, 0, 0};       ///< reading direction, unit
	vcg::Point3d v{0, 1, 0};       ///< up, unit
	vcg::Point3d w{0, 0, 1};       ///< u x v, towards the viewer
	bool perspective = false;      ///< false: parallel projection along -w
	vcg::Point3d center{0, 0, 0};  ///< centre of projection C, when perspective
	double wrapRadius = 0;  ///< not 0: wrapped round an axis so far behind the origin; < 0: before it, as in a pipe
	vcg::Point3d wrapAxis{0, 1, 0};       ///< its direction, unit, perpendicular to w; meaningful when wrapped
	vcg::Matrix44d toWorld = Identity();  ///< the layer's matrix, mesh to world; affine, may mirror

	static vcg::Matrix44d Identity()
	{
		vcg::Matrix44d m;
		m.SetIdentity();
		return m;
	}
};

/// A parallel frame from a direction towards the viewer and an up direction, which is made perpendicular to it.
/// @throws Error{BadFrame} when a vector is not finite or zero, or up is parallel to the direction
inline LabelFrame FrameFromDirection(const vcg::Point3d& origin, const vcg::Point3d& towardsViewer,
                                     const vcg::Point3d& up)
{
	const auto unit = [](vcg::Point3d p) {  // scaled first: 1e-300 and 1e300 are directions too
		const double big = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
		if (big == 0) throw Error(ErrorCode::BadFrame, "a direction is zero");
		p /= big;
		return p / p.Norm();
	};
	if (!IsFinite(origin) || !IsFinite(towardsViewer) || !IsFinite(up))
		throw Error(ErrorCode::BadFrame, "a coordinate is not finite");
	constexpr double smallestSine = 1e-6;
	LabelFrame f;
	f.origin = origin;
	f.w = unit(towardsViewer);
	const vcg::Point3d side = unit(up) ^ f.w;
	if (side.Norm() < smallestSine) throw Error(ErrorCode::BadFrame, "up is parallel to the direction");
	f.u = side / side.Norm();
	f.v = f.w ^ f.u;
	return f;
}

/// Maps mesh coordinates to label space and on to the label plane, and back.
class LabelSpace {
public:
	/// @param[in] middle  label plane: opposite to it a wrapped surface is cut open
	/// @throws Error{BadFrame} when the frame is not finite and orthonormal, the layer's matrix is singular, C is not on the
	///         viewer's side of the label plane, or the axis is not across the line of sight
	explicit LabelSpace(const LabelFrame& frame, const vcg::Point2d& middle = {0, 0});

	/// Mesh coordinates to label space.
	vcg::Point3d toLabel(const vcg::Point3d& mesh) const { return wraps() ? turned(unrolled(mesh)) : inFrame(mesh); }
	/// Label space to mesh coordinates.
	vcg::Point3d toMesh(const vcg::Point3d& label) const;
	/// A vector (no point) of label space at a point of the mesh, in mesh coordinates; the same everywhere unless it is wrapped.
	vcg::Point3d vectorToMesh(const vcg::Point3d& atMesh, const vcg::Point3d& label) const;
	/// Mesh coordinates to those along the frame's axes: label space where nothing is wrapped.
	vcg::Point3d inFrame(const vcg::Point3d& mesh) const { return multiply(meshToLabel_, mesh - meshOrigin_); }

	bool wraps() const { return radius_ != 0; }
	/// Length of the way round the axis on the label's cylinder.
	double circumference() const { return 2 * pi * std::abs(radius_); }
	/// Where a point lies on its way round the axis (an arc of the label's cylinder, up to half a circumference to both sides of the
	/// middle), along the axis, and how far from that cylinder towards the viewer. @pre wraps()
	vcg::Point3d unrolled(const vcg::Point3d& mesh) const { return unrolledInFrame(inFrame(mesh)); }
	/// The same of a point along the frame's axes. @pre wraps()
	vcg::Point3d unrolledInFrame(const vcg::Point3d& q) const;
	/// Label space of an unrolled point. @pre wraps()
	vcg::Point3d turned(const vcg::Point3d& p) const
	{
		return {across_[0] * p[0] - across_[1] * p[1], across_[1] * p[0] + across_[0] * p[1], p[2]};
	}
	/// Sine and cosine of the angle from the middle, times the distance from the axis, of a point along the frame's axes. @pre wraps()
	vcg::Point2d aroundAxis(const vcg::Point3d& q) const
	{
		const vcg::Point2d p = offAxis(q);
		return {p[0] * middleCosine_ - p[1] * middleSine_, p[0] * middleSine_ + p[1] * middleCosine_};
	}
	/// The angle from the middle of a place on the way round, radians. @pre wraps()
	double angleAt(double wayRound) const { return wayRound / radius_ - middle_; }
	/// How far from the axis a height of label space is. @pre wraps()
	double distanceFromAxis(double z) const { return std::abs(radius_) + std::copysign(z, z * radius_); }
	/// Whether what is straight between three unrolled points lies between them when it is unrolled: they are off the axis, and less
	/// than half the way round apart. @pre wraps()
	bool isInOnePiece(const std::array<vcg::Point3d, 3>& unrolled) const
	{
		const auto [first, last] = std::minmax({unrolled[0][0], unrolled[1][0], unrolled[2][0]});
		return last - first < circumference() / 2 && isInFront(unrolled[0]) && isInFront(unrolled[1]) &&
		       isInFront(unrolled[2]);
	}
	/// Where the way round begins and ends, opposite to the middle. @pre wraps()
	double cutAt(int side) const { return middle_ * radius_ + side * circumference() / 2; }
	/// The box of a label as seen along the way round and along the axis. @pre wraps()
	PlaneBox unrolledBox(const PlaneBox& box) const;
	/// The way round of a point of label space. @pre wraps()
	double wayRound(const vcg::Point3d& q) const { return across_[0] * q[0] + across_[1] * q[1]; }
	/// Where along the axis it lies. @pre wraps()
	double alongAxis(const vcg::Point3d& q) const { return across_[0] * q[1] - across_[1] * q[0]; }

	bool perspective() const { return perspective_; }
	/// Centre of projection in label space; meaningful when perspective().
	const vcg::Point3d& center() const { return center_; }
	/// True when the layer's matrix mirrors: triangles that face the viewer are stored clockwise then.
	bool mirrors() const { return mirrors_; }
	/// World length of one unit of mesh coordinates, the largest over all directions (bounded from above).
	double scale() const { return scale_; }
	/// Label space: what lies safely in front of the centre of projection has a smaller z.
	double nearestZ() const { return nearestZ_; }
	/// True when q lies safely in front of the centre of projection; where it is wrapped, off the axis.
	bool isInFront(const vcg::Point3d& q) const
	{
		return wraps() ? distanceFromAxis(q[2]) > nearPlane * std::abs(radius_) : !perspective_ || q[2] < nearestZ_;
	}

	/// Size of the projection over size in space, for what lies at q and faces the viewer; also the weight of a vertex
	/// when interpolating along projected lines (perspective-correct). 1 in parallel projection.
	double magnification(const vcg::Point3d& q) const { return perspective_ ? center_[2] / (center_[2] - q[2]) : 1.0; }
	/// Project a point of label space to the label plane. @pre isInFront(q)
	vcg::Point2d project(const vcg::Point3d& q) const
	{
		if (!perspective_) return {q[0], q[1]};
		const double k = magnification(q);
		return {center_[0] + (q[0] - center_[0]) * k, center_[1] + (q[1] - center_[1]) * k};
	}
	/// Unit vector from a point of label space towards the viewer.
	vcg::Point3d towardsViewer(const vcg::Point3d& q) const
	{
		if (!perspective_) return {0, 0, 1};
		const vcg::Point3d d = center_ - q;
		return d / d.Norm();
	}

private:
	using Rows = vcg::Point3d[3];
	static constexpr double nearPlane = 1e-3;  // of the distance from C, or the axis, to the label plane
	static constexpr double pi = 3.141592653589793;
	/// From the axis across it, and towards the middle of the frame, of a point along the frame's axes. @pre wraps()
	vcg::Point2d offAxis(const vcg::Point3d& q) const
	{
		return vcg::Point2d(wayRound(q), q[2] + radius_) * std::copysign(1.0, radius_);
	}
	static vcg::Point3d multiply(const Rows& m, const vcg::Point3d& p) { return {m[0] * p, m[1] * p, m[2] * p}; }

	Rows meshToLabel_, labelToMesh_;
	vcg::Point3d meshOrigin_{0, 0, 0}, center_{0, 0, 0};
	double nearestZ_ = std::numeric_limits<double>::infinity(), scale_ = 1;
	bool perspective_ = false, mirrors_ = false;
	// wrapped
	double radius_ = 0;
	vcg::Point2d across_{1, 0};                              ///< label plane: the way round; the axis is to its left
	double middle_ = 0, middleSine_ = 0, middleCosine_ = 1;  ///< angle round the axis
};

inline vcg::Point3d LabelSpace::unrolledInFrame(const vcg::Point3d& q) const
{
	const vcg::Point2d p = offAxis(q), fromMiddle = aroundAxis(q);
	const double angle = std::atan2(fromMiddle[0], fromMiddle[1]);
	return {(angle + middle_) * radius_, alongAxis(q),
	        std::copysign(1.0, radius_) * (std::hypot(p[0], p[1]) - std::abs(radius_))};
}

inline vcg::Point3d LabelSpace::toMesh(const vcg::Point3d& label) const
{
	vcg::Point3d q = label;
	if (wraps()) {
		const double angle = wayRound(label) / radius_, distance = std::copysign(distanceFromAxis(label[2]), radius_);
		q = turned({distance * std::sin(angle), alongAxis(label), distance * std::cos(angle) - radius_});
	}
	return multiply(labelToMesh_, q) + meshOrigin_;
}

inline vcg::Point3d LabelSpace::vectorToMesh(const vcg::Point3d& atMesh, const vcg::Point3d& label) const
{
	vcg::Point3d d = label;
	if (wraps()) {
		const vcg::Point2d p = offAxis(inFrame(atMesh));
		const double distance = std::hypot(p[0], p[1]), sine = distance > 0 ? p[0] / distance : 0,
					 cosine = distance > 0 ? p[1] / distance : 1;
		const double along = wayRound(label);
		d = turned({along * cosine + label[2] * sine, alongAxis(label), label[2] * cosine - along * sine});
	}
	return multiply(labelToMesh_, d);
}

inline PlaneBox LabelSpace::unrolledBox(const PlaneBox& box) const
{
	PlaneBox out;
	for (const double x : {box.low[0], box.high[0]})
		for (const double y : {box.low[1], box.high[1]}) out.add({wayRound({x, y, 0}), alongAxis({x, y, 0})});
	return out;
}

/// A layer's matrix as three directions and a shift.
struct LayerMatrix {
	vcg::Point3d column[3], shift;
	double determinant, norm;  ///< of the directions; Frobenius norm

	/// @throws Error{BadFrame} when it is not finite, not affine or singular
	explicit LayerMatrix(const vcg::Matrix44d& toWorld)
	{
		const auto bad = [](const char* why) { throw Error(ErrorCode::BadFrame, why); };
		for (int i = 0; i < 3; ++i) {
			for (int j = 0; j < 3; ++j) column[j][i] = toWorld.ElementAt(i, j);
			shift[i] = toWorld.ElementAt(i, 3);
		}
		for (const vcg::Point3d& p : {column[0], column[1], column[2], shift})
			if (!IsFinite(p)) bad("the layer's matrix is not finite");
		for (int j = 0; j < 4; ++j)
			if (toWorld.ElementAt(3, j) != (j == 3 ? 1 : 0)) bad("the layer's matrix is not affine");
		determinant = (column[0] ^ column[1]) * column[2];
		norm = std::sqrt(column[0].SquaredNorm() + column[1].SquaredNorm() + column[2].SquaredNorm());
		if (!(std::abs(determinant) > std::numeric_limits<double>::epsilon() * norm * norm * norm))
			bad("the layer's matrix is singular");
	}
};

inline LabelSpace::LabelSpace(const LabelFrame& f, const vcg::Point2d& middle) : perspective_(f.perspective)
{
	constexpr double orthonormality = 1e-9;  // what a caller's rounding may leave
	const auto bad = [](const char* why) { throw Error(ErrorCode::BadFrame, why); };
	for (const vcg::Point3d& p : {f.origin, f.u, f.v, f.w, f.center})
		if (!IsFinite(p)) bad("the frame is not finite");
	for (const double d :
	     {f.u * f.u - 1, f.v * f.v - 1, f.w * f.w - 1, f.u * f.v, f.v * f.w, f.w * f.u, (f.u ^ f.v) * f.w - 1})
		if (!(std::abs(d) < orthonormality)) bad("the frame is not orthonormal and right-handed");
	const LayerMatrix layer(f.toWorld);
	const vcg::Point3d* const column = layer.column;
	const double det = layer.determinant;
	scale_ = layer.norm;
	// a rigid layer: of all matrices of determinant 1 it has the least Frobenius norm; elsewhere that bound is enough
	if (std::abs(det) == 1 && scale_ * scale_ <= 3 * (1 + orthonormality)) scale_ = 1;
	mirrors_ = det < 0;
	const vcg::Point3d inverseRow[3] = {(column[1] ^ column[2]) / det, (column[2] ^ column[0]) / det,
	                                    (column[0] ^ column[1]) / det};
	const vcg::Point3d axis[3] = {f.u, f.v, f.w};
	for (int i = 0; i < 3; ++i)
		for (int j = 0; j < 3; ++j) {
			meshToLabel_[i][j] = axis[i] * column[j];
			labelToMesh_[i][j] = inverseRow[i] * axis[j];
		}
	meshOrigin_ = multiply(inverseRow, f.origin - layer.shift);
	if (perspective_) {
		const vcg::Point3d c = f.center - f.origin;
		center_ = {f.u * c, f.v * c, f.w * c};
		if (!(center_[2] > 0)) bad("the centre of projection is not in front of the label plane");
		nearestZ_ = center_[2] * (1 - nearPlane);
	}
	if (f.wrapRadius == 0) return;
	if (f.perspective) bad("a wrapped label is projected towards its axis, from no centre");
	if (!std::isfinite(f.wrapRadius) || !IsFinite(f.wrapAxis)) bad("the axis is not finite");
	if (!(std::abs(f.wrapAxis * f.wrapAxis - 1) < orthonormality) || !(std::abs(f.wrapAxis * f.w) < orthonormality))
		bad("the axis is not a unit vector across the line of sight");
	radius_ = f.wrapRadius;
	across_ = {f.wrapAxis * f.v, -(f.wrapAxis * f.u)};
	across_ /= across_.Norm();
	middle_ = (across_ * middle) / radius_;
	middleSine_ = std::sin(middle_);
	middleCosine_ = std::cos(middle_);
}

}  // namespace vcg::textlabel
