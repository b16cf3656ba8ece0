#include "drawing_stroke.h"

#include <algorithm>
#include <cmath>
#include "vcg_ext/contour.h"

namespace textlabel {
namespace {

using vcg::Point2d;

constexpr double kPi = 3.14159265358979323846;
/// Most corners of a half circle.
constexpr double kMostCorners = 500;

class Stroker {
public:
	Stroker(const LineStyle& style, double tolerance) : m_style(style), m_half(style.width / 2), m_tolerance(tolerance)
	{
		const double sagitta = std::clamp(tolerance / m_half, 0.0, 0.5);
		m_step = std::max(2 * std::acos(1 - sagitta), kPi / kMostCorners);
	}

	std::vector<Ring> run(const Ring& line, bool isClosed)
	{
		Ring points;
		for (const Point2d& p : line)
			if (points.empty() || p != points.back()) points.push_back(p);
		while (isClosed && points.size() > 1 && points.front() == points.back()) points.pop_back();
		if (points.size() == 1) dot(points[0]);
		else follow(points, isClosed);
		return std::move(m_rings);
	}

private:
	/// A line without length has its ends only.
	void dot(const Point2d& p)
	{
		if (m_style.cap == LineCap::Butt) return;
		cap(p, {1, 0});
		cap(p, {-1, 0});
	}

	/// A straight piece: from where to where, and how its ends lie across it.
	struct Piece {
		Point2d a, b, along;  ///< along: unit
		double length;
		Point2d sideA, sideB;  ///< from the line's end to the corner on its left
		bool goesOn = false;   ///< has its corners at b in common with the next one
	};

	void follow(const Ring& points, bool isClosed)
	{
		const std::size_t n = points.size(), count = isClosed ? n : n - 1;
		std::vector<Piece> pieces;
		for (std::size_t i = 0; i < count; ++i) {
			const Point2d &a = points[i], &b = points[(i + 1) % n];
			const double length = (b - a).Norm();
			const Point2d along = (b - a) / length, side = left(along);
			pieces.push_back({a, b, along, length, side, side});
		}
		for (std::size_t i = isClosed ? 0 : 1; i < count; ++i) {
			Piece &before = pieces[(i + count - 1) % count], &after = pieces[i];
			before.goesOn = join(before, after);
			if (!before.goesOn) joint(after.a, before.along, after.along);
		}
		// a band that ended where it began would have both sides in common with itself
		pieces.back().goesOn = false;
		if (isClosed) pieces[count / 2].goesOn = false;
		for (std::size_t i = 0; i < count; ++i) {
			const std::size_t first = i;
			while (pieces[i].goesOn) ++i;
			band(pieces, first, i);
		}
		if (isClosed) return;
		cap(points.front(), pieces.front().along * -1);
		cap(points.back(), pieces.back().along);
	}

	/// Pieces that go on into each other as one polygon: it winds around as often as each of them would.
	void band(const std::vector<Piece>& pieces, std::size_t first, std::size_t last)
	{
		Ring ring{pieces[first].a - pieces[first].sideA};
		for (std::size_t i = first; i <= last; ++i) ring.push_back(pieces[i].b - pieces[i].sideB);
		for (std::size_t i = last + 1; i-- > first;) ring.push_back(pieces[i].b + pieces[i].sideB);
		ring.push_back(pieces[first].a + pieces[first].sideA);
		add(std::move(ring));
	}

	/// Where a curve goes on, its pieces have their corners in common, which no kind of joint would change by more than the tolerance.
	/// @return false where the line turns more than that
	bool join(Piece& before, Piece& after) const
	{
		constexpr double share = 0.4;  // of a piece, that its inner side may lose at each end
		const double turn = std::atan2(before.along ^ after.along, before.along * after.along);
		const double inner = m_half * std::abs(std::tan(turn / 2)), miter = 1 / std::cos(turn / 2);
		if (std::abs(turn) > 1 || m_half * (miter - 1) > m_tolerance) return false;
		if (inner > share * std::min(before.length, after.length)) return false;
		before.sideB = after.sideA = (left(before.along) + left(after.along)) / 2 * (miter * miter);
		return true;
	}

	Point2d left(const Point2d& along) const { return Point2d(-along[1], along[0]) * m_half; }

	/// @param[in] out  unit, away from the line
	void cap(const Point2d& p, const Point2d& out)
	{
		const Point2d side = left(out), end = p + out * m_half;
		if (m_style.cap == LineCap::Square) add({p - side, end - side, end + side, p + side});
		if (m_style.cap == LineCap::Round) fan(p, side * -1, kPi);
	}

	void joint(const Point2d& p, const Point2d& in, const Point2d& out)
	{
		const double turn = std::atan2(in ^ out, in * out);
		if (turn == 0) return;
		const double outer = turn > 0 ? -1 : 1;  // on the right where it turns to the left
		const Point2d from = left(in) * outer, to = left(out) * outer;
		if (m_style.join == LineJoin::Round) return fan(p, from, turn);
		const double miter = 1 / std::cos(turn / 2);  // of half the width
		const bool isMitered = m_style.join == LineJoin::Miter && std::abs(turn) < kPi && miter <= m_style.miterLimit;
		if (isMitered) add({p, p + from, p + (from + to) / 2 * (miter * miter), p + to});
		else add({p, p + from, p + to});
	}

	/// A piece of a disc.
	void fan(const Point2d& p, const Point2d& from, double turn)
	{
		const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / m_step)));
		Ring ring{p};
		for (int i = 0; i <= count; ++i) {
			const double c = std::cos(turn * i / count), s = std::sin(turn * i / count);
			ring.push_back(p + Point2d(c * from[0] - s * from[1], s * from[0] + c * from[1]));
		}
		add(std::move(ring));
	}

	void add(Ring ring)
	{
		if (vcg::textlabel::TwiceSignedArea(ring) < 0) std::reverse(ring.begin(), ring.end());
		m_rings.push_back(std::move(ring));
	}

	const LineStyle& m_style;
	const double m_half, m_tolerance;
	double m_step;  ///< of round joints, radians
	std::vector<Ring> m_rings;
};

}  // namespace

std::vector<Ring> StrokeRings(const Ring& line, bool isClosed, const LineStyle& style, double tolerance)
{
	if (line.empty() || !(style.width > 0)) return {};
	return Stroker(style, tolerance).run(line, isClosed);
}

}  // namespace textlabel
