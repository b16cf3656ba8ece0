// What CGAL says about a mesh file, as one line of key=value pairs: an independent judge for the tests.
//
//   oracle_cgal FILE.stl|.obj|.ply
//
// Equal points are merged first, and triangles that use a point twice left out. Crossing pairs are counted by CGAL's exact
// predicates on the soup of the other triangles by the rule of its self_intersections(), which takes 2-manifolds only; where
// that takes the mesh, its own count stands beside ours as manifold_crossing_pairs.
// Exit: 0 whatever the mesh is like, 2 when the file can't be read.

#include <CGAL/box_intersection_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <iostream>

#include "oracle_mesh_file.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
namespace PMP = CGAL::Polygon_mesh_processing;
using Polygons = std::vector<std::vector<size_t>>;

struct Soup {
	std::vector<Kernel::Point_3> points;
	Polygons faces;
	size_t repeatedIndex = 0;
};

Soup ReadMerged(const char* path)
{
	const oracle::MeshFile file = oracle::ReadMeshFile(path);
	Soup soup;
	for (const auto& p : file.points) soup.points.emplace_back(p[0], p[1], p[2]);
	for (const auto& f : file.faces) soup.faces.push_back({size_t(f[0]), size_t(f[1]), size_t(f[2])});
	PMP::merge_duplicate_points_in_polygon_soup(soup.points, soup.faces);
	const auto repeats = [](const auto& f) { return f[0] == f[1] || f[1] == f[2] || f[2] == f[0]; };
	const auto kept = std::remove_if(soup.faces.begin(), soup.faces.end(), repeats);
	soup.repeatedIndex = size_t(soup.faces.end() - kept);
	soup.faces.erase(kept, soup.faces.end());
	return soup;
}

bool IsCollinear(const Soup& soup, size_t f)
{
	const auto& t = soup.faces[f];
	return CGAL::collinear(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
}

/// Turns two faces so that the vertices they share come first.
/// @return how many they share
size_t BringSharedFirst(std::vector<size_t>& f, std::vector<size_t>& g)
{
	size_t shared = 0;
	for (size_t i = 0; i < 3; ++i) {
		const auto other = std::find(g.begin(), g.end(), f[i]);
		if (other == g.end()) continue;
		std::iter_swap(other, g.begin() + long(shared));
		std::swap(f[i], f[shared++]);
	}
	return shared;
}

/// CGAL's rule: an intersection other than a vertex or an edge of both.
bool DoCross(const Soup& soup, std::vector<size_t> f, std::vector<size_t> g)
{
	const size_t shared = BringSharedFirst(f, g);
	const auto point = [&](const std::vector<size_t>& face, size_t i) { return soup.points[face[i]]; };
	const Kernel::Triangle_3 s(point(f, 0), point(f, 1), point(f, 2)), t(point(g, 0), point(g, 1), point(g, 2));
	if (shared == 0) return CGAL::do_intersect(s, t);
	if (shared == 1)
		return CGAL::do_intersect(s, Kernel::Segment_3(point(g, 1), point(g, 2))) ||
		       CGAL::do_intersect(t, Kernel::Segment_3(point(f, 1), point(f, 2)));
	if (shared == 3) return true;
	return CGAL::coplanar(s[0], s[1], s[2], t[2]) &&
	       CGAL::coplanar_orientation(s[0], s[1], s[2], t[2]) == CGAL::POSITIVE;
}

void PrintSurface(const Soup& soup)
{
	const bool isManifold = PMP::is_polygon_soup_a_polygon_mesh(soup.faces);
	std::cout << " manifold_oriented=" << isManifold;
	if (!isManifold) return;
	CGAL::Surface_mesh<Kernel::Point_3> mesh;
	PMP::polygon_soup_to_polygon_mesh(soup.points, soup.faces, mesh);
	std::cout << " closed=" << CGAL::is_closed(mesh);
	if (CGAL::is_closed(mesh)) std::cout << " volume=" << PMP::volume(mesh);
	std::cout << " euler=" << int(num_vertices(mesh)) - int(num_edges(mesh)) + int(num_faces(mesh));
	std::vector<std::pair<CGAL::SM_Face_index, CGAL::SM_Face_index>> found;
	PMP::self_intersections(mesh, std::back_inserter(found));
	std::cout << " manifold_crossing_pairs="
			  << std::count_if(found.begin(), found.end(), [](const auto& p) { return p.first != p.second; });
}

void PrintCrossings(const Soup& soup)
{
	using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, size_t>;
	std::vector<Box> boxes;
	for (size_t f = 0; f < soup.faces.size(); ++f) {
		if (IsCollinear(soup, f)) continue;
		const auto& t = soup.faces[f];
		boxes.emplace_back(soup.points[t[0]].bbox() + soup.points[t[1]].bbox() + soup.points[t[2]].bbox(), f);
	}
	size_t pairs = 0;
	CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
		pairs += DoCross(soup, soup.faces[a.info()], soup.faces[b.info()]);
	});
	std::cout << " collinear=" << soup.faces.size() - boxes.size() << " crossing_pairs=" << pairs;
}

}  // namespace

int main(int argc, char** argv)
{
	if (argc != 2) return std::cerr << "usage: oracle_cgal FILE\n", 2;
	try {
		std::cout.precision(9);
		const Soup soup = ReadMerged(argv[1]);
		std::cout << "faces=" << soup.faces.size() << " vertices=" << soup.points.size()
				  << " repeated_index=" << soup.repeatedIndex;
		PrintSurface(soup);
		PrintCrossings(soup);
		std::cout << '\n';
		return 0;
	} catch (const std::exception& e) {
		std::cerr << e.what() << '\n';
		return 2;
	}
}
