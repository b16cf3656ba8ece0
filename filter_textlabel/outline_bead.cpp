#include "outline_bead.h"

#include <algorithm>
#include <cmath>
#include "text_error.h"

namespace textlabel {
namespace {

using ClipperLib::DoublePoint;

/// Pieces of one ring that are closer than this along the ring (times `finest`) are one corner, not two that come
/// close.
constexpr double kDetour = 4;
/// Corners of a capsule's round end: an octagon.
constexpr int kEndCorners = 8;

double SquaredDistance(const DoublePoint& q, const GridEdge& e, DoublePoint* nearest)
{
	const double dx = static_cast<double>(e.b.X - e.a.X), dy = static_cast<double>(e.b.Y - e.a.Y);
	const double ax = static_cast<double>(e.a.X), ay = static_cast<double>(e.a.Y);
	const double t = std::clamp(((q.X - ax) * dx + (q.Y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
	*nearest = DoublePoint(ax + t * dx, ay + t * dy);
	return (q.X - nearest->X) * (q.X - nearest->X) + (q.Y - nearest->Y) * (q.Y - nearest->Y);
}

DoublePoint PointOn(const GridEdge& e, double t)
{
	return DoublePoint(static_cast<double>(e.a.X) + t * static_cast<double>(e.b.X - e.a.X),
	                   static_cast<double>(e.a.Y) + t * static_cast<double>(e.b.Y - e.a.Y));
}

/// The distance of a point of e from f, as it moves along e: a convex function, so what is below a bound is an
/// interval.
class DistanceAlong {
public:
	DistanceAlong(const GridEdge& e, const GridEdge& f) : m_e(e), m_f(f) {}

	double operator()(double t) const
	{
		DoublePoint nearest;
		return std::sqrt(SquaredDistance(PointOn(m_e, t), m_f, &nearest));
	}

	/// Where it is least, by golden section.
	double lowest() const
	{
		constexpr double kGolden = 0.6180339887498949;
		double low = 0, high = 1;
		for (int i = 0; i < kSteps; ++i) {
			const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
			if ((*this)(left) <= (*this)(right)) high = right;
			else low = left;
		}
		// an end is often the very place, and must not be missed by a digit
		double best = (low + high) / 2;
		for (const double end : {0.0, 1.0}) {
			if ((*this)(end) <= (*this)(best)) best = end;
		}
		return best;
	}

	/// From `inside`, where it is below the bound, towards `outside`: the last place below it.
	double edgeOf(double inside, double outside, double bound) const
	{
		if ((*this)(outside) <= bound) return outside;
		for (int i = 0; i < kSteps; ++i) {
			const double middle = (inside + outside) / 2;
			((*this)(middle) <= bound ? inside : outside) = middle;
		}
		return inside;
	}

private:
	static constexpr int kSteps = 48;  ///< more than the digits of a coordinate
	const GridEdge &m_e, &m_f;
};

/// The way along a ring from its first point to each of its points, and at last round to the first again.
std::vector<double> Mileage(const Path& ring)
{
	std::vector<double> miles(1, 0);
	for (std::size_t i = 0; i < ring.size(); ++i) {
		const IntPoint &p = ring[i], &q = ring[(i + 1) % ring.size()];
		miles.push_back(miles.back() + std::hypot(static_cast<double>(q.X - p.X), static_cast<double>(q.Y - p.Y)));
	}
	return miles;
}

class Welder {
public:
	Welder(const Paths& rings, double finest) : m_rings(rings), m_finest(finest)
	{
		for (const Path& ring : rings) m_miles.push_back(Mileage(ring));
	}

	/// @return an empty path when e and f keep their distance
	Path capsule(const GridEdge& e, const GridEdge& f) const
	{
		if (Follows(e, f, m_rings) || Follows(f, e, m_rings)) return {};
		const bool meet = Meet(e, f);
		if (!meet && !areClose(e, f)) return {};
		const DistanceAlong distance(e, f);
		const double lowest = distance.lowest();
		if (!meet && e.ring == f.ring && wayBetween(e, f, lowest) < kDetour * m_finest) return {};
		return around(middleAt(e, f, distance.edgeOf(lowest, 0, m_finest)),
		              middleAt(e, f, distance.edgeOf(lowest, 1, m_finest)));
	}

private:
	/// Edges that do not meet are nearest at an end of one of them.
	bool areClose(const GridEdge& e, const GridEdge& f) const
	{
		DoublePoint q;
		const double bound = m_finest * m_finest;
		return SquaredDistance(e.a, f, &q) < bound || SquaredDistance(e.b, f, &q) < bound ||
		       SquaredDistance(f.a, e, &q) < bound || SquaredDistance(f.b, e, &q) < bound;
	}

	static DoublePoint middleAt(const GridEdge& e, const GridEdge& f, double t)
	{
		const DoublePoint p = PointOn(e, t);
		DoublePoint q;
		SquaredDistance(p, f, &q);
		return DoublePoint((p.X + q.X) / 2, (p.Y + q.Y) / 2);
	}

	/// Way along the ring between the point of e at t and the point of f nearest to it.
	double wayBetween(const GridEdge& e, const GridEdge& f, double t) const
	{
		const std::vector<double>& miles = m_miles[e.ring];
		DoublePoint q;
		SquaredDistance(PointOn(e, t), f, &q);
		const double onE = miles[e.i] + t * (miles[e.i + 1] - miles[e.i]);
		const double onF = miles[f.i] + std::hypot(q.X - static_cast<double>(f.a.X), q.Y - static_cast<double>(f.a.Y));
		const double way = std::abs(onE - onF);
		return std::min(way, miles.back() - way);
	}

	/// The octagon of radius `finest` swept from p to q.
	Path around(const DoublePoint& p, const DoublePoint& q) const
	{
		constexpr double kPi = 3.14159265358979323846;
		const double along = std::atan2(q.Y - p.Y, q.X - p.X);
		Path ring;
		for (int i = 0; i < kEndCorners; ++i) {
			// the first half of the corners looks ahead, to q
			const double turn = along - kPi / 2 + (i + 0.5) * 2 * kPi / kEndCorners;
			const DoublePoint& centre = i < kEndCorners / 2 ? q : p;
			ring.push_back({std::llround(centre.X + m_finest * std::cos(turn)),
			                std::llround(centre.Y + m_finest * std::sin(turn))});
		}
		return ring;
	}

	const Paths& m_rings;
	double m_finest;
	std::vector<std::vector<double>> m_miles;
};

}  // namespace

Paths BeadsOf(const Paths& rings, double finest)
{
	const std::vector<GridEdge> edges = EdgesOf(rings);
	const BoxTree<cInt> tree = TreeOf(edges);
	const Welder welder(rings, finest);
	Paths beads;
	for (std::size_t k = 0; k < edges.size(); ++k) {
		tree.search(BoxOf(edges[k], static_cast<cInt>(std::ceil(finest))), [&](std::size_t other) {
			if (other <= k) return;
			Path bead = welder.capsule(edges[k], edges[other]);
			if (bead.empty()) return;
			if (beads.size() == kMostBeads)
				throw TextError(TextErrorCode::Unsound, "letters come too close to each other too often");
			beads.push_back(std::move(bead));
		});
	}
	return beads;
}

}  // namespace textlabel
