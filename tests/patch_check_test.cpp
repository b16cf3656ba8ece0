// The check before the commit: sound patches pass, each way of spoiling one is found.

#include "vcg_ext/patch_check.h"

#include <gtest/gtest.h>

#include "label_check.h"

#include <random>

namespace {

using namespace label_check;
using test_mesh::Shape;

double Exactly(double x) { return x; }
double AsFloat(double x) { return static_cast<float>(x); }

PatchVerdict Check(const CutExample& e, double height, ExtrudeAlong along = ExtrudeAlong::Viewpoint,
                   double (*round)(double) = AsFloat)
{
	const LabelPatch patch = RaiseLabel(e.space, e.sheet, e.cut, height, along);
	return CheckPatch(e.space, e.sheet, patch, RoundedPositions(e.sheet, patch, round));
}

Shape Slab() { return test_mesh::Slab(30, 20, 4, 15, 10); }

TEST(PatchCheck, SoundPatchesPass)
{
	const CutExample e(Slab(), ThreeLetters(), FromAbove());
	for (const double h : {1.0, -1.0, 0.0, 100.0})
		for (double (*round)(double) : {Exactly, AsFloat})
			EXPECT_EQ(Check(e, h, ExtrudeAlong::Viewpoint, round).fault, PatchFault::Sound) << h;
}

TEST(PatchCheck, FindsPointsThatRoundingMerges)
{
	const CutExample e(Slab(), Letters({Rectangle(-3.3, -3, 3, 3), Rectangle(5, 0.1, 5.2, 2)}), FromAbove());
	EXPECT_EQ(Check(e, 1, ExtrudeAlong::Viewpoint, [](double x) { return std::round(x * 2) / 2; }).fault,
	          PatchFault::Merged);
	EXPECT_EQ(Check(e, 1e-9, ExtrudeAlong::Viewpoint, [](double x) { return std::round(x * 1e6) / 1e6; }).fault,
	          PatchFault::Merged)
		<< "the top falls back on the surface";
}

TEST(PatchCheck, FindsVerticesInOnePlaceAsALookAtAllPairsDoes)
{
	std::mt19937 random(5);
	int merged = 0;
	for (int round = 0; round < 300; ++round) {
		const double few[] = {0.0, -0.0, 1.0, -1.0, 1e-300, 2.5e9};
		std::uniform_int_distribution<size_t> choice(0, std::size(few) - 1);
		std::vector<vcg::Point3d> position(1 + size_t(round) % 40);
		std::vector<char> marked(position.size());
		for (vcg::Point3d& p : position) p = {few[choice(random)], few[choice(random)], few[choice(random)]};
		for (char& m : marked) m = choice(random) < size_t(round) % 5;
		std::vector<int> pairs;  // of those that are marked, the ones with another in their place
		for (size_t i = 0; i < position.size(); ++i)
			for (size_t k = 0; k < position.size(); ++k)
				if (i != k && marked[i] && position[i] == position[k]) pairs.push_back(int(i));
		const int found = detail::FindMerged(position, marked);
		EXPECT_EQ(found < 0, pairs.empty());
		EXPECT_TRUE(found < 0 || std::count(pairs.begin(), pairs.end(), found)) << found;
		merged += found >= 0;
	}
	EXPECT_GT(merged, 50);
	EXPECT_LT(merged, 250);
}

TEST(PatchCheck, FindsFacesThatRoundingTurnsRound)
{
	// a coordinate grid so coarse that corners of small pieces change sides, but no two points fall together
	const CutExample e(Slab(), Letters({RegularPolygon(0.13, 0.07, 1.1, 9, 0.2)}), FromAbove());
	int found = 0;
	for (double step = 0.05; step < 0.4; step *= 1.1) {
		const auto round = [step](double x) { return std::round(x / step) * step; };
		const LabelPatch patch = RaiseLabel(e.space, e.sheet, e.cut, 0, ExtrudeAlong::Viewpoint);
		const PatchFault fault = CheckPatch(e.space, e.sheet, patch, RoundedPositions(e.sheet, patch, round)).fault;
		// the same, seen from above: does any face of the rounded patch have no positive area?
		const auto position = RoundedPositions(e.sheet, patch, round);
		bool turned = false;
		for (const PatchFace& f : patch.faces) {
			const Corners c = detail::CornersOf(position, f.vertex);
			turned = turned || ((c[1] - c[0]) ^ (c[2] - c[0]))[2] <= 0;
		}
		EXPECT_EQ(fault != PatchFault::Sound, turned || fault == PatchFault::Merged) << "step " << step;
		found += fault == PatchFault::Collapsed;
	}
	EXPECT_GT(found, 0);
}

TEST(PatchCheck, FindsWhatComesOutBehind)
{
	const CutExample e(Slab(), ThreeLetters(), FromAbove());
	EXPECT_EQ(Check(e, -3.99).fault, PatchFault::Sound);
	const PatchVerdict through = Check(e, -4.5);
	EXPECT_EQ(through.fault, PatchFault::CrossesPart);
	ASSERT_GE(through.face, 0);
	const Shape slab = Slab();
	for (const int v : slab.faces[size_t(through.face)]) EXPECT_EQ(slab.points[size_t(v)][2], -4);
}

// In a groove the tops of a label along its normals come together in the axis and turn over behind it.
TEST(PatchCheck, FindsFolds)
{
	const Shape groove = test_mesh::Sheet(40, 10, [](int i, int j) {
		const double a = M_PI * (i / 40.0) - M_PI;
		return Point3d(5 * std::cos(a), 3.0 * (j - 5), 5 * std::sin(a) + 5);
	});
	const CutExample e(groove, Letters({Rectangle(-3.3, -4, 3.1, 4)}), FromAbove());
	EXPECT_EQ(Check(e, 2, ExtrudeAlong::SurfaceNormal).fault, PatchFault::Sound);
	const PatchFault fault = Check(e, 7, ExtrudeAlong::SurfaceNormal).fault;
	EXPECT_TRUE(fault == PatchFault::Folded || fault == PatchFault::CrossesSelf) << int(fault);
}

// A part that crosses itself under the label is not held against the label.
TEST(PatchCheck, ForgivesWhatWasWrongBefore)
{
	const Shape spike = test_mesh::Box(0.5, 0.5, 2).moved([](const Point3d& p) { return p + Point3d(0.3, 0.2, 1); });
	const Shape both = Slab().joined(spike);  // sticks through the top
	const CutExample e(both, Letters({Rectangle(-4, -4, 4, 4), Hole(Rectangle(-1.5, -1.5, 1.5, 1.5))}), FromAbove());
	for (const double h : {1.0, -1.0, 0.0}) EXPECT_EQ(Check(e, h).fault, PatchFault::Sound) << h;
}

// A triangle that reaches behind the viewpoint has no place in the label plane, but the raised letters may run into it.
TEST(PatchCheck, FindsTrianglesThatReachBehindTheViewpoint)
{
	Shape part = Slab();
	const int a = part.add({0.5, -0.2, -1}), b = part.add({0.7, 0.2, -1}), c = part.add({0.6, 0, 30});
	part.faces.push_back({a, b, c});
	const Outline on = Letters({Rectangle(-1, -1, 1, 1)}), beside = Letters({Rectangle(-4, -1, -2, 1)});
	const LabelFrame view = FromAbovePerspective(10);
	LabelOptions options;
	for (const double height : {0.5, -0.5}) {
		options.height = height;
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, part);
		Error error(ErrorCode::EmptyLabel);
		EXPECT_NE(Refusal(m, on, view, options, &error), "no error") << height;
		EXPECT_EQ(Refusal(m, beside, view, options, &error), "no error") << height;
	}
}

}  // namespace
