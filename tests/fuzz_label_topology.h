#pragma once
// What can be counted about a mesh: borders, fans, components, Euler characteristic; written apart from the
// library's own.

#include "random_mesh.h"
#include "vcg_ext/label_frame.h"
#include "vcg_ext/triangle_crossing.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace vcg::textlabel::test::detail {

using Place = std::tuple<double, double, double>;
inline Place PlaceOf(const vcg::Point3d& p) { return {p[0], p[1], p[2]}; }

/// What can be counted about a welded mesh. Faces with a corner twice count as degenerate and as nothing else.
struct Topology {
	std::set<std::pair<Place, Place>> border;       ///< directed edges with one face
	std::set<std::pair<Place, Place>> nonManifold;  ///< edges of more than two faces, or of two in the same direction
	std::set<Place> forks;                          ///< vertices with more than one fan
	int components = 0;
	int euler = 0;
	std::vector<int> degenerate;  ///< faces with collinear corners
};

struct DisjointSets {
	std::vector<int> parent;
	explicit DisjointSets(size_t n) : parent(n)
	{
		for (size_t i = 0; i < n; ++i) parent[i] = int(i);
	}
	int find(int i)
	{
		while (parent[size_t(i)] != i) i = parent[size_t(i)] = parent[size_t(parent[size_t(i)])];
		return i;
	}
	void join(int a, int b) { parent[size_t(find(a))] = find(b); }
};

inline Corners CornersIn(const Soup& s, int f)
{
	const auto& t = s.faces[size_t(f)];
	return {s.vertices[size_t(t[0])], s.vertices[size_t(t[1])], s.vertices[size_t(t[2])]};
}

inline Topology TopologyOf(const Soup& s)
{
	Topology t;
	struct Half {
		int low, high, face, corner;
		bool up;
	};
	std::vector<Half> halves;
	std::vector<char> used(s.vertices.size(), 0);
	int faces = 0, vertices = 0, edges = 0;
	DisjointSets shells(s.vertices.size()), fans(s.faces.size() * 3);
	for (int f = 0; f < int(s.faces.size()); ++f) {
		const auto& v = s.faces[size_t(f)];
		const Corners c = CornersIn(s, f);
		if (!IsFinite(c[0]) || !IsFinite(c[1]) || !IsFinite(c[2])) continue;
		if (IsCollinear(c)) t.degenerate.push_back(f);
		if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
		++faces;
		for (int k = 0; k < 3; ++k) {
			const int a = v[size_t(k)], b = v[size_t((k + 1) % 3)];
			halves.push_back({std::min(a, b), std::max(a, b), f, k, a < b});
			vertices += !std::exchange(used[size_t(a)], 1);
			shells.join(a, b);
		}
	}
	std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
		return std::tie(a.low, a.high, a.face, a.corner) < std::tie(b.low, b.high, b.face, b.corner);
	});
	for (size_t i = 0, j; i < halves.size(); i = j) {
		for (j = i; j < halves.size() && halves[j].low == halves[i].low && halves[j].high == halves[i].high;) ++j;
		++edges;
		const Place a = PlaceOf(s.vertices[size_t(halves[i].low)]), b = PlaceOf(s.vertices[size_t(halves[i].high)]);
		if (j - i == 1) t.border.insert(halves[i].up ? std::make_pair(a, b) : std::make_pair(b, a));
		if (j - i > 2 || (j - i == 2 && halves[i].up == halves[i + 1].up)) t.nonManifold.insert(std::minmax(a, b));
		for (size_t k = i + 1; k < j; ++k) {  // the corners at both ends of the edge belong to one fan
			const auto cornerAt = [&](const Half& h, int v) {
				for (int c = 0; c < 3; ++c)
					if (s.faces[size_t(h.face)][size_t(c)] == v) return 3 * h.face + c;
				return -1;
			};
			for (const int v : {halves[i].low, halves[i].high})
				fans.join(cornerAt(halves[i], v), cornerAt(halves[k], v));
		}
	}
	std::vector<int> fanAt(s.vertices.size(), -1);
	for (const Half& h : halves) {
		const int v = s.faces[size_t(h.face)][size_t(h.corner)], fan = fans.find(3 * h.face + h.corner);
		if (fanAt[size_t(v)] >= 0 && fanAt[size_t(v)] != fan) t.forks.insert(PlaceOf(s.vertices[size_t(v)]));
		fanAt[size_t(v)] = fan;
	}
	for (size_t v = 0; v < used.size(); ++v)
		if (used[v] && shells.find(int(v)) == int(v)) ++t.components;
	t.euler = vertices - edges + faces;
	return t;
}

}  // namespace vcg::textlabel::test::detail
