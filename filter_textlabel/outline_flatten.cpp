#include "outline_flatten.h"

#include <algorithm>
#include <cmath>
#include "text_error.h"

namespace textlabel {
namespace {

using vcg::Point2d;

/// Share of the tolerance that goes to the dense samples: ten samples for each chord.
constexpr double kSampleShare = 0.01;
/// A joint that turns by more than this is a corner, and stays (radians; about 15 degrees).
constexpr double kCorner = 0.26;
/// A line longer than this keeps its ends, a corner between pieces longer than this stays (times the tolerance). What
/// is shorter is a detail, which the tolerance rules.
constexpr double kDetail = 8;
/// Longest reach of a chord, in samples: bounds the work where a font has thousands of points within the tolerance.
constexpr std::size_t kReach = 256;
/// Halvings of the error when the chords of a stretch are evened out.
constexpr int kEvenings = 8;

/// Finest and coarsest chord error, times the size.
constexpr double kFinestTolerance = 1e-6, kCoarsestTolerance = 0.25;

/// Dense samples of a contour, and which of them must stay.
struct Samples {
	std::vector<Point2d> points;     ///< closed; the last is not the first
	std::vector<std::size_t> fixed;  ///< ascending indices into points
};

double SecondDifference(const CurvePiece& c)
{
	if (c.degree == 2) return (c.p[0] - c.p[1] * 2 + c.p[2]).Norm() * 2;
	if (c.degree == 3)
		return std::max((c.p[0] - c.p[1] * 2 + c.p[2]).Norm(), (c.p[1] - c.p[2] * 2 + c.p[3]).Norm()) * 6;
	return 0;
}

/// How many chords of equal parameter keep within the error.
double ChordsNeeded(const CurvePiece& c, double error)
{
	return std::max(1.0, std::ceil(std::sqrt(SecondDifference(c) / (8 * error))));
}

/// A tolerance at which a contour needs no more samples than there may be: each piece may need one more than its share,
/// by rounding up.
double LeastTolerance(const CurveContour& contour)
{
	const double left = static_cast<double>(kMostSamples) - 1 - static_cast<double>(contour.size());
	if (!(left > 0)) throw TextError(TextErrorCode::Unsound, "a glyph has too many pieces");
	double sum = 0;
	for (const CurvePiece& piece : contour) sum += std::sqrt(SecondDifference(piece) / (8 * kSampleShare));
	return std::pow(sum / left, 2);
}

/// Direction in which a piece leaves its start (or, reversed, its end): towards the first control point that differs.
Point2d Leaving(const CurvePiece& c, bool atEnd)
{
	const int n = c.degree;
	for (int i = 1; i <= n; ++i) {
		const Point2d d =
			atEnd ? c.p[static_cast<std::size_t>(n - i)] - c.end() : c.p[static_cast<std::size_t>(i)] - c.start();
		if (d.SquaredNorm() > 0) return d;
	}
	return {0, 0};
}

double ControlLength(const CurvePiece& c)
{
	double length = 0;
	for (std::size_t i = 0; i < static_cast<std::size_t>(c.degree); ++i) length += (c.p[i + 1] - c.p[i]).Norm();
	return length;
}

/// Must the joint between two pieces stay a point of the polyline?
bool IsFixedJoint(const CurvePiece& before, const CurvePiece& after, double tolerance)
{
	const bool longBefore = ControlLength(before) > kDetail * tolerance;
	const bool longAfter = ControlLength(after) > kDetail * tolerance;
	if ((before.degree == 1 && longBefore) || (after.degree == 1 && longAfter)) return true;
	if (!longBefore || !longAfter) return false;
	const Point2d in = Leaving(before, true) * -1, out = Leaving(after, false);
	return std::abs(std::atan2(in ^ out, in * out)) > kCorner;
}

Samples Sample(const CurveContour& contour, double tolerance)
{
	Samples result;
	if (!(SamplesNeeded(contour, tolerance) < static_cast<double>(kMostSamples)))
		throw TextError(TextErrorCode::BadTolerance, "too fine for this outline")
			.measured(tolerance, LeastTolerance(contour));
	const CurvePiece* before = contour.empty() ? nullptr : &contour.back();
	for (const CurvePiece& piece : contour) {
		if (IsFixedJoint(*before, piece, tolerance)) result.fixed.push_back(result.points.size());
		before = &piece;
		const double n = ChordsNeeded(piece, kSampleShare * tolerance);
		for (int i = 0; i < static_cast<int>(n); ++i) result.points.push_back(PointAt(piece, i / n));
	}
	return result;
}

/// Samples without repeated ones, beginning with a point that stays; of a round contour, its lowest.
Samples Tidied(const Samples& raw)
{
	const std::size_t n = raw.points.size();
	std::size_t first = 0;
	if (!raw.fixed.empty()) first = raw.fixed.front();
	else first = static_cast<std::size_t>(std::min_element(raw.points.begin(), raw.points.end()) - raw.points.begin());
	std::vector<char> isFixed(n, 0);
	for (const std::size_t i : raw.fixed) isFixed[i] = 1;
	Samples result;
	for (std::size_t k = 0; k < n; ++k) {
		const std::size_t i = (first + k) % n;
		const bool repeated = !result.points.empty() && raw.points[i] == result.points.back();
		if (!repeated) result.points.push_back(raw.points[i]);
		if (isFixed[i] && (result.fixed.empty() || result.fixed.back() != result.points.size() - 1))
			result.fixed.push_back(result.points.size() - 1);
	}
	while (result.points.size() > 1 && result.points.back() == result.points.front()) result.points.pop_back();
	while (!result.fixed.empty() && result.fixed.back() >= result.points.size()) result.fixed.pop_back();
	if (result.fixed.empty()) result.fixed.push_back(0);
	return result;
}

double SquaredDistance(const Point2d& q, const Point2d& a, const Point2d& b)
{
	const Point2d ab = b - a;
	const double length = ab.SquaredNorm();
	const double t = length > 0 ? std::clamp(((q - a) * ab) / length, 0.0, 1.0) : 0.0;
	return (q - a - ab * t).SquaredNorm();
}

/// One stretch of samples between two that stay.
class Stretch {
public:
	/// @param[in] last  index after which the samples begin anew at 0; may be points.size()
	Stretch(const std::vector<Point2d>& points, std::size_t first, std::size_t last)
		: m_points(points), m_first(first), m_last(last)
	{}

	/// Indices of the chords' starts, each chord reaching as far as it can.
	std::vector<std::size_t> chords(double error) const
	{
		std::vector<std::size_t> starts;
		for (std::size_t i = m_first; i < m_last; i = reach(i, error)) starts.push_back(i);
		return starts;
	}

	/// The same number of chords as chords(error) has, with the least error.
	std::vector<std::size_t> evenChords(double error) const
	{
		std::vector<std::size_t> best = chords(error);
		double low = 0, high = error;
		for (int i = 0; i < kEvenings && best.size() > 1; ++i) {
			const double middle = (low + high) / 2;
			std::vector<std::size_t> tried = chords(middle);
			if (tried.size() > best.size()) {
				low = middle;
			} else {
				high = middle;
				best = std::move(tried);
			}
		}
		return best;
	}

private:
	const Point2d& at(std::size_t i) const { return m_points[i % m_points.size()]; }

	std::size_t reach(std::size_t from, double error) const
	{
		std::size_t to = from + 1;
		while (to < m_last && to - from < kReach && isWithin(from, to + 1, error * error)) ++to;
		return to;
	}

	bool isWithin(std::size_t from, std::size_t to, double squaredError) const
	{
		for (std::size_t i = to - 1; i > from; --i) {
			if (SquaredDistance(at(i), at(from), at(to)) > squaredError) return false;
		}
		return true;
	}

	const std::vector<Point2d>& m_points;
	std::size_t m_first, m_last;
};

Ring Reduce(const Samples& samples, double error)
{
	Ring ring;
	for (std::size_t k = 0; k < samples.fixed.size(); ++k) {
		const std::size_t last = k + 1 < samples.fixed.size() ? samples.fixed[k + 1] : samples.points.size();
		for (const std::size_t i : Stretch(samples.points, samples.fixed[k], last).evenChords(error))
			ring.push_back(samples.points[i]);
	}
	return ring;
}

}  // namespace

double SamplesNeeded(const CurveContour& contour, double tolerance)
{
	double total = 0;
	for (const CurvePiece& piece : contour) total += ChordsNeeded(piece, kSampleShare * tolerance);
	return total;
}

Ring Flatten(const CurveContour& contour, double tolerance)
{
	const Samples raw = Sample(contour, tolerance);
	if (raw.points.size() < 3) return {};
	const Samples samples = Tidied(raw);
	if (samples.points.size() < 3) return {};
	// A dot smaller than the tolerance would shrink to a line: it gets what it needs to stay a dot.
	for (double error = (1 - kSampleShare) * tolerance; error > kSampleShare * tolerance; error /= 2) {
		Ring ring = Reduce(samples, error);
		if (ring.size() >= 3) return ring;
	}
	return samples.points;
}

Ring FlattenOpen(const CurveContour& curves, double tolerance)
{
	double total = 0;
	for (const CurvePiece& piece : curves) total += ChordsNeeded(piece, tolerance);
	if (!(total < static_cast<double>(kMostSamples)))
		throw TextError(TextErrorCode::BadTolerance, "too fine for this outline")
			.measured(tolerance, LeastTolerance(curves));
	Ring line;
	for (const CurvePiece& piece : curves) {
		const int count = static_cast<int>(ChordsNeeded(piece, tolerance));
		for (int i = 0; i < count; ++i) line.push_back(PointAt(piece, static_cast<double>(i) / count));
	}
	if (!curves.empty()) line.push_back(curves.back().end());
	return line;
}

double CheckedTolerance(double asked, double size, double fineness)
{
	if (asked == 0) return size / fineness;
	const double finest = kFinestTolerance * size, coarsest = kCoarsestTolerance * size;
	if (asked < finest) throw TextError(TextErrorCode::BadTolerance).measured(asked, finest);
	if (asked > coarsest) throw TextError(TextErrorCode::BadTolerance).measured(asked, coarsest);
	return asked;
}

}  // namespace textlabel
