#pragma once
// Rounding to the coordinates that files keep.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace vcg::textlabel {

/// The float32 nearest to x, as a double.
/// GCC 12 at -O2 drops the rounding of double(float(x)) when it vectorises a loop of them, so the float is really stored.
inline double RoundToFloat(double x)
{
	volatile const float stored = static_cast<float>(x);
	return static_cast<double>(stored);
}

/// A finite number as it comes back from a text.
/// @param[in] digits  > 0: significant ones, as printf's %g; < 0: decimals, as %f
inline double RoundToDigits(double x, int digits)
{
	char text[400];  // 309 digits before the point, and room for decimals
	if (digits > 0) std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
	else std::snprintf(text, sizeof text, "%.*f", -digits, x);
	return std::strtod(text, nullptr);
}

/// The step between numbers of this size in a text.
inline double StepOfDigits(double x, int digits)
{
	return std::pow(10.0, digits > 0 ? std::floor(std::log10(std::max(x, 1e-300))) + 1 - digits : digits);
}

}  // namespace vcg::textlabel
