#pragma once
// A drawing as shapes: what an SVG file paints, in the order in which it does.

#include <vector>
#include "outline_curve.h"
#include "outline_union.h"

namespace textlabel {

/// Curves one after the other. Where it is filled, a straight line closes an open one.
struct DrawnPath {
	CurveContour curves;  ///< not empty; where the path is closed, they end where they start
	bool isClosed = false;
};

enum class LineJoin { Miter, Round, Bevel };
enum class LineCap { Butt, Round, Square };

/// How a path is drawn as a line.
struct LineStyle {
	double width = 1;
	LineJoin join = LineJoin::Miter;
	LineCap cap = LineCap::Butt;
	double miterLimit = 4;  ///< longest miter, from its corner, in half widths
};

/// One filling or one line.
struct DrawnShape {
	std::vector<DrawnPath> paths;  ///< in units of their own
	Affine toPage;                 ///< from there to the page, whose y points down
	FillRule rule = FillRule::NonZero;
	bool isLine = false;
	LineStyle line;          ///< of a line, in the units of the paths
	bool isWhite = false;    ///< it covers what was painted before
	std::vector<int> clips;  ///< indices into Drawing::clips: it is seen within all of them
};

struct Drawing {
	std::vector<DrawnShape> shapes;
	std::vector<std::vector<DrawnShape>> clips;  ///< each is the union of its shapes
};

}  // namespace textlabel
