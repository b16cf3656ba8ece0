// Flattening: the chord error against the exact curves, the number of points against the least that any chords need.

#include "outline_flatten.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iomanip>
#include <iostream>
#include <limits>
#include "font_face.h"
#include "text_error.h"

using namespace textlabel;
using vcg::Point2d;

namespace {

double SquaredDistance(const Point2d& q, const Point2d& a, const Point2d& b)
{
	const Point2d d = b - a;
	const double length = d.SquaredNorm();
	const double t = length > 0 ? std::clamp(((q - a) * d) / length, 0.0, 1.0) : 0;
	return (q - a - d * t).SquaredNorm();
}

double DistanceToRing(const Point2d& q, const Ring& ring)
{
	double least = std::numeric_limits<double>::max();
	for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
		least = std::min(least, SquaredDistance(q, ring[j], ring[i]));
	return std::sqrt(least);
}

Ring DenseSamples(const CurveContour& contour, int perCurve)
{
	Ring samples;
	for (const CurvePiece& piece : contour) {
		const int n = piece.degree == 1 ? 1 : perCurve;
		for (int i = 0; i < n; ++i) samples.push_back(PointAt(piece, double(i) / n));
	}
	return samples;
}

/// Largest distance of the curves from the polyline, and of the polyline from the curves.
double ErrorOf(const CurveContour& contour, const Ring& ring)
{
	constexpr int kPerCurve = 100;
	const Ring dense = DenseSamples(contour, kPerCurve);
	double error = 0;
	for (const Point2d& q : dense) error = std::max(error, DistanceToRing(q, ring));
	for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
		for (int k = 0; k < 8; ++k)
			error = std::max(error, DistanceToRing(ring[j] + (ring[i] - ring[j]) * (k / 8.0), dense));
	}
	return error;
}

/// The least number of chords between samples of a closed curve that keep within the error: the shortest way round in
/// the graph of all chords that do, over all places to start (Imai and Iri 1986).
std::size_t LeastPoints(const Ring& dense, double error)
{
	const std::size_t n = dense.size();
	std::vector<std::vector<std::size_t>> reaches(n);  // chords from each sample, as numbers of samples that they span
	for (std::size_t i = 0; i < n; ++i) {
		int misses = 0;
		for (std::size_t span = 1; span < n && misses < 10; ++span) {
			bool within = true;
			for (std::size_t k = 1; k < span && within; ++k)
				within = SquaredDistance(dense[(i + k) % n], dense[i], dense[(i + span) % n]) <= error * error;
			if (within) reaches[i].push_back(span);
			else ++misses;
		}
	}
	std::size_t best = n, starts = reaches[0].back();
	for (std::size_t start = 0; start <= starts && start < n; ++start) {
		std::vector<std::size_t> chords(n + 1, n);
		chords[0] = 0;
		for (std::size_t at = 0; at < n; ++at) {
			for (const std::size_t span : reaches[(start + at) % n])
				if (at + span <= n) chords[at + span] = std::min(chords[at + span], chords[at] + 1);
		}
		best = std::min(best, chords[n]);
	}
	return std::max<std::size_t>(best, 3);
}

CurveContour Circle(double radius)
{
	constexpr double kArm = 0.5522847498;
	CurveContour contour;
	const Point2d corners[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
	for (std::size_t i = 0; i < 4; ++i) {
		const Point2d a = corners[i] * radius, b = corners[(i + 1) % 4] * radius;
		contour.push_back(CurvePiece::Cubic(a, a + b * kArm, b + a * kArm, b));
	}
	return contour;
}

TEST(Flatten, ACircleGetsTheChordsThatItNeeds)
{
	for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
		const Ring ring = Flatten(Circle(1), tolerance);
		const double needed =
			3.14159265358979 / std::acos(1 - tolerance);  // sagitta of a chord of half angle a: 1 - cos a
		EXPECT_LE(ErrorOf(Circle(1), ring), tolerance);
		EXPECT_GE(static_cast<double>(ring.size()), needed);
		EXPECT_LE(static_cast<double>(ring.size()), 1.1 * needed + 1);
	}
}

TEST(Flatten, ASquareStaysASquareAtAnyTolerance)
{
	const Ring corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
	CurveContour square;
	for (std::size_t i = 0; i < 4; ++i) square.push_back(CurvePiece::Line(corners[i], corners[(i + 1) % 4]));
	for (const double tolerance : {1e-6, 1e-3, 0.1}) EXPECT_EQ(Flatten(square, tolerance), corners);
}

TEST(Flatten, ADotSmallerThanTheToleranceStaysADot)
{
	EXPECT_GE(Flatten(Circle(0.01), 1).size(), 3u);
	EXPECT_LE(ErrorOf(Circle(0.01), Flatten(Circle(0.01), 1)), 0.02);
}

TEST(Flatten, NothingWithoutArea)
{
	EXPECT_TRUE(Flatten({}, 0.1).empty());
	EXPECT_TRUE(Flatten({CurvePiece::Line({0, 0}, {1, 0}), CurvePiece::Line({1, 0}, {0, 0})}, 0.1).empty());
	EXPECT_TRUE(Flatten({CurvePiece::Quadratic({1, 1}, {1, 1}, {1, 1})}, 0.1).empty());
}

TEST(Flatten, RefusesWhatWouldTakeTooManyPointsAndNamesATolerance)
{
	double limit = 0;
	try {
		Flatten(Circle(1e9), 1e-9);
		FAIL();
	} catch (const TextError& e) {
		limit = e.limit;
		EXPECT_NE(Sentence(e).find("at least"), std::string::npos) << Sentence(e);
	}
	EXPECT_THROW(Flatten(Circle(1e9), 0.999 * limit), TextError);
	EXPECT_LT(Flatten(Circle(1e9), 1.001 * limit).size(), kMostSamples);
}

/// The letters of the built-in font: error below the tolerance, and not more than 1.5 times the least number of points.
TEST(Flatten, LettersHaveFewPointsAndKeepTheTolerance)
{
	const FontFace font(OpenFontLibrary(), {});
	const std::string letters = "ABCDGOQRSabcdefgosty0235689&@?%";
	std::cout << "tolerance / capital height, points, least, ratio\n";
	for (const double fine : {100.0, 400.0, 2000.0}) {
		const double tolerance = font.capitalHeight() / fine;
		std::size_t points = 0, least = 0;
		for (const char letter : letters) {
			hb_codepoint_t glyph = 0;
			ASSERT_TRUE(hb_font_get_nominal_glyph(font.shaper(), static_cast<unsigned char>(letter), &glyph));
			std::size_t pointsOfLetter = 0, leastOfLetter = 0;
			for (const CurveContour& contour : font.glyph(glyph)) {
				const Ring ring = Flatten(contour, tolerance);
				ASSERT_LE(ErrorOf(contour, ring), tolerance) << letter;
				pointsOfLetter += ring.size();
				leastOfLetter += LeastPoints(DenseSamples(contour, 80), tolerance);
			}
			EXPECT_LE(static_cast<double>(pointsOfLetter), 1.5 * static_cast<double>(leastOfLetter))
				<< letter << " 1/" << fine;
			points += pointsOfLetter;
			least += leastOfLetter;
		}
		const double ratio = static_cast<double>(points) / static_cast<double>(least);
		std::cout << "1/" << fine << ", " << points << ", " << least << ", " << std::setprecision(3) << ratio << '\n';
		EXPECT_LE(ratio, 1.25);
	}
}

}  // namespace
