// Whole labels, judged: every case that once failed, by name, and a short random run. The long run is label_fuzz.

#include "fuzz_label_judge.h"
#include "random_wrapped_label.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace vcg::textlabel;
using namespace vcg::textlabel::test;

namespace {

std::vector<std::filesystem::path> CorpusFiles()
{
	std::vector<std::filesystem::path> files;
	for (const auto& entry : std::filesystem::directory_iterator(TEXTLABEL_SOURCE_DIR "/tests/corpus/labels"))
		if (entry.path().extension() == ".label") files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	return files;
}

/// Where a failing case was written, for the message.
std::string Keep(LabelCase c, const std::string& name, const std::string& fault)
{
	const std::string path = testing::TempDir() + name + ".label";
	c.comment = fault;
	std::ofstream out(path);
	Write(out, c);
	return fault + "\ncase written to " + path;
}

class LabelCorpus : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(LabelCorpus, IsValidOrRefused)
{
	std::ifstream in(GetParam());
	ASSERT_TRUE(in) << GetParam();
	const Verdict v = Judge(ReadLabelCase(in));
	EXPECT_TRUE(v.good()) << v.fault;
}

INSTANTIATE_TEST_SUITE_P(Files, LabelCorpus, testing::ValuesIn(CorpusFiles()),
                         [](const auto& file) { return file.param.stem().string(); });

struct Tally {
	int labels = 0, mustWork = 0, refused = 0, valid = 0;
};

Tally RunSeeds(std::uint64_t first, int count, LabelCase (*make)(Random&))
{
	Tally tally;
	for (std::uint64_t seed = first; seed < first + std::uint64_t(count); ++seed) {
		Random random(seed);
		const LabelCase c = make(random);
		const Verdict v = Judge(c);
		EXPECT_TRUE(v.good()) << Keep(c, "label_" + std::to_string(seed), v.fault);
		++tally.labels;
		tally.mustWork += c.mustWork;
		++(v.refused ? tally.refused : tally.valid);
	}
	return tally;
}

TEST(LabelFuzz, CleanLabelsWork)
{
	const Tally tally = RunSeeds(1, 800, MakeCleanLabel);
	EXPECT_GT(tally.mustWork, tally.labels * 9 / 10);  // or the generator has lost its purpose
}

TEST(LabelFuzz, LabelsOnSpoiledMeshesAreValidOrRefused)
{
	const Tally tally = RunSeeds(1, 600, MakeSpoiledLabel);
	EXPECT_GT(tally.valid, tally.labels / 3);
	EXPECT_GT(tally.refused, tally.labels / 50);
}

TEST(LabelFuzz, LabelsAnywhereAreValidOrRefused)
{
	const Tally tally = RunSeeds(1, 600, MakeHostileLabel);
	EXPECT_GT(tally.valid, tally.labels / 5);
	EXPECT_GT(tally.refused, tally.labels / 5);
}

TEST(LabelFuzz, WrappedLabelsAreValidOrRefused)
{
	const Tally tally = RunSeeds(1, 800, MakeWrappedLabel);
	EXPECT_GT(tally.mustWork, tally.labels / 20);
	EXPECT_GT(tally.valid, tally.labels / 3);
	EXPECT_GT(tally.refused, tally.labels / 5);
}

TEST(LabelFuzz, ACaseIsReadAsItWasWritten)
{
	for (std::uint64_t seed = 1; seed <= 50; ++seed) {
		Random random(seed);
		const LabelCase c = seed % 5 ? MakeLabelCase(random) : MakeWrappedLabel(random);
		std::stringstream text, again;
		Write(text, c);
		const std::string before = text.str();
		Write(again, ReadLabelCase(text));
		EXPECT_EQ(before, again.str());
	}
}

TEST(LabelFuzz, AWrongLineIsNamed)
{
	for (const char* text :
	     {"v 1 2", "v 1 2 x", "f 0 1 2", "nonsense", "along sideways", "p 1 2", "height", "height 1 2"}) {
		std::istringstream in(std::string("mesh float\n") + text + "\n");
		try {
			ReadLabelCase(in);
			ADD_FAILURE() << text;
		} catch (const std::runtime_error& e) {
			EXPECT_EQ(std::string(e.what()), std::string("line 2: ") + text);
		}
	}
}

// The judge must be able to condemn: each way of spoiling a good result has to be seen.

/// A raised square on a box, before and after, and what the library says about it.
struct GoodLabel {
	LabelCase c;
	Soup before, after;
	LabelResult result;

	GoodLabel()
	{
		c.mesh = MakeBox(4, 4, 4);
		AddPart(c.outline, Rectangle(-1, -1, 1, 1));
		c.frame = FrameFromDirection({0, 0, 0}, {0, 0, 1}, {0, 1, 0});
		c.height = 0.5;
		test::detail::FloatMesh m;
		test::detail::Fill(m, c.mesh);
		before = test::detail::SoupOf(m);
		Verdict v;
		test::detail::RunLabel(m, c, v);
		result = v.result;
		after = test::detail::SoupOf(m);
	}
	std::string fault() const
	{
		const std::string text = test::detail::CheckResult(c, before, after, result);
		return text.substr(0, text.find(':'));
	}
};

TEST(LabelJudge, AcceptsAGoodLabel) { EXPECT_EQ(GoodLabel().fault(), ""); }

TEST(LabelJudge, SeesAMissingFace)
{
	GoodLabel g;
	g.after.faces[size_t(g.result.wallFaces[0])] = g.after.faces[size_t(g.result.wallFaces[1])];
	EXPECT_NE(g.fault(), "");
}

TEST(LabelJudge, SeesATurnedFace)
{
	GoodLabel g;
	auto& f = g.after.faces[size_t(g.result.wallFaces[0])];
	std::swap(f[0], f[1]);
	EXPECT_EQ(g.fault(), "non-manifold");
}

TEST(LabelJudge, SeesAMovedOldVertex)
{
	GoodLabel g;
	g.after.vertices[0][0] += 0x1p-20;
	EXPECT_EQ(g.fault(), "vertex");
}

TEST(LabelJudge, SeesAChangedFaceThatIsNotInTheResult)
{
	GoodLabel g;
	for (size_t f = 0; f < g.before.faces.size(); ++f) {
		const auto& out = g.result.outsideFaces;
		if (std::find(out.begin(), out.end(), int(f)) != out.end()) continue;
		std::swap(g.after.faces[f][0], g.after.faces[f][1]);
		break;
	}
	EXPECT_EQ(g.fault(), "untouched");
}

TEST(LabelJudge, SeesACrossing)
{
	GoodLabel g;
	const int top = g.after.faces[size_t(g.result.topFaces[0])][0];
	g.after.vertices[size_t(top)] = {1.5, 1.5, -1};
	EXPECT_NE(g.fault(), "");
}

TEST(LabelJudge, SeesAWrongVolume)
{
	GoodLabel g;
	g.c.height = 0.25;
	EXPECT_EQ(g.fault(), "volume");
}

TEST(LabelJudge, SeesPointsThatBecomeOneInAFile)
{
	GoodLabel g;
	g.after.vertices.back() = g.after.vertices[g.after.vertices.size() - 2];
	EXPECT_NE(g.fault(), "");
}

}  // namespace
