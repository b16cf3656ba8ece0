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

/// A circle through a cut of the surface.
struct CutCircle {
	Point3d axis;    ///< unit
	Point3d center;  ///< in the plane of the cut
	double radius = 0;
	double roughness = 0;  ///< root mean square of how far the cut is from it, in radii
	double arc = 0;        ///< radians of it that the cut reaches over
};

Eigen::Vector3d ToEigen(const Point3d& p) { return {p[0], p[1], p[2]}; }

/// The directions across which the normals vary least: once about their mean, as on a cone, and once about zero, as on a cylinder of
/// which a small piece is seen.
std::array<Point3d, 2> DirectionsAcrossNormals(const SurfacePatch& surface)
{
	Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
	Eigen::Vector3d sum = Eigen::Vector3d::Zero();
	double area = 0;
	for (const auto& t : surface.triangles) {
		const Eigen::Vector3d n = ToEigen((t[1] - t[0]) ^ (t[2] - t[0]));
		const double size = n.norm();
		if (!(size > 0)) continue;
		moments += n * n.transpose() / size;
		sum += n;
		area += size;
	}
	std::array<Point3d, 2> directions;
	for (size_t i = 0; i < 2; ++i) {
		const Eigen::Matrix3d m = i == 0 ? Eigen::Matrix3d(moments - sum * sum.transpose() / area) : moments;
		const Eigen::Vector3d least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors().col(0);
		directions[i] = {least[0], least[1], least[2]};
	}
	return directions;
}

/// Lay a circle through the cut of a surface with the plane across an axis through a place.
/// Source: I. Kasa, "A circle fitting procedure and its error analysis", IEEE Transactions on Instrumentation and Measurement 25
/// (1976); differs in: points count by the length of the pieces that they end.
std::optional<CutCircle> CircleAcross(const SurfacePatch& surface, const Point3d& place, const Point3d& axis)
{
	const Point3d across = std::abs(axis[0]) < 0.6 ? Point3d(1, 0, 0) : Point3d(0, 1, 0);
	const Point3d x = (across ^ axis) / (across ^ axis).Norm(), y = axis ^ x;
	struct Weighed {
		Eigen::Vector2d p;
		double weight;
	};
	std::vector<Weighed> points;
	double size = 0;
	for (const auto& t : surface.triangles) {
		Eigen::Vector2d end[2];
		int ends = 0;
		for (size_t k = 0; k < 3 && ends < 2; ++k) {
			const Point3d a = t[k] - place, b = t[(k + 1) % 3] - place;
			const double za = a * axis, zb = b * axis;
			if ((za < 0) == (zb < 0)) continue;
			const Point3d q = a + (b - a) * (za / (za - zb));
			end[ends++] = {q * x, q * y};
		}
		if (ends < 2) continue;
		const double length = (end[1] - end[0]).norm();
		for (const Eigen::Vector2d& p : end) {
			points.push_back({p, length});
			size = std::max(size, p.norm());
		}
	}
	if (!(size > 0)) return std::nullopt;
	Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
	Eigen::Vector3d right = Eigen::Vector3d::Zero();
	double weights = 0;
	for (Weighed& w : points) {
		w.p /= size;
		const Eigen::Vector3d row(w.p[0], w.p[1], 1);
		normal += w.weight * row * row.transpose();
		right += w.weight * w.p.squaredNorm() * row;
		weights += w.weight;
	}
	constexpr double leastBend = 1e-10;  // of the normal equations: below it, a line
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
	if (!(solver.eigenvalues()[0] > leastBend * solver.eigenvalues()[2])) return std::nullopt;
	const Eigen::Vector3d solution = normal.ldlt().solve(right);
	const Eigen::Vector2d center = solution.head<2>() / 2;
	const double radius = std::sqrt(solution[2] + center.squaredNorm());
	if (!std::isfinite(radius) || !(radius > 0)) return std::nullopt;
	CutCircle circle{axis, place + (x * center[0] + y * center[1]) * size, radius * size};
	double squares = 0, low = 0, high = 0;
	const Eigen::Vector2d middle = -center / center.norm();  // the place, seen from the centre
	for (const Weighed& w : points) {
		const Eigen::Vector2d d = w.p - center;
		squares += w.weight * std::pow(d.norm() / radius - 1, 2);
		const double angle = std::atan2(middle[0] * d[1] - middle[1] * d[0], middle.dot(d));
		low = std::min(low, angle);
		high = std::max(high, angle);
	}
	circle.roughness = std::sqrt(squares / weights);
	circle.arc = high - low;
	return circle;
}

/// The roundest cut; the earlier direction when it is nearly as good.
std::optional<CutCircle> RoundestCut(const SurfacePatch& surface, const LabelFrame& frame)
{
	constexpr double nearlyAsGood = 1.5, roundings = 1e-5;
	const std::array<Point3d, 2> found = DirectionsAcrossNormals(surface);
	std::optional<CutCircle> best;
	for (const Point3d& axis : {frame.v, frame.u, found[0], found[1]}) {
		const std::optional<CutCircle> circle = CircleAcross(surface, frame.origin, axis);
		if (!circle) continue;
		if (!best || circle->roughness * nearlyAsGood + roundings < best->roughness) best = circle;
	}
	return best;
}

/// The frame at the same place, across an axis that passes at `center`.
LabelFrame FrameRound(const LabelFrame& frame, const Point3d& axis, const Point3d& center)
{
	LabelFrame f = frame;
	Point3d away = frame.origin - center;
	away -= axis * (away * axis);
	const double radius = away.Norm();
	const bool isInside = away * frame.w < 0;
	f.w = isInside ? -away / radius : away / radius;
	f.wrapAxis = axis - f.w * (axis * f.w);
	f.wrapAxis /= f.wrapAxis.Norm();
	f.wrapRadius = isInside ? -radius : radius;
	f.perspective = false;
	const Point3d side = f.wrapAxis ^ f.w;
	f.v = f.wrapAxis;
	for (const Point3d& up : {-f.wrapAxis, side, -side})
		if (up * frame.v > f.v * frame.v + 1e-9) f.v = up;
	f.u = f.v ^ f.w;
	return f;
}

}  // namespace

LabelFrame WrappedFrame(const LabelFrame& frame, double diagonal, const SurfaceAround& surface)
{
	constexpr double first = 1.0 / 16, enough = 1.2, least = 0.1, roughest = 0.1, largest = 20;  // of the diagonal; radians; radii
	const Point3d towards = frame.perspective ? frame.center - frame.origin : frame.w;
	const LabelFrame parallel = vcg::textlabel::FrameFromDirection(frame.origin, towards, frame.v);
	std::optional<CutCircle> circle;
	for (double halfSide = first * diagonal; halfSide < 2 * diagonal; halfSide *= 2) {
		const SurfacePatch patch = surface(parallel, halfSide);
		if (patch.triangles.empty()) break;
		circle = RoundestCut(patch, parallel);
		if ((circle && circle->arc >= enough) || patch.isWhole) break;
	}
	if (!circle || circle->arc < least || circle->roughness > roughest || circle->radius > largest * diagonal)
		throw RequestError(RequestProblem::NoAxis, "wrap");
	return FrameRound(parallel, circle->axis, circle->center);
}

LabelFrame WrappedFrame(const LabelFrame& frame, double radius)
{
	LabelFrame f = frame;
	f.perspective = false;
	f.wrapAxis = frame.v;
	f.wrapRadius = radius;
	return f;
}

}  // namespace textlabel
