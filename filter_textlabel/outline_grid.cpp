#include "outline_grid.h"

#include <cmath>

namespace textlabel {
namespace {

int Side(const IntPoint& a, const IntPoint& b, const IntPoint& c)
{
	const cInt cross = Cross(a, b, c);
	return (cross > 0) - (cross < 0);
}

/// Is q, which is on the line ab, between a and b?
bool IsBetween(const IntPoint& q, const IntPoint& a, const IntPoint& b)
{
	return std::min(a.X, b.X) <= q.X && q.X <= std::max(a.X, b.X) && std::min(a.Y, b.Y) <= q.Y &&
	       q.Y <= std::max(a.Y, b.Y);
}

bool IsStraightOrBack(const Path& ring)
{
	const std::size_t n = ring.size();
	for (std::size_t i = 0; i < n; ++i) {
		if (Cross(ring[i], ring[(i + 1) % n], ring[(i + 2) % n]) == 0) return true;
	}
	return n < 3;
}

}  // namespace

std::vector<GridEdge> EdgesOf(const Paths& rings)
{
	std::vector<GridEdge> edges;
	for (std::size_t r = 0; r < rings.size(); ++r) {
		for (std::size_t i = 0; i < rings[r].size(); ++i)
			edges.push_back({r, i, rings[r][i], rings[r][(i + 1) % rings[r].size()]});
	}
	return edges;
}

FlatBox<cInt> BoxOf(const GridEdge& e, cInt margin)
{
	return {std::min(e.a.X, e.b.X) - margin, std::min(e.a.Y, e.b.Y) - margin, std::max(e.a.X, e.b.X) + margin,
	        std::max(e.a.Y, e.b.Y) + margin};
}

BoxTree<cInt> TreeOf(const std::vector<GridEdge>& edges)
{
	std::vector<FlatBox<cInt>> boxes;
	boxes.reserve(edges.size());
	for (const GridEdge& edge : edges) boxes.push_back(BoxOf(edge));
	return BoxTree<cInt>(std::move(boxes));
}

bool Meet(const GridEdge& e, const GridEdge& f)
{
	const int fa = Side(e.a, e.b, f.a), fb = Side(e.a, e.b, f.b);
	const int ea = Side(f.a, f.b, e.a), eb = Side(f.a, f.b, e.b);
	if (fa * fb < 0 && ea * eb < 0) return true;
	return (fa == 0 && IsBetween(f.a, e.a, e.b)) || (fb == 0 && IsBetween(f.b, e.a, e.b)) ||
	       (ea == 0 && IsBetween(e.a, f.a, f.b)) || (eb == 0 && IsBetween(e.b, f.a, f.b));
}

bool Follows(const GridEdge& e, const GridEdge& f, const Paths& rings)
{
	return e.ring == f.ring && (e.i + 1) % rings[e.ring].size() == f.i;
}

std::size_t CountCrossings(const Paths& rings, std::size_t most)
{
	const std::vector<GridEdge> edges = EdgesOf(rings);
	const BoxTree<cInt> tree = TreeOf(edges);
	std::size_t count = 0;
	for (std::size_t k = 0; k < edges.size() && count < most; ++k) {
		tree.search(BoxOf(edges[k]), [&](std::size_t other) {
			if (other <= k || count >= most) return;
			const GridEdge &e = edges[k], &f = edges[other];
			if (!Follows(e, f, rings) && !Follows(f, e, rings) && Meet(e, f)) ++count;
		});
	}
	return count;
}

bool AreSound(const Paths& rings)
{
	for (const Path& ring : rings) {
		if (IsStraightOrBack(ring)) return false;
	}
	return CountCrossings(rings, 1) == 0;
}

std::vector<int> ParentsOf(const Paths& rings)
{
	std::vector<FlatBox<cInt>> boxes;
	std::vector<double> areas;
	for (const Path& ring : rings) {
		FlatBox<cInt> box{ring[0].X, ring[0].Y, ring[0].X, ring[0].Y};
		for (const IntPoint& p : ring) box.add({p.X, p.Y, p.X, p.Y});
		boxes.push_back(box);
		areas.push_back(std::abs(ClipperLib::Area(ring)));
	}
	const BoxTree<cInt> tree(boxes);
	std::vector<int> parents(rings.size(), -1);
	for (std::size_t r = 0; r < rings.size(); ++r) {
		const IntPoint p = rings[r][0];
		tree.search({p.X, p.Y, p.X, p.Y}, [&](std::size_t other) {
			if (other == r || areas[other] <= areas[r] || ClipperLib::PointInPolygon(p, rings[other]) != 1) return;
			int& parent = parents[r];
			if (parent < 0 || areas[other] < areas[static_cast<std::size_t>(parent)]) parent = static_cast<int>(other);
		});
	}
	return parents;
}

}  // namespace textlabel
