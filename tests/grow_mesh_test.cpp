// Growing a mesh: what points into the arrays still points to the same elements, and room or no room gives the same label.

#include "vcg_ext/grow_mesh.h"

#include <gtest/gtest.h>

#include "label_check.h"

#include <algorithm>

#ifdef MREMAP_DONTUNMAP
#include <fstream>
#include <sys/resource.h>
#endif

namespace {

using namespace label_check;

class LinkedVertex;
class LinkedFace;
struct LinkedTypes : vcg::UsedTypes<vcg::Use<LinkedVertex>::AsVertexType, vcg::Use<LinkedFace>::AsFaceType> {};
class LinkedVertex : public vcg::Vertex<LinkedTypes, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::BitFlags,
                                        vcg::vertex::VFAdj> {};
class LinkedFace : public vcg::Face<LinkedTypes, vcg::face::VertexRef, vcg::face::Normal3f, vcg::face::BitFlags,
                                    vcg::face::FFAdj, vcg::face::VFAdj> {};
class LinkedMesh : public vcg::tri::TriMesh<std::vector<LinkedVertex>, std::vector<LinkedFace>> {};

/// Everything that a mesh's pointers say, as numbers.
std::vector<long> Links(LinkedMesh& m)
{
	std::vector<long> links;
	for (auto& f : m.face)
		for (int k = 0; k < 3; ++k) {
			links.push_back(f.V(k) - m.vert.data());
			links.push_back(f.FFp(k) - m.face.data());
			links.push_back(f.VFp(k) == nullptr ? -1 : f.VFp(k) - m.face.data());
		}
	for (auto& v : m.vert) links.push_back(v.VFp() - m.face.data());
	return links;
}

TEST(GrowMesh, KeepsAllPointers)
{
	LinkedMesh m;
	test_mesh::Fill(m, test_mesh::Sphere(10, 12, 8));
	vcg::tri::UpdateTopology<LinkedMesh>::FaceFace(m);
	vcg::tri::UpdateTopology<LinkedMesh>::VertexFace(m);
	m.vert.shrink_to_fit();
	m.face.shrink_to_fit();
	const std::vector<long> before = Links(m);
	const auto *const vertices = m.vert.data(), *const faces = reinterpret_cast<LinkedVertex*>(m.face.data());
	const size_t nv = m.vert.size(), nf = m.face.size();
	GrowMesh(m, 1000, 3000);
	EXPECT_NE(m.vert.data(), vertices) << "the test is about arrays that move";
	EXPECT_NE(reinterpret_cast<LinkedVertex*>(m.face.data()), faces);
	EXPECT_EQ(m.vert.size(), nv + 1000);
	EXPECT_EQ(m.fn, int(nf) + 3000);
	m.face.resize(nf);
	m.vert.resize(nv);
	EXPECT_EQ(Links(m), before);
}

#ifdef MREMAP_DONTUNMAP
class PageReuse : public testing::Test {
protected:
	static constexpr size_t kBytes = size_t(1) << 16;

	~PageReuse() override
	{
		for (char* p : taken_) munmap(p, kBytes);
	}
	char* map(int sharing, char filling)
	{
		void* const p = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, sharing | MAP_ANONYMOUS, -1, 0);
		EXPECT_NE(p, MAP_FAILED);
		taken_.push_back(static_cast<char*>(p));
		std::fill_n(taken_.back(), kBytes, filling);
		return taken_.back();
	}
	static bool writable(char* p)
	{
		std::fill_n(p, kBytes, 'w');
		return size_t(std::count(p, p + kBytes, 'w')) == kBytes;
	}

private:
	std::vector<char*> taken_;
};

TEST_F(PageReuse, MovesWholePagesAndLeavesBothWritable)
{
	char *const old = map(MAP_PRIVATE, 'o'), *const fresh = map(MAP_PRIVATE, 'f');
	if (!detail::ReusePages(old + 1, kBytes - 1, fresh + 1, kBytes - 1)) GTEST_SKIP() << "the system can't do it";
	const auto page = size_t(sysconf(_SC_PAGESIZE));
	EXPECT_EQ(old[page - 1], 'o') << "not a whole page";
	EXPECT_EQ(fresh[page - 1], 'f');
	EXPECT_EQ(fresh[page + 1], 'o');
	EXPECT_EQ(fresh[kBytes - 1], 'o');
	EXPECT_EQ(old[page], 0);
	EXPECT_TRUE(writable(old));
	EXPECT_TRUE(writable(fresh));
	EXPECT_FALSE(detail::ReusePages(old, 10, fresh, kBytes)) << "less than a page";
}

TEST_F(PageReuse, LeavesBothWritableAndApartWhereItCannotBeDone)
{
	char *const shared = map(MAP_SHARED, 'o'), *const fresh = map(MAP_PRIVATE, 'f');
	EXPECT_FALSE(detail::ReusePages(shared, kBytes, fresh, kBytes));
	EXPECT_TRUE(writable(shared));
	std::fill_n(fresh, kBytes, 'f');
	EXPECT_EQ(shared[kBytes / 2], 'w') << "the same memory in two places";

	char* const old = map(MAP_PRIVATE, 'o');
	rlimit before;
	ASSERT_EQ(getrlimit(RLIMIT_AS, &before), 0);
	rlimit none = before;
	size_t pages = 0;
	std::ifstream("/proc/self/statm") >> pages;
	none.rlim_cur = pages * size_t(sysconf(_SC_PAGESIZE));
	ASSERT_EQ(setrlimit(RLIMIT_AS, &none), 0);
	detail::ReusePages(old, kBytes, fresh, kBytes);  // may find no address space
	setrlimit(RLIMIT_AS, &before);
	EXPECT_TRUE(writable(old));
	EXPECT_TRUE(writable(fresh));
}
#endif

// Large enough for the array's old pages to be used again while it is copied.
TEST(GrowMesh, RoomOrNoRoomGivesTheSameLabelOnALargeMesh)
{
	const test_mesh::Shape slab = test_mesh::Slab(300, 200, 40, 1000, 500);
	test_mesh::FloatMesh roomy, tight;
	roomy.vert.reserve(slab.points.size() + 100000);
	roomy.face.reserve(slab.faces.size() + 100000);
	test_mesh::Fill(roomy, slab);
	test_mesh::Fill(tight, slab);
	tight.vert.shrink_to_fit();
	tight.face.shrink_to_fit();
	ASSERT_GT(tight.face.size() * sizeof(test_mesh::FloatFace), size_t(4) << 20);
	LabelOptions options;
	options.height = 1;
	const LabelResult a = LabelMesh(roomy, ThreeLetters(), FromAbove(), options),
					  b = LabelMesh(tight, ThreeLetters(), FromAbove(), options);
	EXPECT_EQ(a.newFaces, b.newFaces);
	ASSERT_EQ(roomy.face.size(), tight.face.size());
	ASSERT_EQ(roomy.vert.size(), tight.vert.size());
	int different = 0;
	for (size_t i = 0; i < roomy.vert.size(); ++i) different += roomy.vert[i].cP() != tight.vert[i].cP();
	for (size_t i = 0; i < roomy.face.size(); ++i)
		for (int k = 0; k < 3; ++k)
			different += roomy.face[i].cV(k) - roomy.vert.data() != tight.face[i].cV(k) - tight.vert.data();
	EXPECT_EQ(different, 0);
}

TEST(EachChunk, CoversEverythingOnceAndPassesOnWhatWasThrown)
{
	for (const size_t count : {size_t(0), size_t(1), size_t(7), size_t(1000003)})
		for (size_t chunks = 1; chunks < 6; ++chunks) {
			std::vector<char> seen(count, 0);
			EachChunk(count, chunks, [&](size_t, size_t first, size_t last) {
				for (size_t i = first; i < last; ++i) ++seen[i];
			});
			EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(count));
		}
	const auto fail = [](size_t chunk, size_t, size_t) {
		if (chunk > 0) throw int(chunk);
	};
	try {
		EachChunk(100, 4, fail);
		FAIL();
	} catch (const int chunk) {
		EXPECT_EQ(chunk, 1) << "the first chunk that failed, whichever was the first in time";
	}
}

}  // namespace
