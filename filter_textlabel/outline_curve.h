#pragma once
// Outlines as fonts draw them: closed contours of lines, quadratic and cubic Bézier curves.

#include <array>
#include <vector>
#include <vcg/space/box2.h>
#include <vcg/space/point2.h>

namespace textlabel {

/// A Bézier curve of degree 1, 2 or 3; p[0] is its start, p[degree] and all after it are its end.
struct CurvePiece {
	int degree;
	std::array<vcg::Point2d, 4> p;

	static CurvePiece Line(const vcg::Point2d& a, const vcg::Point2d& b) { return {1, {a, b, b, b}}; }
	static CurvePiece Quadratic(const vcg::Point2d& a, const vcg::Point2d& b, const vcg::Point2d& c)
	{
		return {2, {a, b, c, c}};
	}
	static CurvePiece Cubic(const vcg::Point2d& a, const vcg::Point2d& b, const vcg::Point2d& c, const vcg::Point2d& d)
	{
		return {3, {a, b, c, d}};
	}

	const vcg::Point2d& start() const { return p[0]; }
	const vcg::Point2d& end() const { return p[static_cast<std::size_t>(degree)]; }
};

/// A closed curve: each piece starts where the one before it ends, the first where the last ends.
using CurveContour = std::vector<CurvePiece>;

/// A map of the plane that keeps lines straight: x' = xx x + xy y + dx, y' = yx x + yy y + dy.
struct Affine {
	double xx = 1, xy = 0, yx = 0, yy = 1, dx = 0, dy = 0;

	vcg::Point2d operator()(const vcg::Point2d& q) const
	{
		return {xx * q[0] + xy * q[1] + dx, yx * q[0] + yy * q[1] + dy};
	}
	/// First `inner`, then this.
	Affine after(const Affine& inner) const;
};

/// Point at parameter t in [0, 1], by de Casteljau's rule.
vcg::Point2d PointAt(const CurvePiece& piece, double t);

std::vector<CurveContour> Mapped(const std::vector<CurveContour>& contours, const Affine& map);

/// Box of the curves themselves, not of their control points; null when there is none.
vcg::Box2d BoxOf(const std::vector<CurveContour>& contours);

}  // namespace textlabel
