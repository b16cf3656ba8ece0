// The raise: where the tops go, by each way of extruding, and that walls join them to the surface.

#include "vcg_ext/label_raise.h"

#include <gtest/gtest.h>
#include <map>
#include <random>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

Shape Ball(double radius)
{
	return test_mesh::Sphere(radius, 120, 80).moved([&](const Point3d& p) { return p - Point3d(0, 0, radius); });
}

/// Call use(base, top) for each point of a contour and each moved vertex, in mesh coordinates.
template <class Use>
void EachRaised(const CutExample& e, const LabelPatch& patch, Use&& use)
{
	// the first vertices of a patch are the cut's new points, in their order
	const auto at = [&](int v) {
		const int old = int(e.sheet.vertices.size());
		return v < old ? e.sheet.vertices[size_t(v)].mesh : patch.vertices[size_t(v - old)].mesh;
	};
	std::map<int, int> topOf;  // a wall's first triangle is a piece of the contour from a to b, and the top of b
	for (size_t i = 0; i + 1 < patch.faces.size(); ++i) {
		if (patch.faces[i].kind != FaceKind::Wall) continue;
		const IndexTriangle &lower = patch.faces[i].vertex, &upper = patch.faces[i + 1].vertex;
		topOf[lower[1]] = lower[2];
		EXPECT_EQ(upper[0], lower[0]);
		EXPECT_EQ(upper[1], lower[2]);
		++i;
	}
	EXPECT_EQ(topOf.size(), e.cut.pieces.size());
	for (const auto& [base, top] : topOf) use(at(base), at(top));
	for (const auto& [v, p] : patch.moved) use(at(v), p);
}

TEST(Raise, GoesAlongTheRays)
{
	for (const double h : {0.7, -0.7}) {
		const CutExample e(Ball(12), ThreeLetters(), FromAbovePerspective(40));
		const LabelPatch patch = RaiseLabel(e.space, e.sheet, e.cut, h, ExtrudeAlong::Viewpoint);
		ASSERT_FALSE(patch.moved.empty());
		EachRaised(e, patch, [&](const Point3d& base, const Point3d& top) {
			const Point3d ray = Point3d(0, 0, 40) - base;
			EXPECT_NEAR(((top - base) - ray / ray.Norm() * h).Norm(), 0, 1e-12);
		});
	}
}

TEST(Raise, GoesAlongTheLabelsNormal)
{
	const LabelFrame frame = FrameFromDirection({0, 0, 0}, {0.3, -0.2, 1}, {0, 1, 0});
	const CutExample e(Ball(12), Moved(ThreeLetters(), 0.5, 0, 0), frame);
	EachRaised(
		e, RaiseLabel(e.space, e.sheet, e.cut, 0.7, ExtrudeAlong::LabelNormal),
		[&](const Point3d& base, const Point3d& top) { EXPECT_NEAR((top - base - frame.w * 0.7).Norm(), 0, 1e-12); });
}

// On a plane the smoothed normal is the plane's; on a ball it is the ball's, but for the facets.
TEST(Raise, GoesAlongTheSurfacesNormal)
{
	const Shape plane =
		test_mesh::Slab(40, 30, 4, 20, 15).moved([](const Point3d& p) { return p + Point3d(0, 0, 0.5 * p[0]); });
	const CutExample flat(plane, ThreeLetters(), FromAbove());
	const Point3d normal = Point3d(-0.5, 0, 1) / std::sqrt(1.25);
	EachRaised(
		flat, RaiseLabel(flat.space, flat.sheet, flat.cut, 0.7, ExtrudeAlong::SurfaceNormal),
		[&](const Point3d& base, const Point3d& top) { EXPECT_NEAR((top - base - normal * 0.7).Norm(), 0, 1e-9); });
	const CutExample round(Ball(12), ThreeLetters(), FromAbove());
	EachRaised(round, RaiseLabel(round.space, round.sheet, round.cut, 1, ExtrudeAlong::SurfaceNormal),
	           [&](const Point3d& base, const Point3d& top) {
				   EXPECT_NEAR((top - base).Norm(), 1, 1e-9);
				   const Point3d outwards = (base + Point3d(0, 0, 12)) / 12;
				   EXPECT_GT((top - base) * outwards, 0.99);
			   });
}

/// Whether new points of the cut lie on an edge of the sheet.
bool IsSplit(const CutExample& e, const std::pair<int, int>& edge)
{
	for (const CutPoint& p : e.cut.points.added) {
		const auto& parent = p.mixture.parent;
		if (std::minmax(parent[0], parent[1]) == std::pair<const int&, const int&>(edge.first, edge.second) &&
		    parent[2] == parent[1])
			return true;
	}
	return false;
}

// Directed edges of what goes and of what comes: inside the patch they cancel, what is left is the same border.
TEST(Raise, KeepsTheBorderOfThePatch)
{
	for (const double h : {0.7, -0.7, 0.0}) {
		const CutExample e(Ball(12), ThreeLetters(), FromAbovePerspective(40));
		const LabelPatch patch = RaiseLabel(e.space, e.sheet, e.cut, h, ExtrudeAlong::Viewpoint);
		std::map<std::pair<int, int>, int> balance;
		const auto add = [&](const IndexTriangle& t, int sign) {
			for (size_t k = 0; k < 3; ++k) {
				const int a = t[k], b = t[(k + 1) % 3];
				balance[{std::min(a, b), std::max(a, b)}] += a < b ? sign : -sign;
			}
		};
		int walls = 0;
		std::map<int, int> notWalls;
		for (const PatchFace& f : patch.faces) {
			add(f.vertex, 1);
			walls += f.kind == FaceKind::Wall;
			notWalls[f.parent] += f.kind != FaceKind::Wall;
		}
		for (const int t : patch.removed) {
			add(e.sheet.triangles[size_t(t)].vertex, -1);
			EXPECT_GT(notWalls[t], 0) << "every removed triangle lives on in a piece";
		}
		// edges that new points split are there whole on the one side and in pieces on the other
		const int old = int(e.sheet.vertices.size());
		for (const auto& [edge, count] : balance) {
			EXPECT_TRUE(edge.second >= old || count == 0 || IsSplit(e, edge)) << edge.first << ' ' << edge.second;
		}
		EXPECT_EQ(walls, h == 0 ? 0 : 2 * int(e.cut.pieces.size()));
		EXPECT_EQ(patch.moved.empty(), h == 0);
		EXPECT_TRUE(std::is_sorted(patch.removed.begin(), patch.removed.end()));
	}
}

// Raised along the normals of a rough plane, tops lean less from its axis than facets do.
TEST(Raise, NormalsOfARoughSurfaceSettle)
{
	std::mt19937 random(3);
	std::uniform_real_distribution<double> noise(-0.1, 0.1);
	const Shape rough = test_mesh::Slab(40, 30, 4, 40, 30).moved([&](const Point3d& p) {
		return p[2] == 0 ? p + Point3d(0, 0, noise(random)) : p;
	});
	const CutExample e(rough, ThreeLetters(), FromAbove());
	double most = 0;
	EachRaised(e, RaiseLabel(e.space, e.sheet, e.cut, 1, ExtrudeAlong::SurfaceNormal),
	           [&](const Point3d& base, const Point3d& top) {
				   most = std::max(most, std::hypot(top[0] - base[0], top[1] - base[1]));
			   });
	EXPECT_LT(most, 0.1);
	RecordProperty("most", std::to_string(most));
}

}  // namespace
