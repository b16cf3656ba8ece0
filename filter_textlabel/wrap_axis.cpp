#include "wrap_axis.h"
#include "request_error.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

namespace textlabel {
namespace {

using vcg::Point3d;
using vcg::textlabel::LabelFrame;

/// What an end says of an axis, times what a middle says: see wrap_axis.h.
constexpr double kSayOfEnds = 0.01;

struct Axis {
	Point3d direction;   ///< unit
	Point3d point;       ///< on it
	double radius = 0;   ///< from the place to it
	double outward = 0;  ///< cosine between the facet's normal at the place and the way from the axis to there
	double roughness =
		0;  ///< root mean square of the sines between the normals and the planes through the axis; ends count little
	double arc = 0;  ///< radians round it over which the surface is seen, and its normals turn
};

Eigen::Vector3d ToEigen(const Point3d& p) { return {p[0], p[1], p[2]}; }
Point3d FromEigen(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

/// The angles of vectors round an axis.
class Sector {
public:
	/// @param[in] middle  the angle 0
	Sector(const Point3d& axis, const Point3d& middle) : axis_(axis), middle_(middle) {}
	void add(const Point3d& v)
	{
		const Point3d across = v - axis_ * (v * axis_);
		const double angle = std::atan2((middle_ ^ across) * axis_, middle_ * across);
		low_ = std::min(low_, angle);
		high_ = std::max(high_, angle);
	}
	/// Radians from the first to the last.
	double angle() const { return high_ - low_; }

private:
	const Point3d axis_, middle_;
	double low_ = 0, high_ = 0;
};

/// How the normals move when the surface is turned about lines through a place, and moved: a turn of which they see nothing is one
/// about the axis. Of a turn a and a move m the normal n at p sees (p x n) a + n m.
class Turns {
public:
	/// @param[in] unit  of length, so that turns and moves weigh alike
	/// @param[in] ofEnds  the ends of the folds, else their middles
	Turns(const SurfacePatch& surface, const Point3d& place, double unit, bool ofEnds) : unit_(unit)
	{
		Eigen::Matrix3d turns = Eigen::Matrix3d::Zero();
		double weight = 0;
		for (const FoldPoint& e : surface.folds) {
			if (e.isEnd != ofEnds) continue;
			const Eigen::Vector3d n = ToEigen(e.normal), turn = ToEigen((e.point - place) ^ e.normal) / unit;
			turns += e.weight * turn * turn.transpose();
			moves_ += e.weight * n * n.transpose();
			mixed_ += e.weight * n * turn.transpose();
			weight += e.weight;
		}
		moves_ /= weight;
		mixed_ /= weight;
		const Eigen::Matrix3d inverse = inverseOn(Eigen::Matrix3d::Identity());
		cost_ = turns / weight - mixed_.transpose() * inverse * mixed_;
	}
	/// Units squared: a turn times this times the turn is what the normals see of it, when it has the best move beside it.
	const Eigen::Matrix3d& cost() const { return cost_; }
	/// The move across a turn that goes with it: it brings the turn's axis to where the normals meet.
	Eigen::Vector3d move(const Eigen::Vector3d& turn) const
	{
		const Eigen::Vector3d first = turn.unitOrthogonal();
		Eigen::Matrix<double, 3, 2> across;
		across << first, turn.cross(first);
		return -(inverseOn(across) * (mixed_ * turn)) * unit_;
	}

private:
	/// The inverse of moves_ among the moves in a basis (columns).
	Eigen::Matrix3d inverseOn(const Eigen::MatrixXd& basis) const
	{
		constexpr double free = 1e-8;  // radians squared: no normal looks along such a move, so it helps nothing
		const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> costs(basis.transpose() * moves_ * basis);
		Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
		for (Eigen::Index i = 0; i < basis.cols(); ++i) {
			const Eigen::Vector3d along = basis * costs.eigenvectors().col(i);
			if (costs.eigenvalues()[i] > free) inverse += along * along.transpose() / costs.eigenvalues()[i];
		}
		return inverse;
	}

	const double unit_;
	Eigen::Matrix3d moves_ = Eigen::Matrix3d::Zero(), mixed_ = moves_;
	Eigen::Matrix3d cost_;
};

/// The turns of which little is seen: the least, and all that are as good; columns.
Eigen::MatrixXd LeastSeen(const Eigen::Matrix3d& cost)
{
	constexpr double nothing = 1e-10, asGood = 1e-4, alike = 4;  // units squared; of the worst; times the best
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(cost);
	const Eigen::Vector3d& seen = solver.eigenvalues();
	const double most = std::max({nothing, asGood * seen[2], alike * seen[0]});
	Eigen::Index count = 1;
	while (count < seen.size() && seen[count] <= most) ++count;
	return solver.eigenvectors().leftCols(count);
}

/// The direction about which turns are seen least. Where several are as good, as on a ball, the first of those wished for.
/// The ends always have a say: the middles of a single row are at one height, and of turns about its diameters they see nothing, but
/// for what rounded coordinates do to the normals; that would decide.
Eigen::Vector3d DirectionOf(const Turns& ofMiddles, const Turns& ofEnds, std::initializer_list<Eigen::Vector3d> wishes)
{
	constexpr double enough = 0.5;  // of a wish that is met
	const Eigen::MatrixXd least = LeastSeen(ofMiddles.cost() + kSayOfEnds * ofEnds.cost());
	for (const Eigen::Vector3d& wish : wishes) {
		const Eigen::Vector3d met = least * (least.transpose() * wish);
		if (met.norm() > enough) return met.normalized();
	}
	return least.col(0);
}

/// The axis of a direction to which the normals come nearest.
Axis AxisAlong(const Eigen::Vector3d& direction, const Turns& turns, const SurfacePatch& surface,
               const LabelFrame& frame)
{
	constexpr double onAxis = 0.1;  // of the radius: the tip of a cone has no plane through the axis
	const Eigen::Vector3d center = direction.cross(turns.move(direction));
	Axis axis{FromEigen(direction), frame.origin + FromEigen(center), center.norm()};
	axis.outward = FromEigen(-center) * surface.facetNormal / axis.radius;
	double squares = 0, weight = 0;
	Sector places(axis.direction, FromEigen(-center)), normals(axis.direction, surface.facetNormal);
	for (const FoldPoint& e : surface.folds) {
		Point3d across = e.point - axis.point;
		across -= axis.direction * (across * axis.direction);
		if (e.isEnd && across.Norm() < onAxis * axis.radius) continue;
		const double sine = (axis.direction ^ across) * e.normal / across.Norm();
		const double say = e.weight * (e.isEnd ? kSayOfEnds : 1);
		squares += say * sine * sine;
		weight += say;
		if (e.isEnd) continue;
		places.add(across);
		normals.add(e.normal);
	}
	axis.roughness = std::sqrt(squares / weight);
	axis.arc = std::min(places.angle(), normals.angle());
	return axis;
}

/// Parts are modelled along the axes of the world, and facets hide where exactly an axis points.
/// @param[in] frame  at the place
/// @param[in] unit  of length: about as far as the surface is seen
std::optional<Axis> AxisOf(const SurfacePatch& surface, const LabelFrame& frame, double unit)
{
	constexpr double straight = 0.99996, rougher = 1.1, rough = 0.005;  // cosine of half a degree; times; a sine
	if (surface.folds.empty()) return std::nullopt;
	const Turns turns(surface, frame.origin, unit, false), ofEnds(surface, frame.origin, unit, true);
	const Eigen::Vector3d direction = DirectionOf(turns, ofEnds, {ToEigen(frame.v), ToEigen(frame.u)});
	const Axis axis = AxisAlong(direction, turns, surface, frame);
	if (!std::isfinite(axis.arc + axis.radius + axis.roughness)) return std::nullopt;
	for (const Point3d& p : {frame.v, frame.u, Point3d(1, 0, 0), Point3d(0, 1, 0), Point3d(0, 0, 1)}) {
		if (std::abs(p * axis.direction) < straight) continue;
		const Axis near = AxisAlong(ToEigen(p), turns, surface, frame);
		if (near.roughness <= axis.roughness * rougher + rough) return near;
	}
	return axis;
}

/// Whether the facet at the place lies as one of a turned part does: the axis is behind its middle. Beside a rounded edge a flat side
/// does not, though all that bends there tells of the edge's axis.
bool IsBehindMiddle(const SurfacePatch& surface, const Axis& axis)
{
	constexpr double most = 0.15, wide = 0.3;  // of the radius; on a scan, triangles are small and turned anyhow
	const Point3d across = axis.direction ^ surface.facetNormal;
	double low = std::numeric_limits<double>::infinity(), high = -low;
	for (const Point3d& p : surface.facet) {
		low = std::min(low, (p - axis.point) * across);
		high = std::max(high, (p - axis.point) * across);
	}
	return high - low < wide * axis.radius || std::abs(low + high) / 2 <= most * axis.radius;
}

/// In squares that grow until enough of the arc is seen, or other things that do not belong to it.
std::optional<Axis> FindAxis(const LabelFrame& frame, double diagonal, const SurfaceAround& surface)
{
	constexpr double first = 1.0 / 64, enough = 1.2, least = 0.05;             // of the diagonal; radians
	constexpr double rougher = 2, rough = 0.05, mostTowards = 0.5;             // times; sine, cosine
	constexpr double known = 0.3, same = 0.995, clean = 0.01, little = 0.005;  // radians; cosine; sines
	constexpr double leastOutward = 0.2;  // a flat end looks along the axis, however it is looked at
	std::optional<Axis> found;
	for (double halfSide = first * diagonal; halfSide < 2 * diagonal; halfSide *= 2) {
		const SurfacePatch patch = surface(frame, halfSide);
		const std::optional<Axis> axis = AxisOf(patch, frame, halfSide);
		const auto isAcross = [&](const Point3d& d) { return std::abs(axis->direction * d) < mostTowards; };
		const bool isSeen = axis && axis->arc >= least && (isAcross(frame.w) || isAcross(patch.facetNormal)) &&
		                    std::abs(axis->outward) > leastOutward && IsBehindMiddle(patch, *axis);
		if (found && isSeen) {
			// a branch that comes into sight brings an axis of its own, which fits nearly as well
			const bool isClear = found->arc >= known && found->roughness < clean;
			const bool isAnother = isClear && std::abs(axis->direction * found->direction) < same;
			if (axis->roughness > rougher * found->roughness + (isAnother ? little : rough)) break;
		}
		if (isSeen) found = axis;
		if (patch.isWhole || (found && found->arc >= enough)) break;
	}
	return found;
}

/// The parallel view of a place along the line of sight to it.
LabelFrame Straight(const LabelFrame& frame)
{
	if (!frame.perspective) return frame;
	return vcg::textlabel::FrameFromDirection(frame.origin, frame.center - frame.origin, frame.v);
}

}  // namespace

LabelFrame WrappedFrame(const LabelFrame& frame, double diagonal, const SurfaceAround& surface)
{
	constexpr double roughest = 0.15, largest = 20, nearest = 1e-3;  // a sine; of the diagonal
	const LabelFrame parallel = Straight(frame);
	const std::optional<Axis> axis = FindAxis(parallel, diagonal, surface);
	const bool isFound =
		axis && axis->roughness <= roughest && axis->radius >= nearest * diagonal && axis->radius <= largest * diagonal;
	if (!isFound) throw RequestError(RequestProblem::NoAxis, "wrap");
	const Point3d away = frame.origin - axis->point;
	const bool isInside = axis->outward < 0;
	LabelFrame f = parallel;
	f.w = away / (isInside ? -away.Norm() : away.Norm());
	f.wrapAxis = axis->direction - f.w * (axis->direction * f.w);
	f.wrapAxis /= f.wrapAxis.Norm();
	f.wrapRadius = isInside ? -axis->radius : axis->radius;
	const Point3d side = f.wrapAxis ^ f.w;
	f.v = f.wrapAxis;
	for (const Point3d& up : {-f.wrapAxis, side, -side})
		if (up * parallel.v > f.v * parallel.v) f.v = up;
	f.u = f.v ^ f.w;
	return f;
}

LabelFrame WrappedFrame(const LabelFrame& frame, double radius)
{
	LabelFrame f = Straight(frame);
	f.wrapAxis = f.v;
	f.wrapRadius = radius;
	return f;
}

}  // namespace textlabel
