#pragma once
// A tree of boxes over things in the plane: which of them may be near a place?
//
// Built once by halving the things at the median of the wider direction, so that it works as well for a line of text as
// for ten thousand lines. Header only, for any coordinate type.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace textlabel {

template <class Scalar>
struct FlatBox {
	Scalar x0, y0, x1, y1;

	bool meets(const FlatBox& o) const { return x0 <= o.x1 && o.x0 <= x1 && y0 <= o.y1 && o.y0 <= y1; }
	void add(const FlatBox& o)
	{
		x0 = std::min(x0, o.x0), y0 = std::min(y0, o.y0);
		x1 = std::max(x1, o.x1), y1 = std::max(y1, o.y1);
	}
};

template <class Scalar>
class BoxTree {
public:
	using Box = FlatBox<Scalar>;

	explicit BoxTree(std::vector<Box> boxes) : m_boxes(std::move(boxes)), m_order(m_boxes.size())
	{
		for (std::size_t i = 0; i < m_order.size(); ++i) m_order[i] = i;
		if (!m_order.empty()) build(0, m_order.size());
	}

	/// Call visit(index) for every thing whose box meets `box`. The visitor may change `box` while the search runs.
	template <class Visitor>
	void search(const Box& box, Visitor&& visit) const
	{
		std::vector<std::size_t> stack;
		if (!m_nodes.empty()) stack.push_back(0);
		while (!stack.empty()) {
			const Node& node = m_nodes[stack.back()];
			stack.pop_back();
			if (!node.box.meets(box)) continue;
			if (node.right != 0) {
				stack.push_back(node.right);
				stack.push_back(static_cast<std::size_t>(&node - m_nodes.data()) + 1);
				continue;
			}
			for (std::size_t i = node.first; i < node.last; ++i) {
				if (m_boxes[m_order[i]].meets(box)) visit(m_order[i]);
			}
		}
	}

private:
	static constexpr std::size_t kLeafSize = 4;
	struct Node {
		Box box;
		std::size_t first, last;  ///< range of m_order
		std::size_t right;        ///< second child, 0 for a leaf; the first child follows its parent
	};

	std::size_t build(std::size_t first, std::size_t last)
	{
		const std::size_t self = m_nodes.size();
		Box box = m_boxes[m_order[first]];
		for (std::size_t i = first + 1; i < last; ++i) box.add(m_boxes[m_order[i]]);
		m_nodes.push_back({box, first, last, 0});
		if (last - first <= kLeafSize) return self;
		const bool byX = box.x1 - box.x0 > box.y1 - box.y0;
		const auto centre = [&](std::size_t i) {
			const Box& b = m_boxes[i];
			return byX ? b.x0 / 2 + b.x1 / 2 : b.y0 / 2 + b.y1 / 2;
		};
		const auto at = [this](std::size_t i) { return m_order.begin() + static_cast<std::ptrdiff_t>(i); };
		const std::size_t middle = (first + last) / 2;
		std::nth_element(at(first), at(middle), at(last),
		                 [&](std::size_t i, std::size_t j) { return centre(i) < centre(j); });
		build(first, middle);
		const std::size_t right = build(middle, last);
		m_nodes[self].right = right;
		return self;
	}

	std::vector<Box> m_boxes;
	std::vector<std::size_t> m_order;
	std::vector<Node> m_nodes;
};

}  // namespace textlabel
