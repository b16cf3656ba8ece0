// The exact predicates against whole-number arithmetic, on input that is degenerate more often than not.

#include "vcg_ext/predicates.h"

#include <gtest/gtest.h>
#include <random>
#include <utility>

#if __has_include(<boost/multiprecision/cpp_int.hpp>)
#include <boost/multiprecision/cpp_int.hpp>
#define TEXTLABEL_TEST_HAS_BIG_INTEGERS 1
#endif

namespace {

using namespace vcg::textlabel;
using vcg::Point2d;
using vcg::Point3d;

__extension__ typedef __int128 Wide;

/// Determinants in whole numbers; Int must hold them without overflow.
template <class Int>
int Orient2dWhole(const std::array<std::array<Int, 2>, 3>& p)
{
	const auto& [a, b, c] = p;
	const Int det = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
	return (det > 0) - (det < 0);
}

template <class Int>
Int Determinant3(const std::array<std::array<Int, 3>, 3>& r)
{
	return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
	       r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

template <class Int>
int Orient3dWhole(const std::array<std::array<Int, 3>, 4>& p)
{
	std::array<std::array<Int, 3>, 3> rows;
	for (size_t i = 0; i < 3; ++i)
		for (size_t k = 0; k < 3; ++k) rows[i][k] = p[i + 1][k] - p[0][k];
	const Int det = Determinant3(rows);
	return (det > 0) - (det < 0);
}

int Orient2dOf(const std::array<Point2d, 4>& p) { return Orient2d(p[0], p[1], p[2]); }
int Orient3dOf(const std::array<Point3d, 4>& p) { return Orient3d(p[0], p[1], p[2], p[3]); }

/// One random case in whole numbers and as doubles, the doubles shifted and scaled by powers of two.
template <size_t Dim>
struct WholeCase {
	std::array<std::array<Wide, Dim>, 4> whole;
	std::array<std::conditional_t<Dim == 2, Point2d, Point3d>, 4> scaled;
};

/// Points on a grid: a few steps wide, so that degenerate cases abound, around an offset of up to 2^bits.
template <size_t Dim>
WholeCase<Dim> RandomCase(std::mt19937_64& random, int bits, int exponent)
{
	const long limit = 1L << bits;
	const long width = random() % 2 ? 3 : limit;
	std::uniform_int_distribution<long> step(-width, width), offset(-limit, limit);
	WholeCase<Dim> c;
	for (size_t k = 0; k < Dim; ++k) {
		const long shift = offset(random);
		for (size_t i = 0; i < 4; ++i) {
			c.whole[i][k] = shift + step(random);
			c.scaled[i][static_cast<int>(k)] = std::ldexp(static_cast<double>(c.whole[i][k]), exponent);
		}
	}
	return c;
}

/// The last point becomes a whole combination of the others: exactly on their line or plane.
template <size_t Dim>
void MakeDegenerate(WholeCase<Dim>& c, std::mt19937_64& random, int exponent, size_t last)
{
	std::uniform_int_distribution<int> weight(-2, 2);
	for (size_t k = 0; k < Dim; ++k) c.whole[last][k] = c.whole[0][k];
	for (size_t i = 1; i < last; ++i) {
		const int w = weight(random);
		for (size_t k = 0; k < Dim; ++k) c.whole[last][k] += w * (c.whole[i][k] - c.whole[0][k]);
	}
	for (size_t k = 0; k < Dim; ++k)
		c.scaled[last][static_cast<int>(k)] = std::ldexp(static_cast<double>(c.whole[last][k]), exponent);
}

constexpr int kExponents[] = {-149, -100, -10, 0, 10, 100};  // 1e-45 (the smallest float32), 1e-30, .., 1e30
constexpr int kCases = 20000;

class ExactSign : public ::testing::TestWithParam<int> {};

TEST_P(ExactSign, Orient2dEqualsWholeNumbers)
{
	std::mt19937_64 random(1);
	int zeros = 0;
	for (int n = 0; n < kCases; ++n) {
		auto c = RandomCase<2>(random, 48, GetParam());
		if (n % 4 == 0) MakeDegenerate(c, random, GetParam(), 2);
		const int expected = Orient2dWhole<Wide>({c.whole[0], c.whole[1], c.whole[2]});
		zeros += expected == 0;
		ASSERT_EQ(Orient2dOf(c.scaled), expected) << "case " << n;
	}
	EXPECT_GT(zeros, kCases / 5);
}

TEST_P(ExactSign, Orient3dEqualsWholeNumbers)
{
	std::mt19937_64 random(2);
	int zeros = 0;
	for (int n = 0; n < kCases; ++n) {
		auto c = RandomCase<3>(random, 38, GetParam());
		if (n % 4 == 0) MakeDegenerate(c, random, GetParam(), 3);
		const int expected = Orient3dWhole(c.whole);
		zeros += expected == 0;
		ASSERT_EQ(Orient3dOf(c.scaled), expected) << "case " << n;
	}
	EXPECT_GT(zeros, kCases / 5);
}

INSTANTIATE_TEST_SUITE_P(Scales, ExactSign, ::testing::ValuesIn(kExponents));

// L. Kettner et al., "Classroom examples of robustness problems in geometric computations": the plain formula gets most of
// these wrong. Two of the points lie on y = x, so the sign is that of the third one's y - x.
TEST(ExactSign, ClassroomExample)
{
	const double ulp = std::ldexp(1.0, -53);
	for (int i = 0; i < 256; ++i)
		for (int j = 0; j < 256; ++j) {
			const Point2d p(0.5 + i * ulp, 0.5 + j * ulp), q(12, 12), r(24, 24);
			const double above = p[1] - p[0];
			ASSERT_EQ(Orient2d(q, r, p), (above > 0) - (above < 0)) << i << ' ' << j;
		}
}

// The plane x + y = 1, whose normal as given points to the origin: one ulp of one coordinate decides.
TEST(ExactSign, OneUlpDecides)
{
	const Point3d a(0, 1, 0), b(1, 0, 0), c(0, 1, 1);
	const double small = std::ldexp(1.0, -30);
	const Point3d on(small, 1 - small, 7.3);
	EXPECT_EQ(Orient3d(a, b, c, on), 0);
	for (int k = 0; k < 2; ++k) {
		Point3d beyond = on, before = on;
		beyond[k] = std::nextafter(on[k], 2);
		before[k] = std::nextafter(on[k], -2);
		EXPECT_EQ(Orient3d(a, b, c, beyond), -1) << k;
		EXPECT_EQ(Orient3d(a, b, c, before), 1) << k;
	}
}

TEST(ExactSign, Conventions)
{
	EXPECT_EQ(Orient2d({0, 0}, {1, 0}, {0, 1}), 1);
	EXPECT_EQ(Orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1);
}

#ifdef TEXTLABEL_TEST_HAS_BIG_INTEGERS

using Big = boost::multiprecision::cpp_int;
constexpr int kBigShift = 260;

double RandomWide(std::mt19937_64& random)
{
	std::uniform_real_distribution<double> mantissa(-1, 1);
	std::uniform_int_distribution<int> exponent(-200, 200);
	return random() % 8 ? std::ldexp(mantissa(random), exponent(random)) : 0;
}

/// x * 2^kBigShift, exactly, for |x| a multiple of 2^-kBigShift.
Big Whole(double x)
{
	int exponent = 0;
	const double mantissa = std::frexp(x, &exponent);
	const Big digits = static_cast<long long>(std::ldexp(mantissa, 53));
	const int shift = exponent - 53 + kBigShift;
	return shift >= 0 ? Big(digits << shift) : Big(digits / (Big(1) << -shift));
}

// Coordinates of 1e-60 to 1e60 side by side: expansions of their full length.
TEST(ExactSign, MixedMagnitudes)
{
	std::mt19937_64 random(4);
	for (int n = 0; n < 2000; ++n) {
		std::array<Point3d, 4> p;
		std::array<Point2d, 4> flat;
		std::array<std::array<Big, 3>, 4> whole;
		std::array<std::array<Big, 2>, 4> wholeFlat;
		for (size_t i = 0; i < 4; ++i)
			for (size_t k = 0; k < 3; ++k) {
				const int axis = static_cast<int>(k);
				// coordinates in common make determinants in which most terms cancel
				p[i][axis] = i > 0 && random() % 4 == 0 ? p[i - 1][axis] : RandomWide(random);
				whole[i][k] = Whole(p[i][axis]);
				if (k < 2) flat[i][axis] = p[i][axis], wholeFlat[i][k] = whole[i][k];
			}
		ASSERT_EQ(Orient3dOf(p), Orient3dWhole(whole)) << "case " << n;
		ASSERT_EQ(Orient2dOf(flat), Orient2dWhole<Big>({wholeFlat[0], wholeFlat[1], wholeFlat[2]})) << "case " << n;
	}
}

// Points computed to lie on a plane land within an ulp of it: only the exact stage knows the side.
TEST(ExactSign, RoundedOntoThePlane)
{
	std::mt19937_64 random(5);
	std::uniform_real_distribution<double> unit(-1, 1);
	int sides[3] = {};
	for (int n = 0; n < 5000; ++n) {
		std::array<Point3d, 4> p;
		for (int i = 0; i < 3; ++i) p[static_cast<size_t>(i)] = Point3d(unit(random), unit(random), unit(random));
		p[3] = p[0] + (p[1] - p[0]) * unit(random) + (p[2] - p[0]) * unit(random);
		std::array<std::array<Big, 3>, 4> whole;
		for (size_t i = 0; i < 4; ++i)
			for (size_t k = 0; k < 3; ++k) whole[i][k] = Whole(p[i][static_cast<int>(k)]);
		const int expected = Orient3dWhole(whole);
		ASSERT_EQ(Orient3dOf(p), expected) << "case " << n;
		++sides[expected + 1];
	}
	EXPECT_GT(sides[0], 1000);
	EXPECT_GT(sides[2], 1000);
}

#else
TEST(ExactSign, MixedMagnitudes) { GTEST_SKIP() << "Boost.Multiprecision not found: mixed magnitudes not checked"; }
#endif

}  // namespace
