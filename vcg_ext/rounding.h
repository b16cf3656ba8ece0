#pragma once
// Rounding to the coordinates that files keep.

namespace vcg::textlabel {

/// The float32 nearest to x, as a double.
/// GCC 12 at -O2 drops the rounding of double(float(x)) when it vectorises a loop of them, so the float is really stored.
inline double RoundToFloat(double x)
{
	volatile const float stored = static_cast<float>(x);
	return static_cast<double>(stored);
}

}  // namespace vcg::textlabel
