#include "drawing_path.h"

#include <cmath>
#include "drawing_scan.h"

namespace textlabel {
namespace {

using vcg::Point2d;

constexpr double kPi = 3.14159265358979323846;
/// Longest piece of an arc that becomes one curve, radians.
constexpr double kArcPiece = kPi / 4;

/// An ellipse: its axes as vectors, so that the point at an angle is center + a cos + b sin.
struct Ellipse {
	Point2d center, a, b;

	Point2d at(double angle) const { return center + a * std::cos(angle) + b * std::sin(angle); }
	Point2d along(double angle) const { return b * std::cos(angle) - a * std::sin(angle); }
};

/// Curves over the angles from `first` on, from the point `p` there to the point `end`, exactly.
void AddArc(const Ellipse& ellipse, double first, double sweep, Point2d p, const Point2d& end, CurveContour& curves)
{
	constexpr double rounding = 1e-9;  // of a piece: four quarters are eight pieces
	const int count = std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / kArcPiece - rounding)));
	const double step = sweep / count, reach = 4.0 / 3 * std::tan(step / 4);
	for (int i = 0; i < count; ++i) {
		const double angle = first + i * step, next = first + (i + 1) * step;
		const Point2d q = i + 1 == count ? end : ellipse.at(next);
		curves.push_back(CurvePiece::Cubic(p, p + ellipse.along(angle) * reach, q - ellipse.along(next) * reach, q));
		p = q;
	}
}

/// An arc as a path gives it: by its ends.
struct EndpointArc {
	Point2d radii;
	double rotation = 0;  ///< radians
	bool isLarge = false, isPositive = false;
};

/// Source: SVG 1.1, F.6.5 and F.6.6
void AddArc(const Point2d& from, const EndpointArc& arc, const Point2d& to, CurveContour& curves)
{
	double rx = std::abs(arc.radii[0]), ry = std::abs(arc.radii[1]);
	if (from == to) return;
	if (!(rx > 0) || !(ry > 0)) {
		curves.push_back(CurvePiece::Line(from, to));
		return;
	}
	const double c = std::cos(arc.rotation), s = std::sin(arc.rotation);
	const Point2d half = (from - to) / 2, turned(c * half[0] + s * half[1], c * half[1] - s * half[0]);
	const double x = turned[0] / rx, y = turned[1] / ry, far = x * x + y * y;
	if (far > 1) {
		rx *= std::sqrt(far);
		ry *= std::sqrt(far);
	}
	const double off = far < 1 ? std::sqrt((1 - far) / far) * (arc.isLarge == arc.isPositive ? -1 : 1) : 0;
	const Point2d middle = (from + to) / 2, shift(off * rx * y, -off * ry * x);
	const Ellipse ellipse{middle + Point2d(c * shift[0] - s * shift[1], s * shift[0] + c * shift[1]),
	                      Point2d(c, s) * rx, Point2d(-s, c) * ry};
	const auto angleOf = [&](const Point2d& p) {
		const Point2d d = p - ellipse.center;
		return std::atan2((c * d[1] - s * d[0]) / ry, (c * d[0] + s * d[1]) / rx);
	};
	const double start = angleOf(from);
	double sweep = angleOf(to) - start;
	if (arc.isPositive && sweep < 0) sweep += 2 * kPi;
	if (!arc.isPositive && sweep > 0) sweep -= 2 * kPi;
	AddArc(ellipse, start, sweep, from, to, curves);
}

/// Follows the commands of a path.
class PathParser {
public:
	explicit PathParser(const std::string& data) : m_scanner(data) {}

	std::optional<std::vector<DrawnPath>> run()
	{
		char command = 0;
		while (!m_scanner.atEnd()) {
			if (Scanner::IsLetter(m_scanner.peek())) command = m_scanner.take();
			else if (command == 'M') command = 'L';  // further pairs are lines
			else if (command == 'm') command = 'l';
			else if (command == 0 || command == 'z' || command == 'Z') return std::nullopt;
			if (!m_hasStart && command != 'M' && command != 'm') return std::nullopt;
			if (!follow(command)) return std::nullopt;
		}
		finish(false);
		return std::move(m_paths);
	}

private:
	bool read(Point2d& p, bool isRelative)
	{
		const auto x = m_scanner.number();
		const auto y = x ? m_scanner.number() : std::nullopt;
		if (y) p = Point2d(*x, *y) + (isRelative ? m_at : Point2d(0, 0));
		return y.has_value();
	}
	bool readFlag(bool& flag)
	{
		const char c = m_scanner.take();
		flag = c == '1';
		return c == '0' || c == '1';
	}
	void add(const CurvePiece& piece)
	{
		m_curves.push_back(piece);
		m_at = piece.end();
	}
	/// Begin a path anew; what is open is kept.
	void moveTo(const Point2d& p)
	{
		finish(false);
		m_at = m_start = p;
		m_hasStart = true;
	}
	void finish(bool isClosed)
	{
		if (isClosed && (m_curves.empty() || m_at != m_start)) add(CurvePiece::Line(m_at, m_start));
		if (!m_curves.empty()) m_paths.push_back({std::move(m_curves), isClosed});
		m_curves.clear();
	}

	bool follow(char command)
	{
		const bool isRelative = command >= 'a';
		const char kind = static_cast<char>(isRelative ? command - 'a' + 'A' : command);
		Point2d to;
		const Point2d before = m_at;
		Point2d handle = before;  // where the next smooth curve mirrors from
		switch (kind) {
		case 'M':
			if (!read(to, isRelative)) return false;
			moveTo(to);
			break;
		case 'Z':
			finish(true);
			m_at = m_start;
			break;
		case 'L':
			if (!read(to, isRelative)) return false;
			add(CurvePiece::Line(before, to));
			break;
		case 'H':
		case 'V': {
			const auto value = m_scanner.number();
			if (!value) return false;
			const int axis = kind == 'H' ? 0 : 1;
			to = before;
			to[axis] = *value + (isRelative ? before[axis] : 0);
			add(CurvePiece::Line(before, to));
			break;
		}
		case 'C':
		case 'S': {
			Point2d first = m_lastKind == 'C' || m_lastKind == 'S' ? before * 2 - m_handle : before;
			if ((kind == 'C' && !read(first, isRelative)) || !read(handle, isRelative) || !read(to, isRelative))
				return false;
			add(CurvePiece::Cubic(before, first, handle, to));
			break;
		}
		case 'Q':
		case 'T':
			if (kind == 'T') handle = m_lastKind == 'Q' || m_lastKind == 'T' ? before * 2 - m_handle : before;
			if ((kind == 'Q' && !read(handle, isRelative)) || !read(to, isRelative)) return false;
			add(CurvePiece::Quadratic(before, handle, to));
			break;
		case 'A': {
			EndpointArc arc;
			const bool isRead = read(arc.radii, false) && readRotation(arc) && readFlag(arc.isLarge) &&
			                    readFlag(arc.isPositive) && read(to, isRelative);
			if (!isRead) return false;
			AddArc(before, arc, to, m_curves);
			m_at = to;
			break;
		}
		default: return false;
		}
		m_lastKind = kind;
		m_handle = handle;
		return true;
	}
	bool readRotation(EndpointArc& arc)
	{
		const auto degrees = m_scanner.number();
		if (degrees) arc.rotation = *degrees * kPi / 180;
		return degrees.has_value();
	}

	Scanner m_scanner;
	std::vector<DrawnPath> m_paths;
	CurveContour m_curves;
	Point2d m_start{0, 0}, m_at{0, 0}, m_handle{0, 0};
	char m_lastKind = 0;
	bool m_hasStart = false;
};

}  // namespace

std::optional<std::vector<DrawnPath>> ParsePath(const std::string& data) { return PathParser(data).run(); }

std::optional<std::vector<DrawnPath>> ParsePolyline(const std::string& points, bool isClosed)
{
	Scanner scanner(points);
	std::vector<Point2d> corners;
	while (!scanner.atEnd()) {
		const auto x = scanner.number();
		const auto y = x ? scanner.number() : std::nullopt;
		if (!y) return std::nullopt;
		corners.emplace_back(*x, *y);
	}
	if (corners.size() < 2) return std::vector<DrawnPath>{};
	DrawnPath path;
	path.isClosed = isClosed;
	for (std::size_t i = 1; i < corners.size(); ++i)
		path.curves.push_back(CurvePiece::Line(corners[i - 1], corners[i]));
	if (isClosed) path.curves.push_back(CurvePiece::Line(corners.back(), corners.front()));
	return std::vector<DrawnPath>{std::move(path)};
}

DrawnPath RectanglePath(const Point2d& low, const Point2d& size, Point2d radii)
{
	for (int axis = 0; axis < 2; ++axis) radii[axis] = std::min(radii[axis], size[axis] / 2);
	const Point2d high = low + size;
	DrawnPath path;
	path.isClosed = true;
	const bool isRound = radii[0] > 0 && radii[1] > 0;
	if (!isRound) radii = {0, 0};
	const Point2d corners[4] = {{high[0], low[1]}, high, {low[0], high[1]}, low};
	Point2d at(low[0] + radii[0], low[1]);
	const Point2d start = at;
	for (int i = 0; i < 4; ++i) {
		const double x = corners[i][0] == high[0] ? -radii[0] : radii[0],
					 y = corners[i][1] == high[1] ? -radii[1] : radii[1];
		const Point2d alongX = corners[i] + Point2d(x, 0), alongY = corners[i] + Point2d(0, y);
		const Point2d &before = i % 2 == 0 ? alongX : alongY, &after = i % 2 == 0 ? alongY : alongX;
		if (at != before) path.curves.push_back(CurvePiece::Line(at, before));
		at = i == 3 ? start : after;
		if (!isRound) continue;
		const Point2d center = corners[i] + Point2d(x, y);
		AddArc({center, {radii[0], 0}, {0, radii[1]}}, (i - 1) * kPi / 2, kPi / 2, before, at, path.curves);
	}
	return path;
}

DrawnPath EllipsePath(const Point2d& center, const Point2d& radii)
{
	DrawnPath path;
	path.isClosed = true;
	const Point2d start = center + Point2d(radii[0], 0);
	AddArc({center, {radii[0], 0}, {0, radii[1]}}, 0, 2 * kPi, start, start, path.curves);
	return path;
}

}  // namespace textlabel
