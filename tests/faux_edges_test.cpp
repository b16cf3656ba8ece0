// Polygons with more than three corners, kept as triangles with faux edges: those under the letters become triangles, all others stay
// polygons.

#include "vcg_ext/faux_edges.h"

#include <gtest/gtest.h>
#include <map>
#include <numeric>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::FloatMesh;
using test_mesh::Shape;
using Ends = std::pair<int, int>;

Ends EndsOf(const FloatMesh& m, int face, int k)
{
	const auto& f = m.face[size_t(face)];
	const int a = int(vcg::tri::Index(m, f.cV(k))), b = int(vcg::tri::Index(m, f.cV((k + 1) % 3)));
	return {std::min(a, b), std::max(a, b)};
}

std::map<Ends, std::vector<int>> FacesOfEdges(const FloatMesh& m)
{
	std::map<Ends, std::vector<int>> faces;
	for (int f = 0; f < int(m.face.size()); ++f)
		for (int k = 0; k < 3; ++k) faces[EndsOf(m, f, k)].push_back(f);
	return faces;
}

/// polygonOf: #faces; edges between two faces of one polygon are marked.
void MarkPolygons(FloatMesh& m, const std::vector<int>& polygonOf)
{
	const auto facesOf = FacesOfEdges(m);
	for (int f = 0; f < int(m.face.size()); ++f)
		for (int k = 0; k < 3; ++k) {
			const std::vector<int>& both = facesOf.at(EndsOf(m, f, k));
			if (both.size() == 2 && polygonOf[size_t(both[0])] == polygonOf[size_t(both[1])]) m.face[size_t(f)].SetF(k);
		}
}

int CountFaux(const FloatMesh& m)
{
	int count = 0;
	for (const auto& f : m.face)
		for (int k = 0; k < 3; ++k) count += f.IsF(k);
	return count;
}

struct PolygonCase {
	const char* name;
	Shape shape;
	std::vector<int> polygonOf;  ///< #faces
	Outline outline;
	LabelFrame frame;
	double height;
};

std::vector<int> Pairs(const Shape& s)
{
	std::vector<int> polygonOf(s.faces.size());
	for (size_t f = 0; f < polygonOf.size(); ++f) polygonOf[f] = int(f) / 2;
	return polygonOf;
}

/// All faces that look up are one polygon; the others are triangles.
std::vector<int> OneTop(const Shape& s)
{
	std::vector<int> polygonOf(s.faces.size());
	std::iota(polygonOf.begin(), polygonOf.end(), 1);
	for (size_t f = 0; f < polygonOf.size(); ++f) {
		const auto at = [&](size_t k) { return s.points[size_t(s.faces[f][k])]; };
		const Point3d normal = (at(1) - at(0)) ^ (at(2) - at(0));
		if (normal[2] > normal.Norm() / 2) polygonOf[f] = 0;
	}
	return polygonOf;
}

std::vector<PolygonCase> PolygonCases()
{
	const Shape slab = test_mesh::Slab(30, 20, 6, 15, 10), box = test_mesh::Box(30, 20, 6),
				fan = test_mesh::Fan(24, 15, 6);
	LabelFrame mirrored = FromAbove();
	mirrored.toWorld[0][0] = -1;
	const Outline small = Letters({Rectangle(3, 0.5, 7, 4)});
	std::vector<PolygonCase> cases;
	for (const double height : {0.0, 0.5, -0.5}) {
		cases.push_back({"Slab", slab, Pairs(slab), ThreeLetters(), FromAbove(), height});
		cases.push_back({"Mirrored", slab, Pairs(slab), ThreeLetters(), mirrored, height});
		cases.push_back({"Box", box, Pairs(box), ThreeLetters(), FromAbove(), height});
		cases.push_back(
			{"BesideTheDiagonal", box, Pairs(box), Letters({Rectangle(8, -7, 11, -4)}), FromAbove(), height});
		cases.push_back({"SomeOfAFan", fan, OneTop(fan), small, FromAbove(), height});
		cases.push_back({"AllOfAFan", fan, OneTop(fan), ThreeLetters(), FromAbove(), height});
	}
	return cases;
}

class FauxEdges : public testing::TestWithParam<PolygonCase> {};

TEST_P(FauxEdges, EndWhereLettersAre)
{
	const PolygonCase& c = GetParam();
	FloatMesh before, after;
	test_mesh::Fill(before, c.shape);
	MarkPolygons(before, c.polygonOf);
	test_mesh::Fill(after, c.shape);
	MarkPolygons(after, c.polygonOf);
	LabelOptions options;
	options.height = c.height;
	const LabelResult result = LabelMesh(after, c.outline, c.frame, options);
	ExpectSameKind(c.shape, after);

	std::vector<char> isNew(after.face.size(), 0);
	for (const auto* list : {&result.topFaces, &result.wallFaces, &result.outsideFaces})
		for (const int f : *list) isNew[size_t(f)] = 1;
	const auto facesOf = FacesOfEdges(after);
	int ended = 0;
	for (int f = 0; f < int(after.face.size()); ++f)
		for (int k = 0; k < 3; ++k) {
			const bool isFaux = after.face[size_t(f)].IsF(k);
			if (isNew[size_t(f)]) {
				EXPECT_FALSE(isFaux) << "new face " << f;
				continue;
			}
			const std::vector<int>& both = facesOf.at(EndsOf(after, f, k));
			const bool wasFaux = before.face[size_t(f)].IsF(k),
					   meetsNew = isNew[size_t(both[0])] || isNew[size_t(both[1])];
			EXPECT_EQ(isFaux, wasFaux && !meetsNew) << "face " << f << ", edge " << k;
			ended += wasFaux && meetsNew;
		}
	EXPECT_LT(CountFaux(after), CountFaux(before));
	const bool isBesideSome = std::string(c.name) == "BesideTheDiagonal" || std::string(c.name) == "SomeOfAFan";
	EXPECT_TRUE(!isBesideSome || ended > 0) << "no polygon was cut in two";
}

INSTANTIATE_TEST_SUITE_P(Polygons, FauxEdges, testing::ValuesIn(PolygonCases()), [](const auto& c) {
	const double height = c.param.height;
	return std::string(c.param.name) + (height > 0 ? "Raised" : height < 0 ? "Sunk" : "Flat");
});

}  // namespace
