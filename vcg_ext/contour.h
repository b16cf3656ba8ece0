#pragma once
// Contours: what the text is to the library.
//
// A label is a set of closed polylines in the label plane, oriented so that the region outside the letter lies to the right of
// the contour (paper, figure 3): outer contours counter-clockwise, holes clockwise. A *part* is one outer contour with the holes
// directly in it; an island in a hole is a part of its own, and so is the dot of an i.

#include <vector>
#include <vcg/space/point2.h>

namespace vcg::textlabel {

/// One closed polyline in the label plane; the last point is joined to the first.
struct Contour {
	std::vector<vcg::Point2d> points;  ///< #P by 2, label units, u to the right, v up; no point repeated
	int part = 0;                      ///< which part of the label: an outer contour and its holes share it
	int letter = 0;                    ///< which letter of the text it came from (index of the cluster), for messages
};

/// The silhouette of a whole label: simple, pairwise disjoint, correctly nested contours.
struct Outline {
	std::vector<Contour> contours;
	int partCount = 0;  ///< parts are numbered 0 .. partCount-1
};

/// Twice the signed area of a closed polyline; positive when counter-clockwise.
inline double TwiceSignedArea(const std::vector<vcg::Point2d>& p)
{
	double sum = 0;
	for (size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
		sum += (p[j][0] - p[0][0]) * (p[i][1] - p[0][1]) - (p[i][0] - p[0][0]) * (p[j][1] - p[0][1]);
	return sum;
}

/// Area of the letters in label units squared: holes count negative by their orientation.
inline double Area(const Outline& outline)
{
	double sum = 0;
	for (const Contour& c : outline.contours) sum += TwiceSignedArea(c.points);
	return sum / 2;
}

}  // namespace vcg::textlabel
