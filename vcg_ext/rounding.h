#pragma once
// Rounding: to the coordinates that files keep, and of the arithmetic itself.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace vcg::textlabel {

/// Relative: far more than what the sums and products of a check in doubles are off by.
constexpr double kFarAboveRounding = 1e4 * std::numeric_limits<double>::epsilon();

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

/// How the coordinates of a mesh are stored or saved.
struct Precision {
	bool isFloat = true;        ///< float32, else float64: what the label has to survive
	bool storesDouble = false;  ///< the mesh itself keeps what is not rounded, which has to be right as well
	int fileDigits = 0;         ///< of a text file that the label has to survive: see RoundToDigits; 0: it keeps all

	/// Whether it keeps doubles as they are.
	bool isExact() const { return !isFloat && fileDigits == 0; }
	/// Whether a coordinate of the mesh stays as it is.
	bool keepsStored() const { return fileDigits == 0 && !(isFloat && storesDouble); }
	double round(double x) const
	{
		const double read = fileDigits == 0 ? x : RoundToDigits(storesDouble ? x : RoundToFloat(x), fileDigits);
		return isFloat ? RoundToFloat(read) : read;
	}
	/// The step between coordinates of this size.
	double ulp(double largest) const
	{
		const int digits = isFloat ? std::numeric_limits<float>::digits : std::numeric_limits<double>::digits;
		const double least =
			isFloat ? double(std::numeric_limits<float>::denorm_min()) : std::numeric_limits<double>::denorm_min();
		const double step = largest > 0 ? std::max(std::ldexp(1.0, std::ilogb(largest) + 1 - digits), least) : least;
		return fileDigits == 0 ? step : std::max(step, StepOfDigits(largest, fileDigits));
	}
};

}  // namespace vcg::textlabel
