// Automatic placement against parts whose inside is known: a place is judged by the cells of the part, by closed forms, or by
// casting rays at every triangle, never by the images that found it.

#include "filter_textlabel/auto_placement.h"
#include "placement_parts.h"

#include <gtest/gtest.h>
#include <limits>
#include <vcg/math/matrix44.h>

namespace textlabel::test {
namespace {

struct Text {
	double width = 2.3, height = 1;  // of the box at capital height 1
	double size = -1, depth = 0;
	Point3d up{0, 0, 0};
};

std::vector<Place> Find(const Triangles& part, const Text& text = {})
{
	PlaceQuery query{part.positions, part.triangles};
	query.labelWidth = text.width;
	query.labelHeight = text.height;
	query.size = text.size;
	query.depth = text.depth;
	query.up = text.up;
	return FirstPlaces(query);
}

Point3d Right(const Place& place) { return place.up ^ place.direction; }

/// Points all over the text's box, in the plane of the place.
std::vector<Point3d> BoxPoints(const Place& place, const Text& text)
{
	constexpr int across = 40, along = 16;
	std::vector<Point3d> points;
	for (int i = 0; i <= across; ++i)
		for (int j = 0; j <= along; ++j)
			points.push_back(place.position + Right(place) * (text.width * place.size * (double(i) / across - 0.5)) +
			                 place.up * (text.height * place.size * (double(j) / along - 0.5)));
	return points;
}

void ExpectUnitFrame(const Place& place)
{
	EXPECT_NEAR(place.direction.Norm(), 1, 1e-12);
	EXPECT_NEAR(place.up.Norm(), 1, 1e-12);
	EXPECT_NEAR(place.up * place.direction, 0, 1e-12);
}

/// The text lies on the part everywhere, and nothing of the part is in front of it.
void ExpectOnSurface(const BlockPart& part, const Place& place, const Text& text)
{
	ExpectUnitFrame(place);
	for (const Point3d& p : BoxPoints(place, text)) {
		ASSERT_TRUE(part.contains(p - place.direction * 1e-6)) << "a hole under the text";
		for (double t = 1e-6; t < part.size[0] + part.size[1] + part.size[2]; t += 0.25)
			ASSERT_FALSE(part.contains(p + place.direction * t)) << "hidden at height " << t;
	}
}

void ExpectAllOnSurface(const BlockPart& part, const std::vector<Place>& places, const Text& text = {})
{
	for (const Place& place : places) {
		SCOPED_TRACE(testing::Message() << "place " << &place - places.data());
		ExpectOnSurface(part, place, text);
		EXPECT_TRUE(place.flat);
	}
}

void ExpectNear(const Point3d& a, const Point3d& b, double tolerance)
{
	EXPECT_LE((a - b).Norm(), tolerance) << a[0] << " " << a[1] << " " << a[2] << " is not " << b[0] << " " << b[1]
										 << " " << b[2];
}

Triangles Moved(Triangles part, const vcg::Matrix44d& by)
{
	for (Point3d& p : part.positions) p = by * p;
	return part;
}

TEST(AutoPlacement, TakesTheMiddleOfTheLargestFace)
{
	const BlockPart box = Box(60, 20, 40);  // the largest faces look along Y; the front is the one towards -Y
	const std::vector<Place> places = Find(SurfaceOf(box));
	ASSERT_FALSE(places.empty());
	ExpectAllOnSurface(box, places);
	ExpectNear(places[0].position, Point3d(30, 0, 20), 1e-9);
	ExpectNear(places[0].direction, Point3d(0, -1, 0), 1e-12);
	ExpectNear(places[0].up, Point3d(0, 0, 1), 1e-12);
	EXPECT_NEAR(places[0].wall, 20, 1e-9);
}

TEST(AutoPlacement, TopReadsFromTheFront)
{
	const std::vector<Place> places = Find(SurfaceOf(Box(60, 40, 5)));
	ASSERT_FALSE(places.empty());
	ExpectNear(places[0].direction, Point3d(0, 0, 1), 1e-12);
	ExpectNear(places[0].up, Point3d(0, 1, 0), 1e-12);
}

TEST(AutoPlacement, ChosenSizeFillsTheFaceButLeavesAir)
{
	Text text;
	text.width = 8;
	const std::vector<Place> places = Find(SurfaceOf(Box(60, 20, 40)), text);
	ASSERT_FALSE(places.empty());
	const double fillsExactly = 60 / text.width;
	EXPECT_GT(places[0].size, 0.6 * fillsExactly);
	EXPECT_LT(places[0].size, 0.85 * fillsExactly);
}

TEST(AutoPlacement, AvoidsAHoleInTheMiddle)
{
	BlockPart plate = Box(60, 40, 4);
	plate.solid = [](int x, int y, int) { return x < 20 || x >= 40 || y < 14 || y >= 26; };
	const std::vector<Place> places = Find(SurfaceOf(plate));
	ASSERT_GE(places.size(), 2u);
	ExpectAllOnSurface(plate, places);
	// Above and below the hole a strip of 14 x 60 is free, beside it one of 20 x 40; with air the text takes 1.75 by 3.375.
	EXPECT_GE(places[0].size, 0.8 * std::min(14 / 1.75, 60 / 3.375));
}

TEST(AutoPlacement, StairsTakeOneStepOrTheBack)
{
	BlockPart stairs = Box(40, 30, 30);
	stairs.solid = [](int, int y, int z) { return z < 10 * (y / 10 + 1); };
	const std::vector<Place> places = Find(SurfaceOf(stairs));
	ASSERT_FALSE(places.empty());
	ExpectAllOnSurface(stairs, places);
	ExpectNear(places[0].direction, Point3d(0, 1, 0), 1e-12);  // the back, 40 x 30 and upright
	Text fitsAStep;
	fitsAStep.up = Point3d(0, 0, 1);
	fitsAStep.size = 6;
	ExpectAllOnSurface(stairs, Find(SurfaceOf(stairs), fitsAStep), fitsAStep);
}

TEST(AutoPlacement, AFaceBehindAGrilleDoesNotCount)
{
	BlockPart part = Box(60, 20, 60);  // a wall at the back, in front of it bars, joined by a post in the corner
	part.solid = [](int x, int y, int z) { return y >= 16 || (y < 2 && z % 6 < 2) || (x < 2 && z < 2); };
	const std::vector<Place> places = Find(SurfaceOf(part));
	ASSERT_FALSE(places.empty());
	ExpectAllOnSurface(part, places);
	ExpectNear(places[0].direction, Point3d(0, 1, 0), 1e-12);
}

TEST(AutoPlacement, FollowsATiltedPart)
{
	const BlockPart box = Box(60, 20, 40);
	vcg::Matrix44d turn;
	turn.SetRotateDeg(33, Point3d(1, 2, -1));
	const std::vector<Place> places = Find(Moved(SurfaceOf(box), turn));
	ASSERT_FALSE(places.empty());
	const Point3d normal = turn * Point3d(0, 1, 0), across = turn * Point3d(1, 0, 0), along = turn * Point3d(0, 0, 1);
	const double side = places[0].direction * normal;
	EXPECT_NEAR(std::abs(side), 1, 1e-12);
	ExpectNear(places[0].position, turn * Point3d(30, side > 0 ? 20 : 0, 20), 1e-6);
	const double parallel = std::max(std::abs(places[0].up * across), std::abs(places[0].up * along));
	EXPECT_NEAR(parallel, 1, 1e-9) << "the text is not along the edges of the face";
	EXPECT_GE(places[0].up[2], std::max(std::abs(across[2]), std::abs(along[2])) - 1e-9)
		<< "another edge is more upright";
}

TEST(AutoPlacement, FollowsAPlateThatIsTurnedOnTheTable)
{
	for (const double degrees : {20.0, -35.0}) {
		vcg::Matrix44d turn;
		turn.SetRotateDeg(degrees, Point3d(0, 0, 1));
		const std::vector<Place> places = Find(Moved(SurfaceOf(Box(50, 30, 3)), turn));
		ASSERT_FALSE(places.empty());
		ExpectNear(places[0].up, turn * Point3d(0, 1, 0), 1e-9);
	}
}

TEST(AutoPlacement, AnUnweldedMeshIsTheSamePart)
{
	vcg::Matrix44d turn;
	turn.SetRotateDeg(20, Point3d(0, 0, 1));
	const Triangles welded = Moved(SurfaceOf(Box(50, 30, 3)), turn);
	Triangles soup;
	for (const std::array<int, 3>& t : welded.triangles) {
		const int first = int(soup.positions.size());
		for (int v : t) soup.positions.push_back(welded.positions[size_t(v)]);
		soup.triangles.push_back({first, first + 1, first + 2});
	}
	const std::vector<Place> a = Find(welded), b = Find(soup);
	ASSERT_EQ(a.size(), b.size());
	for (size_t i = 0; i < a.size(); ++i) {
		EXPECT_EQ(a[i].position, b[i].position);
		EXPECT_EQ(a[i].up, b[i].up);
		EXPECT_EQ(a[i].size, b[i].size);
	}
}

TEST(AutoPlacement, ALongTextOnAColumnReadsUpwards)
{
	Text text;
	text.width = 9;
	BlockPart column = Box(10, 10, 100);
	column.solid = [](int x, int y, int z) {  // with a groove all round
		return z < 20 || z >= 24 || (x >= 2 && x < 8 && y >= 2 && y < 8);
	};
	const std::vector<Place> places = Find(SurfaceOf(column), text);
	ASSERT_FALSE(places.empty());
	ExpectAllOnSurface(column, places, text);
	ExpectNear(Right(places[0]), Point3d(0, 0, 1), 1e-12);
	EXPECT_NEAR(places[0].position[2], 62, 2);
}

TEST(AutoPlacement, TakesTheUpThatIsWanted)
{
	Text text;
	text.up = Point3d(1, 0, 0.2);
	const std::vector<Place> places = Find(SurfaceOf(Box(60, 20, 40)), text);
	ASSERT_FALSE(places.empty());
	ExpectNear(places[0].up, Point3d(1, 0, 0.2) / std::hypot(1, 0.2), 1e-12);
}

TEST(AutoPlacement, KeepsTheWantedSize)
{
	const BlockPart box = Box(30, 4, 10);
	Text text;
	text.width = 2.5;
	text.size = 8;  // 20 x 8 on 30 x 10: no room for air, but it fits
	const std::vector<Place> places = Find(SurfaceOf(box), text);
	ASSERT_FALSE(places.empty());
	ExpectAllOnSurface(box, places, text);
	for (const Place& place : places) EXPECT_EQ(place.size, 8);
	text.size = 11;  // higher than 10, and turned it is longer
	EXPECT_TRUE(Find(SurfaceOf(box), text).empty());
}

TEST(AutoPlacement, ASunkLabelLooksForAThickWall)
{
	BlockPart part = Box(60, 24, 30);  // towards -Y a large thin face and a small thick one
	part.solid = [](int x, int y, int) { return y < 1 || x < 20; };
	Text text;
	EXPECT_NEAR(Find(SurfaceOf(part), text)[0].wall, 1, 1e-9);
	text.depth = 2;
	EXPECT_NEAR(Find(SurfaceOf(part), text)[0].wall, 1, 1e-9);
	text.depth = -2;
	const std::vector<Place> places = Find(SurfaceOf(part), text);
	ASSERT_FALSE(places.empty());
	ExpectAllOnSurface(part, places);
	EXPECT_GE(places[0].wall, 2.5);
	for (size_t i = 1; i < places.size(); ++i) EXPECT_FALSE(places[i - 1].wall < 2.5 && places[i].wall >= 2.5);
}

TEST(AutoPlacement, OnASphereTheTextStaysOnTheVisibleCap)
{
	constexpr double radius = 10;
	const Text text;
	const std::vector<Place> places = Find(Sphere(radius), text);
	ASSERT_FALSE(places.empty());
	for (const Place& place : places) {
		ExpectUnitFrame(place);
		EXPECT_NEAR(place.position.Norm(), radius, 0.01 * radius);
		EXPECT_GT(place.direction * place.position / radius, std::cos(0.1));
		const double corner = place.size * std::hypot(text.width, text.height) / 2;  // from the axis of the look
		ASSERT_LT(corner, radius * std::sin(fullTurn / 6));
		const double slope = 1 / std::sqrt(1 - corner * corner / (radius * radius));  // of a sphere at that distance
		EXPECT_NEAR(place.stretch, slope, 0.2 * slope);
		EXPECT_FALSE(place.flat);
	}
	EXPECT_GT(places[0].size * text.width, 0.5 * radius) << "needlessly small";
}

TEST(AutoPlacement, OnATorusItFacesTheViewer)
{
	const std::vector<Place> places = Find(Torus(10, 4));
	ASSERT_FALSE(places.empty());
	for (const Place& place : places) {
		const Point3d p = place.position;
		const double out = std::hypot(p[0], p[1]);
		const Point3d onRing(10 * p[0] / out, 10 * p[1] / out, 0);
		EXPECT_NEAR((p - onRing).Norm(), 4, 0.05);
		EXPECT_GT((p - onRing) * place.direction / 4, std::cos(fullTurn / 36));
		EXPECT_GE(place.stretch, 1);
	}
}

TEST(AutoPlacement, BadTrianglesChangeNothing)
{
	const Triangles clean = SurfaceOf(Box(60, 20, 40));
	Triangles bad = clean;
	const int known = int(bad.positions.size());
	const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
	bad.positions.insert(bad.positions.end(), {Point3d(nan, 0, 0), Point3d(0, infinity, 0), Point3d(500, 500, 500)});
	bad.triangles.push_back({0, 1, known});
	bad.triangles.push_back({known + 1, 1, 2});
	bad.triangles.push_back({0, 0, 1});
	bad.triangles.push_back({0, 1, known + 3});
	bad.triangles.push_back({-1, 1, 2});
	const std::vector<Place> a = Find(clean), b = Find(bad);
	ASSERT_EQ(a.size(), b.size());
	for (size_t i = 0; i < a.size(); ++i) {
		EXPECT_EQ(a[i].position, b[i].position);
		EXPECT_EQ(a[i].size, b[i].size);
	}
}

TEST(AutoPlacement, NothingToLabelGivesNothing)
{
	EXPECT_TRUE(Find({}).empty());
	EXPECT_TRUE(Find({{Point3d(0, 0, 0), Point3d(1, 0, 0), Point3d(2, 0, 0)}, {{0, 1, 2}}}).empty());
	Triangles insideOut = SurfaceOf(Box(6, 2, 4));
	for (std::array<int, 3>& t : insideOut.triangles) std::swap(t[1], t[2]);
	EXPECT_TRUE(Find(insideOut).empty()) << "a face was labelled on its back";
	Text text;
	text.width = 0;
	EXPECT_TRUE(Find(SurfaceOf(Box(6, 2, 4)), text).empty());
	text.width = std::numeric_limits<double>::quiet_NaN();
	EXPECT_TRUE(Find(SurfaceOf(Box(6, 2, 4)), text).empty());
}

TEST(AutoPlacement, UnitAndOriginDoNotMatter)
{
	const Triangles part = SurfaceOf(Box(60, 20, 40));
	const std::vector<Place> places = Find(part);
	for (const double unit : {1e-6, 1e6}) {
		Triangles other = part;
		const Point3d offset = Point3d(3, -5, 7) * (1e4 * unit);
		for (Point3d& p : other.positions) p = p * unit + offset;
		const std::vector<Place> scaled = Find(other);
		ASSERT_EQ(scaled.size(), places.size());
		ExpectNear((scaled[0].position - offset) / unit, places[0].position, 1e-6);
		EXPECT_NEAR(scaled[0].size / unit, places[0].size, 1e-9 * places[0].size);
	}
}

// A colour beside another may be a flat label that is there already.
TEST(AutoPlacement, DoesNotRunAcrossColours)
{
	const BlockPart block = Box(60, 40, 10);
	const Triangles part = SurfaceOf(block);
	PlaceQuery query{part.positions, part.triangles};
	query.labelWidth = 2.3;
	query.labelHeight = 1;
	query.size = 8;
	query.up = {0, 1, 0};
	const Place middle = FirstPlaces(query, 1).at(0);
	EXPECT_NEAR(middle.position[0], 30, 2);
	EXPECT_NEAR(middle.position[1], 20, 2);
	const auto isPainted = [](const Point3d& p) {
		return p[2] == 10 && p[0] > 20 && p[0] < 40 && p[1] > 16 && p[1] < 24;
	};
	for (const auto& t : part.triangles) {
		const auto at = [&](size_t k) { return part.positions[size_t(t[k])]; };
		query.paint.push_back(isPainted((at(0) + at(1) + at(2)) / 3) ? 0x0000ff : 0xffffff);
	}
	const std::vector<Place> beside = FirstPlaces(query);
	ASSERT_FALSE(beside.empty());
	for (const Place& place : beside) {
		int painted = 0;
		for (const Point3d& p : BoxPoints(place, {query.labelWidth, query.labelHeight})) painted += isPainted(p);
		EXPECT_EQ(painted, 0) << place.position[0] << ", " << place.position[1] << ", " << place.position[2];
	}
	// where there is no room beside it, across is better than nowhere
	for (size_t f = 0; f < query.paint.size(); ++f) query.paint[f] = std::uint32_t(f);
	const std::vector<Place> across = FirstPlaces(query, 1);
	ASSERT_EQ(across.size(), 1u);
	EXPECT_EQ(across[0].position, middle.position);
}

TEST(AutoPlacement, OffersUntilOneIsTaken)
{
	const Triangles part = SurfaceOf(Box(60, 20, 40));
	PlaceQuery query{part.positions, part.triangles};
	query.labelWidth = 2.3;
	query.labelHeight = 1;
	const std::vector<Place> places = FirstPlaces(query);
	ASSERT_GE(places.size(), 3u);
	std::vector<Place> offered;
	EXPECT_TRUE(OfferPlaces(query, [&](const Place& place) {
		offered.push_back(place);
		return offered.size() == 2;
	}));
	ASSERT_EQ(offered.size(), 2u);
	for (size_t i = 0; i < 2; ++i) EXPECT_EQ(offered[i].position, places[i].position);
	EXPECT_FALSE(OfferPlaces(query, [](const Place&) { return false; }));
}

}  // namespace
}  // namespace textlabel::test
