// The same input gives the same bytes: again in one process, in another process, and on any number of threads.

#include "vcg_ext/text_label.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>

#include "label_check.h"
#include "test_mesh.h"

namespace {
unsigned cores = 1;
}

/// The library asks the machine how many threads are worth it; here the linker finds this answer first.
unsigned int std::thread::hardware_concurrency() noexcept { return cores; }

namespace {

using namespace label_check;
using test_mesh::RichMesh;
using test_mesh::Shape;

/// Several chunks on small meshes, where there are cores.
[[maybe_unused]] const size_t chunk = vcg::textlabel::leastChunk = 1000;

/// A wavy slab.
Shape Waves(int nx, int ny)
{
	const Shape top = test_mesh::Sheet(nx, ny, [=](int i, int j) {
		const double x = 60 * (double(i) / nx - 0.5), y = 30 * (double(j) / ny - 0.5);
		return Point3d(x, y, 0.3 * std::sin(x) * std::cos(1.3 * y));
	});
	return test_mesh::Thickened(top, nx, ny, {0, 0, -6});
}

/// All of a labelled mesh and of the library's answer, as one number.
size_t LabelHash(const Shape& shape, unsigned threads, double height, bool perspective)
{
	cores = threads;
	RichMesh m;
	test_mesh::Fill(m, shape);
	LabelOptions options;
	options.height = height;
	const LabelResult r = LabelMesh(m, Moved(ThreeLetters(), 1.3, 0.1, 0.2, 0.1),
	                                perspective ? FromAbovePerspective(60) : FromAbove(), options);
	std::string bytes = test_mesh::Bytes(m);
	for (const auto* list : {&r.topFaces, &r.wallFaces, &r.outsideFaces})
		for (const int f : *list) bytes += std::to_string(f) + ' ';
	for (const double x : {r.labelArea, r.surfaceArea, r.addedVolume, r.stretch, r.room, r.resolution}) {
		char text[40];
		std::snprintf(text, sizeof text, "%a ", x);
		bytes += text;
	}
	return std::hash<std::string>()(bytes);
}

TEST(SameBytes, OnAnyNumberOfThreads)
{
	const Shape shape = Waves(60, 30);
	for (const double height : {0.8, 0.0})
		for (const bool perspective : {false, true}) {
			const size_t alone = LabelHash(shape, 1, height, perspective);
			for (const unsigned threads : {2u, 3u, 7u}) {
				EXPECT_EQ(LabelHash(shape, threads, height, perspective), alone) << threads << " threads";
				ASSERT_EQ(ChunkCount(shape.faces.size()), threads) << "the mesh is too small to test so many";
			}
		}
}

/// One number over all ways to label a smaller part.
size_t AllHashes()
{
	const Shape shape = Waves(60, 30);
	std::string all;
	for (const double height : {0.8, -0.8, 0.0})
		for (const bool perspective : {false, true})
			all += std::to_string(LabelHash(shape, 1, height, perspective)) + ' ';
	return std::hash<std::string>()(all);
}

constexpr const char* kChild = "TEXTLABEL_TELL_HASH";

TEST(SameBytes, InOneProcess)
{
	const size_t first = AllHashes();
	if (std::getenv(kChild)) std::printf("hash %zu\n", first);
	EXPECT_EQ(AllHashes(), first);
	EXPECT_EQ(AllHashes(), first);
}

// Another process has its memory elsewhere: an order that goes by addresses shows.
TEST(SameBytes, InAnotherProcess)
{
	const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
	const std::string command = std::string(kChild) + "=1 '" + self + "' --gtest_filter=SameBytes.InOneProcess";
	for (int run = 0; run < 2; ++run) {
		FILE* pipe = popen(command.c_str(), "r");
		ASSERT_NE(pipe, nullptr);
		char line[256];
		size_t told = 0, found = 0;
		while (std::fgets(line, sizeof line, pipe)) found += std::sscanf(line, "hash %zu", &told) == 1;
		EXPECT_EQ(pclose(pipe), 0);
		ASSERT_EQ(found, 1u);
		EXPECT_EQ(told, AllHashes());
	}
}

}  // namespace
