#pragma once
// Fractions of whole numbers: slow, short, and right, to check fast code against on small whole input.

#include <array>
#include <cassert>
#include <vector>

namespace oracle {

__extension__ typedef __int128 Wide;

/// A reduced fraction; the denominator is positive. Aborts on overflow rather than being wrong.
class Fraction {
public:
	Fraction(Wide numerator = 0, Wide denominator = 1) : n(numerator), d(denominator)
	{
		Wide a = n < 0 ? -n : n, b = d < 0 ? -d : d;
		while (b != 0) {
			const Wide rest = a % b;
			a = b;
			b = rest;
		}
		if (d < 0) a = -a;
		n /= a;
		d /= a;
	}
	int sign() const { return (n > 0) - (n < 0); }
	friend Fraction operator*(const Fraction& a, const Fraction& b) { return {Times(a.n, b.n), Times(a.d, b.d)}; }
	friend Fraction operator/(const Fraction& a, const Fraction& b) { return {Times(a.n, b.d), Times(a.d, b.n)}; }
	friend Fraction operator+(const Fraction& a, const Fraction& b)
	{
		return {Times(a.n, b.d) + Times(b.n, a.d), Times(a.d, b.d)};
	}
	friend Fraction operator-(const Fraction& a, const Fraction& b) { return a + Fraction(-b.n, b.d); }
	friend bool operator==(const Fraction& a, const Fraction& b) { return a.n == b.n && a.d == b.d; }

private:
	static Wide Times(Wide a, Wide b)
	{
		Wide product;
		if (__builtin_mul_overflow(a, b, &product)) std::abort();
		return product;
	}
	Wide n, d;
};

using Point = std::array<Fraction, 3>;
using Triangle = std::array<Point, 3>;

inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator*(const Point& a, const Fraction& s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline Fraction Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point Cross(const Point& a, const Point& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Point Normal(const Triangle& t) { return Cross(t[1] - t[0], t[2] - t[0]); }
inline bool IsZero(const Point& p) { return Dot(p, p).sign() == 0; }

/// The part of a convex point set (given by its extreme points, and perhaps others) where normal·(p - on) >= 0.
inline std::vector<Point> Clip(const std::vector<Point>& points, const Point& on, const Point& normal)
{
	std::vector<Point> kept;
	std::vector<Fraction> height;
	for (const Point& p : points) height.push_back(Dot(normal, p - on));
	for (size_t i = 0; i < points.size(); ++i) {
		if (height[i].sign() >= 0) kept.push_back(points[i]);
		for (size_t j = 0; j < i; ++j)
			if (height[i].sign() * height[j].sign() < 0)
				kept.push_back(points[i] + (points[j] - points[i]) * (height[i] / (height[i] - height[j])));
	}
	return kept;
}

/// Points whose convex hull is what two triangles with area have in common: a clipped by the plane and the sides of b.
inline std::vector<Point> Common(const Triangle& a, const Triangle& b)
{
	const Point n = Normal(b);
	std::vector<Point> points = Clip(Clip({a[0], a[1], a[2]}, b[0], n), b[0], n * Fraction(-1));
	for (size_t i = 0; i < 3; ++i) points = Clip(points, b[i], Cross(n, b[(i + 1) % 3] - b[i]));
	return points;
}

/// Whether a point of the triangle's plane lies inside it, off its border.
inline bool IsInside(const Point& p, const Triangle& t)
{
	const Point n = Normal(t);
	for (size_t i = 0; i < 3; ++i)
		if (Dot(Cross(n, t[(i + 1) % 3] - t[i]), p - t[i]).sign() <= 0) return false;
	return true;
}

}  // namespace oracle
