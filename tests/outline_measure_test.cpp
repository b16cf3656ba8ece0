// Widths of strokes and gaps on shapes whose widths are known.

#include "outline_measure.h"

#include <cmath>
#include <gtest/gtest.h>
#include "outline_unite.h"

using namespace textlabel;
using vcg::Point2d;

namespace {

LetterWidths WidthsOf(const std::vector<Ring>& rings)
{
	const United united = UniteLetters({{0, rings}}, {1e-3, 0});
	return MeasureWidths(united.outline, 1, 100)[0];
}

Ring Box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

Ring Hole(Ring ring)
{
	std::reverse(ring.begin(), ring.end());
	return ring;
}

Ring Turned(Ring ring, double angle)
{
	for (Point2d& p : ring)
		p = Point2d(std::cos(angle) * p[0] - std::sin(angle) * p[1], std::sin(angle) * p[0] + std::cos(angle) * p[1]);
	return ring;
}

TEST(Widths, OfABar)
{
	for (const double angle : {0.0, 0.3, 1.2}) {
		const LetterWidths w = WidthsOf({Turned(Box(0, 0, 2, 9), angle)});
		EXPECT_NEAR(w.stroke, 2, 1e-5);
		EXPECT_EQ(w.gap, 0) << "a lone bar has no gap";
	}
}

TEST(Widths, OfABarWithObliqueOrPointedEnds)
{
	for (const double angle : {0.0, 0.3, 1.2}) {
		for (const double lean : {0.5, 1.0, 3.0, -3.0}) {
			const Ring oblique{{0, 0}, {10, 0}, {10 + lean, 2}, {lean, 2}};
			EXPECT_NEAR(WidthsOf({Turned(oblique, angle)}).stroke, 2, 1e-5) << lean;
		}
		const Ring pointed{{0, 0}, {1, -1}, {9, -1}, {10, 0}, {9, 1}, {1, 1}};
		EXPECT_NEAR(WidthsOf({Turned(pointed, angle)}).stroke, 2, 1e-5);
		const Ring rounded{{0.1, 0}, {9.9, 0}, {10.1, 0.1}, {12.9, 1.9}, {12.9, 2}, {3.1, 2}, {2.9, 1.9}, {0.1, 0.1}};
		EXPECT_NEAR(WidthsOf({Turned(rounded, angle)}).stroke, 2, 1e-5);
		const Ring slot = Hole(pointed);
		EXPECT_NEAR(WidthsOf({Turned(Box(-5, -5, 15, 5), angle), Turned(slot, angle)}).gap, 2, 1e-5);
	}
}

TEST(Widths, OfAFrameWithUnequalSides)
{
	const LetterWidths w = WidthsOf({Box(0, 0, 10, 10), Hole(Box(1, 2, 7, 5.5))});
	EXPECT_NEAR(w.stroke, 1, 1e-5) << "left";
	EXPECT_NEAR(w.gap, 3.5, 1e-5) << "the height of the hole";
}

TEST(Widths, OfTwoBarsInOneLetterAndInTwo)
{
	EXPECT_NEAR(WidthsOf({Box(0, 0, 2, 9), Box(2.7, 0, 5, 9)}).gap, 0.7, 1e-5);
	const United united = UniteLetters({{0, {Box(0, 0, 2, 9)}}, {1, {Box(2.7, 0, 5, 9)}}}, {1e-3, 0});
	const auto widths = MeasureWidths(united.outline, 2, 100);
	EXPECT_NEAR(widths[0].gap, 0.7, 1e-5);
	EXPECT_NEAR(widths[1].gap, 0.7, 1e-5) << "a gap between two letters is one of both";
	EXPECT_NEAR(widths[0].stroke, 2, 1e-5);
	EXPECT_NEAR(widths[1].stroke, 2.3, 1e-5);
}

TEST(Widths, OfARing)
{
	Ring outer, inner;
	constexpr int n = 64;
	for (int i = 0; i < n; ++i) {
		const double a = 2 * 3.14159265358979 * i / n;
		outer.push_back({5 * std::cos(a), 5 * std::sin(a)});
		inner.push_back({4 * std::cos(-a) + 0.3, 4 * std::sin(-a)});
	}
	const LetterWidths w = WidthsOf({outer, inner});
	EXPECT_NEAR(w.stroke, 0.7, 0.01) << "thinnest where the hole is nearest";
	EXPECT_NEAR(w.gap, 8, 0.03 * 8) << "a round is measured a bit short";
}

TEST(Widths, CornersAndPointsAreNoStrokes)
{
	// sides that meet at 45 degrees, and at 12; the widest part of the latter is 2
	EXPECT_EQ(WidthsOf({{{0, 0}, {10, 0}, {10, 10}}}).stroke, 0);
	const double half = 9.5 * std::tan(0.105);
	const LetterWidths spike = WidthsOf({{{0, -half}, {9.5, 0}, {0, half}}});
	EXPECT_GT(spike.stroke == 0 ? 1 : spike.stroke, 0.9) << "the tip does not count";
	// a notch that runs to a point, cut into a block
	const LetterWidths notch = WidthsOf({{{0, 0}, {10, 0}, {10, 10}, {5.5, 10}, {5, 2}, {4.5, 10}, {0, 10}}});
	EXPECT_GT(notch.gap == 0 ? 1 : notch.gap, 0.9);
}

TEST(Widths, ANotchWithParallelSidesIsAGap)
{
	const LetterWidths w = WidthsOf({{{0, 0}, {10, 0}, {10, 10}, {5.2, 10}, {5.2, 2}, {4.8, 2}, {4.8, 10}, {0, 10}}});
	EXPECT_NEAR(w.gap, 0.4, 1e-5);
	EXPECT_NEAR(w.stroke, 2, 1e-5) << "below the notch";
}

}  // namespace
