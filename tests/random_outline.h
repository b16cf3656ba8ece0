#pragma once
// Random outlines for the fuzzers: simple, disjoint, nested contours as the library asks for, of about unit size.

#include "random_source.h"
#include "vcg_ext/contour.h"

#include <algorithm>
#include <cmath>

namespace vcg::textlabel::test {

using Ring = std::vector<vcg::Point2d>;

inline void AddPart(Outline& o, Ring outer, std::vector<Ring> holes = {}, int letter = 0)
{
	const int part = o.partCount++;
	if (TwiceSignedArea(outer) < 0) std::reverse(outer.begin(), outer.end());
	o.contours.push_back({std::move(outer), part, letter});
	for (Ring& hole : holes) {
		if (TwiceSignedArea(hole) > 0) std::reverse(hole.begin(), hole.end());
		o.contours.push_back({std::move(hole), part, letter});
	}
}

inline Ring Circle(double x, double y, double radius, int points, double turn = 0)
{
	Ring r;
	for (int i = 0; i < points; ++i) {
		const double angle = turn + 2 * M_PI * i / points;
		r.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
	}
	return r;
}

inline Ring Rectangle(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// Letters of straight stems on a grid of 4 by 6 units, a stem is one unit wide.
inline void AddBlockLetter(Outline& o, char c, double x, int letter)
{
	const auto at = [x](Ring r) {
		for (vcg::Point2d& p : r) p[0] += x;
		return r;
	};
	switch (c) {
	case 'L': return AddPart(o, at({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 6}, {0, 6}}), {}, letter);
	case 'T':
		return AddPart(o, at({{1.5, 0}, {2.5, 0}, {2.5, 5}, {4, 5}, {4, 6}, {0, 6}, {0, 5}, {1.5, 5}}), {}, letter);
	case 'E':
		return AddPart(o,
		               at({{0, 0},
		                   {4, 0},
		                   {4, 1},
		                   {1, 1},
		                   {1, 2.5},
		                   {3, 2.5},
		                   {3, 3.5},
		                   {1, 3.5},
		                   {1, 5},
		                   {4, 5},
		                   {4, 6},
		                   {0, 6}}),
		               {}, letter);
	case 'H':
		return AddPart(o,
		               at({{0, 0},
		                   {1, 0},
		                   {1, 2.5},
		                   {3, 2.5},
		                   {3, 0},
		                   {4, 0},
		                   {4, 6},
		                   {3, 6},
		                   {3, 3.5},
		                   {1, 3.5},
		                   {1, 6},
		                   {0, 6}}),
		               {}, letter);
	case 'O': return AddPart(o, at(Rectangle(0, 0, 4, 6)), {at(Rectangle(1, 1, 3, 5))}, letter);
	case '8':
		return AddPart(o, at(Rectangle(0, 0, 4, 6)), {at(Rectangle(1, 1, 3, 2.5)), at(Rectangle(1, 3.5, 3, 5))},
		               letter);
	case 'A':
		return AddPart(o, at({{0, 0}, {1, 0}, {1.4, 1.5}, {2.6, 1.5}, {3, 0}, {4, 0}, {2.5, 6}, {1.5, 6}}),
		               {at({{1.6, 2.5}, {2.4, 2.5}, {2, 4.5}})}, letter);
	case 'R':  // an island in a hole
		AddPart(o, at(Rectangle(0, 0, 5, 6)), {at(Rectangle(1, 1, 4, 5))}, letter);
		return AddPart(o, at(Rectangle(2, 2, 3, 4)), {}, letter);
	case 'i':
		AddPart(o, at(Rectangle(1, 0, 2, 4)), {}, letter);
		return AddPart(o, at(Rectangle(1, 5, 2, 6)), {}, letter);
	default: return AddPart(o, at(Rectangle(1, 0, 2, 6)), {}, letter);
	}
}

inline Outline MakeBlockText(Random& random)
{
	Outline o;
	const int count = random.integer(1, 4);
	for (int i = 0; i < count; ++i)
		AddBlockLetter(o, random.pick({'L', 'T', 'E', 'H', 'O', '8', 'A', 'R', 'i', 'I'}), i * 6.0, i);
	return o;
}

/// A star-shaped polygon with random radii.
inline Ring RandomStar(Random& random, int points, double least)
{
	Ring r;
	for (int i = 0; i < points; ++i) {
		const double angle = 2 * M_PI * (i + random.real(0, 0.8)) / points, radius = random.real(least, 1);
		r.push_back({radius * std::cos(angle), radius * std::sin(angle)});
	}
	return r;
}

/// Teeth: many contour pieces side by side, as fine as they are many.
inline Ring Comb(int teeth)
{
	Ring r = {{0, 0}, {2.0 * teeth, 0}};
	for (int i = teeth; i-- > 0;) {
		const double x = 2.0 * i;
		r.insert(r.end(), {{x + 1.5, 4}, {x + 0.5, 4}, {x + 0.5, 1}, {x, 1}});
	}
	r.erase(r.begin() + 1);
	r.insert(r.begin() + 1, {2.0 * teeth - 0.5, 0});
	return r;
}

/// Rings in rings, alternately outer contours and holes.
inline Outline MakeNested(Random& random)
{
	Outline o;
	const int depth = random.integer(1, 3), points = random.integer(3, 40);
	for (int i = 0; i < depth; ++i) {
		const double r = 1 - double(i) / depth, step = 1.0 / depth;
		std::vector<Ring> holes;
		if (i + 1 < depth || random.chance(0.7)) holes.push_back(Circle(0, 0, r - step / 2, points + 2));
		const double apothem = std::cos(M_PI / (points + 2));
		if (r * apothem <= r - step / 2) holes.clear();
		AddPart(o, Circle(0, 0, r, points + 2), holes, i);
		if (holes.empty() || (r - step / 2) * apothem <= r - step) break;
	}
	return o;
}

/// Scale and shift an outline so that its box's longer side is 2 and its centre the origin.
inline void Normalize(Outline& o)
{
	vcg::Point2d low(1e300, 1e300), high(-1e300, -1e300);
	for (const Contour& c : o.contours)
		for (const vcg::Point2d& p : c.points)
			for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
	const vcg::Point2d middle = (low + high) / 2;
	const double scale = 2 / std::max(high[0] - low[0], high[1] - low[1]);
	for (Contour& c : o.contours)
		for (vcg::Point2d& p : c.points) p = (p - middle) * scale;
}

inline Outline MakeOutline(Random& random)
{
	Outline o;
	switch (random.below(8)) {
	case 0:
	case 1:
	case 2: o = MakeBlockText(random); break;
	case 3: AddPart(o, RandomStar(random, random.integer(3, 30), 0.2)); break;
	case 4: AddPart(o, Circle(0, 0, 1, random.integer(3, random.chance(0.1) ? 1000 : 60), random.real(0, 1))); break;
	case 5: o = MakeNested(random); break;
	case 6: AddPart(o, Comb(random.integer(1, 12))); break;
	default:
		AddPart(o, RandomStar(random, random.integer(8, 20), 0.7),
		        {Circle(0, 0, 0.4, random.integer(3, 12), random.real(0, 1))});
		if (random.chance(0.5)) AddPart(o, Circle(0, 0, 0.15, random.integer(3, 12)), {}, 1);
	}
	Normalize(o);
	if (random.chance(0.3))  // start elsewhere
		for (Contour& c : o.contours)
			std::rotate(c.points.begin(), c.points.begin() + random.below(int(c.points.size())), c.points.end());
	return o;
}

}  // namespace vcg::textlabel::test
