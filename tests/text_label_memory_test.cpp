// Out of memory, at every place where memory is asked for: a typed error, and the mesh as it was.

#include "vcg_ext/text_label.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <new>

#include "label_check.h"
#include "test_mesh.h"

namespace {

/// How many more allocations succeed; negative: all.
long allocationsLeft = -1;

void* Allocate(std::size_t size)
{
	if (allocationsLeft == 0) throw std::bad_alloc();
	if (allocationsLeft > 0) --allocationsLeft;
	if (void* p = std::malloc(size == 0 ? 1 : size)) return p;
	throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) { return Allocate(size); }
void* operator new[](std::size_t size) { return Allocate(size); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

namespace {

using namespace label_check;

/// What came of one run.
enum class Outcome { Done, OutOfMemory, OtherError, OtherException };

template <class MeshType>
Outcome Run(MeshType& m, const Outline& outline, double height, long allocations)
{
	LabelOptions options;
	options.height = height;
	Outcome outcome = Outcome::Done;
	allocationsLeft = allocations;
	try {
		LabelMesh(m, outline, FromAbove(), options);
	} catch (const Error& e) {
		outcome = e.code == ErrorCode::OutOfMemory ? Outcome::OutOfMemory : Outcome::OtherError;
	} catch (...) {
		outcome = Outcome::OtherException;
	}
	allocationsLeft = -1;
	return outcome;
}

/// A mesh without room for a label, with arrays that other filters have added, and edges within polygons.
template <class MeshType>
struct TightMesh {
	using Allocator = vcg::tri::Allocator<MeshType>;
	MeshType mesh;
	typename MeshType::template PerVertexAttributeHandle<double> first, second;
	typename MeshType::template PerFaceAttributeHandle<double> third;

	explicit TightMesh(const test_mesh::Shape& shape)
	{
		test_mesh::Fill(mesh, shape);
		for (auto& f : mesh.face) f.SetF(0);
		mesh.vert.shrink_to_fit();
		mesh.face.shrink_to_fit();
		first = Allocator::template AddPerVertexAttribute<double>(mesh, "first");
		second = Allocator::template AddPerVertexAttribute<double>(mesh, "second");
		third = Allocator::template AddPerFaceAttribute<double>(mesh, "third");
	}
	~TightMesh()  // a mesh does not free them
	{
		Allocator::DeletePerVertexAttribute(mesh, first);
		Allocator::DeletePerVertexAttribute(mesh, second);
		Allocator::DeletePerFaceAttribute(mesh, third);
	}
	TightMesh(const TightMesh&) = delete;
	TightMesh& operator=(const TightMesh&) = delete;
	bool attributesFit() const
	{
		return first._handle->data.size() == mesh.vert.size() && second._handle->data.size() == mesh.vert.size() &&
		       third._handle->data.size() == mesh.face.size();
	}
};

template <class MeshType>
void FailEverywhere(const test_mesh::Shape& shape, const Outline& outline, double height)
{
	long n = 0;
	for (;; ++n) {
		TightMesh<MeshType> tight(shape);
		MeshType& m = tight.mesh;
		const std::string bytes = test_mesh::Bytes(m);
		const Outcome outcome = Run(m, outline, height, n);
		if (outcome == Outcome::Done) break;
		ASSERT_EQ(outcome, Outcome::OutOfMemory) << "allocation " << n;
		ASSERT_TRUE(test_mesh::Bytes(m) == bytes) << "the mesh was changed, allocation " << n;
		ASSERT_EQ(m.vert.size(), shape.points.size());
		ASSERT_EQ(m.face.size(), shape.faces.size());
		ASSERT_TRUE(tight.attributesFit()) << "allocation " << n;
		ASSERT_LT(n, 100000);
		ASSERT_EQ(Run(m, outline, height, -1), Outcome::Done) << "the mesh is as good as new, allocation " << n;
		ASSERT_TRUE(tight.attributesFit()) << "allocation " << n;
		if (n % 50 == 0) ExpectSameKind(shape, m);
	}
	EXPECT_GT(n, 50) << "allocations that can fail";
}

TEST(Memory, EveryAllocationMayFail)
{
	const Outline letters = Letters({Rectangle(-3, -3, 2.5, 3), Hole(Rectangle(-2, -2, 2, 2))});
	const test_mesh::Shape slab = test_mesh::Slab(10, 10, 3, 3, 3);
	for (const double height : {1.0, 0.0}) {
		FailEverywhere<test_mesh::FloatMesh>(slab, letters, height);
		FailEverywhere<test_mesh::DoubleMesh>(slab, letters, height);
		FailEverywhere<test_mesh::RichMesh>(slab, letters, height);
	}
	// sizes at which other arrays happen to be full
	FailEverywhere<test_mesh::FloatMesh>(test_mesh::Slab(30, 20, 4, 15, 10), ThreeLetters(), 0);
}

}  // namespace
