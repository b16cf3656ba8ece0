#pragma once
// Vertices by their place, to tell which of them lie in the same one: a hash table with open addressing. What is found does not
// depend on the order of hashing.

#include <cstdint>
#include <cstring>
#include <vcg/space/point3.h>
#include <vector>

namespace vcg::textlabel {

/// The same for equal coordinates; 0 and -0 are equal.
inline std::uint64_t HashOfPlace(const vcg::Point3d& p)
{
	std::uint64_t hash = 0;
	for (int k = 0; k < 3; ++k) {
		const double x = p[k] + 0.0;  // -0 is 0
		std::uint64_t word;
		std::memcpy(&word, &x, sizeof word);
		hash = (hash ^ word) * 0x9E3779B97F4A7C15;  // 2^64 / golden ratio
		hash ^= hash >> 32;
	}
	return hash;
}

class PlaceTable {
public:
	/// @param[in] position  kept by reference
	/// @param[in] most  vertices that will be added
	PlaceTable(const std::vector<vcg::Point3d>& position, size_t most) : position_(position)
	{
		size_t size = 2;  // always more than what is added, so that each search ends
		while (size < 2 * most) size *= 2;
		slots_.assign(size, -1);
	}

	/// Add a vertex, unless one is there already.
	/// @return that one, or -1
	int add(int vertex)
	{
		int& slot = slots_[slotOf(vertex)];
		if (slot < 0) slot = vertex;
		return slot == vertex ? -1 : slot;
	}
	/// @return the vertex at the place of another, or -1
	int find(int vertex) const { return slots_[slotOf(vertex)]; }

private:
	/// The slot that holds a vertex of this place, or would.
	size_t slotOf(int vertex) const
	{
		const vcg::Point3d& p = position_[size_t(vertex)];
		const size_t last = slots_.size() - 1;
		size_t slot = size_t(HashOfPlace(p)) & last;
		while (slots_[slot] >= 0 && position_[size_t(slots_[slot])] != p) slot = (slot + 1) & last;
		return slot;
	}

	const std::vector<vcg::Point3d>& position_;
	std::vector<int> slots_;  ///< a power of two; -1 is free
};

}  // namespace vcg::textlabel
