#include "font_outline.h"

namespace textlabel {
namespace {

using vcg::Point2d;

/// Collects what FT_Outline_Decompose reports.
struct Pen {
	double unit;  ///< 26.6 units for one em
	std::vector<CurveContour> contours;
	Point2d start{0, 0}, at{0, 0};

	Point2d scaled(const FT_Vector* v) const
	{
		return {static_cast<double>(v->x) / unit, static_cast<double>(v->y) / unit};
	}

	void add(const CurvePiece& piece)
	{
		at = piece.end();
		contours.back().push_back(piece);
	}

	/// Back to the start; fonts may leave out the last line.
	void close()
	{
		if (!contours.empty() && !(at == start)) add(CurvePiece::Line(at, start));
		if (!contours.empty() && contours.back().empty()) contours.pop_back();
	}
};

int MoveTo(const FT_Vector* to, void* user)
{
	Pen& pen = *static_cast<Pen*>(user);
	pen.close();
	pen.contours.emplace_back();
	pen.start = pen.at = pen.scaled(to);
	return 0;
}

int LineTo(const FT_Vector* to, void* user)
{
	Pen& pen = *static_cast<Pen*>(user);
	const Point2d end = pen.scaled(to);
	if (!(end == pen.at)) pen.add(CurvePiece::Line(pen.at, end));
	return 0;
}

int ConicTo(const FT_Vector* control, const FT_Vector* to, void* user)
{
	Pen& pen = *static_cast<Pen*>(user);
	pen.add(CurvePiece::Quadratic(pen.at, pen.scaled(control), pen.scaled(to)));
	return 0;
}

int CubicTo(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to, void* user)
{
	Pen& pen = *static_cast<Pen*>(user);
	pen.add(CurvePiece::Cubic(pen.at, pen.scaled(control1), pen.scaled(control2), pen.scaled(to)));
	return 0;
}

}  // namespace

std::optional<std::vector<CurveContour>> CurvesOf(FT_Outline& outline, double pixelsPerEm)
{
	constexpr double kParts = 64;
	const FT_Outline_Funcs functions{MoveTo, LineTo, ConicTo, CubicTo, 0, 0};
	Pen pen{kParts * pixelsPerEm, {}};
	if (FT_Outline_Decompose(&outline, &functions, &pen) != 0) return std::nullopt;
	pen.close();
	return std::move(pen.contours);
}

}  // namespace textlabel
