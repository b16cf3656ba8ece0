#include "outline_curve.h"

#include <cmath>

namespace textlabel {
namespace {

/// Parameters of the extremes of one coordinate inside a piece: the roots of the derivative.
/// @return how many, at most 2; in (0, 1)
int Extremes(const CurvePiece& piece, int axis, std::array<double, 2>& roots)
{
	const auto c = [&](std::size_t i) { return piece.p[i][axis]; };
	// derivative, up to a factor, as a t² + b t + d
	double a = 0, b = 0, d = 0;
	if (piece.degree == 2) {
		b = c(0) - 2 * c(1) + c(2);
		d = c(1) - c(0);
	} else if (piece.degree == 3) {
		a = c(3) - 3 * c(2) + 3 * c(1) - c(0);
		b = 2 * (c(2) - 2 * c(1) + c(0));
		d = c(1) - c(0);
	}
	int count = 0;
	const auto keep = [&](double t) {
		if (t > 0 && t < 1) roots[static_cast<std::size_t>(count++)] = t;
	};
	const double discriminant = b * b - 4 * a * d;
	if (a == 0 && b == 0) return 0;
	if (discriminant < 0) return 0;
	// q has the sign of b, so that no digits cancel; it serves the linear case (a == 0) as well
	const double q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
	if (a != 0) keep(q / a);
	if (q != 0) keep(d / q);
	return count;
}

}  // namespace

Affine Affine::after(const Affine& inner) const
{
	const vcg::Point2d shift = (*this)({inner.dx, inner.dy});
	return {xx * inner.xx + xy * inner.yx,
	        xx * inner.xy + xy * inner.yy,
	        yx * inner.xx + yy * inner.yx,
	        yx * inner.xy + yy * inner.yy,
	        shift[0],
	        shift[1]};
}

vcg::Point2d PointAt(const CurvePiece& piece, double t)
{
	std::array<vcg::Point2d, 4> q = piece.p;
	for (std::size_t left = static_cast<std::size_t>(piece.degree); left > 0; --left)
		for (std::size_t i = 0; i < left; ++i) q[i] = q[i] * (1 - t) + q[i + 1] * t;
	return q[0];
}

std::vector<CurveContour> Mapped(const std::vector<CurveContour>& contours, const Affine& map)
{
	std::vector<CurveContour> result = contours;
	for (CurveContour& contour : result) {
		for (CurvePiece& piece : contour) {
			for (vcg::Point2d& p : piece.p) p = map(p);
		}
	}
	return result;
}

vcg::Box2d BoxOf(const std::vector<CurveContour>& contours)
{
	vcg::Box2d box;
	for (const CurveContour& contour : contours) {
		for (const CurvePiece& piece : contour) {
			box.Add(piece.start());
			for (int axis = 0; axis < 2; ++axis) {
				std::array<double, 2> roots{};
				const int count = Extremes(piece, axis, roots);
				for (int i = 0; i < count; ++i) box.Add(PointAt(piece, roots[static_cast<std::size_t>(i)]));
			}
		}
	}
	return box;
}

}  // namespace textlabel
