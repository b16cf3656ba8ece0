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

/// What to do with which rings.
struct Work {
	ClipperLib::ClipType kind = ClipperLib::ctUnion;
	ClipperLib::PolyFillType rule = ClipperLib::pftNonZero;
	Paths one, other;
};

Clipped Clip(const Work& work)
{
	ClipperLib::Clipper clipper;
	clipper.StrictlySimple(true);
	Clipped result;
	// nothing but points and lines: nothing is left, which Clipper would call a failure
	if (!clipper.AddPaths(work.one, ClipperLib::ptSubject, true)) return {true, {}};
	clipper.AddPaths(work.other, ClipperLib::ptClip, true);
	result.ok = clipper.Execute(work.kind, result.rings, work.rule, work.rule);
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

/// Done both ways, and with points moved, until two agree.
Paths Checked(const Work& work, double trifle)
{
	for (int trial = 0; trial < kTrials; ++trial) {
		Work tried = work;
		if (trial > 0) {
			tried.one = Moved(std::move(tried.one), trifle, static_cast<unsigned>(trial));
			tried.other = Moved(std::move(tried.other), trifle, static_cast<unsigned>(trial + kTrials));
		}
		Clipped one = Clip(tried);
		const double slack = kRounding * (LengthOf(tried.one) + LengthOf(tried.other) + 1);
		tried.one = Transposed(std::move(tried.one));
		tried.other = Transposed(std::move(tried.other));
		const Clipped other = Clip(tried);
		if (one.ok && other.ok && std::abs(AreaOf(one.rings) - AreaOf(other.rings)) <= slack)
			return std::move(one.rings);
	}
	throw TextError(TextErrorCode::Unsound, "Clipper fails");
}

}  // namespace

void RequireFewCrossings(const Paths& rings)
{
	if (CountCrossings(rings, kMostCrossings) >= kMostCrossings)
		throw TextError(TextErrorCode::Unsound, "it crosses itself too often");
}

Paths CheckedUnion(const Paths& rings, double trifle, FillRule rule)
{
	return Checked(
		{ClipperLib::ctUnion, rule == FillRule::EvenOdd ? ClipperLib::pftEvenOdd : ClipperLib::pftNonZero, rings, {}},
		trifle);
}

Paths CheckedIntersection(const Paths& one, const Paths& other, double trifle)
{
	return Checked({ClipperLib::ctIntersection, ClipperLib::pftNonZero, one, other}, trifle);
}

Paths CheckedDifference(const Paths& one, const Paths& other, double trifle)
{
	return Checked({ClipperLib::ctDifference, ClipperLib::pftNonZero, one, other}, trifle);
}

}  // namespace textlabel
