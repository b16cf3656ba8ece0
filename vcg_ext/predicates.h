#pragma once
// Exact signs of determinants: on which side of a line or plane a point lies.
//
// Every sidedness decision of the library goes through here, so that two triangles that share an edge never disagree about a
// point near it. A floating-point filter answers nearly always; when it cannot vouch for the sign, the determinant is computed
// without rounding as an expansion, a sum of doubles of decreasing size that do not overlap.
//
// Domain: finite coordinates that are zero or of magnitude 1e-60 .. 1e60; within it nothing over- or underflows and the sign is
// exact. Every float32 value is in the domain too, the denormal ones included, since all are multiples of 2^-149.
//
// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
// Computational Geometry 18 (1997); written anew. Differs in: one exact stage instead of four adaptive ones. Zero components
// are dropped on the way, so that float32 input, whose differences are mostly exact, stays short and fast by itself.

#include <array>
#include <cfloat>
#include <cmath>
#include <limits>
#include <vcg/space/point2.h>
#include <vcg/space/point3.h>

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST)
#error "exact predicates need IEEE arithmetic in the order written: compile without -ffast-math"
#endif

namespace vcg::textlabel {

static_assert(std::numeric_limits<double>::is_iec559 && std::numeric_limits<double>::digits == 53,
              "needs IEEE doubles");
static_assert(FLT_EVAL_METHOD == 0, "needs doubles that are not kept in wider registers");

/// Side of the line a→b on which c lies.
/// @return +1 left (abc is counter-clockwise), -1 right, 0 exactly collinear or two points equal
int Orient2d(const vcg::Point2d& a, const vcg::Point2d& b, const vcg::Point2d& c);

/// Side of the plane abc on which d lies.
/// @return +1 where the normal (b-a)×(c-a) points, -1 behind, 0 exactly coplanar or abc collinear
int Orient3d(const vcg::Point3d& a, const vcg::Point3d& b, const vcg::Point3d& c, const vcg::Point3d& d);

namespace detail {

/// Half an ulp of 1: the relative error of one rounded operation.
constexpr double kRoundoff = std::numeric_limits<double>::epsilon() / 2;
// Errors of the filters, relative to the sum of the magnitudes of the terms: Shewchuk, figures 21, 23 (A).
constexpr double kOrient2dError = (3 + 16 * kRoundoff) * kRoundoff;
constexpr double kOrient3dError = (7 + 56 * kRoundoff) * kRoundoff;

inline int Sign(double x) { return (x > 0) - (x < 0); }

/// An exact number: the sum of x[0 .. n-1], increasing in magnitude, none zero, non-overlapping; n = 0 is zero.
template <int Capacity>
struct Expansion {
	std::array<double, size_t(Capacity)> x;
	int n = 0;

	/// The largest component outweighs the sum of all the others.
	int sign() const { return n == 0 ? 0 : Sign(x[static_cast<size_t>(n) - 1]); }
	void push(double v)
	{
		if (v != 0) x[static_cast<size_t>(n++)] = v;
	}
};

/// A rounded result and what the rounding lost: sum + lost is exact.
struct Rounded {
	double sum, lost;
};

inline Rounded TwoSum(double a, double b)
{
	const double sum = a + b, bRound = sum - a, aRound = sum - bRound;
	return {sum, (a - aRound) + (b - bRound)};
}

/// As TwoSum, for |a| >= |b|.
inline Rounded FastTwoSum(double a, double b)
{
	const double sum = a + b;
	return {sum, b - (sum - a)};
}

inline Rounded TwoProduct(double a, double b)
{
	const double product = a * b;
	return {product, std::fma(a, b, -product)};
}

/// a - b, exactly.
inline Expansion<2> Difference(double a, double b)
{
	const Rounded d = TwoSum(a, -b);
	Expansion<2> e;
	e.push(d.lost);
	e.push(d.sum);
	return e;
}

/// e + f, exactly, into h, which must be empty and no part of e or f (Shewchuk's Fast-Expansion-Sum, zeros dropped).
template <int N, int M, int H>
void AddInto(const Expansion<N>& e, const Expansion<M>& f, Expansion<H>& h)
{
	size_t i = 0, j = 0;
	const size_t en = static_cast<size_t>(e.n), fn = static_cast<size_t>(f.n);
	const auto next = [&] {
		return j == fn || (i < en && std::fabs(e.x[i]) < std::fabs(f.x[j])) ? e.x[i++] : f.x[j++];
	};
	if (en + fn == 0) return;
	double q = next();
	for (size_t k = 1; k < en + fn; ++k) {
		const Rounded r = TwoSum(q, next());
		h.push(r.lost);
		q = r.sum;
	}
	h.push(q);
}

template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f)
{
	Expansion<N + M> h;
	AddInto(e, f, h);
	return h;
}

template <int N>
Expansion<N> operator-(Expansion<N> e)
{
	for (size_t i = 0; i < static_cast<size_t>(e.n); ++i) e.x[i] = -e.x[i];
	return e;
}

/// e * b, exactly (Shewchuk's Scale-Expansion, zeros dropped).
template <int N>
Expansion<2 * N> operator*(const Expansion<N>& e, double b)
{
	Expansion<2 * N> h;
	if (e.n == 0) return h;
	const Rounded first = TwoProduct(e.x[0], b);
	double q = first.sum;
	h.push(first.lost);
	for (size_t i = 1; i < static_cast<size_t>(e.n); ++i) {
		const Rounded product = TwoProduct(e.x[i], b), low = TwoSum(q, product.lost);
		h.push(low.lost);
		const Rounded high = FastTwoSum(product.sum, low.sum);
		h.push(high.lost);
		q = high.sum;
	}
	h.push(q);
	return h;
}

/// e * f, exactly: e scaled by each component of f, summed in two buffers by turns.
template <int N, int M>
Expansion<2 * N * M> operator*(const Expansion<N>& e, const Expansion<M>& f)
{
	Expansion<2 * N * M> sums[2];
	size_t from = 0;
	for (size_t i = 0; i < static_cast<size_t>(f.n); ++i, from = 1 - from) {
		sums[1 - from].n = 0;
		AddInto(sums[from], e * f.x[i], sums[1 - from]);
	}
	return sums[from];
}

// Equal points, such as corners that two triangles share, are why most exact signs are asked for: they need no expansion.

inline int Orient2dExact(const vcg::Point2d& a, const vcg::Point2d& b, const vcg::Point2d& c)
{
	if (a == b || b == c || c == a) return 0;
	const auto acx = Difference(a[0], c[0]), acy = Difference(a[1], c[1]);
	const auto bcx = Difference(b[0], c[0]), bcy = Difference(b[1], c[1]);
	return (acx * bcy + -(acy * bcx)).sign();
}

inline int Orient3dExact(const vcg::Point3d& a, const vcg::Point3d& b, const vcg::Point3d& c, const vcg::Point3d& d)
{
	if (a == b || a == c || a == d || b == c || b == d || c == d) return 0;
	const auto abx = Difference(b[0], a[0]), aby = Difference(b[1], a[1]), abz = Difference(b[2], a[2]);
	const auto acx = Difference(c[0], a[0]), acy = Difference(c[1], a[1]), acz = Difference(c[2], a[2]);
	const auto adx = Difference(d[0], a[0]), ady = Difference(d[1], a[1]), adz = Difference(d[2], a[2]);
	const auto nx = aby * acz + -(abz * acy), ny = abz * acx + -(abx * acz), nz = abx * acy + -(aby * acx);
	return (nx * adx + ny * ady + nz * adz).sign();
}

}  // namespace detail

// In the two filters a size of zero means that every term is exactly zero, as in axis-parallel planes: nothing underflows
// within the domain, and a rounded difference is zero only for equal coordinates.

inline int Orient2d(const vcg::Point2d& a, const vcg::Point2d& b, const vcg::Point2d& c)
{
	const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
	const double size = std::fabs(left) + std::fabs(right);
	const double det = left - right, bound = detail::kOrient2dError * size;
	if (det > bound || -det > bound || size == 0) return detail::Sign(det);
	return detail::Orient2dExact(a, b, c);
}

inline int Orient3d(const vcg::Point3d& a, const vcg::Point3d& b, const vcg::Point3d& c, const vcg::Point3d& d)
{
	const double abx = b[0] - a[0], aby = b[1] - a[1], abz = b[2] - a[2];
	const double acx = c[0] - a[0], acy = c[1] - a[1], acz = c[2] - a[2];
	const double adx = d[0] - a[0], ady = d[1] - a[1], adz = d[2] - a[2];
	const double yz = aby * acz, zy = abz * acy, zx = abz * acx, xz = abx * acz, xy = abx * acy, yx = aby * acx;
	const double det = (yz - zy) * adx + (zx - xz) * ady + (xy - yx) * adz;
	const double size = (std::fabs(yz) + std::fabs(zy)) * std::fabs(adx) +
	                    (std::fabs(zx) + std::fabs(xz)) * std::fabs(ady) +
	                    (std::fabs(xy) + std::fabs(yx)) * std::fabs(adz);
	const double bound = detail::kOrient3dError * size;
	if (det > bound || -det > bound || size == 0) return detail::Sign(det);
	return detail::Orient3dExact(a, b, c, d);
}

}  // namespace vcg::textlabel
