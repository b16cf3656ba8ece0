#pragma once
// Makes a failing case small: drops contours, points and faces as long as the same class of fault comes out.
//
// Source: A. Zeller, R. Hildebrandt, "Simplifying and Isolating Failure-Inducing Input", 2002 (delta debugging),
// greedy.

#include "label_case.h"

#include <functional>

namespace vcg::textlabel::test {

/// Whether a case still fails in the way that is looked for.
using StillFails = std::function<bool(const LabelCase&)>;

/// @param[in] keepMesh  leave the faces alone: a refusal on a mesh with holes would be none
/// @return the smallest case found that still fails
LabelCase Reduce(LabelCase c, const StillFails& fails, bool keepMesh);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Leave out ever smaller runs of `count` items.
/// @param[in] without  (case, first, last) to the case without these items
/// @return whether anything could go
template <class Count, class Without>
bool DropRuns(LabelCase& c, const StillFails& fails, const Count& count, const Without& without)
{
	bool dropped = false;
	for (size_t run = std::max<size_t>(count(c) / 2, 1); run > 0; run /= 2)
		for (size_t first = 0; first < count(c);) {
			const LabelCase smaller = without(c, first, std::min(first + run, count(c)));
			if (fails(smaller)) {
				c = smaller;
				dropped = true;
			} else {
				first += run;
			}
		}
	return dropped;
}

inline LabelCase WithoutFaces(LabelCase c, size_t first, size_t last)
{
	c.mesh.faces.erase(c.mesh.faces.begin() + std::ptrdiff_t(first), c.mesh.faces.begin() + std::ptrdiff_t(last));
	return c;
}

/// Without whole parts: outer contour and holes together.
inline LabelCase WithoutParts(LabelCase c, size_t first, size_t last)
{
	auto& all = c.outline.contours;
	all.erase(std::remove_if(all.begin(), all.end(),
	                         [&](const Contour& k) { return size_t(k.part) >= first && size_t(k.part) < last; }),
	          all.end());
	for (Contour& k : all)
		if (size_t(k.part) >= last) k.part -= int(last - first);
	c.outline.partCount -= int(last - first);
	return c;
}

inline LabelCase WithoutPoints(LabelCase c, size_t contour, size_t first, size_t last)
{
	auto& points = c.outline.contours[contour].points;
	points.erase(points.begin() + std::ptrdiff_t(first), points.begin() + std::ptrdiff_t(last));
	return c;
}

inline LabelCase WithoutUnusedVertices(LabelCase c)
{
	std::vector<int> number(c.mesh.vertices.size(), -1);
	Soup s;
	for (const auto& f : c.mesh.faces) {
		std::array<int, 3> g;
		for (size_t k = 0; k < 3; ++k) {
			int& n = number[size_t(f[k])];
			if (n < 0) n = s.add(c.mesh.vertices[size_t(f[k])]);
			g[k] = n;
		}
		s.faces.push_back(g);
	}
	c.mesh = s;
	return c;
}

/// True while each contour encloses an area of the sign it had: cheap, and keeps the outline good in nearly all cases.
inline bool HaveArea(const Outline& o)
{
	return std::all_of(o.contours.begin(), o.contours.end(),
	                   [](const Contour& c) { return c.points.size() >= 3 && TwiceSignedArea(c.points) != 0; });
}

}  // namespace detail

inline LabelCase Reduce(LabelCase c, const StillFails& fails, bool keepMesh)
{
	for (bool changed = true; changed;) {
		changed = detail::DropRuns(
			c, fails, [](const LabelCase& k) { return k.outline.partCount > 1 ? size_t(k.outline.partCount) : 0; },
			detail::WithoutParts);
		if (!keepMesh)
			changed |= detail::DropRuns(
				c, fails, [](const LabelCase& k) { return k.mesh.faces.size(); }, detail::WithoutFaces);
		for (size_t i = 0; i < c.outline.contours.size(); ++i)
			changed |= detail::DropRuns(
				c, [&](const LabelCase& k) { return detail::HaveArea(k.outline) && fails(k); },
				[i](const LabelCase& k) { return k.outline.contours[i].points.size(); },
				[i](const LabelCase& k, size_t first, size_t last) {
					return detail::WithoutPoints(k, i, first, last);
				});
	}
	const LabelCase tidy = detail::WithoutUnusedVertices(c);
	return fails(tidy) ? tidy : c;
}

}  // namespace vcg::textlabel::test
