// Labels against numbers worked out another way: volumes, areas, distances, and what must not have changed.

#include "vcg_ext/text_label.h"

#include <gtest/gtest.h>
#include <random>
#include <set>

#include "label_check.h"
#include "test_mesh.h"
#include "text_outline.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

const std::string kText = "A43 %&@ÄgiB8";

const Outline& TextOutlines()
{
	static const Outline outline = [] {
		textlabel::TextOptions options;
		options.size = 8;
		return textlabel::MakeTextOutline(kText, options).outline;
	}();
	return outline;
}

double HalfWidth(const Outline& o)
{
	double most = 0;
	for (const Contour& c : o.contours)
		for (const Point2d& p : c.points) most = std::max(most, std::abs(p[0]));
	return most;
}

template <class MeshType>
class OnPlane : public testing::Test {
protected:
	/// Label a slab and return how much volume that added.
	double label(const Shape& slab, const Outline& outline, const LabelFrame& frame, double height,
	             LabelResult* out = nullptr)
	{
		MeshType m;
		test_mesh::Fill(m, slab);
		const Shape before = test_mesh::ToShape(m);
		LabelOptions options;
		options.height = height;
		const LabelResult result = LabelMesh(m, outline, frame, options);
		const Shape after = test_mesh::ToShape(m);
		ExpectSameKind(before, m);
		const double added = Volume(after) - Volume(before);
		EXPECT_NEAR(result.addedVolume, added, 1e-6 * std::abs(added) + 1e-9 * Volume(before));
		if (out != nullptr) *out = result;
		return added;
	}
};

using MeshTypes = testing::Types<test_mesh::FloatMesh, test_mesh::DoubleMesh>;
TYPED_TEST_SUITE(OnPlane, MeshTypes);

// Parallel projection: a prism over the letters.
TYPED_TEST(OnPlane, VolumeIsAreaTimesDepth)
{
	const Outline& text = TextOutlines();
	const double half = HalfWidth(text) + 2;
	for (const auto& [nx, ny] : {std::pair(1, 1), std::pair(37, 11)})
		for (const double height : {0.8, -0.8}) {
			LabelResult result;
			const double added =
				this->label(test_mesh::Slab(2 * half, 20, 3, nx, ny), text, FromAbove(), height, &result);
			EXPECT_NEAR(added, Area(text) * height, 1e-4 * Area(text) * std::abs(height)) << nx << " x " << ny;
			EXPECT_NEAR(result.labelArea, Area(text), 1e-5 * Area(text));
			EXPECT_NEAR(result.surfaceArea, Area(text), 1e-4 * Area(text));
		}
}

// Perspective: a point at distance L from C moves along its ray by h, so over the area element dA, seen under the solid angle
// c dA / L^3, lies the volume c dA (L^3 - (L - h)^3) / (3 L^3). The top is flat between its vertices and so differs from that by
// second order in (stroke width / c): below 1e-4 here.
TYPED_TEST(OnPlane, PerspectiveVolumeIsTheIntegralOverTheLetters)
{
	const Outline& text = TextOutlines();
	const double half = HalfWidth(text) + 2, c = 200;
	const auto perArea = [&](const Point2d& p, double h) {
		const double s = 1 - h / std::sqrt(c * c + p.SquaredNorm());
		return c * (1 - s * s * s) / 3;
	};
	for (const double h : {0.8, -0.8}) {
		// Integrate over each contour as signed triangles from the origin, cut fine; holes count negative by orientation.
		double expected = 0;
		constexpr int parts = 40;
		for (const Contour& contour : text.contours)
			for (size_t i = 0, j = contour.points.size() - 1; i < contour.points.size(); j = i++)
				for (int k = 0; k < parts; ++k) {
					const double inner = double(k) / parts, outer = double(k + 1) / parts;
					const Point2d a = contour.points[j], b = contour.points[i];
					const double area = (a ^ b) / 2 * (outer * outer - inner * inner);
					expected += area * perArea((a + b) / 2 * std::sqrt((outer * outer + inner * inner) / 2), h);
				}
		const double added = this->label(test_mesh::Slab(2 * half, 20, 3, 37, 11), text, FromAbovePerspective(c), h);
		EXPECT_NEAR(added, expected, 1e-4 * std::abs(expected));
	}
}

// A regular polygon under the viewpoint, within one triangle: all its corners are at the same distance from C, so its top is flat
// and the label is a frustum whose top is smaller by s = 1 - h / L.
TYPED_TEST(OnPlane, PerspectiveLabelOverOneTriangleIsAFrustum)
{
	const double c = 30, r = 3;
	const Outline letter = Letters({RegularPolygon(0, 0, r, 12)});
	Shape slab = test_mesh::Box(60, 60, 10);
	for (Point3d& p : slab.points) p += Point3d(10, -10, 0);  // the diagonal passes the polygon by
	for (const double h : {2.0, -2.0}) {
		const double distance = std::sqrt(c * c + r * r), s = 1 - h / distance, rise = h * c / distance;
		const double expected = Area(letter) * rise * (1 + s + s * s) / 3;
		EXPECT_NEAR(this->label(slab, letter, FromAbovePerspective(c), h), expected, 1e-6 * std::abs(expected));
	}
}

// The walls of a label towards C are planar and the solid is what the cones from C over its base have more than those over its top:
// with s_i = 1 - h / L_i for the corners of a base triangle, 1 - s_0 s_1 s_2 of the base's cone.
TYPED_TEST(OnPlane, PerspectiveVolumeIsTheDifferenceOfCones)
{
	TypeParam m, flat;
	const Shape slab = test_mesh::Slab(40, 20, 6, 9, 5);
	const double c = 40, h = 1.5;
	const Outline letters = ThreeLetters();
	test_mesh::Fill(flat, slab);
	const LabelResult base = LabelMesh(flat, letters, FromAbovePerspective(c));
	double expected = 0;
	for (const int f : base.topFaces) {
		double cone = 0, left = 1;
		std::array<Point3d, 3> p;
		for (int k = 0; k < 3; ++k) {
			for (int i = 0; i < 3; ++i) p[size_t(k)][i] = double(flat.face[size_t(f)].cP(k)[i]);
			left *= 1 - h / (p[size_t(k)] - Point3d(0, 0, c)).Norm();
		}
		cone = ((p[1] - p[0]) ^ (p[2] - p[0]))[2] * c / 6;
		expected += cone * (1 - left);
	}
	EXPECT_NEAR(this->label(slab, letters, FromAbovePerspective(c), h), expected, 1e-5 * expected);
}

// Cavalieri: in parallel projection the top is the base moved along w, whatever the surface is.
TYPED_TEST(OnPlane, ParallelVolumeDoesNotDependOnTheSurface)
{
	const Outline letters = Moved(ThreeLetters(), 1, 0.1234, -0.0567, 0.3);
	const Shape ball = test_mesh::Sphere(12, 60, 40).moved([](const Point3d& p) { return p - Point3d(0, 0, 12); });
	const Shape tube =
		test_mesh::Cylinder(15, 40, 64, 12).moved([](const Point3d& p) { return p - Point3d(0, 0, 15); });
	std::mt19937 random(7);
	std::uniform_real_distribution<double> noise(-0.15, 0.15);
	const Shape rough = test_mesh::Slab(30, 20, 8, 60, 40).moved([&](const Point3d& p) {
		return p[2] == 0 && std::abs(p[0]) < 14.9 && std::abs(p[1]) < 9.9 ? p + Point3d(0, 0, noise(random)) : p;
	});
	const Shape steep =
		test_mesh::Slab(40, 60, 30, 10, 10).moved([](const Point3d& p) { return p + Point3d(0, 0, p[1] + p[0] / 2); });
	for (const Shape* s : {&ball, &tube, &rough, &steep})
		for (const double h : {0.7, -0.7}) {
			LabelResult result;
			EXPECT_NEAR(this->label(*s, letters, FromAbove(), h, &result), Area(letters) * h, 1e-5 * Area(letters));
			if (s == &steep) {  // the plane z = y + x/2: every piece is longer by the same ratio
				EXPECT_NEAR(result.surfaceArea, Area(letters) * 1.5, 1e-5 * Area(letters));
				EXPECT_NEAR(result.stretch, 1.5, 1e-5);
			}
		}
}

// ---- the surface stays where it was ----

using Corner = std::array<Point3d, 3>;

std::vector<Corner> FacesOf(const Shape& s, const std::vector<int>& which)
{
	std::vector<Corner> out;
	for (const int f : which) {
		const auto& v = s.faces[size_t(f)];
		out.push_back({s.points[size_t(v[0])], s.points[size_t(v[1])], s.points[size_t(v[2])]});
	}
	return out;
}

std::vector<int> AllFaces(const Shape& s)
{
	std::vector<int> all(s.faces.size());
	for (size_t i = 0; i < all.size(); ++i) all[i] = int(i);
	return all;
}

/// Whether a triangle's box is farther away than that: most are, and are not looked at closely.
bool IsBeyond(const Corner& t, const Point3d& p, double distance)
{
	for (int i = 0; i < 3; ++i) {
		const auto [low, high] = std::minmax({t[0][i], t[1][i], t[2][i]});
		if (low - p[i] > distance || p[i] - high > distance) return true;
	}
	return false;
}

double NearestDistance(const Point3d& p, const std::vector<Corner>& faces)
{
	double least = std::numeric_limits<double>::infinity();
	for (const Corner& t : faces)
		if (!IsBeyond(t, p, least)) least = std::min(least, Distance(p, t));
	return least;
}

/// Every new piece lies in one old triangle: the distance from a triangle is convex, so corners tell for the whole piece.
double FarthestFromOld(const std::vector<Corner>& pieces, const std::vector<Corner>& old)
{
	double most = 0;
	for (const Corner& piece : pieces) {
		double least = std::numeric_limits<double>::infinity();
		for (const Corner& t : old) {
			if (IsBeyond(t, piece[0], least)) continue;
			double farthest = 0;
			for (const Point3d& p : piece) farthest = std::max(farthest, Distance(p, t));
			least = std::min(least, farthest);
		}
		most = std::max(most, least);
	}
	return most;
}

Point3d RandomPointIn(const Corner& t, std::mt19937& random)
{
	std::uniform_real_distribution<double> unit(0, 1);
	double a = unit(random), b = unit(random);
	if (a + b > 1) a = 1 - a, b = 1 - b;
	return t[0] + (t[1] - t[0]) * a + (t[2] - t[0]) * b;
}

TEST(Flat, SurfaceIsTheSameSetOfPoints)
{
	const Shape ball = test_mesh::Sphere(12, 40, 24).moved([](const Point3d& p) { return p - Point3d(0, 0, 12); });
	const Shape slab = test_mesh::Slab(30, 20, 4, 7, 5);
	std::mt19937 random(3);
	for (const Shape* s : {&slab, &ball})
		for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(40)}) {
			test_mesh::FloatMesh m;
			test_mesh::Fill(m, *s);
			const Shape before = test_mesh::ToShape(m);
			LabelMesh(m, Moved(ThreeLetters(), 1, 0.3, 0.2, 0.1), frame);
			const Shape after = test_mesh::ToShape(m);
			ExpectSameKind(before, m);
			const std::vector<Corner> old = FacesOf(before, AllFaces(before)), now = FacesOf(after, AllFaces(after));
			const double allowed = 3 * FloatUlp(before);
			EXPECT_LE(FarthestFromOld(now, old), allowed);
			for (const Corner& t : old)
				for (int i = 0; i < 4; ++i) EXPECT_LE(NearestDistance(RandomPointIn(t, random), now), allowed);
			EXPECT_NEAR(SurfaceArea(after), SurfaceArea(before), 1e-6 * SurfaceArea(before));
		}
}

TEST(Raised, SurfaceOutsideTheLettersIsTheSameSetOfPoints)
{
	const Outline letters = Moved(ThreeLetters(), 1, 0.3, 0.2, 0.1);
	const Shape ball = test_mesh::Sphere(12, 40, 24).moved([](const Point3d& p) { return p - Point3d(0, 0, 12); });
	std::mt19937 random(4);
	for (const double h : {1.0, -1.0}) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, ball);
		const Shape before = test_mesh::ToShape(m);
		LabelOptions options;
		options.height = h;
		const LabelResult result = LabelMesh(m, letters, FromAbove(), options);
		const Shape after = test_mesh::ToShape(m);
		std::set<int> label(result.topFaces.begin(), result.topFaces.end());
		label.insert(result.wallFaces.begin(), result.wallFaces.end());
		std::vector<int> outside;
		for (const int f : AllFaces(after))
			if (label.count(f) == 0) outside.push_back(f);
		const std::vector<Corner> old = FacesOf(before, AllFaces(before)), now = FacesOf(after, outside);
		const double allowed = 3 * FloatUlp(before);
		EXPECT_LE(FarthestFromOld(now, old), allowed);
		for (const Corner& t : old)
			for (int i = 0; i < 4; ++i) {
				const Point3d p = RandomPointIn(t, random);
				const Point2d inPlane(p[0], p[1]);
				const bool facing = ((t[1] - t[0]) ^ (t[2] - t[0]))[2] > 0;
				if (facing && (Winding(letters, inPlane) != 0 || ContourDistance(letters, inPlane) < 1e-3)) continue;
				EXPECT_LE(NearestDistance(p, now), allowed);
			}
		// and the tops are the letters' surface, moved by h
		for (const Corner& t : FacesOf(after, result.topFaces)) {
			const Point2d middle((t[0][0] + t[1][0] + t[2][0]) / 3, (t[0][1] + t[1][1] + t[2][1]) / 3);
			EXPECT_EQ(Winding(letters, middle), 1);
			for (const Point3d& p : t) EXPECT_LE(NearestDistance(p - Point3d(0, 0, h), old), allowed);
		}
	}
}

// ---- the result's own words ----

TEST(Result, ListsEveryNewFaceOnce)
{
	test_mesh::FloatMesh m;
	test_mesh::Fill(m, test_mesh::Slab(30, 20, 4, 7, 5));
	const int oldFaces = m.fn, oldVertices = m.vn;
	LabelOptions options;
	options.height = 1;
	const LabelResult result = LabelMesh(m, ThreeLetters(), FromAbove(), options);
	EXPECT_EQ(m.fn, oldFaces + result.newFaces);
	EXPECT_EQ(m.vn, oldVertices + result.newVertices);
	EXPECT_EQ(result.firstNewVertex, oldVertices);
	EXPECT_EQ(m.face.size(), size_t(m.fn)) << "deleted faces are left";
	std::set<int> faces;
	for (const std::vector<int>* list : {&result.topFaces, &result.wallFaces, &result.outsideFaces})
		for (const int f : *list) EXPECT_TRUE(faces.insert(f).second) << "face " << f << " twice";
	EXPECT_EQ(int(faces.size()), result.newFaces + result.touchedFaces);
	for (int f = oldFaces; f < m.fn; ++f) EXPECT_EQ(faces.count(f), 1u) << "new face " << f;
	// walls stand upright, tops lie at the height, pieces outside in the plane
	for (const int f : result.wallFaces) {
		const auto& t = m.face[size_t(f)];
		EXPECT_EQ(((t.cP(1) - t.cP(0)) ^ (t.cP(2) - t.cP(0)))[2], 0);
	}
	for (const int f : result.topFaces)
		for (int k = 0; k < 3; ++k) EXPECT_EQ(m.face[size_t(f)].cP(k)[2], 1);
	for (const int f : result.outsideFaces)
		for (int k = 0; k < 3; ++k) EXPECT_EQ(m.face[size_t(f)].cP(k)[2], 0);
}

// A point of the contour so near to another that the coordinates can't tell them apart is dropped: it, too, lies no further from what
// is made than the result says.
TEST(Result, ResolutionCoversThePointsThatAreDropped)
{
	for (double beside = 1e-7; beside < 1e-4; beside *= 1.5) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, test_mesh::Slab(30, 20, 4, 7, 5));
		const Point2d corner(5 + beside, -3 + beside / 2);
		LabelOptions options;
		options.height = 1;
		const LabelResult result =
			LabelMesh(m, Letters({{{-5, -3}, {5, -3}, corner, {5, 3}, {-5, 3}}}), FromAbove(), options);
		double nearest = std::numeric_limits<double>::infinity();
		for (const int f : result.wallFaces)
			for (int k = 0; k < 3; ++k) {
				const auto &p = m.face[size_t(f)].cP(k), &q = m.face[size_t(f)].cP((k + 1) % 3);
				if (p[2] != 0 || q[2] != 0) continue;
				nearest = std::min(nearest, ContourDistance(Letters({{{p[0], p[1]}, {q[0], q[1]}}}), corner));
			}
		EXPECT_LE(nearest, result.resolution) << beside;
		EXPECT_LT(result.resolution, 50 * FloatUlp(test_mesh::ToShape(m)));
	}
}

// The box of what has moved, and that of where all that is new or has moved is now, against a look at every vertex.
TEST(Result, SaysWhereWhatHasMovedWasAndIs)
{
	// the tip of a tent, a vertex of the mesh, is the highest point; it moves with the letter
	const Shape tent = test_mesh::Fan(9, 12, 4).moved(
		[](const Point3d& p) { return p[0] == 0 && p[1] == 0 && p[2] == 0 ? Point3d(0, 0, 3) : p; });
	for (const double height : {1.0, -1.0, 0.0}) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, tent);
		const Shape before = test_mesh::ToShape(m);
		LabelOptions options;
		options.height = height;
		const LabelResult result = LabelMesh(m, Letters({Rectangle(-2, -1, 2, 1)}), FromAbove(), options);
		const Shape after = test_mesh::ToShape(m);
		vcg::Box3d from, now;
		for (size_t i = 0; i < after.points.size(); ++i) {
			const bool isOld = i < before.points.size();
			if (isOld && after.points[i] == before.points[i]) continue;
			if (isOld) from.Add(before.points[i]);
			now.Add(after.points[i]);
		}
		EXPECT_EQ(result.movedFrom.IsNull(), height == 0);
		EXPECT_EQ(from.IsNull(), height == 0);
		if (height != 0) {
			EXPECT_LE((result.movedFrom.min - from.min).Norm() + (result.movedFrom.max - from.max).Norm(), 1e-6);
			if (height > 0) { EXPECT_EQ(now.max[2], 4); }
		}
		EXPECT_LE((result.newPlaces.min - now.min).Norm() + (result.newPlaces.max - now.max).Norm(), 1e-5);
	}
}

TEST(Result, RoomIsTheThicknessOfTheWall)
{
	const Shape slab = test_mesh::Slab(30, 20, 2.5, 7, 5);
	test_mesh::FloatMesh m;
	test_mesh::Fill(m, slab);
	LabelOptions options;
	options.height = -1;
	test_mesh::FloatMesh measured;
	EXPECT_EQ(LabelMesh(m, ThreeLetters(), FromAbove(), options).room, std::numeric_limits<double>::infinity())
		<< "deeper than the label";
	test_mesh::Fill(measured, slab);
	options.measureRoom = true;
	EXPECT_NEAR(LabelMesh(measured, ThreeLetters(), FromAbove(), options).room, 2.5, 1e-6);
	// a sheet has nothing behind it
	test_mesh::FloatMesh sheet;
	test_mesh::Fill(sheet, test_mesh::Sheet(4, 4, [](int i, int j) { return Point3d(10 * (i - 2), 10 * (j - 2), 0); }));
	options.height = 0;
	EXPECT_EQ(LabelMesh(sheet, ThreeLetters(), FromAbove(), options).room, std::numeric_limits<double>::infinity());
}

// To measure the room, everything behind the letters is looked at; without, only what they may reach.
TEST(Result, WhatLiesDeepChangesNothing)
{
	const Shape slab = test_mesh::Slab(30, 20, 2.5, 7, 5),
				ball = test_mesh::Sphere(12, 40, 24).moved([](const Point3d&p) { return p - Point3d(0, 0, 12); });
	int made = 0;
	const Shape twoFloors = slab.joined(slab.moved([](const Point3d& p) { return p - Point3d(0, 0, 5); }));
	for (const Shape& shape : {slab, ball, twoFloors})
		for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(60)})
			for (const double height : {1.0, -1.0, 0.0})
				for (const ExtrudeAlong along : {ExtrudeAlong::Viewpoint, ExtrudeAlong::SurfaceNormal}) {
					test_mesh::FloatMesh with, without;
					test_mesh::Fill(with, shape);
					test_mesh::Fill(without, shape);
					LabelOptions options;
					options.height = height;
					options.along = along;
					Error first(ErrorCode::OutOfMemory), second = first;
					const std::string said = Refusal(without, ThreeLetters(), frame, options, &first);
					options.measureRoom = true;
					EXPECT_EQ(Refusal(with, ThreeLetters(), frame, options, &second), said);
					EXPECT_EQ(first.limit, second.limit);
					made += said == "no error";
					const Shape a = test_mesh::ToShape(without), b = test_mesh::ToShape(with);
					EXPECT_EQ(a.points, b.points);
					EXPECT_EQ(a.faces, b.faces);
				}
	EXPECT_GE(made, 30) << "of 36";
}

TEST(Result, SameBytesOnEveryRun)
{
	std::string first;
	for (int run = 0; run < 3; ++run) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, test_mesh::Sphere(12, 40, 24).moved([](const Point3d& p) { return p - Point3d(0, 0, 12); }));
		LabelOptions options;
		options.height = 0.5;
		LabelMesh(m, ThreeLetters(), FromAbovePerspective(50), options);
		if (run == 0) first = test_mesh::Bytes(m);
		EXPECT_TRUE(test_mesh::Bytes(m) == first);
	}
}

}  // namespace
