#include "outline_measure.h"

#include <algorithm>
#include <cmath>
#include "outline_flatten.h"
#include "outline_tree.h"

namespace textlabel {
namespace {

using vcg::Point2d;
using vcg::textlabel::Outline;

struct Edge {
	Point2d a, b;
	Point2d outward;  ///< unit normal: the inside is to the left of a contour
	int letter;
	std::size_t first, count;  ///< range of the contour's edges
	bool isFirstHalf;          ///< of a side; it ends in the middle
};

/// An edge that is so many times as long as its neighbour is no chord of the same curve.
constexpr double kMuchLonger = 2;
/// A pocket with less area than this share of width times depth is a taper: a triangle has one half.
constexpr double kTaper = 0.6;
/// A taper has no more corners than this.
constexpr std::size_t kMostTaperCorners = 64;

/// Is an edge, from a to b, a side by itself and not a chord of a curve: does a corner end it, or a much shorter edge?
bool IsSide(const Point2d& before, const Point2d& a, const Point2d& b, const Point2d& after)
{
	const Point2d in = a - before, along = b - a, out = after - b;
	const double length = along.Norm(), first = in.Norm(), last = out.Norm(), least = std::cos(kFacing);
	return in * along < least * first * length || along * out < least * length * last ||
	       length > kMuchLonger * std::min(first, last);
}

/// The edges of the contours; sides as two halves, to look from their middles, too: a bar whose ends are oblique or
/// pointed looks like a taper from its own corners.
std::vector<Edge> EdgesOf(const Outline& outline)
{
	std::vector<Edge> edges;
	for (const vcg::textlabel::Contour& contour : outline.contours) {
		const std::size_t first = edges.size(), n = contour.points.size();
		const auto at = [&contour, n](std::size_t i) { return contour.points[i % n]; };
		for (std::size_t i = 0; i < n; ++i) {
			const Point2d a = at(i), b = at(i + 1), d = b - a, outward = Point2d(d[1], -d[0]) / d.Norm();
			const bool isSide = IsSide(at(i + n - 1), a, b, at(i + 2));
			const Point2d middle = isSide ? a + d / 2 : b;
			edges.push_back({a, middle, outward, contour.letter, first, 0, isSide});
			if (isSide) edges.push_back({middle, b, outward, contour.letter, first, 0, false});
		}
		for (std::size_t i = first; i < edges.size(); ++i) edges[i].count = edges.size() - first;
	}
	return edges;
}

Point2d NearestOn(const Edge& e, const Point2d& q)
{
	const Point2d d = e.b - e.a;
	return e.a + d * std::clamp(((q - e.a) * d) / d.SquaredNorm(), 0.0, 1.0);
}

/// Is `direction` (unit) a normal of the boundary at the corner between two edges, within `slack` radians? A corner
/// that sticks out to that side has all the normals from the one edge's to the other's.
/// @param[in] side  +1: outward normals, -1: inward ones
bool IsNormalAt(const Edge& before, const Edge& after, const Point2d& direction, int side, double slack)
{
	const double least = std::cos(slack);
	const Point2d n0 = before.outward * side, n1 = after.outward * side;
	if (n0 * direction >= least || n1 * direction >= least) return true;
	// the contour turns left at a corner that sticks out of the inside, and then the normals turn left too
	const bool sticksOut = (before.outward ^ after.outward) * side > 0;
	const double turn0 = (n0 ^ direction) * side, turn1 = (direction ^ n1) * side;
	return sticksOut && turn0 > 0 && turn1 > 0 && (n0 + n1) * direction > 0;
}

/// A walk along a contour by edges.
struct Walk {
	const std::vector<Edge>& edges;

	std::size_t next(std::size_t i) const { return edges[i].first + (i - edges[i].first + 1) % edges[i].count; }
	std::size_t ahead(std::size_t from, std::size_t to) const
	{
		return (to + edges[from].count - from) % edges[from].count;
	}
};

/// Is the polygon from a mouth, its first and last point, a taper?
bool IsTaper(const Ring& pocket)
{
	const Point2d mouth = pocket.back() - pocket.front();
	const double width = mouth.Norm();
	double depth = 0;
	for (const Point2d& p : pocket) depth = std::max(depth, std::abs(mouth ^ (p - pocket.front())) / width);
	return std::abs(vcg::textlabel::TwiceSignedArea(pocket)) / 2 < kTaper * width * depth;
}

class Widths {
public:
	Widths(const Outline& outline, int letterCount, double reach)
		: m_edges(EdgesOf(outline)), m_tree(boxes()), m_reach(reach), m_widths(static_cast<std::size_t>(letterCount))
	{}

	std::vector<LetterWidths> measured()
	{
		// from the middles last: few are nearer to anything than the corners, so that they need not look far
		for (const bool fromMiddles : {false, true}) {
			for (std::size_t i = 0; i < m_edges.size(); ++i) {
				if (m_edges[i].isFirstHalf != fromMiddles) continue;
				searchFrom(i, +1, &LetterWidths::stroke);
				searchFrom(i, -1, &LetterWidths::gap);
			}
		}
		return m_widths;
	}

private:
	using Width = double LetterWidths::*;

	std::vector<FlatBox<double>> boxes() const
	{
		std::vector<FlatBox<double>> result;
		for (const Edge& e : m_edges)
			result.push_back({std::min(e.a[0], e.b[0]), std::min(e.a[1], e.b[1]), std::max(e.a[0], e.b[0]),
			                  std::max(e.a[1], e.b[1])});
		return result;
	}

	double& widthOf(int letter, Width width) { return m_widths[static_cast<std::size_t>(letter)].*width; }

	/// Does the boundary between a corner and a place on an edge, one way or the other, run into a point?
	bool isInTaper(std::size_t before, std::size_t edge, const Point2d& place) const
	{
		if (m_edges[before].first != m_edges[edge].first) return false;
		const Walk walk{m_edges};
		const std::size_t after = walk.next(before);
		return endsInTaper(m_edges[after].a, after, edge, place) || endsInTaper(place, edge, before, m_edges[after].a);
	}

	/// The boundary from a place on the edge `from` forward to a place on the edge `to`.
	bool endsInTaper(const Point2d& start, std::size_t from, std::size_t to, const Point2d& end) const
	{
		const Walk walk{m_edges};
		if (walk.ahead(from, to) > kMostTaperCorners) return false;
		Ring pocket{start};
		for (std::size_t i = from; i != to; i = walk.next(i)) pocket.push_back(m_edges[i].b);
		pocket.push_back(end);
		return IsTaper(pocket);
	}

	/// Look from the corner at the end of an edge for what faces it. side +1: across the inside, -1: across the
	/// outside.
	void searchFrom(std::size_t corner, int side, Width width)
	{
		const Edge &before = m_edges[corner], &after = m_edges[Walk{m_edges}.next(corner)];
		const Point2d v = before.b;
		double& mine = widthOf(before.letter, width);
		double radius = mine > 0 ? mine : m_reach;
		FlatBox<double> box{};
		const auto shrinkTo = [&](double r) {
			radius = r;
			box = {v[0] - r, v[1] - r, v[0] + r, v[1] + r};
		};
		shrinkTo(radius);
		m_tree.search(box, [&](std::size_t index) {
			const Edge& e = m_edges[index];
			if (&e == &before || &e == &after) return;
			const Point2d nearest = NearestOn(e, v), across = nearest - v;
			const double distance = across.Norm();
			if (distance >= radius || distance == 0) return;
			const Point2d direction = across / distance;
			// what the one side is off the way across, the other may not be off as well
			const double slack = kFacing - std::acos(std::clamp((e.outward * direction) * side, -1.0, 1.0));
			if (slack < 0 || !IsNormalAt(before, after, direction * -1, side, slack)) return;
			if (isInTaper(corner, index, nearest)) return;
			mine = distance;
			double& other = widthOf(e.letter, width);
			if (other == 0 || distance < other) other = distance;
			shrinkTo(distance);
		});
	}

	std::vector<Edge> m_edges;
	BoxTree<double> m_tree;
	double m_reach;
	std::vector<LetterWidths> m_widths;
};

}  // namespace

std::vector<LetterWidths> MeasureWidths(const Outline& outline, int letterCount, double reach)
{
	return Widths(outline, letterCount, reach).measured();
}

}  // namespace textlabel
