#pragma once
// Cases of the contour walk as text: tests/corpus/walk/*.walk.
//
//   # a comment                   from a # to the end of the line
//   border X Y                    a point of the triangle's border: corners and points of its edges, counter-clockwise from a corner
//   chain I X Y ... J             a contour piece from border point I (counted from 0) through inner points to border point J;
//                                 the inside of the letter lies on its left
//   loop X Y X Y X Y ...          a contour that lies wholly within the triangle
//   inside AREA CORNERS [HOLES]   a region that is expected: its area, the number of corners of all its rings, its holes (0)
//   outside AREA CORNERS [HOLES]
//   untouched AREA CORNERS        the region of a triangle in which no contour piece lies
//   conflict                      the walk must refuse the case
//
// A test that fails prints its case in this form; saved as a file here, it is a test of its own.

#include <array>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "svg.h"
#include "vcg_ext/triangle_walk.h"

namespace walk_case {

using vcg::Point2d;
using vcg::textlabel::PolylineSet;
using vcg::textlabel::RegionSet;
using vcg::textlabel::Side;
using vcg::textlabel::TriangleCase;

struct ExpectedRegion {
	Side side;
	double area;
	int corners;
	int holes;
};

struct Chain {
	int from, to;  ///< border points
	std::vector<Point2d> inner;
};

struct WalkCase {
	std::string name;
	std::vector<Point2d> border;
	std::vector<Chain> chains;
	std::vector<std::vector<Point2d>> loops;
	std::vector<ExpectedRegion> expected;
	bool conflict = false;
};

/// Read a case.
/// @throws std::invalid_argument with the number of the line
WalkCase FromText(const std::string& text, const std::string& name = {});
/// The case in the form that FromText reads; numbers keep every bit.
std::string ToText(const WalkCase& c);
/// A picture: inside regions blue, outside ones grey, contours red, border points numbered.
void WriteSvg(const WalkCase& c, const RegionSet& regions, const std::string& file);

TriangleCase ToTriangle(const WalkCase& c);
/// What the walk was given, as a case without expectations.
WalkCase FromTriangle(const TriangleCase& t, const std::string& name = {});

// The same case seen in another way; the expectations go with it.

/// The border counted from another of its points.
WalkCase Turned(WalkCase c, int first);
/// Left and right swapped, contours still with the inside on their left.
WalkCase Mirrored(WalkCase c);
/// Every contour turned round: what was inside is outside.
WalkCase SidesSwapped(WalkCase c);
/// A point more in the middle of each border piece.
WalkCase BorderRefined(const WalkCase& c);

// ---------------------------------------------------------------------------------------------------------------------------

inline const char* SideName(Side side)
{
	return side == Side::Inside ? "inside" : side == Side::Outside ? "outside" : "untouched";
}

namespace detail {

/// The numbers of a line, one after the other.
class LineReader {
public:
	LineReader(const std::string& line, int number) : in_(line.substr(0, line.find('#'))), number_(number) {}

	std::string word()
	{
		std::string w;
		in_ >> w;
		return w;
	}
	bool atEnd() { return (in_ >> std::ws).eof(); }
	double real()
	{
		const std::string w = word();
		try {
			size_t used = 0;
			const double x = std::stod(w, &used);
			if (used == w.size() && std::isfinite(x)) return x;
		} catch (const std::exception&) {  // no number, or none that a double holds
		}
		fail("a number is expected, not '" + w + "'");
	}
	int index(int limit)
	{
		const double x = real();
		if (!(x >= 0 && x < limit) || x != std::floor(x)) fail("no such number of a point");
		return int(x);
	}
	Point2d point()
	{
		const double x = real();
		return {x, real()};
	}
	[[noreturn]] void fail(const std::string& why) const
	{
		throw std::invalid_argument("line " + std::to_string(number_) + ": " + why);
	}

private:
	std::istringstream in_;
	int number_;
};

inline ExpectedRegion ReadRegion(LineReader& line, Side side)
{
	constexpr int most = 1 << 24;  // corners
	ExpectedRegion r{side, line.real(), line.index(most), 0};
	if (!line.atEnd()) r.holes = line.index(most);
	return r;
}

/// Pairs of numbers up to the end of the line, or up to a last single one, which is `to`.
inline std::vector<Point2d> ReadPoints(LineReader& line, double* to)
{
	std::vector<Point2d> points;
	while (!line.atEnd()) {
		const double x = line.real();
		if (to != nullptr && line.atEnd()) {
			*to = x;
			return points;
		}
		points.emplace_back(x, line.real());
	}
	if (to != nullptr) line.fail("a chain ends with the number of a border point");
	return points;
}

inline void ReadLine(LineReader& line, WalkCase& c)
{
	const std::string word = line.word();
	if (word == "border") {
		c.border.push_back(line.point());
	} else if (word == "chain") {
		constexpr int most = 1 << 24;  // border points
		double to = 0;
		const int from = line.index(most);
		std::vector<Point2d> inner = ReadPoints(line, &to);
		if (!(to >= 0 && to < most) || to != std::floor(to)) line.fail("no such number of a point");
		c.chains.push_back({from, int(to), std::move(inner)});
	} else if (word == "loop") {
		c.loops.push_back(ReadPoints(line, nullptr));
		if (c.loops.back().size() < 3) line.fail("a loop has three points or more");
	} else if (word == "inside" || word == "outside" || word == "untouched") {
		const Side side = word == "inside" ? Side::Inside : word == "outside" ? Side::Outside : Side::Unknown;
		c.expected.push_back(ReadRegion(line, side));
	} else if (word == "conflict") {
		c.conflict = true;
	} else if (!word.empty()) {
		line.fail("unknown word '" + word + "'");
	}
	if (!line.atEnd()) line.fail("more numbers than expected");
}

inline void Put(std::ostream& out, const std::vector<Point2d>& points)
{
	for (const Point2d& p : points) out << ' ' << p[0] << ' ' << p[1];
}

inline std::vector<Point2d> PointsOf(const TriangleCase& t, const int* begin, const int* end)
{
	std::vector<Point2d> points;
	for (const int* i = begin; i < end; ++i) points.push_back(t.points[size_t(*i)]);
	return points;
}

}  // namespace detail

inline WalkCase FromText(const std::string& text, const std::string& name)
{
	WalkCase c;
	c.name = name;
	std::istringstream in(text);
	int number = 0;
	for (std::string line; std::getline(in, line);) {
		detail::LineReader reader(line, ++number);
		detail::ReadLine(reader, c);
	}
	const int n = int(c.border.size());
	if (n < 3) throw std::invalid_argument("fewer than three border points");
	for (const Chain& chain : c.chains)
		if (chain.from >= n || chain.to >= n) throw std::invalid_argument("a chain ends in no border point");
	return c;
}

inline std::string ToText(const WalkCase& c)
{
	std::ostringstream out;
	out.precision(std::numeric_limits<double>::max_digits10);
	if (!c.name.empty()) out << "# " << c.name << '\n';
	for (const Point2d& p : c.border) out << "border " << p[0] << ' ' << p[1] << '\n';
	for (const Chain& chain : c.chains) {
		out << "chain " << chain.from;
		detail::Put(out, chain.inner);
		out << ' ' << chain.to << '\n';
	}
	for (const std::vector<Point2d>& loop : c.loops) {
		out << "loop";
		detail::Put(out, loop);
		out << '\n';
	}
	for (const ExpectedRegion& r : c.expected)
		out << SideName(r.side) << ' ' << r.area << ' ' << r.corners << ' ' << r.holes << '\n';
	if (c.conflict) out << "conflict\n";
	return out.str();
}

inline TriangleCase ToTriangle(const WalkCase& c)
{
	TriangleCase t;
	t.points = c.border;
	t.borderCount = int(c.border.size());
	const auto addInner = [&](PolylineSet& lines, const std::vector<Point2d>& points) {
		for (const Point2d& p : points) {
			lines.add(int(t.points.size()));
			t.points.push_back(p);
		}
	};
	for (const Chain& chain : c.chains) {
		t.chains.add(chain.from);
		addInner(t.chains, chain.inner);
		t.chains.add(chain.to);
		t.chains.close();
	}
	for (const std::vector<Point2d>& loop : c.loops) {
		addInner(t.loops, loop);
		t.loops.close();
	}
	return t;
}

inline WalkCase FromTriangle(const TriangleCase& t, const std::string& name)
{
	WalkCase c;
	c.name = name;
	c.border.assign(t.points.begin(), t.points.begin() + t.borderCount);
	for (int i = 0; i < t.chains.size(); ++i) {
		const int *begin = t.chains.begin(i), *last = t.chains.end(i) - 1;
		c.chains.push_back({*begin, *last, detail::PointsOf(t, begin + 1, last)});
	}
	for (int i = 0; i < t.loops.size(); ++i) c.loops.push_back(detail::PointsOf(t, t.loops.begin(i), t.loops.end(i)));
	return c;
}

inline void WriteSvg(const WalkCase& c, const RegionSet& regions, const std::string& file)
{
	const TriangleCase t = ToTriangle(c);
	svg::Picture picture;
	for (const RegionSet::Region& r : regions.regions) {
		std::vector<std::vector<Point2d>> rings;
		for (int i = r.firstRing; i < r.firstRing + r.ringCount; ++i)
			rings.push_back(detail::PointsOf(t, regions.rings.begin(i), regions.rings.end(i)));
		picture.fill(rings, r.side == Side::Inside ? "#a0c0ff" : "#d8d8d8");
	}
	picture.line(c.border, "black", true);
	for (size_t i = 0; i < c.border.size(); ++i) picture.label(c.border[i], std::to_string(i));
	for (int i = 0; i < t.chains.size(); ++i)
		picture.line(detail::PointsOf(t, t.chains.begin(i), t.chains.end(i)), "red");
	for (const std::vector<Point2d>& loop : c.loops) picture.line(loop, "red", true);
	picture.write(file);
}

inline WalkCase Turned(WalkCase c, int first)
{
	const int n = int(c.border.size());
	std::rotate(c.border.begin(), c.border.begin() + first, c.border.end());
	for (Chain& chain : c.chains)
		for (int* end : {&chain.from, &chain.to}) *end = (*end + n - first) % n;
	return c;
}

inline WalkCase SidesSwapped(WalkCase c)
{
	for (Chain& chain : c.chains) {
		std::swap(chain.from, chain.to);
		std::reverse(chain.inner.begin(), chain.inner.end());
	}
	for (std::vector<Point2d>& loop : c.loops) std::reverse(loop.begin(), loop.end());
	for (ExpectedRegion& r : c.expected) r.side = Side(-int(r.side));
	return c;
}

inline WalkCase Mirrored(WalkCase c)
{
	const auto mirror = [](std::vector<Point2d>& points) {
		for (Point2d& p : points) p[0] = -p[0];
	};
	const int n = int(c.border.size());
	mirror(c.border);
	std::reverse(c.border.begin(), c.border.end());
	for (Chain& chain : c.chains) {
		mirror(chain.inner);
		chain.from = n - 1 - chain.from;
		chain.to = n - 1 - chain.to;
	}
	for (std::vector<Point2d>& loop : c.loops) mirror(loop);
	WalkCase swapped = SidesSwapped(c);  // the mirror alone would leave the inside on the right
	swapped.expected = c.expected;
	return swapped;
}

inline WalkCase BorderRefined(const WalkCase& c)
{
	WalkCase fine = c;
	fine.border.clear();
	const size_t n = c.border.size();
	for (size_t i = 0; i < n; ++i) {
		fine.border.push_back(c.border[i]);
		fine.border.push_back((c.border[i] + c.border[(i + 1) % n]) / 2);
	}
	for (Chain& chain : fine.chains)
		for (int* end : {&chain.from, &chain.to}) *end *= 2;
	return fine;
}

}  // namespace walk_case
