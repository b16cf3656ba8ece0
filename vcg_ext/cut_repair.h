#pragma once
// Repairs below the resolution.
//
// CAD exports are full of triangles thinner than the step between coordinates. A contour that crosses one leaves two points that
// rounding makes one, or a piece that rounding turns round. Two repairs, both local and both tried only where needed:
//  - an edge of the cut that is shorter than the resolution and has a new end is collapsed, when the surface stays a manifold and no
//    triangle turns round (link condition; Dey et al., "Topology preserving edge contraction", 1999);
//  - a *cap*, a triangle whose obtuse corner lies within the resolution of the opposite edge, is removed by flipping that edge. The
//    surface moves by less than the cap's height.
// No vertex of the mesh moves or goes.

#include "label_cut.h"

#include <unordered_map>

namespace vcg::textlabel {

/// Collapse the edges of a cut that are too short to survive rounding.
/// @param[in] shortest  mesh units
void CollapseShortEdges(const Sheet& sheet, CutLabel& cut, double shortest);

/// Flip away the caps among some triangles of a sheet, and those on which they lie; the sheet remembers which it changed.
/// @param[in] triangles  sheet triangles to look at
/// @param[in] thinnest  mesh units: caps lower than this go
/// @return whether anything was flipped
bool FlipCaps(Sheet& sheet, const std::vector<int>& triangles, double thinnest);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// One cut, while its short edges are collapsed. What is near an edge is looked up once, before the first one goes: both ends of an
/// edge that has gone are left alone from then on.
class EdgeCollapser {
public:
	EdgeCollapser(const Sheet& sheet, CutLabel& cut)
		: sheet_(sheet), cut_(cut), gone_(size_t(cut.points.count(sheet)), 0), start_(gone_.size() + 1, 0),
		  pieceFrom_(gone_.size(), -1), pieceTo_(gone_.size(), -1)
	{
		for (const CutTriangle& t : cut.triangles)
			for (const int v : t.point) ++start_[size_t(v) + 1];
		for (size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
		around_.resize(size_t(start_.back()));
		std::vector<int> next(start_.begin(), start_.end() - 1);
		for (size_t i = 0; i < cut.triangles.size(); ++i)
			for (const int v : cut.triangles[i].point) around_[size_t(next[size_t(v)]++)] = int(i);
		for (size_t i = 0; i < cut.pieces.size(); ++i) {
			pieceFrom_[size_t(cut.pieces[i].from)] = int(i);
			pieceTo_[size_t(cut.pieces[i].to)] = int(i);
		}
	}

	void run(std::vector<std::pair<int, int>> edges)
	{
		bool changed = false;
		for (auto [a, b] : edges) {
			if (gone_[size_t(a)] || gone_[size_t(b)])
				continue;                // its neighbourhood has changed already; the next round sees what is left
			if (a > b) std::swap(a, b);  // the old vertex, or the earlier point, stays
			if (isCollapsible(a, b)) {
				collapse(a, b);
				changed = true;
			}
		}
		if (!changed) return;
		auto& t = cut_.triangles;
		t.erase(std::remove_if(t.begin(), t.end(), [](const CutTriangle& c) { return c.parent < 0; }), t.end());
		auto& p = cut_.pieces;
		p.erase(std::remove_if(p.begin(), p.end(), [](const ContourPiece& c) { return c.from == c.to; }), p.end());
		dropUnusedPoints();
	}

private:
	static bool has(const IndexTriangle& t, int point) { return t[0] == point || t[1] == point || t[2] == point; }

	/// Visit the triangles of the cut around a point that has not gone.
	template <class Use>
	void eachCut(int point, Use&& use) const
	{
		for (int i = start_[size_t(point)]; i < start_[size_t(point) + 1]; ++i) {
			CutTriangle& t = cut_.triangles[size_t(around_[size_t(i)])];
			if (t.parent >= 0) use(t);
		}
	}
	/// Visit all triangles around a point, of the cut and of what the cut left whole.
	template <class Use>
	void eachAround(int point, Use&& use) const
	{
		eachCut(point, [&](const CutTriangle& t) { use(t.point); });
		if (point >= int(sheet_.vertices.size())) return;
		for (int i = sheet_.vertexStart[size_t(point)]; i < sheet_.vertexStart[size_t(point) + 1]; ++i) {
			const int t = sheet_.vertexFan[size_t(i)];
			if (!std::binary_search(cut_.touched.begin(), cut_.touched.end(), t))
				use(sheet_.triangles[size_t(t)].vertex);
		}
	}
	std::vector<int> neighbours(int point) const
	{
		std::vector<int> out;
		eachAround(point, [&](const IndexTriangle& t) {
			for (const int v : t)
				if (v != point) out.push_back(v);
		});
		std::sort(out.begin(), out.end());
		out.erase(std::unique(out.begin(), out.end()), out.end());
		return out;
	}
	/// b goes into a.
	bool isCollapsible(int a, int b) const
	{
		int faces = 0;
		eachAround(b, [&](const IndexTriangle& t) { faces += has(t, a); });
		const std::vector<int> na = neighbours(a), nb = neighbours(b);
		std::vector<int> common;
		std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::back_inserter(common));
		if (faces == 0 || int(common.size()) != faces) return false;
		const auto leads = [&](int from, int to) {
			const int piece = pieceFrom_[size_t(from)];
			return piece >= 0 && cut_.pieces[size_t(piece)].to == to;
		};
		if (pieceFrom_[size_t(a)] >= 0 && !leads(a, b) && !leads(b, a))
			return false;  // would pinch two pieces together
		bool turns = false;
		eachCut(b, [&](const CutTriangle& t) {
			if (has(t.point, a) || !sheet_.triangles[size_t(t.parent)].facing) return;
			std::array<vcg::Point2d, 3> p;
			for (size_t k = 0; k < 3; ++k) p[k] = cut_.points.at(sheet_, t.point[k] == b ? a : t.point[k]).plane;
			turns = turns || Orient2d(p[0], p[1], p[2]) <= 0;
		});
		return !turns;
	}
	void collapse(int a, int b)
	{
		eachCut(b, [&](CutTriangle& t) {
			if (has(t.point, a)) t.parent = -1;
			for (int& v : t.point)
				if (v == b) v = a;
		});
		if (const int piece = pieceFrom_[size_t(b)]; piece >= 0) cut_.pieces[size_t(piece)].from = a;
		if (const int piece = pieceTo_[size_t(b)]; piece >= 0) cut_.pieces[size_t(piece)].to = a;
		gone_[size_t(a)] = gone_[size_t(b)] = 1;
	}

	void dropUnusedPoints()
	{
		const int old = int(sheet_.vertices.size());
		std::vector<CutPoint>& added = cut_.points.added;
		std::vector<int> number(added.size(), -1);
		for (const CutTriangle& t : cut_.triangles)
			for (const int v : t.point)
				if (v >= old) number[size_t(v - old)] = 0;
		size_t kept = 0;
		for (size_t i = 0; i < number.size(); ++i) {
			if (number[i] < 0) continue;
			added[kept] = added[i];
			number[i] = old + int(kept++);
		}
		added.resize(kept);
		const auto renumber = [&](int& v) { v = v < old ? v : number[size_t(v - old)]; };
		for (CutTriangle& t : cut_.triangles)
			for (int& v : t.point) renumber(v);
		for (ContourPiece& p : cut_.pieces) {
			renumber(p.from);
			renumber(p.to);
		}
	}

	const Sheet& sheet_;
	CutLabel& cut_;
	std::vector<char> gone_;                ///< #points
	std::vector<int> start_, around_;       ///< CSR: cut triangles around each point
	std::vector<int> pieceFrom_, pieceTo_;  ///< #points: the contour piece that starts or ends there, or -1
};

/// The longest side of a triangle of a sheet, a half-edge.
inline int LongestSide(const Sheet& sheet, int t)
{
	const auto length = [&](int h) {
		return (sheet.vertices[size_t(sheet.to(h))].mesh - sheet.vertices[size_t(sheet.from(h))].mesh).SquaredNorm();
	};
	int longest = 3 * t;
	for (int h = 3 * t + 1; h < 3 * t + 3; ++h)
		if (length(h) > length(longest)) longest = h;
	return longest;
}

/// Mesh units: of a triangle over its longest side.
inline double HeightOver(const Sheet& sheet, int longest)
{
	const auto at = [&](int v) -> const vcg::Point3d& { return sheet.vertices[size_t(v)].mesh; };
	const vcg::Point3d &a = at(sheet.from(longest)), along = at(sheet.to(longest)) - a;
	return (along ^ (at(sheet.from(Sheet::Previous(longest))) - a)).Norm() / along.Norm();
}

/// A sheet, while caps are flipped away. Its half-edges are kept up to date; its fans are so in `fans_` alone, and whoever has flipped
/// links it anew at the end.
class CapFlipper {
public:
	CapFlipper(Sheet& sheet, double thinnest) : sheet_(sheet), thinnest_(thinnest) {}

	/// Flip a triangle's longest edge when it is a cap and may go. Each is a cap once: else two below one another could take turns.
	/// @return the triangle across that edge, or -1
	int flip(int t)
	{
		if (isFlipped(t)) return -1;
		const int longest = LongestSide(sheet_, t);
		const int other = sheet_.twin[size_t(longest)], g = other / 3;
		if (other < 0 || !sheet_.triangles[size_t(g)].facing) return -1;
		//      c            the cap: a b c, beside it: b a d;  after the flip: a d c and d b c
		//    a   b
		//      d
		const int a = sheet_.from(longest), b = sheet_.to(longest), c = sheet_.from(Sheet::Previous(longest)),
				  d = sheet_.from(Sheet::Previous(other));
		const vcg::Point3d along = at(b) - at(a);
		const double length = along.Norm(), foot = along * (at(c) - at(a)) / length;
		const bool isCap =
			HeightOver(sheet_, longest) < thinnest_ && foot > thinnest_ && foot < length - thinnest_ && c != d;
		if (!isCap) return -1;
		const auto facing = [&](int p, int q, int r) {
			return Orient2d(sheet_.plane(p), sheet_.plane(q), sheet_.plane(r)) > 0;
		};
		if (!facing(a, d, c) || !facing(d, b, c)) return -1;
		if (!isFanWhole(c) && !isFanWhole(d)) {
			askForMore(c, d);
			return -1;
		}
		for (const int near : fan(c))
			for (const int v : sheet_.triangles[size_t(near)].vertex)
				if (v == d) return -1;  // c and d are neighbours already, on the far side of the part
		sheet_.triangles[size_t(t)].facing = true;
		sheet_.triangles[size_t(t)].birth =
			sheet_.triangles[size_t(g)].birthFace();  // the cap had no area to show its own
		for (const int changing : {t, g}) {
			const auto place = std::lower_bound(sheet_.flipped.begin(), sheet_.flipped.end(), changing);
			if (place != sheet_.flipped.end() && *place == changing) continue;
			sheet_.unflipped.insert(sheet_.unflipped.begin() + (place - sheet_.flipped.begin()),
			                        sheet_.triangles[size_t(changing)].vertex);
			sheet_.flipped.insert(place, changing);
		}
		turn(longest, other, {a, d, c}, {d, b, c});
		const auto move = [&](int triangle, int from, int to) {
			std::vector<int>& left = fan(from);
			left.erase(std::find(left.begin(), left.end(), triangle));
			fan(to).push_back(triangle);
		};
		move(t, b, d);
		move(g, a, c);
		return g;
	}

	/// What should be flipped before a cap is: another one, on which its longest edge lies; or -1.
	int before(int t) const
	{
		const int longest = LongestSide(sheet_, t), other = sheet_.twin[size_t(longest)];
		if (isFlipped(t) || other < 0 || isFlipped(other / 3) || HeightOver(sheet_, longest) >= thinnest_) return -1;
		const int below = LongestSide(sheet_, other / 3);
		return below != other && HeightOver(sheet_, below) < thinnest_ ? other / 3 : -1;
	}

private:
	const vcg::Point3d& at(int v) const { return sheet_.vertices[size_t(v)].mesh; }
	bool isFlipped(int t) const { return std::binary_search(sheet_.flipped.begin(), sheet_.flipped.end(), t); }
	/// The candidates around a vertex as they are now.
	std::vector<int>& fan(int v)
	{
		const auto [found, isNew] = fans_.try_emplace(v);
		if (isNew)
			found->second.assign(sheet_.vertexFan.begin() + sheet_.vertexStart[size_t(v)],
			                     sheet_.vertexFan.begin() + sheet_.vertexStart[size_t(v) + 1]);
		return found->second;
	}
	/// What lies around a vertex within the box is there; around one beyond it, a larger box would bring it.
	void askForMore(int c, int d)
	{
		const PlaneBox& box = sheet_.box;
		const auto beyond = [&](int v) {
			const vcg::Point2d& p = sheet_.plane(v);
			return std::max({box.low[0] - p[0], p[0] - box.high[0], box.low[1] - p[1], p[1] - box.high[1]});
		};
		const double near = std::min(beyond(c), beyond(d)), far = std::max(beyond(c), beyond(d));
		const double reach = near > 0 ? near : far;
		if (reach <= box.width() + box.height()) sheet_.capReach = std::max(sheet_.capReach, reach);
	}
	/// Whether every face of the mesh around a vertex is a candidate: then its neighbours are known.
	bool isFanWhole(int v)
	{
		for (const int t : fan(v))
			for (int h = 3 * t; h < 3 * t + 3; ++h)
				if (sheet_.twin[size_t(h)] < 0 && (sheet_.from(h) == v || sheet_.to(h) == v)) return false;
		return true;
	}
	/// Give two neighbours their new corners: h is a-b of abc, g is b-a of bad.
	void turn(int h, int g, const std::array<int, 3>& adc, const std::array<int, 3>& dbc)
	{
		const int t = h / 3 * 3, s = g / 3 * 3;
		const int bc = sheet_.twin[size_t(Sheet::Next(h))], ca = sheet_.twin[size_t(Sheet::Previous(h))],
				  ad = sheet_.twin[size_t(Sheet::Next(g))], db = sheet_.twin[size_t(Sheet::Previous(g))];
		sheet_.triangles[size_t(t / 3)].vertex = adc;
		sheet_.triangles[size_t(s / 3)].vertex = dbc;
		const auto join = [&](int halfEdge, int across) {
			sheet_.twin[size_t(halfEdge)] = across;
			if (across >= 0) sheet_.twin[size_t(across)] = halfEdge;
		};
		join(t, ad);
		join(t + 1, s + 2);
		join(t + 2, ca);
		join(s, db);
		join(s + 1, bc);
	}

	Sheet& sheet_;
	double thinnest_;                                 ///< mesh units
	std::unordered_map<int, std::vector<int>> fans_;  ///< of the vertices asked for
};

}  // namespace detail

inline void CollapseShortEdges(const Sheet& sheet, CutLabel& cut, double shortest)
{
	constexpr int rounds = 3;  // a collapse may leave another short edge beside it
	for (int round = 0; round < rounds; ++round) {
		std::vector<std::pair<int, int>> edges;
		for (const CutTriangle& t : cut.triangles)
			for (size_t k = 0; k < 3; ++k) {
				const int a = t.point[k], b = t.point[(k + 1) % 3];
				if (std::max(a, b) < int(sheet.vertices.size())) continue;
				if ((cut.points.at(sheet, a).mesh - cut.points.at(sheet, b).mesh).SquaredNorm() < shortest * shortest)
					edges.emplace_back(std::min(a, b), std::max(a, b));
			}
		if (edges.empty()) return;
		std::sort(edges.begin(), edges.end());
		edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
		detail::EdgeCollapser(sheet, cut).run(edges);
	}
}

inline bool FlipCaps(Sheet& sheet, const std::vector<int>& triangles, double thinnest)
{
	if (!sheet.mayFlip) return false;
	detail::CapFlipper flipper(sheet, thinnest);
	std::vector<char> isListed(sheet.triangles.size(), 0), isAskedFor(isListed);
	for (const int t : triangles) isListed[size_t(t)] = 1;
	bool flipped = false;
	for (std::vector<int> stack(triangles.rbegin(), triangles.rend()); !stack.empty();) {
		const int t = stack.back();
		stack.pop_back();
		const int first = flipper.before(t);  // a fan that closes an edge with many vertices has a cap below a cap
		if (first >= 0 && !std::exchange(isAskedFor[size_t(first)], 1)) {
			isListed[size_t(first)] = 1;
			stack.insert(stack.end(), {t, first});
			continue;
		}
		const int across = flipper.flip(t);
		if (across < 0) continue;
		flipped = true;
		for (const int changed : {t, across})
			for (int h = 3 * changed; h < 3 * changed + 3; ++h)
				if (const int twin = sheet.twin[size_t(h)]; twin >= 0 && isListed[size_t(twin / 3)])
					stack.push_back(twin / 3);
	}
	if (flipped) detail::LinkTriangles(sheet);
	return flipped;
}

}  // namespace vcg::textlabel
