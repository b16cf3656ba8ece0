#include "outline_measure.h"

#include <algorithm>
#include <cmath>
#include "outline_tree.h"

namespace textlabel {
namespace {

using vcg::Point2d;
using vcg::textlabel::Outline;

struct Edge {
	Point2d a, b;
	Point2d outward;  ///< unit normal: the inside is to the left of a contour
	int letter;
	std::size_t next;  ///< index of the edge after it
};

std::vector<Edge> EdgesOf(const Outline& outline)
{
	std::vector<Edge> edges;
	for (const vcg::textlabel::Contour& contour : outline.contours) {
		const std::size_t first = edges.size(), n = contour.points.size();
		for (std::size_t i = 0; i < n; ++i) {
			const Point2d a = contour.points[i], b = contour.points[(i + 1) % n], d = b - a;
			edges.push_back({a, b, Point2d(d[1], -d[0]) / d.Norm(), contour.letter, first + (i + 1) % n});
		}
	}
	return edges;
}

Point2d NearestOn(const Edge& e, const Point2d& q)
{
	const Point2d d = e.b - e.a;
	return e.a + d * std::clamp(((q - e.a) * d) / d.SquaredNorm(), 0.0, 1.0);
}

/// Is `direction` (unit) a normal of the boundary at the corner between two edges, within kFacing? A corner that sticks out
/// to that side has all the normals from the one edge's to the other's.
/// @param[in] side  +1: outward normals, -1: inward ones
bool IsNormalAt(const Edge& before, const Edge& after, const Point2d& direction, int side)
{
	const double least = std::cos(kFacing);
	const Point2d n0 = before.outward * side, n1 = after.outward * side;
	if (n0 * direction >= least || n1 * direction >= least) return true;
	// the contour turns left at a corner that sticks out of the inside, and then the normals turn left too
	const bool sticksOut = (before.outward ^ after.outward) * side > 0;
	const double turn0 = (n0 ^ direction) * side, turn1 = (direction ^ n1) * side;
	return sticksOut && turn0 > 0 && turn1 > 0 && (n0 + n1) * direction > 0;
}

class Widths {
public:
	Widths(const Outline& outline, int letterCount, double reach)
		: m_edges(EdgesOf(outline)), m_tree(boxes()), m_reach(reach), m_widths(static_cast<std::size_t>(letterCount))
	{}

	std::vector<LetterWidths> measured()
	{
		for (const Edge& before : m_edges) {
			searchFrom(before, +1, &LetterWidths::stroke);
			searchFrom(before, -1, &LetterWidths::gap);
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

	/// Look from the corner at the end of an edge for what faces it. side +1: across the inside, -1: across the outside.
	void searchFrom(const Edge& before, int side, Width width)
	{
		const Edge& after = m_edges[before.next];
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
			const Point2d across = NearestOn(e, v) - v;
			const double distance = across.Norm();
			if (distance >= radius || distance == 0) return;
			const Point2d direction = across / distance;
			if ((e.outward * direction) * side < std::cos(kFacing)) return;
			if (!IsNormalAt(before, after, direction * -1, side)) return;
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
