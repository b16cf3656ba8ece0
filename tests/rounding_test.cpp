// Rounding: how the coordinates of a mesh are stored or saved.

#include "vcg_ext/rounding.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace {

using vcg::textlabel::Precision;

TEST(Precision, UlpIsTheStepBetweenNumbers)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> exponent(-30, 30);
	for (int n = 0; n < 1000; ++n) {
		const double x = std::exp(exponent(random));
		const float f =
			std::nextafter(static_cast<float>(x), 0.0f);  // not above x: float may round up to the next power of two
		EXPECT_EQ((Precision{true}.ulp(double(f))), double(std::nextafter(f, 1e38f)) - double(f)) << f;
		EXPECT_EQ((Precision{false}.ulp(x)), std::nextafter(x, 1e300) - x);
		EXPECT_EQ((Precision{true}.round(x)), double(static_cast<float>(x)));
		EXPECT_EQ((Precision{false}.round(x)), x);
	}
	EXPECT_GT(Precision{true}.ulp(0), 0);
}

TEST(Precision, TextFilesHaveStepsOfTheirOwn)
{
	const Precision six{true, false, 6}, decimals{true, true, -6};
	EXPECT_EQ(six.ulp(1023), 0.01);
	EXPECT_EQ(six.ulp(999), 0.001);
	EXPECT_EQ(six.round(1005.006), double(1005.01f));
	EXPECT_EQ(six.round(-0.00123456789), double(-0.00123457f));
	EXPECT_EQ(six.round(0), 0);
	EXPECT_EQ((Precision{false, true, 6}.round(1005.006)), 1005.01);
	EXPECT_EQ(decimals.ulp(0.001), 1e-6);
	EXPECT_EQ(decimals.ulp(1e6), Precision{true}.ulp(1e6)) << "single precision is the coarser one";
	EXPECT_EQ(decimals.round(1.23e-5), double(1.2e-5f));
	EXPECT_FALSE((Precision{false, true, 6}.isExact()));
	EXPECT_TRUE((Precision{false, true}.isExact()));
}

// What is said to stay is not rounded at all: of a mesh's own coordinates, floats where it has floats.
TEST(Precision, KeepsWhatTheMeshStores)
{
	const double third = 1.0 / 3, stored = float(third);
	for (const bool isFloat : {true, false})
		for (const bool storesDouble : {true, false})
			for (const int digits : {0, 6}) {
				const Precision p{isFloat, storesDouble, digits};
				const double coordinate = storesDouble ? third : stored;
				EXPECT_EQ(p.keepsStored(), p.round(coordinate) == coordinate) << isFloat << storesDouble << digits;
			}
}

}  // namespace
