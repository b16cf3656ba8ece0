#pragma once
// A source of random numbers that gives the same numbers on every machine, from a seed or from a fuzzer's bytes.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vcg/space/point2.h>
#include <vcg/space/point3.h>

namespace vcg::textlabel::test {

class Random {
public:
	explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ULL + 0x632be59bd9b4e019ULL) {}
	/// Numbers are made of the bytes while there are some, so that a coverage-guided fuzzer can steer every choice.
	Random(const std::uint8_t* bytes, size_t size) : Random(size) { bytes_ = bytes, left_ = size; }

	std::uint64_t next()
	{
		std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;  // splitmix64
		if (left_ >= stride) {
			std::memcpy(&z, bytes_, stride);
			bytes_ += stride;
			left_ -= stride;
		}
		z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
		z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
		return z ^ (z >> 31);
	}
	/// Uniform in [0, 1).
	double unit() { return std::ldexp(double(next() >> 11), -53); }
	double real(double low, double high) { return low + (high - low) * unit(); }
	/// Uniform in the exponent.
	double logReal(double low, double high) { return std::exp(real(std::log(low), std::log(high))); }
	/// Uniform in 0 .. count-1.
	int below(int count) { return int(next() % std::uint64_t(count)); }
	int integer(int low, int high) { return low + below(high - low + 1); }
	bool chance(double probability) { return unit() < probability; }
	template <class Value>
	Value pick(std::initializer_list<Value> values)
	{
		return values.begin()[below(int(values.size()))];
	}
	vcg::Point3d direction()
	{
		for (;;) {
			const vcg::Point3d p(real(-1, 1), real(-1, 1), real(-1, 1));
			const double length = p.Norm();
			if (length > 0.1 && length < 1) return p / length;
		}
	}

private:
	static constexpr size_t stride = 2;  // bytes for one number
	std::uint64_t state_;
	const std::uint8_t* bytes_ = nullptr;
	size_t left_ = 0;
};

}  // namespace vcg::textlabel::test
