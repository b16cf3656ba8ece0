// Pieces of cut triangles that reach out of the box of the candidates: what they cross there must be found.

#include "vcg_ext/overhang.h"

#include <gtest/gtest.h>

#include "label_check.h"

#include <random>

namespace {

using namespace label_check;
using test_mesh::Shape;

constexpr double step = 0.1;  // between coordinates
const Precision decimals{false, true, -1};

/// A plate on a slope of which most points are off the grid of the coordinates, and its triangles' corners on it.
Shape Slope(double side, int cells)
{
	return test_mesh::Sheet(cells, cells, [&](int i, int j) {
		const double x = side * i / cells - side / 2, y = side * j / cells - side / 2;
		return Point3d(x, y, 0.3 * x + 0.2 * y);
	});
}

/// A triangle over the slope whose corners are on the grid, and less than half a step above; or one that pierces the slope.
void AddCover(Shape& s, std::mt19937& random, double from, double to, bool pierces = false)
{
	std::uniform_real_distribution<double> radius(from, to), turn(0, 2 * M_PI), size(-6, 6);
	const double r = radius(random), a = turn(random);
	const int first = int(s.points.size());
	for (int k = 0; k < 3; ++k) {
		int i = int(std::round((r * std::cos(a) + size(random)) / step));
		const int j = int(std::round((r * std::sin(a) + size(random)) / step));
		while ((3 * i + 2 * j) % 10 != -1 && (3 * i + 2 * j) % 10 != 9) ++i;  // a tenth of a step below the next one
		s.add({i * step, j * step, (3 * i + 2 * j + 1) * step / 10 - (pierces && k == 0 ? 2 : 0)});
	}
	s.faces.push_back({first, first + 1, first + 2});
}

struct Tally {
	int crossings = 0, sound = 0, pierced = 0, withinRing = 0;
};

void Compare(const Shape& plate, double from, double to, std::mt19937& random, Tally& tally)
{
	Shape shape = plate;
	for (int i = 0; i < 8; ++i) AddCover(shape, random, from, to, i == 0);
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, shape);
	std::uniform_real_distribution<double> shift(-1, 1);
	const Outline letters = Moved(Letters({Rectangle(-8, -5, -1, 5), RegularPolygon(5, 0, 4, 7)}), 1, shift(random),
	                              shift(random), shift(random));
	const LabelSpace space(FrameFromDirection({0, 0, 0}, {-0.3, -0.2, 1}, {0, 1, 0}));
	PlaneBox box;
	for (const Contour& c : letters.contours)
		for (const Point2d& p : c.points) box.add(p);
	box.grow(step);
	const Sheet sheet = CollectSheet(m, space, box);
	LabelPatch patch;
	try {
		const auto seeds = FindSeeds(space, sheet, letters, step);
		patch =
			RaiseLabel(space, sheet, LabelCutter(space, sheet, step).cut(letters, seeds), 1, ExtrudeAlong::Viewpoint);
	} catch (const Error&) {
		return;  // a cover is over the letters
	} catch (const PlacementConflict&) {
		return;
	}
	const auto position = RoundedPositions(sheet, patch, [](double x) { return decimals.round(x); });
	std::vector<char> isCandidate(shape.faces.size(), 0);
	for (const SheetTriangle& t : sheet.triangles) isCandidate[size_t(t.face)] = 1;
	const Overhang overhang(sheet, patch.removed, decimals, 0);
	const std::vector<DistantFace> found = DistantFinder(m, sheet)(overhang);
	for (const DistantFace& f : found) EXPECT_FALSE(isCandidate[size_t(f.face)]);
	tally.withinRing += overhang.isWithin(sheet.around);
	const PatchVerdict verdict = CheckOverhang(sheet, patch, position, decimals, overhang, found);
	bool crosses = false, pierces = false;
	for (const PatchFace& f : patch.faces) {
		if (f.kind != FaceKind::Outside) continue;
		const Corners piece = detail::CornersOf(position, f.vertex);
		const auto& whole = shape.faces[size_t(sheet.triangles[size_t(f.parent)].face)];
		for (size_t other = plate.faces.size(); other < shape.faces.size(); ++other) {
			if (isCandidate[other]) continue;
			const auto stored = [&](const auto& face) -> Corners {
				const auto at = [&](size_t k) { return shape.points[size_t(face[k])]; };
				return {at(0), at(1), at(2)};
			};
			Corners rounded = stored(shape.faces[other]);
			for (Point3d& p : rounded)
				for (int i = 0; i < 3; ++i) p[i] = decimals.round(p[i]);
			if (!IsCrossing(ContactOf(piece, rounded))) continue;
			const bool before = IsCrossing(ContactOf(stored(whole), stored(shape.faces[other])));
			(before ? pierces : crosses) = true;
		}
	}
	EXPECT_EQ(verdict.fault == PatchFault::SpoilsBeside, crosses);
	if (crosses) { EXPECT_GE(verdict.face, int(plate.faces.size())) << "a cover"; }
	++(crosses ? tally.crossings : tally.sound);
	tally.pierced += pierces && !crosses;
}

/// @param[in] from, to  how far from the letters the covers are
Tally CompareMany(const Shape& plate, double from, double to, int labels)
{
	std::mt19937 random(3);
	Tally tally;
	for (int i = 0; i < labels; ++i) Compare(plate, from, to, random, tally);
	return tally;
}

TEST(Overhang, WhatPiecesCrossFarOutIsFound)
{
	const Tally tally = CompareMany(Slope(400, 1), 25, 120, 300);
	EXPECT_GT(tally.crossings, 30);
	EXPECT_GT(tally.sound, 30);
	EXPECT_GT(tally.pierced, 10) << "what crossed before may";
	EXPECT_EQ(tally.withinRing, 0) << "two triangles hold all";
}

TEST(Overhang, WhatTheyCrossNextToTheBoxIsFound)
{
	const Tally tally = CompareMany(Slope(60, 20), 14, 20, 1000);
	EXPECT_GT(tally.crossings, 10);
	EXPECT_GT(tally.sound, 30);
	EXPECT_GT(tally.withinRing, 600);
}

// The list of faces around the box leaves none out, also of what can't be unrolled whole.
TEST(Overhang, FacesAroundTheBoxAreAllNoted)
{
	constexpr double radius = 12;
	LabelFrame wrapped = FromAbove();
	wrapped.wrapRadius = radius;
	wrapped.wrapAxis = wrapped.v;
	wrapped.origin = {0, 0, radius};
	const Shape ball = test_mesh::Sphere(radius, 40, 24),
				tube = test_mesh::Cylinder(radius, 20, 5, 3).moved([](const Point3d&p) {  // along y
					return Point3d(p[0], p[2] - 10, p[1]);
				});
	int wider = 0, overTheCut = 0;
	for (const Shape& shape : {ball, tube})
		for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(40), wrapped})
			for (const double halfWidth : {5.0, 20.0, 25.0, 33.0}) {
				test_mesh::DoubleMesh m;
				test_mesh::Fill(m, shape);
				const LabelSpace space(frame);
				PlaneBox box;
				box.add({-halfWidth, -3});
				box.add({halfWidth, 3});
				const Sheet sheet = CollectSheet(m, space, box);
				EXPECT_TRUE(sheet.around.holds(box));
				std::vector<char> isThere(shape.faces.size(), 0);
				for (const SheetTriangle& t : sheet.triangles) isThere[size_t(t.face)] = 1;
				for (const StraddlingTriangle& t : sheet.straddling) isThere[size_t(t.face)] = 1;
				for (const int f : sheet.besides) {
					EXPECT_FALSE(isThere[size_t(f)]) << "a candidate is not beside the box";
					isThere[size_t(f)] = 1;
				}
				wider += sheet.around.width() > box.width() && !sheet.besides.empty();
				for (size_t f = 0; f < shape.faces.size(); ++f) {
					bool meets = false;
					const auto at = [&](size_t k) { return shape.points[size_t(shape.faces[f][k])]; };
					constexpr int parts = 12;
					for (int i = 0; i <= parts; ++i)
						for (int j = 0; i + j <= parts; ++j) {
							const Point3d q = space.toLabel((at(0) * i + at(1) * j + at(2) * (parts - i - j)) / parts);
							meets = meets || (space.isInFront(q) && sheet.around.holds(space.project(q)));
						}
					if (meets) { EXPECT_TRUE(isThere[f]) << "face " << f << " of " << shape.faces.size(); }
					if (!meets || !space.wraps()) continue;
					double low = at(0)[0], high = low;
					for (size_t k = 0; k < 3; ++k) {
						const double way = space.unrolled(at(k))[0];
						low = k == 0 ? way : std::min(low, way);
						high = k == 0 ? way : std::max(high, way);
					}
					overTheCut += high - low > space.circumference() / 2;
				}
			}
	EXPECT_GT(wider, 6);
	EXPECT_GT(overTheCut, 0);
}

// The triangles under a line of text may be larger than it is high; no pass over the whole mesh is due for them.
TEST(Overhang, WhatReachesOutOfALongBoxIsWithinTheWiderOne)
{
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, test_mesh::Slab(60, 40, 4, 12, 8));
	PlaneBox box;
	box.add({-10.5, -1});
	box.add({10.5, 1});
	const Sheet sheet = CollectSheet(m, LabelSpace(FromAbove()), box);
	ASSERT_FALSE(sheet.triangles.empty());
	PlaneBox reach;
	for (const SheetVertex& v : sheet.vertices) reach.add(v.plane);
	EXPECT_GT(reach.height(), 2 * box.height());
	EXPECT_TRUE(sheet.around.holds(reach));
}

// Through the whole library: a lid that nearly lies on a coarse plate, beside the letters.
TEST(Overhang, ALabelBesideALidIsSoundOrRefused)
{
	std::mt19937 random(5);
	int made = 0, refused = 0;
	for (int i = 0; i < 60; ++i) {
		Shape shape = Slope(400, 1);
		for (int k = 0; k < 4; ++k) AddCover(shape, random, 30, 120);
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, shape);
		LabelOptions options;
		options.height = 4;
		options.fileDigits = -1;
		const auto isClear = [](const Shape& s) {
			std::vector<Corners> faces;
			for (const auto& f : s.faces) {
				Corners c = {s.points[size_t(f[0])], s.points[size_t(f[1])], s.points[size_t(f[2])]};
				for (Point3d& p : c)
					for (int k = 0; k < 3; ++k) p[k] = decimals.round(p[k]);
				faces.push_back(c);
			}
			return FindCrossings(faces).empty();
		};
		if (!isClear(shape)) continue;  // covers that cross each other
		try {
			LabelMesh(m, Letters({Rectangle(-8, -5, -1, 5), Rectangle(2, -5, 9, 5)}),
			          FrameFromDirection({0.03 * i, 0, 0}, {-0.3, -0.2, 1}, {0, 1, 0}), options);
			++made;
			EXPECT_TRUE(isClear(test_mesh::ToShape(m))) << i;
		} catch (const Error& e) {
			++refused;
			EXPECT_EQ(test_mesh::ToShape(m).points.size(), shape.points.size()) << "nothing has changed";
		}
	}
	EXPECT_GT(made, 5);
	RecordProperty("refused", refused);
}

}  // namespace
