// What of a drawing is ink: areas and extents that were worked out by hand, of every kind of element, style and transformation; and
// what is refused.

#include "drawing_case.h"

#include <cmath>

using namespace drawing_case;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// A drawing, and what it covers in its own units.
struct Case {
	const char* name;
	std::string elements;
	double width, height, area;
	std::string attributes = "";
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class DrawingInk : public ::testing::TestWithParam<Case> {};

TEST_P(DrawingInk, HasTheAreaAndTheExtent)
{
	constexpr double fineness = 2e4;  // height over tolerance
	const Case& c = GetParam();
	const TextOutline made = Made(Document(c.elements, c.attributes), [&](TextOptions& o) {
		o.size = c.height;
		o.tolerance = c.height / fineness;
	});
	const double perimeter = 20 * (c.width + c.height);  // more than that of any case
	EXPECT_NEAR(made.boxMax[0] - made.boxMin[0], c.width, 2e-4 * c.width);
	EXPECT_NEAR(made.boxMax[1] - made.boxMin[1], c.height, 1e-9 * c.height);
	EXPECT_NEAR(AreaOf(made), c.area, perimeter * c.height / fineness);
}

const std::string kBlack = R"~(<rect width="40" height="20"/>)~";

const Case kShapes[] = {
	{"Rectangle", kBlack, 40, 20, 800},
	{"RoundedRectangle", R"~(<rect width="40" height="20" rx="6" ry="4"/>)~", 40, 20, 800 - (4 - kPi) * 24},
	{"OneRadiusForBoth", R"~(<rect width="40" height="20" ry="5"/>)~", 40, 20, 800 - (4 - kPi) * 25},
	{"RadiiOfHalfASideAtMost", R"~(<rect width="40" height="20" rx="99"/>)~", 40, 20, kPi * 200},
	{"Circle", R"~(<circle cx="5" cy="7" r="10"/>)~", 20, 20, kPi * 100},
	{"Ellipse", R"~(<ellipse cx="5" cy="7" rx="10" ry="5"/>)~", 20, 10, kPi * 50},
	{"Polygon", R"~(<polygon points="0,0 10,0 10,10"/>)~", 10, 10, 50},
	{"PolylineIsClosedWhenFilled", R"~(<polyline points="0 0 10 0 10 10"/>)~", 10, 10, 50},
	{"PathWithHoleByEvenOdd", R"~(<path fill-rule="evenodd" d="M0 0h40v20h-40zM10 5h20v10h-20z"/>)~", 40, 20, 600},
	{"NoHoleByNonZero", R"~(<path d="M0 0h40v20h-40zM10 5h20v10h-20z"/>)~", 40, 20, 800},
	{"HoleTurnedRoundByNonZero", R"~(<path d="M0 0h40v20h-40zM10 5v10h20v-10z"/>)~", 40, 20, 600},
	{"ShapesMayOverlap", R"~(<path d="M0 0h30v20h-30z"/><path d="M10 0h30v20h-30z"/>)~", 40, 20, 800},
	{"HalfCircleByArc", R"~(<path d="M-10 0A10 10 0 0 1 10 0z"/>)~", 20, 10, kPi * 50},
	{"CircleOfTwoArcs", R"~(<path d="M-10,0a10,10 0 1,0 20,0a10,10 0 1,0 -20,0"/>)~", 20, 20, kPi * 100},
	{"FlagsWithoutBlanks", R"~(<path d="M-10 0a10 10 0 1020 0a10 10 0 10-20 0"/>)~", 20, 20, kPi * 100},
	{"ArcTooSmallIsScaled", R"~(<path d="M-10 0A1 1 0 0 1 10 0z"/>)~", 20, 10, kPi * 50},
	{"ArcWithoutRadiusIsALine", R"~(<path d="M0 0A0 5 0 0 1 10 0V10z"/>)~", 10, 10, 50},
	{"TurnedEllipticArc", R"~(<path d="M0 -10A10 5 90 0 1 0 10A10 5 90 0 1 0 -10z"/>)~", 10, 20, kPi * 50},
	{"Parabola", R"~(<path d="M0 0Q10 20 20 0z"/>)~", 20, 10, 400.0 / 3},
	{"SmoothQuadratic", R"~(<path d="M0 0Q10 20 20 0T40 0z"/>)~", 40, 20, 2 * 400.0 / 3},
	{"Cubic", R"~(<path d="M0 0C0 20 20 20 20 0z"/>)~", 20, 15, 240},
	{"SmoothCubic", R"~(<path d="M0 0C0 20 20 20 20 0S40-20 40 0z"/>)~", 40, 30, 480},
	{"RelativeAndRepeated", R"~(<path d="m0 0 10 0 0 10-10 0zm20 0 10 0 0 10-10 0"/>)~", 30, 10, 200},
};

const Case kLines[] = {
	{"Butt", R"~(<line x1="0" x2="10" stroke="red" stroke-width="2"/>)~", 10, 2, 20},
	{"SquareEnds", R"~(<line x2="10" stroke="red" stroke-width="2" stroke-linecap="square"/>)~", 12, 2, 24},
	{"RoundEnds", R"~(<line x2="10" stroke="red" stroke-width="2" stroke-linecap="round"/>)~", 12, 2, 20 + kPi},
	{"DotOfARoundEnd", R"~(<path d="M5 5z" stroke="red" stroke-width="4" stroke-linecap="round"/>)~", 4, 4, kPi * 4},
	{"Miter", R"~(<path fill="none" stroke="#000" stroke-width="2" d="M0 0H10V10"/>)~", 11, 11, 40},
	{"Bevel", R"~(<path fill="none" stroke="#000" stroke-width="2" stroke-linejoin="bevel" d="M0 0H10V10"/>)~", 11, 11,
     39.5},
	{"MiterBeyondItsLimit",
     R"~(<path fill="none" stroke="#000" stroke-width="2" stroke-miterlimit="1.4" d="M0 0H10V10"/>)~", 11, 11, 39.5},
	{"RoundJoint", R"~(<path fill="none" stroke="#000" stroke-width="2" stroke-linejoin="round" d="M0 0H10V10"/>)~", 11,
     11, 39 + kPi / 4},
	{"Closed", R"~(<rect width="10" height="10" fill="none" stroke="#000" stroke-width="2"/>)~", 12, 12, 80},
	{"RingOfACircle", R"~(<circle r="10" fill="none" stroke="#000" stroke-width="2"/>)~", 22, 22, kPi * 40},
	{"FilledToo", R"~(<circle r="10" stroke="#000" stroke-width="2"/>)~", 22, 22, kPi * 121},
	{"WiderByAScaling", R"~(<g transform="scale(2,1)"><line x2="10" stroke="red" stroke-width="2"/></g>)~", 20, 2, 40},
	{"NotScaledWhenItSaysSo",
     R"~(<g transform="scale(3)"><line x2="10" stroke="red" stroke-width="2" vector-effect="non-scaling-stroke"/></g>)~",
     30, 2, 60},
	{"WidthInMillimetres", R"~(<path d="M0 0H96" style="stroke:#000;stroke-width:25.4mm"/>)~", 96, 96, 96 * 96},
	{"TurnsBack", R"~(<path fill="none" stroke="#000" stroke-width="2" d="M0 0H10H0"/>)~", 10, 2, 20},
};

const Case kPaint[] = {
	{"WhiteTakesAway", kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="white"/>)~", 40, 20, 600},
	{"WhiteByNumbers", kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="#FFF"/>)~", 40, 20, 600},
	{"WhiteByFunction", kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="rgb(100%, 255, 255)"/>)~", 40, 20,
     600},
	{"WhiteByLightness", kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="hsl(120 50% 100%)"/>)~", 40, 20,
     600},
	{"ClearByItsAlpha", kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="#ffffff00"/>)~", 40, 20, 800},
	{"WhiteBelowIsCovered", R"~(<rect x="10" y="5" width="20" height="10" fill="white"/>)~" + kBlack, 40, 20, 800},
	{"InkOverWhite",
     kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="#fff"/><rect x="15" y="7" width="10" height="5"/>)~",
     40, 20, 650},
	{"FaintWhiteIsAGleam",
     kBlack + R"~(<g opacity=".6"><rect x="10" y="5" width="20" height="10" fill="white" fill-opacity="60%"/></g>)~",
     40, 20, 800},
	{"GleamByItsAlpha", kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="rgba(255,255,255,.3)"/>)~", 40, 20,
     800},
	{"FaintInkIsInk", R"~(<g opacity=".1"><rect width="40" height="20" fill-opacity=".1"/></g>)~", 40, 20, 800},
	{"WhiteLine", kBlack + R"~(<path d="M20 0V20" stroke="white" stroke-width="4"/>)~", 40, 20, 720},
	{"WhiteAloneIsInk", R"~(<rect width="40" height="20" fill="white"/>)~", 40, 20, 800},
	{"YellowIsInk", R"~(<rect width="40" height="20" fill="#ffff00"/>)~", 40, 20, 800},
	{"GradientIsInk", R"~(<rect width="40" height="20" fill="url(#g)"/>)~", 40, 20, 800},
	{"NoFill", kBlack + R"~(<rect x="50" width="9" height="9" fill="none"/>)~", 40, 20, 800},
	{"Transparent",
     kBlack +
         R"~(<rect x="50" width="9" height="9" fill-opacity="0"/><rect x="50" width="9" height="9" opacity="0"/>)~",
     40, 20, 800},
	{"Hidden",
     kBlack + R"~(<g visibility="hidden"><rect x="50" width="9" height="9"/></g><g display="none"><text>A</text></g>)~",
     40, 20, 800},
	{"ShownWithinHidden",
     R"~(<g visibility="hidden"><rect x="50" width="9" height="9"/><rect width="40" height="20" visibility="visible"/></g>)~",
     40, 20, 800},
	{"CurrentColor",
     R"~(<g color="white">)~" + kBlack + R"~(<rect x="10" y="5" width="20" height="10" fill="currentColor"/></g>)~", 40,
     20, 600},
	{"Inherited",
     R"~(<g fill="white"><rect width="40" height="20" fill="black"/><rect x="10" y="5" width="20" height="10"/></g>)~",
     40, 20, 600},
	{"StyleBeforeAttribute", R"~(<rect width="40" height="20" fill="none" style="fill:#123"/>)~", 40, 20, 800},
	{"DisplayedByItsStyle", R"~(<rect width="40" height="20" display="none" style="display:inline"/>)~", 40, 20, 800},
	{"ClassOfASheet",
     R"~(<style>/* a */ .a, .b { fill : #fff ; }</style>)~" + kBlack +
         R"~(<rect class="x b" x="10" y="5" width="20" height="10"/>)~",
     40, 20, 600},
	{"IdBeforeClassBeforeElement",
     R"~(<style><![CDATA[#i{fill:#fff}.c{fill:none}rect{fill:red}@media print{rect{fill:none}}]]></style>)~" + kBlack +
         R"~(<rect class="c" id="i" x="10" y="5" width="20" height="10"/>)~",
     40, 20, 600},
	{"SelectorOfASequenceIsPassedOver",
     R"~(<style>g rect{fill:none} rect.c{fill:white}</style><g>)~" + kBlack +
         R"~(<rect class="c" x="10" y="5" width="20" height="10"/></g>)~",
     40, 20, 600},
};

const Case kStructure[] = {
	{"Translated", R"~(<g transform="translate(5)">)~" + kBlack + R"~(</g><rect width="1" height="20"/>)~", 45, 20,
     820},
	{"Turned", R"~(<g transform="rotate(90)">)~" + kBlack + "</g>", 20, 40, 800},
	{"TurnedAboutAPoint", kBlack + R"~(<rect width="40" height="20" transform="rotate(180 20 10)"/>)~", 40, 20, 800},
	{"Skewed", R"~(<g transform="skewX(45)">)~" + kBlack + "</g>", 60, 20, 800},
	{"MatrixAndList", R"~(<g transform="translate(3 4), matrix(1 0 0 2 0 0) scale(.5 1)">)~" + kBlack + "</g>", 20, 40,
     800},
	{"MirroredLine",
     R"~(<g transform="scale(-1 1)"><path fill="none" stroke="#000" stroke-width="2" d="M0 0H10V10"/></g>)~", 11, 11,
     40},
	{"Use", R"~(<defs><rect id="r" width="10" height="20"/></defs><use href="#r"/><use xlink:href="#r" x="30"/>)~", 40,
     20, 400},
	{"SymbolInARectangle",
     R"~(<symbol id="s" viewBox="0 0 2 1"><rect width="2" height="1"/></symbol><use href="#s" width="40" height="99"/>)~",
     40, 20, 800},
	{"NestedDrawing",
     R"~(<svg x="5" width="40" height="20" viewBox="0 0 80 40"><rect width="200" height="40"/></svg>)~", 40, 20, 800},
	{"NestedMayOverflow", R"~(<svg width="20" height="20" overflow="visible">)~" + kBlack + "</svg>", 40, 20, 800},
	{"SwitchTakesTheFirstForAll",
     "<switch><foreignObject/><rect systemLanguage=\"de\" width=\"9\" height=\"99\"/>" + kBlack +
         R"~(<rect width="99" height="99"/></switch>)~",
     40, 20, 800},
	{"ClipPath",
     R"~(<clipPath id="c"><circle cx="20" cy="10" r="5" fill="none"/></clipPath><g clip-path="url(#c)">)~" + kBlack +
         "</g>",
     10, 10, kPi * 25},
	{"ClipPathMovesWithWhatItClips",
     R"~(<clipPath id="c"><rect width="10" height="10"/></clipPath><g clip-path="url('#c')" transform="translate(100) scale(2)">)~" +
         kBlack + "</g>",
     20, 20, 400},
	{"ClipPathsWithinClipPaths",
     R"~(<clipPath id="c"><rect width="30" height="20"/></clipPath><clipPath id="d"><rect x="10" width="30" height="20"/></clipPath>
	     <g clip-path="url(#c)"><g clip-path="url(#d)">)~" +
         kBlack + "</g></g>",
     20, 20, 400},
	{"ClipPathWithAHole",
     R"~(<clipPath id="c"><path clip-rule="evenodd" d="M0 0h40v20h-40zM10 5h20v10h-20z"/></clipPath><g clip-path="url(#c)">)~" +
         kBlack + "</g>",
     40, 20, 600},
	{"PageHidesWhatIsBeside", R"~(<rect x="-10" y="-10" width="100" height="100"/>)~", 40, 20, 800,
     R"~(viewBox="0 0 40 20")~"},
	{"PageOfASize", R"~(<rect x="-10" y="-10" width="100" height="100"/>)~", 40, 20, 800,
     R"~(width="40" height="20px")~"},
	{"PercentOfThePage", R"~(<rect width="50%" height="100%"/>)~", 20, 20, 400, R"~(viewBox="0 0 40 20")~"},
	{"StretchedPage", R"~(<rect width="40" height="20"/>)~", 40, 40, 1600,
     R"~(viewBox="0 0 40 20" width="40" height="40" preserveAspectRatio="none")~"},
	{"WhatProgramsKeep",
     R"~(<title>t</title><metadata><text>x</text></metadata><unknown><rect width="99" height="99"/></unknown><text> </text>)~" +
         kBlack,
     40, 20, 800},
	{"FarFromTheOrigin", R"~(<g transform="translate(1e7 -1e7)">)~" + kBlack + "</g>", 40, 20, 800},
	{"Tiny", R"~(<g transform="scale(1e-6)"><rect width="40e6" height="2e7"/></g>)~", 40, 20, 800},
};

const auto kCaseName = [](const ::testing::TestParamInfo<Case>& info) { return std::string(info.param.name); };

INSTANTIATE_TEST_SUITE_P(Shapes, DrawingInk, ::testing::ValuesIn(kShapes), kCaseName);
INSTANTIATE_TEST_SUITE_P(Lines, DrawingInk, ::testing::ValuesIn(kLines), kCaseName);
INSTANTIATE_TEST_SUITE_P(Paint, DrawingInk, ::testing::ValuesIn(kPaint), kCaseName);
INSTANTIATE_TEST_SUITE_P(Structure, DrawingInk, ::testing::ValuesIn(kStructure), kCaseName);

TEST(DrawingRead, ForgetsNoPrefix)
{
	const std::string prefixed =
		R"~(<s:svg xmlns:s="http://www.w3.org/2000/svg"><s:rect width="4" height="2"/></s:svg>)~";
	EXPECT_NEAR(AreaOf(Made(prefixed, [](TextOptions& o) { o.size = 2; })), 8, 1e-9);
	EXPECT_NEAR(AreaOf(Made(R"~(<svg><rect width="4" height="2"/></svg>)~", [](TextOptions& o) { o.size = 2; })), 8,
	            1e-9);
	const std::string foreign = Document(R"~(<rect width="4" height="2" x:fill="none"/>)~", "xmlns:x=\"urn:x\"");
	EXPECT_NEAR(AreaOf(Made(foreign, [](TextOptions& o) { o.size = 2; })), 8, 1e-9);
}

TEST(DrawingRead, RefusesWhatCannotBeCutAsItLooks)
{
	const auto whatIn = [](const std::string& elements) {
		const TextError error = ErrorOf(Document("\n" + kBlack + elements));
		EXPECT_EQ(error.code, TextErrorCode::DrawingUnsupported);
		EXPECT_EQ(error.value, 2) << "the line";
		EXPECT_NE(Sentence(error).find("line 2"), std::string::npos);
		return error.detail;
	};
	EXPECT_EQ(whatIn("<text x='1'>A</text>"), "text");
	EXPECT_EQ(whatIn("<text><tspan>A</tspan></text>"), "text");
	EXPECT_EQ(whatIn("<image href='a.png'/>"), "a picture");
	EXPECT_EQ(whatIn("<g mask='url(#m)'/>"), "a mask");
	EXPECT_EQ(whatIn("<path d='M0 0H9' stroke='red' stroke-dasharray='1 2'/>"), "a dashed line");
	EXPECT_EQ(whatIn("<g transform='rotate(9)' style='transform-origin:center'/>"), "a transform-origin");
	EXPECT_EQ(whatIn("<g style='clip-path:circle(5px)'/>"), "a clip path that is no path");
	EXPECT_EQ(whatIn("<path d='M0 0H9' stroke='red' marker-end='url(#m)'/>"), "a line with markers");
}

TEST(DrawingRead, SaysWhatIsWrongWithAFile)
{
	const auto whyNot = [](const std::string& document) {
		const TextError error = ErrorOf(document);
		EXPECT_EQ(error.code, TextErrorCode::DrawingUnreadable) << Sentence(error);
		EXPECT_NE(Sentence(error).find(".svg\""), std::string::npos) << "it names the file";
		return error.detail;
	};
	EXPECT_EQ(whyNot(""), "the file is empty");
	EXPECT_NE(whyNot("solid bracket").find("no XML"), std::string::npos);
	EXPECT_NE(whyNot("<svg><g></svg>").find("on line 1"), std::string::npos);
	EXPECT_EQ(whyNot("<html/>"), "it is XML, but no SVG");
	EXPECT_EQ(whyNot(Document("<path d='M0 0L'/>")), "the data of a path cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<path d='L0 0'/>")), "the data of a path cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<path d='M0 0 nan 1'/>")), "the data of a path cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<path d='M0 0H1e999V5'/>")), "the data of a path cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<path d='M0 0z1'/>")), "the data of a path cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<polygon points='0 0 1'/>")), "the points cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<rect width='wide' height='1'/>")), "the width is no length on line 1");
	EXPECT_EQ(whyNot(Document("<g transform='rotate(1,2)'/>")), "the transform cannot be read on line 1");
	EXPECT_EQ(whyNot(Document("<path d='M0 0H1e13V5'/>")), "a coordinate is too large on line 1");
	EXPECT_EQ(whyNot(Document("<rect width='4' height='2' transform='scale(1e300) scale(1e300)'/>")),
	          "a coordinate is too large on line 1");
	EXPECT_EQ(whyNot(Document("<use href='#nobody'/>")), "nothing has the name '#nobody', which is used on line 1");
	EXPECT_EQ(whyNot(Document("<g id='g'><use href='#g'/></g>")), "an element uses itself on line 1");
	EXPECT_EQ(whyNot(Document("", "viewBox='0 0 1'")), "the viewBox does not have four numbers on line 1");
}

TEST(DrawingRead, RefusesFilesThatAreNone)
{
	TextOptions options;
	const auto whyNot = [&](const std::string& file) {
		options.drawing = file;
		try {
			MakeTextOutline("", options);
		} catch (const TextError& error) {
			EXPECT_EQ(error.code, TextErrorCode::DrawingUnreadable);
			return error.detail;
		}
		return std::string("no error");
	};
	EXPECT_EQ(whyNot("/nowhere/a.svg"), "no such file");
	EXPECT_EQ(whyNot(::testing::TempDir()), "it is a folder");
	EXPECT_EQ(whyNot("/dev/zero"), "it is not a regular file");
	EXPECT_EQ(whyNot(std::string("a.svg\0b", 7)), "NUL");
}

TEST(DrawingRead, PaintsNothing)
{
	for (const char* elements :
	     {"", "<path d=''/>", "<path d='M1 1'/>", "<rect width='0' height='5'/>", "<path d='M0 0H9'/>",
	      "<rect width='4' height='2' fill='none'/>", "<path d='M0 0H9' stroke='red' stroke-width='0'/>",
	      "<rect width='4' height='2' transform='scale(0)'/>", "<rect width='4' height='2' x='100'/>"})
		EXPECT_EQ(ErrorOf(Document(elements, "viewBox='0 0 9 9'")).code, TextErrorCode::DrawingEmpty) << elements;
}

/// What would take forever, or all memory, is refused soon.
TEST(DrawingRead, BombsDoNotGoOff)
{
	std::string deep, wide = "<rect id='a0' width='1' height='1'/>", entities, styles, zigzag = "M0 0", rays = "M0 0";
	for (int i = 0; i < 100000; ++i) deep += "<g>";
	for (int i = 0; i < 30; ++i) {
		const std::string name = "a" + std::to_string(i), next = "a" + std::to_string(i + 1);
		wide += "<g id='" + next + "'><use href='#" + name + "'/><use href='#" + name + "'/></g>";
		entities +=
			"<!ENTITY b" + std::to_string(i + 1) + " '&b" + std::to_string(i) + ";&b" + std::to_string(i) + ";'>";
	}
	for (long long i = 0; i < 50000; ++i) {
		styles += ".c" + std::to_string(i) + "{fill:red}";
		zigzag += i % 2 ? "H0V" + std::to_string(i) : "H1000V" + std::to_string(i);
		rays += "L" + std::to_string(i * 7919 % 1000) + " " + std::to_string(i * 104729 % 997);
	}
	std::string rectangles;
	for (int i = 0; i < 20000; ++i) rectangles += "<rect width='1' height='1'/>";
	EXPECT_EQ(ErrorOf(Document(deep)).code, TextErrorCode::DrawingUnreadable);
	EXPECT_EQ(ErrorOf(Document(wide)).code, TextErrorCode::DrawingUnreadable);
	EXPECT_EQ(ErrorOf("<!DOCTYPE svg [<!ENTITY b0 'lol'>" + entities + "]><svg><title>&b30;</title></svg>").code,
	          TextErrorCode::DrawingUnreadable);
	EXPECT_EQ(ErrorOf(Document("<style>" + styles + "</style>" + rectangles)).code, TextErrorCode::DrawingUnreadable);
	EXPECT_EQ(ErrorOf(Document("<path d='" + rays + "'/>")).code, TextErrorCode::Unsound);
	EXPECT_EQ(ErrorOf(Document("<path fill='none' stroke='red' d='" + rays + "'/>")).code, TextErrorCode::Unsound);
	EXPECT_GT(Made(Document("<path fill='none' stroke='red' stroke-width='.1' d='M0 0H9V9'/><path d='" +
	                        zigzag.substr(0, 20000) + "'/>"))
	              .outline.partCount,
	          0);
}

}  // namespace
