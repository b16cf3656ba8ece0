#pragma once
// What the peers need: the outline as a solid, and a part cropped by hand to what lies under the label.

#include "vcg_ext/contour.h"
#include "vcg_ext/sheet.h"
#include "vcg_ext/tessellate.h"
#include "vcg_ext/validate.h"

namespace bench {

using vcg::textlabel::Face;
using vcg::textlabel::IndexedMesh;
using vcg::textlabel::LabelFrame;
using vcg::textlabel::LabelSpace;
using vcg::textlabel::Outline;
using vcg::textlabel::PlaneBox;

inline PlaneBox BoxOf(const Outline& outline)
{
	PlaneBox box;
	for (const auto& c : outline.contours)
		for (const auto& p : c.points) box.add(p);
	return box;
}

/// A prism over an outline: the same contours at the heights `low` and `high` of label space, in mesh coordinates.
inline IndexedMesh MakePrism(const LabelSpace& space, const Outline& outline, double low, double high)
{
	IndexedMesh prism;
	std::vector<vcg::Point2d> plane;
	std::vector<vcg::Point3d> top;
	for (const auto& c : outline.contours)
		for (const auto& p : c.points) {
			plane.push_back(p);
			top.emplace_back(p[0], p[1], high);
		}
	const int n = int(plane.size());
	for (const double z : {low, high})
		for (const auto& p : plane) prism.positions.push_back(space.toMesh({p[0], p[1], z}));
	std::vector<vcg::textlabel::IndexTriangle> caps;
	vcg::textlabel::Tessellator tessellator;
	for (int part = 0; part < outline.partCount; ++part) {
		vcg::textlabel::PolylineSet rings;
		int first = 0;
		for (const auto& c : outline.contours) {
			const int size = int(c.points.size());
			for (int i = 0; i < size && c.part == part; ++i) {
				const int a = first + i, b = first + (i + 1) % size;
				rings.add(a);
				prism.faces.push_back({a, b, b + n});
				prism.faces.push_back({a, b + n, a + n});
			}
			if (c.part == part) rings.close();
			first += size;
		}
		tessellator.triangulate(plane, top, rings, 0, rings.size(), caps);
	}
	for (const auto& t : caps) {
		prism.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
		prism.faces.push_back({t[0], t[2], t[1]});
	}
	return prism;
}

/// The triangles of a part that face the viewer under a box, closed by walls and a floor.
class Crop {
public:
	Crop(const LabelSpace& space, const IndexedMesh& part, const PlaneBox& box) : part_(part)
	{
		for (const auto& p : part.positions) label_.push_back(space.toLabel(p));
		findPlane();
		for (size_t f = 0; f < part.faces.size(); ++f) taken_.push_back(isUnder(f, box));
		while (fillPinches()) {}
	}
	/// Label space: the lowest and the highest point of what was cropped.
	double lowest() const { return lowest_; }
	double highest() const { return highest_; }
	int triangles() const { return int(std::count(taken_.begin(), taken_.end(), 1)); }

	/// @param[in] floor  label space
	IndexedMesh solid(const LabelSpace& space, double floor) const
	{
		IndexedMesh out;
		std::vector<int> number(part_.positions.size(), -1), next(number);
		const auto use = [&](int v) {
			int& n = number[size_t(v)];
			if (n < 0) {
				n = int(out.positions.size());
				out.positions.push_back(part_.positions[size_t(v)]);
			}
			return n;
		};
		for (size_t f = 0; f < taken_.size(); ++f)
			if (taken_[f])
				out.faces.push_back({use(part_.faces[f][0]), use(part_.faces[f][1]), use(part_.faces[f][2])});
		int start = -1;
		for (const auto& [a, b] : borderEdges()) {
			next[size_t(a)] = b;
			start = a;
		}
		std::vector<vcg::Point2d> plane;
		std::vector<vcg::Point3d> flat;
		vcg::textlabel::PolylineSet ring;
		const int firstBelow = int(out.positions.size());
		int v = start;
		do {
			ring.add(int(plane.size()));
			plane.push_back(plane_[size_t(v)]);
			flat.emplace_back(plane.back()[0], plane.back()[1], 0);
			out.positions.push_back(space.toMesh({plane.back()[0], plane.back()[1], floor}));
			v = next[size_t(v)];
		} while (v != start);
		ring.close();
		const int n = int(plane.size());
		for (int i = 0; i < n; ++i, v = next[size_t(v)]) {
			const int a = number[size_t(v)], b = number[size_t(next[size_t(v)])], below = firstBelow + i,
					  besides = firstBelow + (i + 1) % n;
			out.faces.push_back({b, a, below});
			out.faces.push_back({b, below, besides});
		}
		std::vector<vcg::textlabel::IndexTriangle> bottom;
		vcg::textlabel::Tessellator().triangulate(plane, flat, ring, 0, 1, bottom);
		for (const auto& t : bottom) out.faces.push_back({firstBelow + t[0], firstBelow + t[2], firstBelow + t[1]});
		return out;
	}

private:
	void findPlane()
	{
		for (const auto& q : label_) plane_.emplace_back(q[0], q[1]);
	}
	bool isUnder(size_t f, const PlaneBox& box)
	{
		const Face& t = part_.faces[f];
		PlaneBox own;
		for (const int v : t) own.add(plane_[size_t(v)]);
		const auto at = [&](size_t k) { return plane_[size_t(t[k])]; };
		if (!own.meets(box) || ((at(1) - at(0)) ^ (at(2) - at(0))) <= 0) return false;
		for (const int v : t) {
			lowest_ = std::min(lowest_, label_[size_t(v)][2]);
			highest_ = std::max(highest_, label_[size_t(v)][2]);
		}
		return true;
	}
	/// Edges of one taken triangle, the triangle to their left.
	std::vector<std::array<int, 2>> borderEdges() const
	{
		std::vector<std::array<int, 2>> edges, border;
		for (size_t f = 0; f < taken_.size(); ++f)
			for (size_t k = 0; k < 3 && taken_[f]; ++k)
				edges.push_back({part_.faces[f][k], part_.faces[f][(k + 1) % 3]});
		std::sort(edges.begin(), edges.end());
		for (const auto& e : edges)
			if (!std::binary_search(edges.begin(), edges.end(), std::array<int, 2>{e[1], e[0]})) border.push_back(e);
		return border;
	}
	/// Take all triangles around vertices where the border touches itself; false when there are none.
	bool fillPinches()
	{
		std::vector<char> leaves(part_.positions.size(), 0), pinched(leaves);
		bool any = false;
		for (const auto& [a, b] : borderEdges())
			if (leaves[size_t(a)]++ > 0) {
				pinched[size_t(a)] = 1;
				any = true;
			}
		for (size_t f = 0; f < taken_.size() && any; ++f)
			for (const int v : part_.faces[f])
				if (pinched[size_t(v)]) taken_[f] = 1;
		return any;
	}

	const IndexedMesh& part_;
	std::vector<vcg::Point3d> label_;
	std::vector<vcg::Point2d> plane_;
	std::vector<char> taken_;
	double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
};

}  // namespace bench
