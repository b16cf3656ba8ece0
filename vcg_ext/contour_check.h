#pragma once
// Whether an outline keeps the promises of contour.h.
//
// The text side keeps them by construction; a host that brings its own outlines may not. A wrong outline can't make a wrong mesh
// (the cut checks areas and sides), but what it runs into says nothing about it. So when a label is refused, this is asked first.

#include "contour.h"
#include "label_error.h"
#include "plane_box.h"
#include "predicates.h"

#include <algorithm>

namespace vcg::textlabel {

/// @throws Error{BadContour} with the letter: contours that meet, or are oriented against their nesting
void RequireGoodOutline(const Outline& outline);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

struct OutlineSegment {
	vcg::Point2d a, b;
	int contour, index;  ///< piece `index` of a contour, from point index to the next

	double low() const { return std::min(a[0], b[0]); }
	double high() const { return std::max(a[0], b[0]); }
};

inline std::vector<OutlineSegment> SegmentsOf(const Outline& outline)
{
	std::vector<OutlineSegment> segments;
	for (size_t c = 0; c < outline.contours.size(); ++c) {
		const auto& p = outline.contours[c].points;
		for (size_t i = 0; i < p.size(); ++i) segments.push_back({p[i], p[(i + 1) % p.size()], int(c), int(i)});
	}
	std::sort(segments.begin(), segments.end(),
	          [](const OutlineSegment& x, const OutlineSegment& y) { return x.low() < y.low(); });
	return segments;
}

/// Whether closed segments have a common point (exact).
inline bool DoMeet(const OutlineSegment& s, const OutlineSegment& t)
{
	const auto within = [](const OutlineSegment& r, const vcg::Point2d& p) {
		return p[0] >= r.low() && p[0] <= r.high() && p[1] >= std::min(r.a[1], r.b[1]) &&
		       p[1] <= std::max(r.a[1], r.b[1]);
	};
	const int a = Orient2d(s.a, s.b, t.a), b = Orient2d(s.a, s.b, t.b), c = Orient2d(t.a, t.b, s.a),
			  d = Orient2d(t.a, t.b, s.b);
	if (a * b < 0 && c * d < 0) return true;
	return (a == 0 && within(s, t.a)) || (b == 0 && within(s, t.b)) || (c == 0 && within(t, s.a)) ||
	       (d == 0 && within(t, s.b));
}

/// Whether two pieces may share an end because they follow one another.
inline bool AreNeighbours(const Outline& outline, const OutlineSegment& s, const OutlineSegment& t)
{
	const int n = int(outline.contours[size_t(s.contour)].points.size());
	return s.contour == t.contour && ((s.index + 1) % n == t.index || (t.index + 1) % n == s.index);
}

inline std::vector<PlaneBox> BoxesOfContours(const Outline& outline)
{
	std::vector<PlaneBox> boxes(outline.contours.size());
	for (size_t c = 0; c < boxes.size(); ++c)
		for (const vcg::Point2d& p : outline.contours[c].points) boxes[c].add(p);
	return boxes;
}

/// How often the other contours go round a point (exact).
inline int WindingAround(const Outline& outline, const std::vector<PlaneBox>& boxes, size_t except,
                         const vcg::Point2d& p)
{
	int winding = 0;
	for (size_t c = 0; c < outline.contours.size(); ++c) {
		if (c == except || !boxes[c].holds(p)) continue;
		const auto& q = outline.contours[c].points;
		for (size_t i = 0, j = q.size() - 1; i < q.size(); j = i++) {
			if ((q[j][1] > p[1]) == (q[i][1] > p[1])) continue;
			const bool up = q[i][1] > q[j][1];
			if ((Orient2d(q[j], q[i], p) > 0) == up) winding += up ? 1 : -1;
		}
	}
	return winding;
}

}  // namespace detail

inline void RequireGoodOutline(const Outline& outline)
{
	const auto refuse = [&](int contour, const char* why) {
		throw Error(ErrorCode::BadContour, why).atLetter(outline.contours[size_t(contour)].letter);
	};
	const std::vector<PlaneBox> boxes = detail::BoxesOfContours(outline);
	for (size_t c = 0; c < outline.contours.size(); ++c) {
		const auto& points = outline.contours[c].points;
		const double area = TwiceSignedArea(points);
		const int around = detail::WindingAround(outline, boxes, c, points[0]);
		if (!(area != 0) || around != (area > 0 ? 0 : 1)) refuse(int(c), "a contour is oriented against its nesting");
	}
	const std::vector<detail::OutlineSegment> segments = detail::SegmentsOf(outline);
	for (size_t i = 0; i < segments.size(); ++i)
		for (size_t j = i + 1; j < segments.size() && segments[j].low() <= segments[i].high(); ++j)
			if (!detail::AreNeighbours(outline, segments[i], segments[j]) && detail::DoMeet(segments[i], segments[j]))
				refuse(segments[j].contour, "two pieces of contours meet");
}

}  // namespace vcg::textlabel
