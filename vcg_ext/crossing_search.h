#pragma once
// All pairs of faces that cross, among new faces and between new and old ones.
//
// Each set of faces becomes a tree of boxes: the faces are put in the order of a space-filling curve through their centres and
// grouped by fours, fours of groups by pairs, and so on, so that the tree is a row of boxes for each level and nothing else.
// Two trees are then descended together wherever their boxes meet. The cost is O(n log n) plus the pairs whose boxes meet, for
// faces of any mixture of sizes; a grid would need a cell size, and a sweep fails on faces that are long along its axis.
//
// Source of the tree: C. Lauterbach et al., "Fast BVH Construction on GPUs", Eurographics 2009 (sorting by Morton code).

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "triangle_crossing.h"

namespace vcg::textlabel {

/// Three indices of positions.
using Face = std::array<int, 3>;

/// A closed box, empty until something is added.
struct SearchBox {
	std::array<double, 3> low, high;

	SearchBox()
	{
		low.fill(std::numeric_limits<double>::infinity());
		high.fill(-std::numeric_limits<double>::infinity());
	}
	bool isEmpty() const { return low[0] > high[0]; }
	void add(const SearchBox& b)
	{
		for (size_t k = 0; k < 3; ++k) {
			low[k] = std::min(low[k], b.low[k]);
			high[k] = std::max(high[k], b.high[k]);
		}
	}
	void grow(double margin)
	{
		for (size_t k = 0; k < 3; ++k) {
			low[k] -= margin;
			high[k] += margin;
		}
	}
	bool meets(const SearchBox& b) const
	{
		// without branches: which of the six comparisons fails is not to be predicted
		unsigned apart = 0;
		for (size_t k = 0; k < 3; ++k) apart |= unsigned(low[k] > b.high[k]) | unsigned(b.low[k] > high[k]);
		return apart == 0;
	}
};

struct CrossingOptions {
	bool stopAtFirst = false;  ///< return after one pair: enough to refuse
	bool amongFaces = true;    ///< false: faces × others alone
	/// Called as ignore(first, second, secondIsOther) for a pair that crosses: true leaves it out. May be null.
	std::function<bool(int, int, bool)> ignore = nullptr;
	/// Called as boxOf(face, isOther): a box of a face, in any coordinates in which the boxes of faces that meet do; finite, or empty for
	/// one that meets nothing. Null: in those of the corners.
	std::function<SearchBox(int, bool)> boxOf = nullptr;
};

/// Two faces that cross.
struct FacePair {
	int first = -1;                       ///< index into `faces`
	int second = -1;                      ///< index into `faces`, greater than `first`, or into `others`
	bool secondIsOther = false;           ///< which of the two
	Contact contact = Contact::Disjoint;  ///< Touches, Crosses or Overlaps
};

inline bool operator<(const FacePair& a, const FacePair& b)
{
	return std::make_pair(a.secondIsOther, std::make_pair(a.first, a.second)) <
	       std::make_pair(b.secondIsOther, std::make_pair(b.first, b.second));
}

/// The pairs that cross, faces × faces and faces × others; others among themselves are not looked at.
/// @param[in] faces   #F triangles, coordinates in the domain of the exact predicates; equal points are one vertex; a triangle
///                    with a corner that is not finite meets nothing
/// @param[in] others  #O triangles
/// @return pairs for which IsCrossing holds, in ascending order (faces × faces first): the same on every run
std::vector<FacePair> FindCrossings(const std::vector<Corners>& faces, const std::vector<Corners>& others = {},
                                    const CrossingOptions& options = {});

/// The same for indexed faces.
/// @param[in] positions      #V points
/// @param[in] faces, others  #F, #O by 3 indices of positions
std::vector<FacePair> FindCrossings(const std::vector<vcg::Point3d>& positions, const std::vector<Face>& faces,
                                    const std::vector<Face>& others = {}, const CrossingOptions& options = {});

namespace detail {

/// The box that meets every box.
inline SearchBox Everywhere()
{
	SearchBox box;
	std::swap(box.low, box.high);
	return box;
}

/// The box of a face, empty when a corner is not finite.
inline SearchBox BoxOf(const Corners& t)
{
	SearchBox box, empty;
	for (size_t k = 0; k < 3; ++k) {
		const double x = t[0][static_cast<int>(k)], y = t[1][static_cast<int>(k)], z = t[2][static_cast<int>(k)];
		if (!std::isfinite(x + y + z)) return empty;
		box.low[k] = std::min({x, y, z});
		box.high[k] = std::max({x, y, z});
	}
	return box;
}

/// Spreads the low 21 bits of x to every third bit.
inline std::uint64_t SpreadBits(std::uint64_t x)
{
	x = (x | x << 32) & 0x001f00000000ffffULL;
	x = (x | x << 16) & 0x001f0000ff0000ffULL;
	x = (x | x << 8) & 0x100f00f00f00f00fULL;
	x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
	return (x | x << 2) & 0x1249249249249249ULL;
}

/// The place of a box's centre along a space-filling curve through `space`.
inline std::uint64_t CurvePlace(const SearchBox& box, const SearchBox& space)
{
	constexpr double kCells = (1 << 21) - 1;
	std::uint64_t place = 0;
	for (size_t k = 0; k < 3; ++k) {
		const double width = space.high[k] - space.low[k];
		if (!(width > 0)) continue;
		const double centre = box.low[k] / 2 + box.high[k] / 2;
		const double cell = (centre - space.low[k]) / width * kCells;
		place |= SpreadBits(static_cast<std::uint64_t>(std::clamp(cell, 0.0, kCells))) << k;
	}
	return place;
}

/// Faces in groups of neighbours, each group with its box, each two groups with theirs, up to one box for all.
class FaceTree {
public:
	static constexpr size_t kGroup = 4;  ///< faces in a leaf
	struct Item {
		SearchBox box;
		int face;
	};

	/// The faces whose boxes meet `within`.
	/// @param[in] boxOf  gives the box of face 0 .. count-1
	template <class BoxOfFace>
	FaceTree(size_t count, const BoxOfFace& boxOf, const SearchBox& within)
	{
		std::vector<Item> found;
		SearchBox space;
		for (size_t i = 0; i < count; ++i) {
			const SearchBox box = boxOf(i);
			if (box.isEmpty() || !box.meets(within)) continue;
			found.push_back({box, static_cast<int>(i)});
			space.add(box);
		}
		std::vector<std::pair<std::uint64_t, size_t>> order;
		order.reserve(found.size());
		for (const Item& item : found) order.emplace_back(CurvePlace(item.box, space), order.size());
		std::sort(order.begin(), order.end());
		items.reserve(found.size());
		for (const auto& place : order) items.push_back(found[place.second]);
		BuildLevels();
	}

	int top() const { return static_cast<int>(levels.size()) - 1; }
	bool hasNode(int level, size_t i) const { return i < levels[static_cast<size_t>(level)].size(); }
	const SearchBox& box(int level, size_t i) const { return levels[static_cast<size_t>(level)][i]; }

	const Item* leafBegin(size_t i) const { return items.data() + i * kGroup; }
	const Item* leafEnd(size_t i) const { return items.data() + std::min(items.size(), (i + 1) * kGroup); }

private:
	void BuildLevels()
	{
		if (items.empty()) return;
		levels.emplace_back((items.size() + kGroup - 1) / kGroup);
		for (size_t i = 0; i < items.size(); ++i) levels[0][i / kGroup].add(items[i].box);
		while (levels.back().size() > 1) {
			const std::vector<SearchBox>& below = levels.back();
			std::vector<SearchBox> level((below.size() + 1) / 2);
			for (size_t i = 0; i < below.size(); ++i) level[i / 2].add(below[i]);
			levels.push_back(std::move(level));
		}
	}

	std::vector<Item> items;
	std::vector<std::vector<SearchBox>>
		levels;  ///< node i of a level covers nodes 2i and 2i+1 of the one below; 0: the leaves
};

/// Descends two trees, or one against itself, and hands every pair of faces whose boxes meet to `visit(faceA, faceB)`, which
/// returns false to stop.
template <class Visit>
class PairDescent {
public:
	PairDescent(const FaceTree& first, const FaceTree& second, const Visit& visitor)
		: a(first), b(second), visit(visitor)
	{}

	bool run()
	{
		if (a.top() < 0 || b.top() < 0) return true;
		return &a == &b ? Self(a.top(), 0) : Cross(a.top(), 0, b.top(), 0);
	}

private:
	bool Self(int level, size_t i)
	{
		if (level == 0) return Leaf(i);
		const size_t left = 2 * i, right = left + 1;
		if (!Self(level - 1, left)) return false;
		return !a.hasNode(level - 1, right) || (Self(level - 1, right) && Cross(level - 1, left, level - 1, right));
	}

	bool Cross(int levelA, size_t i, int levelB, size_t j)
	{
		if (!a.box(levelA, i).meets(b.box(levelB, j))) return true;
		if (levelA == 0 && levelB == 0) return Leaves(i, j);
		for (size_t half = 0; half < 2; ++half) {
			if (levelA >= levelB) {
				const size_t child = 2 * i + half;
				if (a.hasNode(levelA - 1, child) && !Cross(levelA - 1, child, levelB, j)) return false;
			} else {
				const size_t child = 2 * j + half;
				if (b.hasNode(levelB - 1, child) && !Cross(levelA, i, levelB - 1, child)) return false;
			}
		}
		return true;
	}

	bool Leaf(size_t i)
	{
		for (const auto* p = a.leafBegin(i); p != a.leafEnd(i); ++p)
			for (const auto* q = p + 1; q != a.leafEnd(i); ++q)
				if (p->box.meets(q->box) && !visit(p->face, q->face)) return false;
		return true;
	}

	bool Leaves(size_t i, size_t j)
	{
		for (const auto* p = a.leafBegin(i); p != a.leafEnd(i); ++p) {
			if (!p->box.meets(b.box(0, j))) continue;
			for (const auto* q = b.leafBegin(j); q != b.leafEnd(j); ++q)
				if (p->box.meets(q->box) && !visit(p->face, q->face)) return false;
		}
		return true;
	}

	const FaceTree& a;
	const FaceTree& b;
	const Visit& visit;
};

/// The search itself, whatever the faces are stored in.
template <class CornersOf, class OtherCornersOf>
std::vector<FacePair> FindCrossingsOf(size_t count, const CornersOf& cornersOf, size_t otherCount,
                                      const OtherCornersOf& otherCornersOf, const CrossingOptions& options)
{
	std::vector<FacePair> pairs;
	const auto judge = [&](int i, int j, bool isOther, const Corners& second) {
		const Corners& first = cornersOf(static_cast<size_t>(i));
		const Contact contact = options.boxOf ? ContactOf(first, second) : ContactWithinBoxes(first, second);
		if (!IsCrossing(contact) || (options.ignore && options.ignore(i, j, isOther))) return true;
		pairs.push_back({i, j, isOther, contact});
		return !options.stopAtFirst;
	};
	const auto amongFaces = [&](int i, int j) {
		return judge(std::min(i, j), std::max(i, j), false, cornersOf(static_cast<size_t>(std::max(i, j))));
	};
	const auto withOther = [&](int i, int j) { return judge(i, j, true, otherCornersOf(static_cast<size_t>(j))); };

	const auto search = [&](const auto& boxOf, const auto& otherBoxOf) {
		const FaceTree tree(count, boxOf, Everywhere());
		if (tree.top() < 0) return;
		const bool goesOn = !options.amongFaces || PairDescent(tree, tree, amongFaces).run();
		if (goesOn && otherCount > 0) {
			const FaceTree otherTree(otherCount, otherBoxOf, tree.box(tree.top(), 0));
			PairDescent(tree, otherTree, withOther).run();
		}
	};
	if (options.boxOf)
		search([&](size_t i) { return options.boxOf(static_cast<int>(i), false); },
		       [&](size_t i) { return options.boxOf(static_cast<int>(i), true); });
	else search([&](size_t i) { return BoxOf(cornersOf(i)); }, [&](size_t i) { return BoxOf(otherCornersOf(i)); });
	std::sort(pairs.begin(), pairs.end());
	return pairs;
}

}  // namespace detail

inline std::vector<FacePair> FindCrossings(const std::vector<Corners>& faces, const std::vector<Corners>& others,
                                           const CrossingOptions& options)
{
	return detail::FindCrossingsOf(
		faces.size(), [&](size_t i) -> const Corners& { return faces[i]; }, others.size(),
		[&](size_t i) -> const Corners& { return others[i]; }, options);
}

inline std::vector<FacePair> FindCrossings(const std::vector<vcg::Point3d>& positions, const std::vector<Face>& faces,
                                           const std::vector<Face>& others, const CrossingOptions& options)
{
	const auto cornersOf = [&positions](const Face& f) -> Corners {
		return {positions[static_cast<size_t>(f[0])], positions[static_cast<size_t>(f[1])],
		        positions[static_cast<size_t>(f[2])]};
	};
	return detail::FindCrossingsOf(
		faces.size(), [&](size_t i) { return cornersOf(faces[i]); }, others.size(),
		[&](size_t i) { return cornersOf(others[i]); }, options);
}

}  // namespace vcg::textlabel
