#pragma once
// What the tests of the text side share: a judge of outlines that knows nothing of how they are made, and the cases of
// tests/corpus/text/*.rings.
//
//   # a comment
//   tolerance T           chord error given to the union; default 0.1
//   contours N            what is expected of the outline, if it is given
//   parts N
//   area A [SLACK]        and its area, within SLACK; default 1e-9 of it
//   exact                 these numbers hold only where the coordinates are exact: turned, the case is another one
//   ring X Y X Y ...      a closed polyline; all rings are one letter, by the non-zero rule
//   letter                the rings that follow belong to another letter
//
// A test that fails writes its case in this form and as a picture; saved in the folder it is a test of its own.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>
#include "outline_unite.h"
#include "svg.h"
#include "vcg_ext/contour.h"
#include "vcg_ext/predicates.h"

#if defined(__SANITIZE_ADDRESS__)
/// Fontconfig 2.14 leaks 288 bytes when it reads its configuration, once in a process.
extern "C" __attribute__((used, weak)) const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace text_support {

using textlabel::LetterRings;
using textlabel::Ring;
using vcg::Point2d;
using vcg::textlabel::Contour;
using vcg::textlabel::Orient2d;
using vcg::textlabel::Outline;

struct Side {
	Point2d a, b;
	std::size_t contour, index;
};

inline bool IsBetween(const Point2d& q, const Point2d& a, const Point2d& b)
{
	return std::min(a[0], b[0]) <= q[0] && q[0] <= std::max(a[0], b[0]) && std::min(a[1], b[1]) <= q[1] &&
	       q[1] <= std::max(a[1], b[1]);
}

/// Do two closed segments have a point in common? By exact predicates.
inline bool Meet(const Side& s, const Side& t)
{
	const int ta = Orient2d(s.a, s.b, t.a), tb = Orient2d(s.a, s.b, t.b);
	const int sa = Orient2d(t.a, t.b, s.a), sb = Orient2d(t.a, t.b, s.b);
	if (ta * tb < 0 && sa * sb < 0) return true;
	return (ta == 0 && IsBetween(t.a, s.a, s.b)) || (tb == 0 && IsBetween(t.b, s.a, s.b)) ||
	       (sa == 0 && IsBetween(s.a, t.a, t.b)) || (sb == 0 && IsBetween(s.b, t.a, t.b));
}

/// How often a ray to the right of q crosses a contour, by exact predicates: odd = inside.
inline bool IsInside(const Point2d& q, const std::vector<Point2d>& ring)
{
	bool inside = false;
	for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
		if ((ring[i][1] > q[1]) == (ring[j][1] > q[1])) continue;
		const int side = Orient2d(ring[j], ring[i], q);
		inside ^= ring[i][1] > ring[j][1] ? side > 0 : side < 0;
	}
	return inside;
}

/// Pairs of sides that meet without being neighbours, by a sweep along x.
inline std::string FlawOfSides(const Outline& outline)
{
	std::vector<Side> sides;
	for (std::size_t c = 0; c < outline.contours.size(); ++c) {
		const auto& p = outline.contours[c].points;
		for (std::size_t i = 0; i < p.size(); ++i) sides.push_back({p[i], p[(i + 1) % p.size()], c, i});
	}
	const auto left = [](const Side& s) { return std::min(s.a[0], s.b[0]); };
	std::sort(sides.begin(), sides.end(), [&](const Side& s, const Side& t) { return left(s) < left(t); });
	std::vector<const Side*> active;
	for (const Side& s : sides) {
		const auto isPast = [&](const Side* t) { return std::max(t->a[0], t->b[0]) < left(s); };
		active.erase(std::remove_if(active.begin(), active.end(), isPast), active.end());
		for (const Side* t : active) {
			const std::size_t n = outline.contours[s.contour].points.size();
			const bool neighbours =
				s.contour == t->contour && ((s.index + 1) % n == t->index || (t->index + 1) % n == s.index);
			if (!neighbours && Meet(s, *t))
				return "contours " + std::to_string(s.contour) + " and " + std::to_string(t->contour) + " meet";
		}
		active.push_back(&s);
	}
	return {};
}

inline std::string FlawOfNesting(const Outline& outline)
{
	const auto& contours = outline.contours;
	std::map<int, int> outers;
	for (std::size_t c = 0; c < contours.size(); ++c) {
		int depth = 0, parent = -1;
		double parentArea = 0;
		for (std::size_t o = 0; o < contours.size(); ++o) {
			if (o == c || !IsInside(contours[c].points[0], contours[o].points)) continue;
			const double area = std::abs(vcg::textlabel::TwiceSignedArea(contours[o].points));
			++depth;
			if (parent < 0 || area < parentArea) parent = static_cast<int>(o), parentArea = area;
		}
		const bool isHole = depth % 2 == 1;
		const std::string name = "contour " + std::to_string(c);
		if ((vcg::textlabel::TwiceSignedArea(contours[c].points) > 0) == isHole) return name + " is turned wrong";
		if (contours[c].part < 0 || contours[c].part >= outline.partCount) return name + " has no part";
		if (!isHole && ++outers[contours[c].part] > 1) return name + " shares the part of another outer contour";
		if (isHole && contours[c].part != contours[static_cast<std::size_t>(parent)].part)
			return name + " is not of the part around it";
	}
	return static_cast<int>(outers.size()) == outline.partCount ? "" : "parts without an outer contour";
}

/// What is wrong with an outline, or nothing: points, simplicity, distance, nesting, orientation, parts.
inline std::string FlawOf(const Outline& outline)
{
	for (const Contour& contour : outline.contours) {
		const auto& p = contour.points;
		if (p.size() < 3) return "a contour of less than three points";
		for (std::size_t i = 0; i < p.size(); ++i) {
			if (!std::isfinite(p[i][0]) || !std::isfinite(p[i][1])) return "a point that is not finite";
			if (Orient2d(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) == 0)
				return "a repeated or redundant point";
		}
	}
	const std::string flaw = FlawOfSides(outline);
	return flaw.empty() ? FlawOfNesting(outline) : flaw;
}

struct RingCase {
	double tolerance = 0.1;
	int contours = -1, parts = -1;
	double area = -1, slack = 0;
	bool exact = false;
	std::vector<LetterRings> letters{{0, {}}};
};

inline RingCase ReadRingCase(const std::string& file)
{
	std::ifstream stream(file);
	if (!stream) throw std::runtime_error("cannot read " + file);
	RingCase result;
	for (std::string line; std::getline(stream, line);) {
		std::istringstream words(line.substr(0, line.find('#')));
		std::string word;
		if (!(words >> word)) continue;
		if (word == "tolerance") words >> result.tolerance;
		if (word == "contours") words >> result.contours;
		if (word == "parts") words >> result.parts;
		if (word == "area" && words >> result.area && !(words >> result.slack)) result.slack = 1e-9 * result.area;
		if (word == "exact") result.exact = true;
		if (word == "letter") result.letters.push_back({static_cast<int>(result.letters.size()), {}});
		if (word == "ring") {
			Ring ring;
			for (double x = 0, y = 0; words >> x >> y;) ring.push_back({x, y});
			result.letters.back().rings.push_back(ring);
		}
	}
	return result;
}

/// Write rings as a case and as a picture. @return what to say about it
inline std::string Saved(const std::vector<LetterRings>& letters, double tolerance, const std::string& name)
{
	std::ofstream file(name + ".rings");
	file.precision(17);
	file << "tolerance " << tolerance << '\n';
	svg::Picture picture;
	for (const LetterRings& letter : letters) {
		if (letter.letter > 0) file << "letter\n";
		for (const Ring& ring : letter.rings) {
			file << "ring";
			for (const Point2d& p : ring) file << ' ' << p[0] << ' ' << p[1];
			file << '\n';
			picture.line(ring, "black", true);
		}
	}
	picture.write(name + ".svg");
	return "see " + name + ".rings and " + name + ".svg";
}

}  // namespace text_support
