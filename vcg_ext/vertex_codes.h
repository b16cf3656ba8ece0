#pragma once
// Where each vertex of the mesh lies against a label's box: the part of the linear pass that looks at vertices (collect_sheet.h).

#include "label_frame.h"
#include "parallel_chunks.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace vcg::textlabel::detail {

enum OutCode : std::uint8_t { Left = 1, Right = 2, Below = 4, Above = 8, Unusable = 16, BehindCamera = 32, Used = 64 };

/// Where a point of the label plane lies against a box. Without branches: that is not to be predicted.
inline std::uint8_t OutCodeOf(const PlaneBox& box, const vcg::Point2d& p)
{
	return std::uint8_t(Left * (p[0] < box.low[0]) | Right * (p[0] > box.high[0]) | Below * (p[1] < box.low[1]) |
	                    Above * (p[1] > box.high[1]));
}

/// Where a finite point of label space is seen, in perspective.
inline std::uint8_t OutCodeOf(const LabelSpace& space, const PlaneBox& box, const vcg::Point3d& q)
{
	if (!space.isInFront(q)) return Unusable | BehindCamera;
	return OutCodeOf(box, space.project(q));
}

/// Where a finite point is seen when it is unrolled: one on the axis has no place on the way round it, but one along it.
/// @param[in] unrolled, box  along the way round and along the axis
inline std::uint8_t OutCodeOfUnrolled(const LabelSpace& space, const PlaneBox& box, const vcg::Point3d& unrolled)
{
	const std::uint8_t code = OutCodeOf(box, {unrolled[0], unrolled[1]});
	return space.isInFront(unrolled) ? code : std::uint8_t((code & (Below | Above)) | Unusable | BehindCamera);
}

/// The box of a wrapped label, asked about points along the frame's axes. Nearly all are so plainly on one side of its ends that the
/// order of their angles tells, which takes no arc tangent; the others are unrolled.
class WindowRoundAxis {
public:
	/// @pre space.wraps()
	WindowRoundAxis(const LabelSpace& space, const PlaneBox& box) : space_(space), window_(space.unrolledBox(box))
	{
		const double low = space.angleAt(window_.low[0]), high = space.angleAt(window_.high[0]);
		before_ = low < high ? Left : Right;
		beyond_ = low < high ? Right : Left;
		first_ = turnAt(std::min(low, high));
		last_ = turnAt(std::max(low, high));
		least_ = farFromAxis * space.circumference();
	}

	/// @param[in] q  finite, along the frame's axes
	std::uint8_t codeOf(const vcg::Point3d& q) const
	{
		const vcg::Point2d p = space_.aroundAxis(q);
		const double size = std::abs(p[0]) + std::abs(p[1]), turn = turnOf(p, size);
		const bool isPlain =
			size > least_ && size < largest && std::abs(turn - first_) > slack && std::abs(turn - last_) > slack;
		if (!isPlain) return OutCodeOfUnrolled(space_, window_, space_.unrolledInFrame(q));
		const double along = space_.alongAxis(q);
		return std::uint8_t(before_ * (turn < first_) | beyond_ * (turn > last_) | Below * (along < window_.low[1]) |
		                    Above * (along > window_.high[1]));
	}

private:
	static constexpr double slack = 1e-9;        // turns: far more than rounding
	static constexpr double farFromAxis = 1e-2;  // of the circumference: where LabelSpace::isInFront needs no asking
	static constexpr double largest = 1e300;     // no sum overflows

	/// -2 .. 2, in the order of the angles -pi .. pi.
	static double turnOf(const vcg::Point2d& p, double size)
	{
		const double sine = p[0] / size;
		return p[1] >= 0 ? sine : std::copysign(2.0, p[0]) - sine;
	}
	static double turnAt(double angle)
	{
		constexpr double none = 3;  // no point is turned so far
		if (!(std::abs(angle) < std::acos(-1.0))) return std::copysign(none, angle);
		const vcg::Point2d p(std::sin(angle), std::cos(angle));
		return turnOf(p, std::abs(p[0]) + std::abs(p[1]));
	}

	const LabelSpace space_;
	const PlaneBox window_;
	double first_, last_;       ///< turns at the ends of the window, in the order of the angles
	double least_;              ///< size of a point that is plainly off the axis
	unsigned before_, beyond_;  ///< codes of what is turned less, or more
};

/// Codes of vertices are looked through by so many at a time.
using CodeBlock = std::uint64_t;
constexpr size_t kCodeBlock = sizeof(CodeBlock);

/// One pass over the vertices: where each is seen. Of a wrapped label it is asked along the way round and along the axis: there, what
/// lies between the corners of a triangle is between their codes, too, though unrolling bends it.
/// @return #V codes, and Unusable up to a whole block
template <class MeshType>
std::vector<std::uint8_t> CodeVertices(const MeshType& m, const LabelSpace& space, const PlaneBox& box)
{
	std::vector<std::uint8_t> code((m.vert.size() + kCodeBlock - 1) / kCodeBlock * kCodeBlock, Unusable);
	enum class View { Parallel, Perspective, Wrapped };
	std::optional<WindowRoundAxis> roundAxis;
	if (space.wraps()) roundAxis.emplace(space, box);
	const auto pass = [&](auto view, size_t first, size_t last) {
		const LabelSpace here = space;  // copies that nothing else can change stay in registers
		const auto* const vertex = m.vert.data();
		std::uint8_t* const to = code.data();
		for (size_t v = first; v < last; ++v) {
			if (vertex[v].IsD()) continue;
			const vcg::Point3d q = here.inFrame(PointOf(vertex[v]));
			if (!std::isfinite(q[0] + q[1])) continue;  // no part of q is finite where a coordinate is not
			if constexpr (view == View::Perspective) to[v] = OutCodeOf(here, box, q);
			else if constexpr (view == View::Wrapped) to[v] = roundAxis->codeOf(q);
			else to[v] = OutCodeOf(box, {q[0], q[1]});
		}
	};
	EachChunk(m.vert.size(), ChunkCount(m.vert.size()), [&](size_t, size_t first, size_t last) {
		if (space.wraps()) pass(std::integral_constant<View, View::Wrapped>(), first, last);
		else if (space.perspective()) pass(std::integral_constant<View, View::Perspective>(), first, last);
		else pass(std::integral_constant<View, View::Parallel>(), first, last);
	});
	return code;
}

/// How many of eight codes are Used.
inline int CountUsed(CodeBlock codes)
{
	constexpr CodeBlock ones = 0x0101010101010101;
	return int((((codes / Used) & ones) * ones) >> (8 * (kCodeBlock - 1)));
}

}  // namespace vcg::textlabel::detail
