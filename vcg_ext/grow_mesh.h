#pragma once
// Room for the label's vertices and faces at the end of a mesh's arrays.
//
// A loaded mesh has no room to spare, so its first label moves both arrays. std::vector would hold the old array and the new one at
// the same time, twice the mesh, and the system would have to clear each new page before it is written; here the pages that have
// been copied take the place of those that are written next (Linux 5.7; elsewhere it is a plain copy). Some room is left for the
// next labels. What points into the arrays is updated as VCGlib's Allocator would.

#include "label_error.h"
#include "parallel_chunks.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <type_traits>
#include <utility>
#include <vcg/complex/complex.h>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace vcg::textlabel {

/// Add vertices and faces at the end of a mesh's arrays, or leave the mesh as it was.
/// @param[in] fill  called when they are there; may write to them, and may throw
/// @throws Error{OutOfMemory}, and what fill throws
template <class MeshType, class Fill>
void GrowMesh(MeshType& m, size_t vertices, size_t faces, const Fill& fill);

template <class MeshType>
void GrowMesh(MeshType& m, size_t vertices, size_t faces)
{
	GrowMesh(m, vertices, faces, [] {});
}

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Let memory that is no longer needed stand in for memory that has not been written yet. Both can be written afterwards; what they
/// held is gone.
/// @return false where it can't be done: then nothing is gained
inline bool ReusePages(const void* old, size_t oldBytes, const void* fresh, size_t freshBytes)
{
#ifdef MREMAP_DONTUNMAP
	const auto page = std::uintptr_t(sysconf(_SC_PAGESIZE));
	const auto firstPage = [&](const void* p) {
		return (reinterpret_cast<std::uintptr_t>(p) + page - 1) / page * page;
	};
	const auto endPage = [&](const void* p, size_t n) {
		return (reinterpret_cast<std::uintptr_t>(p) + n) / page * page;
	};
	const std::uintptr_t from = firstPage(old), fromEnd = endPage(old, oldBytes);
	const std::uintptr_t to = firstPage(fresh), toEnd = endPage(fresh, freshBytes);
	if (from >= fromEnd || to >= toEnd) return false;
	const size_t bytes = std::min(fromEnd - from, toEnd - to);
	void *const source = reinterpret_cast<void*>(from), *const target = reinterpret_cast<void*>(to);
	volatile char* const left = static_cast<char*>(source);
	*left = 1;
	// First to a place that is nobody's: where memory can't be moved (it is shared, or mapped in pieces, as an array may be that was moved
	// like this before), Linux before 6.17 has taken the pages from the place by then, and another thread could get them. Its first
	// and last page stay ours, so that it does not grow together with its neighbours.
	char* const place =
		static_cast<char*>(mmap(nullptr, bytes + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
	if (place == MAP_FAILED) return false;
	constexpr int how = MREMAP_MAYMOVE | MREMAP_FIXED;
	void* const between = mremap(source, bytes, bytes, how | MREMAP_DONTUNMAP, place + page);
	const bool isThere = between != MAP_FAILED, isPrivate = *left == 0;
	const bool isMoved = isThere && isPrivate && mremap(between, bytes, bytes, how, target) == target;
	if (isThere && !isMoved) munmap(between, bytes);
	if (isThere && isPrivate && !isMoved)  // no memory for the kernel's own tables: the target has to be there again
		mmap(target, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0);
	munmap(place, page);
	munmap(place + page + bytes,
	       page);  // where the first move has failed, what is between is perhaps no longer ours: it stays
	return isMoved;
#else
	return (void)old, (void)oldBytes, (void)fresh, (void)freshBytes, false;
#endif
}

/// An array with room for the elements of another and `more` at its end; without any when these fit into the other.
/// @throws std::bad_alloc
template <class Element>
std::vector<Element> LargerArray(const std::vector<Element>& array, size_t more)
{
	constexpr size_t spare = 16;
	std::vector<Element> larger;
	if (array.capacity() - array.size() < more) larger.reserve(array.size() + std::max(more, array.size() / spare));
	return larger;
}

/// Move all elements of an array to a larger one, and this to its place.
/// @param[in] update  called for each element that has moved, while it is in the cache
template <class Element, class Update>
void MoveTo(std::vector<Element> larger, std::vector<Element>& array, const Update& update)
{
	constexpr size_t chunk = std::max<size_t>((size_t(1) << 20) / sizeof(Element), 1);
	bool reuses = std::is_trivially_destructible_v<Element>;  // else the old ones are looked at once more
	for (size_t first = 0; first < array.size(); first += chunk) {
		const size_t count = std::min(chunk, array.size() - first), left = array.size() - first - count;
		const Element* from = array.data() + first;
		larger.insert(larger.end(), from, from + count);
		for (size_t i = first; i < first + count; ++i) update(larger[i]);
		reuses = reuses && left > 0 &&
		         ReusePages(from, count * sizeof(Element), larger.data() + larger.size(), left * sizeof(Element));
	}
	array.swap(larger);
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

/// The vertices have moved: tell all that points to them, but for the faces.
template <class MeshType>
void ShiftVertexPointers(MeshType& m, const PointerShift<typename MeshType::VertexPointer>& shift)
{
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

/// Move the arrays that are given larger ones.
template <class MeshType>
void MoveArrays(MeshType& m, std::vector<typename MeshType::VertexType> vertices,
                std::vector<typename MeshType::FaceType> faces)
{
	PointerShift<typename MeshType::VertexPointer> shift{m.vert.data(), m.vert.data()};
	const bool verticesMove = vertices.capacity() > 0, facesMove = faces.capacity() > 0;
	if (verticesMove) {
		shift.to = vertices.data();
		MoveTo<typename MeshType::VertexType>(std::move(vertices), m.vert, [](auto&) {});
		ShiftVertexPointers(m, shift);
	}
	const auto shiftCorners = [&](typename MeshType::FaceType& f) {
		for (int k = 0; k < f.VN() && !f.IsD(); ++k) shift(f.V(k));
	};
	if (facesMove) {
		auto* const from = m.face.data();
		MoveTo<typename MeshType::FaceType>(std::move(faces), m.face, shiftCorners);
		ShiftFacePointers(m, {from, m.face.data()});
	} else if (verticesMove) {
		EachChunk(m.face.size(), ChunkCount(m.face.size()), [&](size_t, size_t first, size_t last) {
			for (size_t f = first; f < last; ++f) shiftCorners(m.face[f]);
		});
	}
}

/// The values of custom attributes of type bool: of an array of these that grows, older versions of VCGlib keep the first four.
class KeptBools {
public:
	/// @param[in] attributes  of the vertices, or of the faces
	/// @param[in] count  of these
	template <class Attributes>
	KeptBools(const Attributes& attributes, size_t count)
	{
		for (const auto& a : attributes) {
			if (a._type != typeid(bool)) continue;
			const bool* const first = static_cast<const bool*>(a._handle->DataBegin());
			kept.push_back({a._handle, {first, first + count}});
		}
	}
	void restore() const
	{
		for (const Kept& k : kept)
			std::copy(k.value.begin(), k.value.end(), static_cast<bool*>(k.attribute->DataBegin()));
	}

private:
	struct Kept {
		vcg::SimpleTempDataBase* attribute;
		std::vector<char> value;
	};
	std::vector<Kept> kept;
};

}  // namespace detail

template <class MeshType, class Fill>
void GrowMesh(MeshType& m, size_t vertices, size_t faces, const Fill& fill)
{
	using Allocator = vcg::tri::Allocator<MeshType>;
	const size_t oldVertices = m.vert.size(), oldFaces = m.face.size();
	const int oldVn = m.vn, oldFn = m.fn;
	const auto shrink = [&] {
		m.face.resize(oldFaces);
		m.vert.resize(oldVertices);
		vcg::tri::ResizeAttribute(m.face_attr, oldFaces, m);
		vcg::tri::ResizeAttribute(m.vert_attr, oldVertices, m);
		m.vn = oldVn;
		m.fn = oldFn;
	};
	try {
		auto moreVertices = detail::LargerArray<typename MeshType::VertexType>(m.vert, vertices);
		auto moreFaces = detail::LargerArray<typename MeshType::FaceType>(m.face, faces);
		detail::MoveArrays(m, std::move(moreVertices), std::move(moreFaces));
		const detail::KeptBools ofVertices(m.vert_attr, oldVertices), ofFaces(m.face_attr, oldFaces);
		Allocator::AddVertices(m, vertices);
		ofVertices.restore();
		if (faces > 0) Allocator::AddFaces(m, faces);
		ofFaces.restore();
		fill();
	} catch (const std::bad_alloc&) {
		shrink();
		throw Error(ErrorCode::OutOfMemory);
	} catch (...) {  // an attribute of a type of its own may throw what it likes
		shrink();
		throw;
	}
}

}  // namespace vcg::textlabel
