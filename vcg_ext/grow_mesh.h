#pragma once
// Room for the label's vertices and faces at the end of a mesh's arrays.
//
// A loaded mesh has no room to spare, so its first label moves both arrays. std::vector would hold the old array and the new one at
// the same time, twice the mesh; here the old pages go back to the system as they are copied (Linux; elsewhere it is a plain copy),
// and some room is left for the next labels. What points into the arrays is updated as VCGlib's Allocator would.

#include "label_error.h"
#include "parallel_chunks.h"

#include <cstdint>
#include <new>
#include <type_traits>
#include <vcg/complex/complex.h>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace vcg::textlabel {

/// Add vertices and faces at the end of a mesh's arrays, or leave the mesh as it was.
/// @throws Error{OutOfMemory}
template <class MeshType>
void GrowMesh(MeshType& m, size_t vertices, size_t faces);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

#ifdef __linux__
/// Advice about the whole pages within some memory; that it is not taken does no harm.
inline void AdvisePages(const void* begin, size_t bytes, int advice)
{
	const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
	const auto start = reinterpret_cast<std::uintptr_t>(begin), end = (start + bytes) / page * page;
	const std::uintptr_t first = (start + page - 1) / page * page;
	if (first < end) madvise(reinterpret_cast<void*>(first), end - first, advice);
}
inline void ExpectWrites(const void* begin, size_t bytes) { AdvisePages(begin, bytes, MADV_HUGEPAGE); }
inline void GiveBack(const void* begin, size_t bytes) { AdvisePages(begin, bytes, MADV_DONTNEED); }
#else
inline void ExpectWrites(const void*, size_t) {}
inline void GiveBack(const void*, size_t) {}
#endif

/// Make room for `more` elements at the end; false when nothing had to move.
/// @throws std::bad_alloc; the array is as it was
template <class Element>
bool MakeRoom(std::vector<Element>& array, size_t more)
{
	constexpr size_t spare = 16, chunkBytes = size_t(4) << 20;
	constexpr size_t large = size_t(32) << 20;  // bytes: the allocator asks the system for arrays of this size
	if (array.capacity() - array.size() >= more) return false;
	const size_t room = array.size() + std::max(more, array.size() / spare);
	if (array.size() * sizeof(Element) < large) {
		array.reserve(room);
		return true;
	}
	std::vector<Element> grown;
	grown.reserve(room);
	ExpectWrites(grown.data(), (array.size() + more) * sizeof(Element));
	const size_t chunk = std::max<size_t>(chunkBytes / sizeof(Element), 1);
	for (size_t first = 0; first < array.size(); first += chunk) {
		const size_t count = std::min(chunk, array.size() - first);
		const Element* from = array.data() + first;
		grown.insert(grown.end(), from, from + count);
		if (std::is_trivially_destructible_v<Element>) GiveBack(from, count * sizeof(Element));
	}
	array.swap(grown);
	return true;
}

/// Moves pointers from an array that was to where it is now.
template <class Pointer>
struct PointerShift {
	Pointer from, to;

	void operator()(Pointer& p) const
	{
		if (p != nullptr) p = to + (p - from);
	}
};

/// The vertices have moved: tell all that points to them.
template <class MeshType>
void ShiftVertexPointers(MeshType& m, const PointerShift<typename MeshType::VertexPointer>& shift)
{
	EachChunk(m.face.size(), ChunkCount(m.face.size()), [&](size_t, size_t first, size_t last) {
		for (size_t f = first; f < last; ++f)
			if (!m.face[f].IsD())
				for (int k = 0; k < m.face[f].VN(); ++k) shift(m.face[f].V(k));
	});
	for (auto& e : m.edge)
		if (!e.IsD())
			for (int k = 0; k < 2; ++k) shift(e.V(k));
	if (vcg::tri::HasHVAdjacency(m))
		for (auto& h : m.hedge)
			if (!h.IsD()) shift(h.HVp());
	for (auto& t : m.tetra)
		if (!t.IsD())
			for (int k = 0; k < 4; ++k) shift(t.V(k));
}

/// The faces have moved: tell all that points to them.
template <class MeshType>
void ShiftFacePointers(MeshType& m, const PointerShift<typename MeshType::FacePointer>& shift)
{
	const bool ff = vcg::tri::HasFFAdjacency(m),
			   vf = vcg::tri::HasPerVertexVFAdjacency(m) && vcg::tri::HasPerFaceVFAdjacency(m);
	if (ff || vf)
		for (auto& f : m.face)
			for (int k = 0; k < f.VN() && !f.IsD(); ++k) {
				if (ff) shift(f.FFp(k));
				if (vf) shift(f.VFp(k));
			}
	if (vf)
		for (auto& v : m.vert)
			if (!v.IsD()) shift(v.VFp());
	if (vcg::tri::HasEFAdjacency(m))
		for (auto& e : m.edge)
			if (!e.IsD()) shift(e.EFp());
	if (vcg::tri::HasHFAdjacency(m))
		for (auto& h : m.hedge)
			if (!h.IsD()) shift(h.HFp());
}

}  // namespace detail

template <class MeshType>
void GrowMesh(MeshType& m, size_t vertices, size_t faces)
{
	using Allocator = vcg::tri::Allocator<MeshType>;
	const size_t oldVertices = m.vert.size(), oldFaces = m.face.size();
	const int oldVn = m.vn, oldFn = m.fn;
	try {
		auto* const vertexBase = m.vert.data();
		if (detail::MakeRoom<typename MeshType::VertexType>(m.vert, vertices))
			detail::ShiftVertexPointers(m, {vertexBase, m.vert.data()});
		auto* const faceBase = m.face.data();
		if (detail::MakeRoom<typename MeshType::FaceType>(m.face, faces))
			detail::ShiftFacePointers(m, {faceBase, m.face.data()});
		Allocator::AddVertices(m, vertices);
		if (faces > 0) Allocator::AddFaces(m, faces);
	} catch (const std::bad_alloc&) {
		m.face.resize(oldFaces);
		m.vert.resize(oldVertices);
		m.vn = oldVn;
		m.fn = oldFn;
		throw Error(ErrorCode::OutOfMemory);
	}
}

}  // namespace vcg::textlabel
