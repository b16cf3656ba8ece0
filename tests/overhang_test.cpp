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

/// A triangle over the slope whose corners are on the grid, and less than half a step above.
void AddCover(Shape& s, std::mt19937& random, double from, double to)
{
	std::uniform_real_distribution<double> radius(from, to), turn(0, 2 * M_PI), size(-6, 6);
	const double r = radius(random), a = turn(random);
	const int first = int(s.points.size());
	for (int k = 0; k < 3; ++k) {
		int i = int(std::round((r * std::cos(a) + size(random)) / step));
		const int j = int(std::round((r * std::sin(a) + size(random)) / step));
		while ((3 * i + 2 * j) % 10 != -1 && (3 * i + 2 * j) % 10 != 9) ++i;  // a tenth of a step below the next one
		s.add({i * step, j * step, (3 * i + 2 * j + 1) * step / 10});
	}
	s.faces.push_back({first, first + 1, first + 2});
}

struct Tally {
	int crossings = 0, sound = 0, withinRing = 0;
};

void Compare(const Shape& plate, double from, double to, std::mt19937& random, Tally& tally)
{
	Shape shape = plate;
	for (int i = 0; i < 8; ++i) AddCover(shape, random, from, to);
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
	const auto find = [&](const Overhang& overhang) {
		const std::vector<DistantFace> found = FacesNear(m, sheet, overhang);
		for (const DistantFace& f : found) EXPECT_FALSE(isCandidate[size_t(f.face)]);
		tally.withinRing += overhang.isWithin(sheet.around);
		return found;
	};
	const PatchVerdict verdict = CheckOverhang(sheet, patch, position, decimals, find);
	std::vector<Corners> pieces, others;
	for (const PatchFace& f : patch.faces)
		if (f.kind == FaceKind::Outside) pieces.push_back(detail::CornersOf(position, f.vertex));
	for (size_t f = 0; f < shape.faces.size(); ++f) {
		const auto at = [&](size_t k) { return shape.points[size_t(shape.faces[f][k])]; };
		if (!isCandidate[f]) others.push_back({at(0), at(1), at(2)});
		for (size_t k = 0; k < 3 && !isCandidate[f]; ++k)
			for (int i = 0; i < 3; ++i) others.back()[k][i] = decimals.round(others.back()[k][i]);
	}
	CrossingOptions options;
	options.ignore = [](int, int, bool isOther) { return !isOther; };
	const bool crosses = !FindCrossings(pieces, others, options).empty();
	EXPECT_EQ(verdict.fault == PatchFault::CrossesPart, crosses);
	if (crosses) { EXPECT_GE(verdict.face, int(plate.faces.size())) << "a cover"; }
	++(crosses ? tally.crossings : tally.sound);
}

TEST(Overhang, WhatPiecesCrossFarOutIsFound)
{
	std::mt19937 random(3);
	Tally tally;
	for (int i = 0; i < 300; ++i) Compare(Slope(400, 1), 25, 120, random, tally);
	EXPECT_GT(tally.crossings, 30);
	EXPECT_GT(tally.sound, 30);
	EXPECT_EQ(tally.withinRing, 0) << "two triangles hold all";
}

TEST(Overhang, WhatTheyCrossNextToTheBoxIsFound)
{
	std::mt19937 random(4);
	Tally tally;
	for (int i = 0; i < 1500; ++i) Compare(Slope(60, 20), 14, 20, random, tally);
	EXPECT_GT(tally.crossings, 20);
	EXPECT_GT(tally.sound, 30);
	EXPECT_GT(tally.withinRing, 1000);
}

// The list of faces beside the box leaves none out.
TEST(Overhang, FacesBesideTheBoxAreAllNoted)
{
	const Shape ball = test_mesh::Sphere(12, 40, 24);
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, ball);
	LabelFrame wrapped = FromAbove();
	wrapped.wrapRadius = 12;
	wrapped.wrapAxis = wrapped.v;
	wrapped.origin = {0, 0, 12};
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(40), wrapped}) {
		const LabelSpace space(frame);
		PlaneBox box;
		box.add({-5, -3});
		box.add({5, 3});
		const Sheet sheet = CollectSheet(m, space, box);
		EXPECT_TRUE(sheet.around.holds(box));
		EXPECT_GT(sheet.around.width(), box.width());
		std::vector<char> isThere(ball.faces.size(), 0);
		for (const SheetTriangle& t : sheet.triangles) isThere[size_t(t.face)] = 1;
		for (const StraddlingTriangle& t : sheet.straddling) isThere[size_t(t.face)] = 1;
		for (const int f : sheet.besides) {
			EXPECT_FALSE(isThere[size_t(f)]) << "a candidate is not beside the box";
			isThere[size_t(f)] = 1;
		}
		EXPECT_GT(sheet.besides.size(), 10u);
		const Sheet wider = CollectSheet(m, space, sheet.around);
		for (const SheetTriangle& t : wider.triangles) EXPECT_TRUE(isThere[size_t(t.face)]) << "face " << t.face;
	}
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
