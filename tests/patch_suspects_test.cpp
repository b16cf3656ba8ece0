// Suspects: what is left out of the exact search must never be what the exact search would have found.

#include "vcg_ext/patch_check.h"

#include <gtest/gtest.h>

#include "label_check.h"

namespace {

using namespace label_check;
using test_mesh::Shape;

/// The least room between coordinates decides what can go wrong, so coarse ones stand in for millions of labels on fine ones.
double OnGrid(double x, double step) { return std::round(x / step) * step; }

Shape Quantized(const Shape& s, double step)
{
	return s.moved(
		[step](const Point3d& p) { return Point3d(OnGrid(p[0], step), OnGrid(p[1], step), OnGrid(p[2], step)); });
}

/// Hills of a given steepness on a slab, with triangles of about one unit.
Shape Hills(double amplitude, double turn)
{
	const Shape top = test_mesh::Sheet(34, 26, [&](int i, int j) {
		const double x = 0.9 * (i - 17) + 0.2 * std::sin(1.3 * j + turn), y = 0.9 * (j - 13) + 0.2 * std::cos(1.7 * i);
		return Point3d(x, y, amplitude * std::sin(0.9 * x + turn) * std::cos(1.1 * y));
	});
	return test_mesh::Thickened(top, 34, 26, {0, 0, -12});
}

struct Tally {
	int unsuspected = 0, partly = 0, all = 0, faulty = 0;
};
struct Tallies {
	Tally onRays, offRays;
};

void Compare(const Shape& shape, const LabelFrame& frame, const Outline& outline, double step, double height,
             Tallies& tallies)
{
	const double snap = 4 * step;
	std::unique_ptr<CutExample> e;
	SheetLayer layer;
	try {
		e = std::make_unique<CutExample>(Quantized(shape, step), outline, frame, snap);
		layer = FindLayer(e->sheet, outline, FindSeeds(e->space, e->sheet, outline, snap));
	} catch (const PlacementConflict&) {
		return;  // too coarse for these letters
	} catch (const Error&) {
		return;  // too steep for this view
	}
	for (const ExtrudeAlong along : {ExtrudeAlong::Viewpoint, ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal}) {
		const LabelPatch patch = RaiseLabel(e->space, e->sheet, e->cut, height, along);
		const auto position = RoundedPositions(e->sheet, patch, [step](double x) { return OnGrid(x, step); });
		const PatchVerdict full = CheckPatch(e->space, e->sheet, patch, position);
		for (const bool onRays : {true, false}) {
			if (onRays && along != ExtrudeAlong::Viewpoint) continue;
			const Suspects suspects = FindSuspects(e->space, e->sheet, layer, patch, position, onRays, height, snap);
			const PatchVerdict found = CheckPatch(e->space, e->sheet, patch, position, suspects);
			EXPECT_EQ(found.fault == PatchFault::Sound, full.fault == PatchFault::Sound)
				<< "step " << step << " height " << height << " along " << int(along) << " on rays " << onRays
				<< " found " << int(found.fault) << " full " << int(full.fault);
			Tally& tally = onRays ? tallies.onRays : tallies.offRays;
			tally.faulty += full.fault != PatchFault::Sound;
			++(suspects.all ? tally.all : suspects.none() ? tally.unsuspected : tally.partly);
		}
	}
}

TEST(Suspects, NothingThatCrossesGoesUnsuspected)
{
	Tallies tallies;
	const double slant = 0.3;
	for (double step = 1.0 / (1 << 20); step < 0.1; step *= 2)
		for (const double amplitude : {0.0, 0.5, 3.0})
			for (int turn = 0; turn < 3; ++turn)
				for (const double height : {1.0, -1.0, 0.0, 8 * step}) {
					const LabelFrame frame = FrameFromDirection(
						{0.1 * turn, 0, 0}, {slant * std::sin(turn), slant * std::cos(turn), 1}, {0.1, 1, 0});
					Compare(Hills(amplitude, turn), frame, ThreeLetters(), step, height, tallies);
				}
	EXPECT_GT(tallies.onRays.unsuspected, 50);
	EXPECT_GT(tallies.onRays.partly, 50);
	EXPECT_GT(tallies.onRays.all, 10);
	EXPECT_GT(tallies.onRays.faulty, 10);
	EXPECT_GT(tallies.offRays.partly, 200);
	EXPECT_GT(tallies.offRays.faulty, 50);
}

TEST(Suspects, InPerspectiveToo)
{
	Tallies tallies;
	for (double step = 1.0 / (1 << 20); step < 0.1; step *= 4)
		for (const double amplitude : {0.0, 0.5, 2.0})
			for (const double height : {1.0, -1.0}) {
				LabelFrame frame = FromAbovePerspective(40);
				Compare(Hills(amplitude, 1), frame, ThreeLetters(), step, height, tallies);
			}
	EXPECT_GT(tallies.onRays.unsuspected + tallies.onRays.partly, 10);
	EXPECT_GT(tallies.offRays.partly, 20);
}

// A sheet that runs a grid step behind the label: the depth tells nothing then, and each pair must be looked at.
TEST(Suspects, SheetsThatNearlyTouchAreLookedAt)
{
	const double step = 1.0 / 1024;
	const Shape thin = test_mesh::Slab(30, 20, step, 15, 10);
	const CutExample e(thin, ThreeLetters(), FromAbove(), 4 * step);
	const SheetLayer layer = FindLayer(e.sheet, ThreeLetters(), FindSeeds(e.space, e.sheet, ThreeLetters(), 4 * step));
	const LabelPatch patch = RaiseLabel(e.space, e.sheet, e.cut, 1, ExtrudeAlong::Viewpoint);
	const auto position = RoundedPositions(e.sheet, patch, [step](double x) { return OnGrid(x, step); });
	const Suspects suspects = FindSuspects(e.space, e.sheet, layer, patch, position, true, 1, 4 * step);
	EXPECT_TRUE(suspects.all || !suspects.pairs.empty());
	EXPECT_EQ(CheckPatch(e.space, e.sheet, patch, position, suspects).fault,
	          CheckPatch(e.space, e.sheet, patch, position).fault);
}

// What is beside an edge by less than coordinates move is not plainly apart from it; neighbours at an edge are.
TEST(Suspects, NearlyBesideIsNotPlainlyApart)
{
	const double slack = 0.01;
	const auto apart = [&](double beside) {
		Shape two;  // one triangle, and one of another piece to the right of its slanted edge
		two.add({0, 0, 0}), two.add({8, 0, 0}), two.add({4, 6, 0});
		const double length = std::hypot(4, 6);
		const Point3d away = Point3d(6, 4, 0) * (beside / length);
		two.add(Point3d(8, 0, 0) + away), two.add(Point3d(12, 3, 0) + away), two.add(Point3d(4, 6, 0) + away);
		two.faces = {{0, 1, 2}, {3, 4, 5}};
		const LabelSpace space(FromAbove());
		return vcg::textlabel::detail::ArePlainlyApart(CandidatesOf(two, space, 20, 20), 0, 1, slack);
	};
	EXPECT_TRUE(apart(2 * slack));
	EXPECT_FALSE(apart(0.5 * slack));
	EXPECT_FALSE(apart(-0.5 * slack));
	const LabelSpace space(FromAbove());
	const Sheet sheet = CandidatesOf(test_mesh::Slab(2, 2, 1, 1, 1), space, 2, 2);
	EXPECT_TRUE(vcg::textlabel::detail::ArePlainlyApart(sheet, 0, 1, slack)) << "the two halves of a square";
}

// Two members of a layer keep apart within its box and nowhere else.
TEST(Suspects, MembersThatOverlapBesideTheLayersBox)
{
	Sheet sheet;
	const auto add = [&](double x, double y) {
		SheetVertex v;
		v.mesh = v.label = Point3d(x, y, 0);
		v.plane = Point2d(x, y);
		sheet.vertices.push_back(v);
		return int(sheet.vertices.size()) - 1;
	};
	const auto face = [&](int a, int b, int c) {
		SheetTriangle t;
		t.vertex = {a, b, c};
		t.facing = true;
		sheet.triangles.push_back(t);
	};
	face(add(0, 0), add(8, 0), add(0, 2));  // both reach out of the box, and meet at (6, 0.3)
	face(add(0, 4), add(6, 0.3), add(0, 4.1));
	face(add(0, 6), add(8, 6), add(0, 8));     // reaches out, and meets none
	face(add(1, -3), add(4, -3), add(1, -1));  // within
	for (int i = 0; i < 200; ++i) face(add(-9, 9 - 0.05 * i), add(-8, 9 - 0.05 * i), add(-9, 9.04 - 0.05 * i));
	const auto singleUpTo = [&sheet](double x) {
		SheetLayer layer;
		PlaneBox box;
		box.add({-10, -10});
		box.add({x, 10});
		layer.cells = PlaneCells(box, 1);
		layer.single.assign(1, 1);
		layer.member.assign(sheet.triangles.size(), 1);
		return layer;
	};
	std::vector<int> changed(sheet.triangles.size());
	for (size_t i = 0; i < changed.size(); ++i) changed[i] = int(i);
	std::vector<std::array<int, 2>> pairs = detail::FindNearPairs(sheet, singleUpTo(5), changed, 0, 1e-6);
	std::sort(pairs.begin(), pairs.end());
	EXPECT_EQ(pairs, (std::vector<std::array<int, 2>>{{0, 1}, {1, 0}}));
	EXPECT_TRUE(
		detail::FindNearPairs(sheet, singleUpTo(9), changed, 0, 1e-6).empty());  // said to be single where they meet
}

}  // namespace
