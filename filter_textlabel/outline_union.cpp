#include "outline_union.h"

#include <cmath>
#include <random>
#include "text_error.h"

namespace textlabel {
namespace {

/// Times that points are moved before giving up.
constexpr int kTrials = 8;
/// What rounding may do to the area: the boundary may be off by so much, grid units.
constexpr double kRounding = 2;

Paths Transposed(Paths rings)
{
	for (Path& ring : rings) {
		for (IntPoint& p : ring) std::swap(p.X, p.Y);
		ClipperLib::ReversePath(ring);
	}
	return rings;
}

struct Clipped {
	bool ok = false;
	Paths rings;
};

Clipped Union(const Paths& rings)
{
	ClipperLib::Clipper clipper;
	clipper.StrictlySimple(true);
	Clipped result;
	// nothing but points and lines: nothing is left, which Clipper would call a failure
	if (!clipper.AddPaths(rings, ClipperLib::ptSubject, true)) return {true, {}};
	result.ok = clipper.Execute(ClipperLib::ctUnion, result.rings, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
	return result;
}

double AreaOf(const Paths& rings)
{
	double area = 0;
	for (const Path& ring : rings) area += ClipperLib::Area(ring);
	return area;
}

double LengthOf(const Paths& rings)
{
	double length = 0;
	for (const GridEdge& e : EdgesOf(rings))
		length += std::hypot(static_cast<double>(e.b.X - e.a.X), static_cast<double>(e.b.Y - e.a.Y));
	return length;
}

Paths Moved(Paths rings, double trifle, unsigned seed)
{
	std::minstd_rand random(seed);  // the same on every machine
	const auto reach = static_cast<cInt>(std::ceil(trifle));
	const auto move = [&] { return static_cast<cInt>(random() % static_cast<unsigned long>(2 * reach + 1)) - reach; };
	for (Path& ring : rings) {
		for (IntPoint& p : ring) {
			p.X += move();
			p.Y += move();
		}
	}
	return rings;
}

}  // namespace

Paths CheckedUnion(const Paths& rings, double trifle)
{
	for (int trial = 0; trial < kTrials; ++trial) {
		const Paths tried = trial == 0 ? rings : Moved(rings, trifle, static_cast<unsigned>(trial));
		Clipped one = Union(tried);
		const Clipped other = Union(Transposed(tried));
		const double slack = kRounding * (LengthOf(tried) + 1);
		if (one.ok && other.ok && std::abs(AreaOf(one.rings) - AreaOf(other.rings)) <= slack)
			return std::move(one.rings);
	}
	throw TextError(TextErrorCode::Unsound, "Clipper fails");
}

}  // namespace textlabel
