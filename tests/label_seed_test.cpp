// Seeds: the first surface that the viewer sees, against a look at every triangle.

#include "vcg_ext/label_seed.h"

#include <gtest/gtest.h>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

Shape Stairs()
{
	Shape s;
	for (int i = 0; i < 4; ++i)
		s = s.joined(test_mesh::Slab(20 - 4 * i, 16 - 3 * i, 0.5, 5, 5).moved([&](const Point3d& p) {
			return p + Point3d(0.3 * i, 0.2 * i, 2 * i);
		}));
	return s;
}

// On every storey the triangle whose plane is highest under the point.
TEST(Seeds, AreTheFirstSurfaceSeen)
{
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(60)}) {
		const LabelSpace space(frame);
		const Sheet sheet = CandidatesOf(Stairs(), space, 40, 40);
		Outline outline;
		for (int i = -8; i <= 8; ++i)
			for (int j = -6; j <= 6; ++j)
				outline.contours.push_back({RegularPolygon(i + 0.17, j + 0.23, 0.01, 3), 0, 0});
		const std::vector<int> seeds = FindSeeds(space, sheet, outline, 1e-6);
		ASSERT_EQ(seeds.size(), outline.contours.size());
		for (size_t c = 0; c < seeds.size(); ++c) {
			const Point2d p = outline.contours[c].points[0];
			double highest = -1e9;
			int expected = -1;
			for (size_t t = 0; t < sheet.triangles.size(); ++t) {
				if (!sheet.triangles[t].facing) continue;
				const Point3d w = SpaceWeights(space, sheet, int(t), p);
				if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
				double z = 0;
				for (int k = 0; k < 3; ++k)
					z += w[k] * sheet.vertices[size_t(sheet.triangles[t].vertex[size_t(k)])].label[2];
				if (z > highest) highest = z, expected = int(t);
			}
			EXPECT_EQ(seeds[c], expected) << p[0] << ' ' << p[1];
		}
	}
}

// A point exactly on an edge or a vertex has a seed: one of the triangles there.
TEST(Seeds, OnEdgesAndVertices)
{
	const LabelSpace space(FromAbove());
	const Sheet sheet = CandidatesOf(test_mesh::Slab(20, 20, 4, 10, 10), space, 40, 40);
	for (const Point2d& p :
	     {Point2d(0, 0), Point2d(2, 1), Point2d(1, 1), Point2d(10, 3), Point2d(10, 10), Point2d(10 + 0.5e-6, 3)}) {
		Outline outline = Letters({{p, p + Point2d(0.1, 0), p + Point2d(0, 0.1)}});
		const int seed = FindSeeds(space, sheet, outline, 1e-6)[0];
		ASSERT_GE(seed, 0);
		EXPECT_TRUE(sheet.triangles[size_t(seed)].facing);
		const Point3d w = SpaceWeights(space, sheet, seed, p);
		for (int k = 0; k < 3; ++k) EXPECT_GE(w[k], -1e-6);
	}
	EXPECT_THROW(FindSeeds(space, sheet, Letters({Rectangle(10.001, 3, 11, 4)}), 1e-6), Error);
}

TEST(Seeds, SayWhichLetterFallsBeside)
{
	const LabelSpace space(FromAbovePerspective(50));
	const Sheet sheet = CandidatesOf(test_mesh::Box(20, 20, 4), space, 100, 100);
	try {
		FindSeeds(space, sheet, Letters({Rectangle(-1, -1, 1, 1), Rectangle(2, 2, 3, 3), Rectangle(30, 2, 31, 3)}),
		          1e-6);
		FAIL() << "nothing is at 30";
	} catch (const Error& e) {
		EXPECT_EQ(e.code, ErrorCode::OffSurface);
		EXPECT_EQ(e.letter, 2);
		EXPECT_NEAR((e.place - Point3d(30, 2, 0)).Norm(), 0, 1e-9);
	}
}

}  // namespace
