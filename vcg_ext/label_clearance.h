#pragma once
// What lies in front of a label and behind it.
//
// A label must be seen whole from its viewpoint, and a sunk one must not come out on the other side of a wall. Both are questions
// about the candidates that overlap the letters in the label plane: the overlap of two triangles is a convex polygon, depth is
// linear over it, so its corners tell the least distance exactly. No sampling.

#include "label_cut.h"

namespace vcg::textlabel {

/// The nearest other surface behind the letters along the rays, and where.
struct Clearance {
	double behind =
		std::numeric_limits<double>::infinity();  ///< world units along the ray; infinite when nothing is there
	vcg::Point3d place{0, 0, 0};                  ///< mesh coordinates, on the label's surface
	int face = -1;                                ///< the mesh's face behind
};

/// Measure the room behind the letters and check that nothing hides them.
/// @param[in] resolution  world units; overlaps thinner than this are neighbours that touch
/// @throws Error{Occluded} naming the face in front, and the place
Clearance MeasureClearance(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double resolution);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// A convex polygon of at most 3+3 corners: two triangles' overlap.
struct SmallPolygon {
	std::array<vcg::Point2d, 9> point;
	int size = 0;

	void add(const vcg::Point2d& p) { point[size_t(size++)] = p; }
	double area() const
	{
		double sum = 0;
		for (int i = 1; i + 1 < size; ++i) sum += (point[size_t(i)] - point[0]) ^ (point[size_t(i) + 1] - point[0]);
		return sum / 2;
	}
	double perimeter() const
	{
		double sum = 0;
		for (int i = 0; i < size; ++i) sum += (point[size_t((i + 1) % size)] - point[size_t(i)]).Norm();
		return sum;
	}
	/// Keep what lies to the left of a-b (Sutherland and Hodgman).
	SmallPolygon clipped(const vcg::Point2d& a, const vcg::Point2d& b) const
	{
		SmallPolygon out;
		for (int i = 0; i < size; ++i) {
			const vcg::Point2d &p = point[size_t(i)], &q = point[size_t((i + 1) % size)];
			const double dp = (b - a) ^ (p - a), dq = (b - a) ^ (q - a);
			if (dp >= 0) out.add(p);
			if ((dp < 0) != (dq < 0)) out.add(p + (q - p) * (dp / (dp - dq)));
		}
		return out;
	}
};

/// Whether an edge of one triangle keeps the other one beyond it, `sliver` of overlap forgiven. @pre both counter-clockwise
inline bool AreApart(const std::array<vcg::Point2d, 3>& s, const std::array<vcg::Point2d, 3>& t, double sliver)
{
	for (size_t k = 0; k < 3; ++k) {
		const vcg::Point2d edge = s[(k + 1) % 3] - s[k];
		const double inside = std::max({edge ^ (t[0] - s[k]), edge ^ (t[1] - s[k]), edge ^ (t[2] - s[k])});
		if (inside <= 0 || inside * inside <= sliver * sliver * edge.SquaredNorm()) return true;
	}
	return false;
}

/// Buckets of triangles over the label plane, to find those whose boxes meet a box.
class TriangleGrid {
public:
	TriangleGrid(const CutLabel& cut, const std::vector<IndexTriangle>& triangles)
	{
		for (const IndexTriangle& t : triangles)
			for (const int v : t) box_.add(cut.points[size_t(v)].plane);
		constexpr int mostCells = 256;
		side_ = std::clamp(int(std::sqrt(double(triangles.size()))), 1, mostCells);
		start_.assign(size_t(side_) * size_t(side_) + 1, 0);
		const auto eachCell = [&](auto&& use) {
			for (int t = 0; t < int(triangles.size()); ++t) {
				PlaneBox box;
				for (const int v : triangles[size_t(t)]) box.add(cut.points[size_t(v)].plane);
				visitCells(box, [&](int cell) { use(t, cell); });
			}
		};
		eachCell([&](int, int cell) { ++start_[size_t(cell) + 1]; });
		for (size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
		member_.resize(size_t(start_.back()));
		std::vector<int> next(start_.begin(), start_.end() - 1);
		eachCell([&](int t, int cell) { member_[size_t(next[size_t(cell)]++)] = t; });
		seen_.assign(triangles.size(), -1);
	}
	/// Call use(t) once for each triangle that may meet the box; `round` must differ from call to call.
	template <class Use>
	void query(const PlaneBox& box, int round, Use&& use)
	{
		if (box.high[0] < box_.low[0] || box.low[0] > box_.high[0] || box.high[1] < box_.low[1] ||
		    box.low[1] > box_.high[1])
			return;
		visitCells(box, [&](int cell) {
			for (int i = start_[size_t(cell)]; i < start_[size_t(cell) + 1]; ++i)
				if (std::exchange(seen_[size_t(member_[size_t(i)])], round) != round) use(member_[size_t(i)]);
		});
	}

private:
	int cellOf(double x, int axis) const
	{
		const double size = axis == 0 ? box_.width() : box_.height();
		return size > 0 ? std::clamp(int((x - box_.low[axis]) / size * side_), 0, side_ - 1) : 0;
	}
	template <class Use>
	void visitCells(const PlaneBox& box, Use&& use) const
	{
		const auto clamped = [&](double x, int axis) {
			return cellOf(std::clamp(x, box_.low[axis], box_.high[axis]), axis);
		};
		for (int y = clamped(box.low[1], 1); y <= clamped(box.high[1], 1); ++y)
			for (int x = clamped(box.low[0], 0); x <= clamped(box.high[0], 0); ++x) use(y * side_ + x);
	}

	PlaneBox box_;
	int side_ = 1;
	std::vector<int> start_, member_, seen_;
};

}  // namespace detail

inline Clearance MeasureClearance(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double resolution)
{
	std::vector<IndexTriangle> inside;
	std::vector<int> parent;
	for (const CutTriangle& t : cut.triangles)
		if (t.side == Side::Inside) {
			inside.push_back(t.point);
			parent.push_back(t.parent);
		}
	for (const int t : cut.within) {
		inside.push_back(sheet.triangles[size_t(t)].vertex);
		parent.push_back(t);
	}
	const auto pointOn = [&](int triangle, const vcg::Point2d& p) {
		const vcg::Point3d w = SpaceWeights(space, sheet, triangle, p);
		vcg::Point3d q(0, 0, 0);
		for (int k = 0; k < 3; ++k)
			q += sheet.vertices[size_t(sheet.triangles[size_t(triangle)].vertex[size_t(k)])].label * w[k];
		return q;
	};
	detail::TriangleGrid grid(cut, inside);
	Clearance clearance;
	for (int t = 0; t < int(sheet.triangles.size()); ++t) {
		PlaneBox box;
		const auto& vertex = sheet.triangles[size_t(t)].vertex;
		std::array<vcg::Point2d, 3> corner = {sheet.plane(vertex[0]), sheet.plane(vertex[1]), sheet.plane(vertex[2])};
		for (const vcg::Point2d& p : corner) box.add(p);
		if (!sheet.triangles[size_t(t)].facing) std::swap(corner[1], corner[2]);
		grid.query(box, t, [&](int s) {
			if (parent[size_t(s)] == t) return;
			std::array<vcg::Point2d, 3> letter;
			for (size_t k = 0; k < 3; ++k) letter[k] = cut.points[size_t(inside[size_t(s)][k])].plane;
			if (detail::AreApart(letter, corner, resolution) || detail::AreApart(corner, letter, resolution)) return;
			detail::SmallPolygon overlap;
			for (const vcg::Point2d& p : corner) overlap.add(p);
			for (size_t k = 0; k < 3 && overlap.size > 0; ++k)
				overlap = overlap.clipped(letter[k], letter[(k + 1) % 3]);
			if (overlap.size < 3 || overlap.area() <= resolution * overlap.perimeter()) return;
			double least = std::numeric_limits<double>::infinity(), most = -least;
			vcg::Point3d place(0, 0, 0);
			for (int i = 0; i < overlap.size; ++i) {
				const vcg::Point3d q = pointOn(parent[size_t(s)], overlap.point[size_t(i)]);
				const double depth = (q - pointOn(t, overlap.point[size_t(i)])) * space.towardsViewer(q);  // > 0 behind
				most = std::max(most, depth);
				if (depth >= least) continue;
				least = depth;
				place = q;
			}
			if (least + most < 0)
				throw Error(ErrorCode::Occluded, "a surface in front of the label")
					.atFace(sheet.triangles[size_t(t)].face)
					.atPlace(space.toMesh(place));
			if (least < clearance.behind)
				clearance = {std::max(least, 0.0), space.toMesh(place), sheet.triangles[size_t(t)].face};
		});
	}
	return clearance;
}

}  // namespace vcg::textlabel
