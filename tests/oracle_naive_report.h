#pragma once
// The counts of a MeshReport, each by its definition, with maps and searches: slow and plain.

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <vector>

#include "vcg_ext/validate.h"

namespace oracle {

using vcg::textlabel::Face;
using vcg::textlabel::IndexedMesh;
using vcg::textlabel::MeshReport;

/// Into how many sets a relation divides 0 .. n-1.
inline int CountSets(size_t n, const std::function<bool(size_t, size_t)>& related)
{
	std::vector<bool> seen(n, false);
	int sets = 0;
	for (size_t first = 0; first < n; ++first) {
		if (seen[first]) continue;
		++sets;
		std::vector<size_t> stack{first};
		seen[first] = true;
		while (!stack.empty()) {
			const size_t i = stack.back();
			stack.pop_back();
			for (size_t j = 0; j < n; ++j)
				if (!seen[j] && related(i, j)) stack.push_back(j), seen[j] = true;
		}
	}
	return sets;
}

inline int SharedVertices(const Face& f, const Face& g)
{
	return static_cast<int>(
		std::count_if(f.begin(), f.end(), [&](int v) { return std::count(g.begin(), g.end(), v) > 0; }));
}

/// The combinatorial fields of a report; those of coordinates are left at 0.
inline MeshReport NaiveReport(const IndexedMesh& mesh)
{
	MeshReport r;
	std::vector<Face> faces;
	for (const Face& f : mesh.faces)
		if (std::set<int>(f.begin(), f.end()).size() == 3) faces.push_back(f);
	r.faces = static_cast<int>(faces.size());
	r.repeatedIndexFaces = static_cast<int>(mesh.faces.size() - faces.size());

	std::map<std::pair<int, int>, std::pair<int, int>> edges;  // numbers of faces in either direction
	std::map<int, std::vector<Face>> around;
	std::set<std::set<int>> triples;
	for (const Face& f : faces) {
		triples.insert(std::set<int>(f.begin(), f.end()));
		for (size_t i = 0; i < 3; ++i) {
			const int v = f[i], w = f[(i + 1) % 3];
			around[v].push_back(f);
			auto& sides = edges[std::minmax(v, w)];
			++(v < w ? sides.first : sides.second);
		}
	}
	r.duplicateFaces = r.faces - static_cast<int>(triples.size());
	r.vertices = static_cast<int>(around.size());
	r.unusedVertices = static_cast<int>(mesh.positions.size()) - r.vertices;
	r.edges = static_cast<int>(edges.size());
	r.eulerCharacteristic = r.vertices - r.edges + r.faces;

	std::vector<std::pair<int, int>> border;
	for (const auto& [edge, sides] : edges) {
		const int count = sides.first + sides.second;
		if (count == 1) border.push_back(edge);
		r.flippedEdges += count == 2 && sides.first != 1;
		r.nonManifoldEdges += count > 2;
		r.unbalancedEdges += count > 2 && sides.first != sides.second;
	}
	r.borderEdges = static_cast<int>(border.size());
	r.borderLoops = CountSets(border.size(), [&](size_t i, size_t j) {
		const auto& [a, b] = border[i];
		const auto& [c, d] = border[j];
		return a == c || a == d || b == c || b == d;
	});
	for (const auto& entry : around) {
		const std::vector<Face>& fan = entry.second;
		r.nonManifoldVertices +=
			CountSets(fan.size(), [&](size_t i, size_t j) {
				return SharedVertices(fan[i], fan[j]) >= 2;  // this vertex and another: an edge at the vertex
			}) > 1;
	}
	r.components = CountSets(faces.size(), [&](size_t i, size_t j) { return SharedVertices(faces[i], faces[j]) >= 2; });
	return r;
}

}  // namespace oracle
