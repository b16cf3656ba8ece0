// The union of letters: every case of the corpus, turned, mirrored, moved and scaled, against numbers worked out by
// hand.

#include "outline_unite.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <random>
#include "outline_bead.h"
#include "outline_curve.h"
#include "text_error.h"
#include "text_support.h"

using namespace textlabel;
using namespace text_support;

namespace {

std::vector<std::string> CaseFiles()
{
	std::vector<std::string> files;
	for (const auto& entry : std::filesystem::directory_iterator(TEXTLABEL_SOURCE_DIR "/tests/corpus/text"))
		if (entry.path().extension() == ".rings") files.push_back(entry.path().string());
	std::sort(files.begin(), files.end());
	return files;
}

std::vector<LetterRings> Mapped(std::vector<LetterRings> letters, const Affine& map)
{
	for (LetterRings& letter : letters) {
		for (Ring& ring : letter.rings) std::transform(ring.begin(), ring.end(), ring.begin(), map);
	}
	return letters;
}

/// A map, the factor by which it scales lengths, and whether it keeps coordinates as exact as they were.
struct Variation {
	const char* name;
	Affine map;
	double scale;
	bool exact;
};

const Variation kVariations[] = {
	{"as it is", {}, 1, true},
	{"quarter turn", {0, -1, 1, 0, 0, 0}, 1, true},
	{"mirrored", {-1, 0, 0, 1, 0, 0}, 1, true},
	{"turned by 33 degrees",
     {0.83867056794542405, -0.54463903501502708, 0.54463903501502708, 0.83867056794542405, 0, 0},
     1,
     false},
	{"moved", {1, 0, 0, 1, -37.3, 11.7}, 1, false},
	{"tiny", {1e-5, 0, 0, 1e-5, 0, 0}, 1e-5, false},
	{"huge", {1e5, 0, 0, 1e5, 3e5, 0}, 1e5, false},
};

class Corpus : public testing::TestWithParam<std::string> {};

TEST_P(Corpus, IsUnitedAsExpected)
{
	const RingCase expected = ReadRingCase(GetParam());
	ASSERT_GE(expected.area, 0);
	for (const Variation& v : kVariations) {
		const auto letters = Mapped(expected.letters, v.map);
		const United united = UniteLetters(letters, {expected.tolerance * v.scale, 0});
		// a mapped corner is rounded, which turns a touch into a crossing or a gap of a rounding error
		const double slack = expected.slack + (v.exact ? 0 : 1e-2);
		const std::string where =
			std::string(v.name) + ": " +
			Saved(letters, expected.tolerance * v.scale,
		          testing::TempDir() + std::filesystem::path(GetParam()).stem().string() + "-" + v.name);
		EXPECT_EQ(FlawOf(united.outline), "") << where;
		if (expected.exact && !v.exact) continue;
		if (expected.contours >= 0) {
			EXPECT_EQ(static_cast<int>(united.outline.contours.size()), expected.contours) << where;
			EXPECT_EQ(united.outline.partCount, expected.parts) << where;
		}
		EXPECT_NEAR(Area(united.outline) / (v.scale * v.scale), expected.area, slack) << where;
		EXPECT_TRUE(united.vanished.empty()) << where;
	}
}

INSTANTIATE_TEST_SUITE_P(Text, Corpus, testing::ValuesIn(CaseFiles()),
                         [](const auto& i) { return std::filesystem::path(i.param).stem().string(); });

/// Is a point inside by the non-zero rule, asked of the raw rings?
bool IsWoundAround(const Point2d& q, const std::vector<Ring>& rings)
{
	int winding = 0;
	for (const Ring& ring : rings) {
		for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
			const int side = Orient2d(ring[j], ring[i], q);
			if (ring[j][1] <= q[1] && ring[i][1] > q[1] && side > 0) ++winding;
			if (ring[j][1] > q[1] && ring[i][1] <= q[1] && side < 0) --winding;
		}
	}
	return winding != 0;
}

bool IsInOutline(const Point2d& q, const Outline& outline)
{
	bool inside = false;
	for (const Contour& c : outline.contours) inside ^= IsInside(q, c.points);
	return inside;
}

double DistanceTo(const Point2d& q, const std::vector<Ring>& rings)
{
	double least = std::numeric_limits<double>::max();
	for (const Ring& ring : rings) {
		for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
			const Point2d d = ring[i] - ring[j];
			const double length = d.SquaredNorm();
			const double t = length > 0 ? std::clamp(((q - ring[j]) * d) / length, 0.0, 1.0) : 0;
			least = std::min(least, (q - ring[j] - d * t).Norm());
		}
	}
	return least;
}

/// How many random cases: TEXTLABEL_TANGLES, or a number that is quick.
int TangleCount()
{
	const char* asked = std::getenv("TEXTLABEL_TANGLES");
	return asked ? std::atoi(asked) : 400;
}

/// Random tangles on a coarse lattice, where corners meet corners and edges all the time.
TEST(UniteLetters, RandomTanglesAreSoundAndCoverWhatIsWoundAround)
{
	std::mt19937 random(7);
	const auto pick = [&random](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
	constexpr double kTolerance = 0.02;
	for (int round = 0; round < TangleCount(); ++round) {
		const int lattice = 3 + pick(10);
		std::vector<LetterRings> letters{{0, {}}};
		for (int r = 1 + pick(4); r > 0; --r) {
			Ring ring;
			for (int n = 3 + pick(8); n > 0; --n) ring.push_back({double(pick(lattice)), double(pick(lattice))});
			letters[0].rings.push_back(ring);
		}
		const United united = UniteLetters(letters, {kTolerance, 0});
		const std::string where = Saved(letters, kTolerance, testing::TempDir() + "/tangle-" + std::to_string(round));
		ASSERT_EQ(FlawOf(united.outline), "") << where;
		for (int k = 0; k < 200; ++k) {
			const Point2d q(pick(1000 * lattice) / 1000.0, pick(1000 * lattice) / 1000.0);
			// within a bead of the boundary the answer is the bead's; slivers thinner than it may be gone
			if (DistanceTo(q, letters[0].rings) < 4 * kTolerance) continue;
			ASSERT_EQ(IsInOutline(q, united.outline), IsWoundAround(q, letters[0].rings))
				<< q[0] << ' ' << q[1] << ", " << where;
		}
		std::remove((testing::TempDir() + "/tangle-" + std::to_string(round) + ".rings").c_str());
		std::remove((testing::TempDir() + "/tangle-" + std::to_string(round) + ".svg").c_str());
	}
}

TEST(UniteLetters, KeepsTheLetterOfEachPart)
{
	const Ring square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
	Ring farSquare = square, dot = square;
	for (Point2d& p : farSquare) p += Point2d(10, 0);
	for (Point2d& p : dot) p += Point2d(-5, 3);
	const United united = UniteLetters({{4, {farSquare, dot}}, {7, {square}}}, {0.01, 0});
	ASSERT_EQ(united.outline.contours.size(), 3u);
	EXPECT_EQ(united.outline.contours[0].letter, 4);
	EXPECT_EQ(united.outline.contours[0].points[0], Point2d(-5, 3)) << "of one letter, the leftmost part comes first";
	EXPECT_EQ(united.outline.contours[1].letter, 4);
	EXPECT_EQ(united.outline.contours[2].letter, 7);
}

TEST(UniteLetters, EmboldensByTheOffsetOnEverySide)
{
	const Ring square{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, hole{{3, 3}, {3, 7}, {7, 7}, {7, 3}};
	EXPECT_NEAR(Area(UniteLetters({{0, {square, hole}}}, {0.01, 0.5}).outline), 11 * 11 - 3 * 3, 1e-5);
	EXPECT_NEAR(Area(UniteLetters({{0, {square, hole}}}, {0.01, -0.5}).outline), 9 * 9 - 5 * 5, 1e-5);
}

TEST(UniteLetters, SaysWhichLettersVanish)
{
	const Ring stem{{0, 0}, {1, 0}, {1, 10}, {0, 10}}, block{{5, 0}, {9, 0}, {9, 10}, {5, 10}};
	const United united = UniteLetters({{0, {stem}}, {1, {block}}}, {0.01, -0.6});
	EXPECT_EQ(united.vanished, std::vector<int>{0});
	EXPECT_NEAR(Area(united.outline), 2.8 * 8.8, 1e-5);
}

TEST(UniteLetters, SaysWhichLettersThinningTakesApart)
{
	const Ring h = {{0, 0},   {2, 0},  {2, 4.5}, {8, 4.5}, {8, 0},  {10, 0},
	                {10, 10}, {8, 10}, {8, 5.5}, {2, 5.5}, {2, 10}, {0, 10}};
	const Ring stem = {{20, 0}, {22, 0}, {22, 7}, {20, 7}}, dot = {{20.7, 8}, {21.3, 8}, {21.3, 8.6}, {20.7, 8.6}};
	const Ring outer = {{30, 0}, {40, 0}, {40, 10}, {30, 10}}, counter = {{30.8, 2}, {30.8, 8}, {38, 8}, {38, 2}};
	const std::vector<LetterRings> letters = {{0, {h}}, {1, {stem, dot}}, {2, {outer, counter}}};
	EXPECT_TRUE(UniteLetters(letters, {0.01, -0.2}).broken.empty());
	const United thin = UniteLetters(letters, {0.01, -0.45});
	EXPECT_EQ(thin.broken, (std::vector<int>{1, 2})) << "the dot is gone, the ring is open";
	EXPECT_EQ(UniteLetters(letters, {0.01, -0.6}).broken, (std::vector<int>{0, 1, 2})) << "the H has lost its bar";
	EXPECT_TRUE(UniteLetters(letters, {0.01, 0.6}).broken.empty()) << "what grows together was asked for";
}

TEST(UniteLetters, ThinsWhatOverlapsAsOne)
{
	const Ring bar{{0, 0}, {10, 0}, {10, 2}, {0, 2}}, next{{9.5, 0}, {20, 0}, {20, 2}, {9.5, 2}};
	const Outline outline = UniteLetters({{0, {bar}}, {1, {next}}}, {0.01, -0.5}).outline;
	EXPECT_EQ(outline.partCount, 1) << "the overlap is narrower than what is taken away from either";
	EXPECT_NEAR(Area(outline), 19 * 1, 1e-5);
}

TEST(UniteLetters, SaysWhichJoinedLettersThinningParts)
{
	const Ring left{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, joint{{3, 0}, {7, 0}, {7, 1}, {3, 1}},
		right{{6, 0}, {10, 0}, {10, 4}, {6, 4}}, far{{20, 0}, {24, 0}, {24, 4}, {20, 4}};
	std::vector<LetterRings> letters = {{0, {left}}, {1, {right, joint}}, {2, {far}}};
	const auto brokenAt = [&](double embolden) { return UniteLetters(letters, {0.01, embolden}).broken; };
	EXPECT_EQ(brokenAt(-0.6), std::vector<int>{}) << "that they touch may be chance";
	for (LetterRings& letter : letters) letter.isJoined = true;
	EXPECT_EQ(brokenAt(-0.4), std::vector<int>{});
	EXPECT_EQ(brokenAt(-0.6), (std::vector<int>{0, 1}));
}

TEST(UniteLetters, RefusesWhatCrossesItselfWithoutEnd)
{
	std::mt19937 random(1);
	Ring tangle;
	for (int i = 0; i < 3000; ++i) tangle.push_back({double(random() % 1000000), double(random() % 1000000)});
	EXPECT_THROW(UniteLetters({{0, {tangle}}}, {1, 0}), TextError);
}

TEST(UniteLetters, RefusesWhatComesTooCloseWithoutEnd)
{
	Paths pile;
	for (cInt i = 0; i < 200; ++i) pile.push_back({{i, 0}, {1000 + i, 0}, {i, 1000}});
	EXPECT_THROW(BeadsOf(pile, 8), TextError) << "200 times 200 triangles meet in places enough";
	pile.resize(10);
	EXPECT_GT(BeadsOf(pile, 8).size(), 45u);
}

TEST(UniteLetters, RefusesAToleranceBelowTheGrid)
{
	const Ring wide{{0, 0}, {1e9, 0}, {1e9, 1}};
	try {
		UniteLetters({{0, {wide}}}, {1e-3, 0});
		FAIL();
	} catch (const TextError& e) {
		EXPECT_EQ(e.code, TextErrorCode::BadTolerance);
		EXPECT_NO_THROW(UniteLetters({{0, {wide}}}, {e.limit, 0})) << "the limit that it names must do";
	}
}

}  // namespace
