// Drawings as outlines: how large they are, where they stand, how fine they are, and what the options do to them.

#include "drawing_case.h"

#include <cmath>

using namespace drawing_case;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// An L, 40 wide and 20 high, with strokes of 4, its corner at the lower left; and one for the eye: the page's y points down.
const std::string kCorner = Document("<path d='M0 0h4v16h36v4h-40z'/>");
constexpr double kCornerArea = 4 * 16 + 40 * 4;

/// Has the outline ink at a point?
bool IsInked(const TextOutline& text, const vcg::Point2d& p)
{
	bool isInside = false;
	for (const auto& contour : text.outline.contours) isInside ^= text_support::IsInside(p, contour.points);
	return isInside;
}

TEST(DrawingOutline, HasTheHeightThatIsAskedFor)
{
	const TextOutline made = Made(kCorner, [](TextOptions& o) { o.size = 5; });
	EXPECT_NEAR(made.boxMax[1] - made.boxMin[1], 5, 1e-9);
	EXPECT_NEAR(made.boxMax[0] - made.boxMin[0], 10, 1e-9);
	EXPECT_NEAR(made.capitalHeight, 5, 1e-9);
	EXPECT_NEAR(AreaOf(made), kCornerArea / 16, 1e-9);
	EXPECT_TRUE(made.letters.empty());
	EXPECT_TRUE(made.fonts.empty());
	EXPECT_EQ(made.module, 0);
}

TEST(DrawingOutline, HasTheWidthThatIsAskedFor)
{
	const TextOutline made = Made(kCorner, [](TextOptions& o) {
		o.size = -1;
		o.fitWidth = 8;
	});
	EXPECT_NEAR(made.boxMax[0] - made.boxMin[0], 8, 1e-9);
	EXPECT_NEAR(made.capitalHeight, 4, 1e-9);
	const TextOutline bolder = Made(kCorner, [](TextOptions& o) {
		o.fitWidth = 8;
		o.embolden = 0.25;
	});
	EXPECT_NEAR(bolder.boxMax[0] - bolder.boxMin[0], 8, 1e-6);
}

TEST(DrawingOutline, StandsUprightAtItsAnchor)
{
	const TextOutline made = Made(kCorner, [](TextOptions& o) { o.size = 20; });
	EXPECT_NEAR(made.boxMin[0], -20, 1e-9);
	EXPECT_NEAR(made.boxMin[1], -10, 1e-9);
	EXPECT_TRUE(IsInked(made, {-18, 9})) << "the upper end";
	EXPECT_TRUE(IsInked(made, {18, -8})) << "the right end";
	EXPECT_FALSE(IsInked(made, {18, 8}));
	const TextOutline left = Made(kCorner, [](TextOptions& o) {
		o.size = 20;
		o.align = textlabel::Align::Left;
		o.anchor = textlabel::Anchor::Baseline;
	});
	EXPECT_NEAR(left.boxMin[0], 0, 1e-9);
	EXPECT_NEAR(left.boxMin[1], 0, 1e-9);
}

TEST(DrawingOutline, MirroredIsTheMirrorImage)
{
	const auto mirrored = [](bool is) {
		return Made(kCorner, [&](TextOptions& o) {
			o.size = 20;
			o.align = textlabel::Align::Left;
			o.mirrored = is;
		});
	};
	const TextOutline one = mirrored(false), other = mirrored(true);
	EXPECT_NEAR(AreaOf(other), AreaOf(one), 1e-9);
	EXPECT_NEAR(other.boxMin[0], -one.boxMax[0], 1e-9);
	for (const vcg::Point2d& p : {vcg::Point2d(2, 9), vcg::Point2d(38, -8), vcg::Point2d(38, 8)})
		EXPECT_EQ(IsInked(one, p), IsInked(other, {-p[0], p[1]}));
}

TEST(DrawingOutline, KeepsToItsTolerance)
{
	const auto circle = [](double tolerance) {
		return Made(Document("<circle r='1'/>"), [&](TextOptions& o) {
			o.size = 20;
			o.tolerance = tolerance;
		});
	};
	const TextOutline fine = circle(0), coarse = circle(0.1);
	EXPECT_EQ(fine.tolerance, 20.0 / 4000);
	for (const TextOutline* made : {&fine, &coarse})
		for (const vcg::Point2d& p : made->outline.contours[0].points) EXPECT_NEAR(p.Norm(), 10, 1.3 * made->tolerance);
	// chords of a circle that keep within t: more than pi / acos(1 - 2 t / r)
	EXPECT_GE(double(coarse.outline.contours[0].points.size()), kPi / std::acos(1 - 2 * 0.1 / 10));
	EXPECT_GT(fine.outline.contours[0].points.size(), 3 * coarse.outline.contours[0].points.size());
	EXPECT_EQ(ErrorOf(Document("<circle r='1'/>"), [](TextOptions& o) { o.tolerance = 5; }).code,
	          TextErrorCode::BadTolerance);
}

/// The ink is a small part of what is painted: it gets its own tolerance all the same.
TEST(DrawingOutline, IsAsFineWhereMostIsCutAway)
{
	const std::string document = Document("<clipPath id='c'><circle cx='500' cy='500' r='2'/></clipPath><rect "
	                                      "width='1000' height='1000' clip-path='url(#c)'/>");
	const TextOutline made = Made(document, [](TextOptions& o) { o.size = 20; });
	EXPECT_NEAR(AreaOf(made), kPi * 100, 0.5);
	for (const vcg::Point2d& p : made.outline.contours[0].points) EXPECT_NEAR(p.Norm(), 10, 2 * made.tolerance);
}

/// Rounding on the grid of all that is painted would be seen in so small a part of it.
TEST(DrawingOutline, IsRefusedWhereNearlyAllIsCutAway)
{
	const auto seen = [](const std::string& far) {
		return Document("<circle cx='5' cy='5' r='4'/><path d='M0 0H1L" + far + " 0z'/>", "viewBox='0 0 10 10'");
	};
	EXPECT_NEAR(AreaOf(Made(seen("5000"), [](TextOptions& o) { o.size = 8; })), kPi * 16, 0.05);
	const TextError error = ErrorOf(seen("9e7"));
	EXPECT_EQ(error.code, TextErrorCode::Unsound);
	EXPECT_EQ(error.detail, "what is seen of it is too small a part of it");
	const std::string curve = Document("<path d='M0 0C0 1 9e6 1 9e6 0C9e6 9 0 9 0 0'/><circle cx='-5' cy='5' r='4'/>",
	                                   "viewBox='-10 0 10 10'");
	EXPECT_EQ(ErrorOf(curve).code, TextErrorCode::Unsound);
}

TEST(DrawingOutline, PartsThatTouchBecomeOne)
{
	EXPECT_EQ(Made(Document("<rect width='9' height='9'/><rect x='9' y='9' width='9' height='9'/>")).outline.partCount,
	          1);
	EXPECT_EQ(
		Made(Document("<rect width='9' height='9'/><rect x='9.5' y='9' width='9' height='9'/>")).outline.partCount, 2);
}

TEST(DrawingOutline, EmboldenMovesItsEdges)
{
	const double bolder = AreaOf(Made(kCorner, [](TextOptions& o) {
		o.size = 20;
		o.embolden = 1;
	}));
	EXPECT_NEAR(bolder, 6 * 16 + 42 * 6, 1e-6);  // the upright from y = 22 down to the beam
	EXPECT_EQ(ErrorOf(kCorner, [](TextOptions& o) { o.size = 20, o.embolden = -2.5; }).code,
	          TextErrorCode::LetterVanished);
	EXPECT_EQ(ErrorOf(kCorner, [](TextOptions& o) { o.size = 20, o.embolden = 25; }).code, TextErrorCode::BadEmbolden);
	const std::string dumbbell = Document("<path d='M0 0h9v4h9v-4h9v9h-9v-4h-9v4h-9z'/>");
	EXPECT_EQ(ErrorOf(dumbbell, [](TextOptions& o) { o.size = 9, o.embolden = -0.6; }).code,
	          TextErrorCode::LetterBroken);
}

TEST(DrawingOutline, IsMeasuredForThePrinter)
{
	const TextOutline made = Made(kCorner, [](TextOptions& o) { o.size = 20; });
	EXPECT_NEAR(made.thinnestStroke.width, 4, 1e-9);
	const TextError thin = ErrorOf(kCorner, [](TextOptions& o) { o.size = 20, o.minStroke = 6; });
	EXPECT_EQ(thin.code, TextErrorCode::TooThin);
	EXPECT_NEAR(thin.size, 30, 1e-6);
	Made(kCorner, [&](TextOptions& o) { o.size = thin.size * 1.0001, o.minStroke = 6; });
	const std::string two = Document("<rect width='9' height='20'/><rect x='10' width='9' height='20'/>");
	EXPECT_NEAR(ErrorOf(two, [](TextOptions& o) { o.size = 20, o.minGap = 2; }).size, 40, 1e-6);
}

TEST(DrawingOutline, IsNoCode)
{
	const TextError error = ErrorOf(kCorner, [](TextOptions& o) { o.code = textlabel::CodeKind::QrCode; });
	EXPECT_EQ(error.code, TextErrorCode::DrawingAndCode);
}

TEST(DrawingOutline, IsTheSameEachTime)
{
	const std::string document =
		Document("<circle r='7'/><path fill='#fff' d='M-3-3L4 1-2 5z'/><path stroke='red' d='M-9 9Q0 0 9 9'/>");
	const TextOutline one = Made(document), other = Made(document);
	ASSERT_EQ(one.outline.contours.size(), other.outline.contours.size());
	for (std::size_t i = 0; i < one.outline.contours.size(); ++i)
		EXPECT_EQ(one.outline.contours[i].points, other.outline.contours[i].points);
}

}  // namespace
