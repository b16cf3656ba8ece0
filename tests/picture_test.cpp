// Pictures against what geometry says about them: areas of silhouettes, which surface is in front, where a shadow falls.

#include "filter_textlabel/picture.h"
#include "filter_textlabel/picture_raster.h"
#include "filter_textlabel/picture_surface.h"

#include <QImage>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace textlabel;
using vcg::Point3d;

namespace {

constexpr double pi = 3.14159265358979323846;

PictureMesh Sphere(double radius, int rings)
{
	PictureMesh mesh;
	const int around = 2 * rings;
	const auto id = [&](int i, int j) { return i * around + j % around; };
	for (int i = 0; i <= rings; i++)
		for (int j = 0; j < around; j++) {
			const double a = pi * i / rings, b = 2 * pi * j / around;
			mesh.positions.push_back(Point3d(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)) *
			                         radius);
		}
	for (int i = 0; i < rings; i++)
		for (int j = 0; j < around; j++) {
			if (i > 0) mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i, j + 1)});
			if (i + 1 < rings) mesh.triangles.push_back({id(i, j + 1), id(i + 1, j), id(i + 1, j + 1)});
		}
	return mesh;
}

/// A box with its corners at 0 and `size`; each side has two triangles, normals outwards.
PictureMesh Box(const Point3d& size)
{
	PictureMesh mesh;
	for (int i = 0; i < 8; i++)
		mesh.positions.push_back({i & 1 ? size[0] : 0, i & 2 ? size[1] : 0, i & 4 ? size[2] : 0});
	mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
	                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
	return mesh;
}

void Append(PictureMesh& mesh, const PictureMesh& other, const Point3d& shift, PictureColor color, bool label = false)
{
	const int first = int(mesh.positions.size());
	for (const Point3d& p : other.positions) mesh.positions.push_back(p + shift);
	for (const auto& t : other.triangles) {
		mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
		mesh.colors.push_back(color);
		mesh.isLabel.push_back(label);
	}
}

PictureMesh Square(double half)
{
	PictureMesh mesh;
	mesh.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
	mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
	return mesh;
}

/// White on black without light: the sum of the pixels is the area of the silhouette.
PictureOptions Mask(int side, int samples)
{
	PictureOptions options;
	options.width = options.height = side;
	options.samples = samples;
	options.edges = PictureEdges::None;
	options.shaded = false;
	options.part = {255, 255, 255};
	options.backgroundTop = options.backgroundBottom = {0, 0, 0};
	return options;
}

PictureView ViewAlong(const Point3d& direction, const Point3d& up, double extent)
{
	PictureView view;
	view.direction = direction;
	view.up = up;
	view.extent = extent;
	return view;
}

/// Area of what a mask shows, mesh units squared.
double MaskArea(const Picture& picture, double extent)
{
	double covered = 0;
	for (size_t i = 0; i < picture.rgb.size(); i += 3) {
		const double v = picture.rgb[i] / 255.0;
		covered += v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
	}
	return covered * extent * extent / (picture.height * picture.height);
}

int Sum(const PictureColor& c) { return c[0] + c[1] + c[2]; }

const PictureColor red{255, 0, 0}, blue{0, 0, 255}, grey{180, 180, 180};

}  // namespace

TEST(Picture, SphereCoversItsDisc)
{
	const Picture picture = RenderPicture(Sphere(3, 100), ViewAlong({1, 2, 3}, {0, 0, 1}, 8), Mask(400, 2));
	EXPECT_NEAR(MaskArea(picture, 8), pi * 9, 0.003 * pi * 9);
}

TEST(Picture, SphereInPerspectiveCoversItsTangentCone)
{
	PictureView view = ViewAlong({1, 2, 3}, {0, 0, 1}, 10);
	view.distance = 6;
	const double expected = pi * 9 / (1 - 9.0 / 36);  // the cone's circle where it meets the plane of the focus
	EXPECT_NEAR(MaskArea(RenderPicture(Sphere(3, 100), view, Mask(400, 2)), 10), expected, 0.003 * expected);
}

TEST(Picture, CubeAlongItsDiagonalIsAHexagon)
{
	PictureView view = ViewAlong({1, 1, 1}, {0, 0, 1}, 8);
	view.focus = {2, 2, 2};
	EXPECT_NEAR(MaskArea(RenderPicture(Box({4, 4, 4}), view, Mask(400, 2)), 8), std::sqrt(3.0) * 16, 0.003 * 28);
}

TEST(Picture, RightAndUpAreWhereTheViewSays)
{
	PictureMesh mesh;
	Append(mesh, Square(0.5), {2, 0, 0}, red);
	Append(mesh, Square(0.5), {0, 3, 0}, blue);
	const Picture picture = RenderPicture(mesh, ViewAlong({0, 0, 1}, {0, 1, 0}, 10), Mask(100, 1));
	EXPECT_EQ(picture.at(70, 50), red);
	EXPECT_EQ(picture.at(50, 20), blue);
	EXPECT_EQ(picture.at(30, 50), (PictureColor{0, 0, 0}));
}

TEST(Picture, NearerSurfaceHidesFartherInEitherOrder)
{
	for (const double distance : {0.0, 20.0})
		for (const double redDepth : {-1.0, 1.0}) {
			PictureMesh mesh;
			Append(mesh, Square(2), {0, 0, redDepth}, red);
			Append(mesh, Square(2), {0, 0, 0}, blue);
			PictureView view = ViewAlong({0, 0, 1}, {0, 1, 0}, 6);
			view.distance = distance;
			EXPECT_EQ(RenderPicture(mesh, view, Mask(60, 2)).at(30, 30), redDepth > 0 ? red : blue);
		}
}

TEST(Picture, CrossingPlanesPartWhereTheyMeet)
{
	PictureMesh mesh;
	Append(mesh, Square(10), {0, 0, 0}, red);
	Append(mesh, Square(10), {0, 0, 0}, blue);
	for (size_t i = 0; i < 4; i++) mesh.positions[i][2] = 0.3 * mesh.positions[i][0] + 0.3;  // crosses z = 0 at x = -1
	PictureView view = ViewAlong({0, 0, 1}, {0, 1, 0}, 8);
	view.distance = 30;
	const Picture picture = RenderPicture(mesh, view, Mask(160, 1));
	for (int y = 5; y < 155; y += 10) {
		EXPECT_EQ(picture.at(58, y), blue) << y;
		EXPECT_EQ(picture.at(61, y), red) << y;
	}
}

TEST(Picture, NeighboursLeaveNoGap)
{
	std::mt19937 random(7);
	std::uniform_real_distribution<double> jitter(-0.4, 0.4);
	PictureMesh mesh;
	const int n = 40;
	for (int y = 0; y <= n; y++)
		for (int x = 0; x <= n; x++) mesh.positions.push_back({x + jitter(random), y + jitter(random), jitter(random)});
	for (int y = 0; y < n; y++)
		for (int x = 0; x < n; x++) {
			const int a = y * (n + 1) + x, b = a + n + 1;
			mesh.triangles.push_back({a, a + 1, b});
			mesh.triangles.push_back({a + 1, b + 1, b});
		}
	PictureView view = ViewAlong({0.1, 0.2, 1}, {0, 1, 0}, 30);
	view.focus = {20, 20, 0};
	const Picture picture = RenderPicture(mesh, view, Mask(300, 3));
	EXPECT_EQ(std::accumulate(picture.rgb.begin(), picture.rgb.end(), 0L), 255L * long(picture.rgb.size()));
}

TEST(Picture, SameBytesAgainAndFarFromTheOrigin)
{
	PictureOptions options;
	options.width = 320, options.height = 180;
	PictureMesh mesh = Sphere(3, 20);
	PictureView view = FitView(mesh, {1, -2, 1}, {0, 0, 1}, options);
	for (Point3d& p : mesh.positions)  // multiples of 2^-20 stay exact after the shift
		for (int k = 0; k < 3; k++) p[k] = std::ldexp(std::round(std::ldexp(p[k], 20)), -20);
	view.focus = {0.25, 0.5, 0};
	const Picture picture = RenderPicture(mesh, view, options);
	EXPECT_EQ(picture.rgb, RenderPicture(mesh, view, options).rgb);
	const Point3d shift(1048576, -2097152, 4194304);
	for (Point3d& p : mesh.positions) p += shift;
	view.focus += shift;
	EXPECT_EQ(picture.rgb, RenderPicture(mesh, view, options).rgb);
}

TEST(Picture, FitShowsEverythingAndFillsThePicture)
{
	PictureMesh mesh = Box({30, 8, 5});
	for (Point3d& p : mesh.positions) p += Point3d(500, -70, 3);
	for (const auto& [width, height] : {std::array<int, 2>{300, 200}, {200, 300}, {300, 60}}) {
		PictureOptions options = Mask(1, 1);
		options.width = width, options.height = height;
		const Picture picture = RenderPicture(mesh, FitView(mesh, {1, -1, 1}, {0, 0, 1}, options), options);
		int left = width, right = 0, top = height, bottom = 0;
		for (int y = 0; y < height; y++)
			for (int x = 0; x < width; x++)
				if (picture.at(x, y)[0]) {
					left = std::min(left, x), right = std::max(right, x);
					top = std::min(top, y), bottom = std::max(bottom, y);
				}
		EXPECT_GT(left, 0);
		EXPECT_GT(top, 0);
		EXPECT_LT(right, width - 1);
		EXPECT_LT(bottom, height - 1);
		EXPECT_GT(std::max(double(right - left) / width, double(bottom - top) / height), 0.84);
	}
}

// Large flats beside a narrow rounded edge: the light on the flat must not bend towards the rounding.
TEST(Picture, FlatsStayFlatBesideARounding)
{
	PictureMesh mesh;  // a bar along y whose section is a flat top, a rounding of 90 degrees in steps of 10, and a side
	std::vector<std::array<double, 2>> section = {{-10, 0}};
	for (int i = 0; i <= 9; i++) section.push_back({std::sin(i * pi / 18), std::cos(i * pi / 18) - 1});
	section.push_back({1, -10});
	for (const auto& p : section)
		for (const double y : {-10.0, 10.0}) mesh.positions.push_back({p[0], y, p[1]});
	for (int i = 0; i + 1 < int(section.size()); i++) {
		mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
		mesh.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
	}
	PictureOptions options;
	options.width = options.height = 200;
	options.edges = PictureEdges::None;
	PictureView view = ViewAlong({0, 0, 1}, {0, 1, 0}, 18);
	view.focus = {-5, 0, 0};
	const Picture picture = RenderPicture(mesh, view, options);
	const int middle = Sum(picture.at(100, 100));
	for (int x = 60; x < 152; x++) EXPECT_NEAR(Sum(picture.at(x, 100)), middle, 6) << x;
	EXPECT_GT(middle, Sum(picture.at(164, 100)) + 30);  // on the rounding, away from the light
}

TEST(Picture, ShadowFallsAwayFromTheLight)
{
	PictureMesh mesh;
	Append(mesh, Square(10), {0, 0, 0}, grey);
	Append(mesh, Square(1), {0, 0, 3}, grey);
	PictureOptions options;
	options.width = options.height = 200;
	options.edges = PictureEdges::None;
	const PictureView view = ViewAlong({0, 0, 1}, {0, 1, 0}, 16);
	const Picture picture = RenderPicture(mesh, view, options);
	options.shadows = false;
	const Picture plain = RenderPicture(mesh, view, options);
	// The light comes from the upper left, (-0.50, 0.62, 0.80): from 3 up the shadow's centre lies at (1.875, -2.325).
	EXPECT_LT(Sum(picture.at(123, 129)), Sum(plain.at(123, 129)) - 60);
	EXPECT_EQ(picture.at(77, 71), plain.at(77, 71));
	EXPECT_EQ(picture.at(30, 170), plain.at(30, 170));
}

TEST(Picture, CreasesAreDrawnAndFlatEdgesAreNot)
{
	PictureOptions options = Mask(100, 3);
	PictureView view = ViewAlong({1, 0, 1}, {0, 1, 0}, 8);
	view.focus = {4, 2, 4};
	for (const PictureEdges edges : {PictureEdges::Creases, PictureEdges::All}) {
		options.edges = edges;
		const Picture picture = RenderPicture(Box({4, 4, 4}), view, options);
		EXPECT_LT(picture.at(50, 50)[0], 200);  // the edge between the two sides that are seen
		EXPECT_EQ(picture.at(60, 40)[0], 255);
	}
	const Picture diagonal = RenderPicture(Box({4, 4, 4}), view, options);  // from (4,0,4) to (4,4,0) on one side
	EXPECT_LT(diagonal.at(68, 49)[0], 255);
	options.edges = PictureEdges::Creases;
	EXPECT_EQ(RenderPicture(Box({4, 4, 4}), view, options).at(68, 49)[0], 255);
}

TEST(PictureSurface, BoxHasTwelveCreases)
{
	PictureMesh box = Box({1, 2, 3});
	const auto count = [](const detail::PictureSurface& s, detail::EdgeKind kind) {
		return std::count(s.edges.begin(), s.edges.end(), kind);
	};
	const detail::PictureSurface surface = detail::AnalyseSurface(box, 32);
	EXPECT_EQ(count(surface, detail::EdgeKind::Crease), 24);  // each edge is seen from two faces
	EXPECT_EQ(count(surface, detail::EdgeKind::Flat), 12);
	box.isLabel.assign(12, 0);
	box.isLabel[0] = 1;  // a flat label has an outline too
	EXPECT_EQ(count(detail::AnalyseSurface(box, 32), detail::EdgeKind::Crease), 26);
}

TEST(PictureSurface, SphereHasRadialNormalsAlsoAsASoup)
{
	const PictureMesh sphere = Sphere(2, 24);
	PictureMesh soup;
	for (const auto& t : sphere.triangles) {
		const int n = int(soup.positions.size());
		for (int i : t) soup.positions.push_back(sphere.positions[size_t(i)]);
		soup.triangles.push_back({n, n + 1, n + 2});
	}
	const detail::PictureSurface surface = detail::AnalyseSurface(soup, 32);
	for (size_t i = 0; i < soup.positions.size(); i++) {
		const Point3d radial = soup.positions[i] / 2;
		EXPECT_GT(radial * Point3d::Construct(surface.cornerNormals[i]), std::cos(5 * pi / 180)) << i;
	}
}

TEST(LabelPicture, ChoosesTheSideWhereNothingHidesTheLabel)
{
	for (const double side : {-1.0, 1.0}) {
		PictureMesh mesh;
		Append(mesh, Square(10), {0, 0, 0}, grey);
		Append(mesh, Square(2), {0, 0, 0.1}, red, true);
		Append(mesh, Box({1, 18, 12}), {side * 3.5 - 0.5, -9, 0}, grey);  // a wall beside the label
		PictureOptions options;
		options.width = 640, options.height = 360, options.samples = 1, options.shaded = false;
		options.edges = PictureEdges::None;
		const Picture picture = RenderLabelPicture(mesh, {0, 0, 1}, {0, 1, 0}, options);
		int whole = 0, upper = 0, lower = 0;
		for (int y = 0; y < 360; y++)
			for (int x = 0; x < 640; x++)
				if (picture.at(x, y) == red) (x < 400 ? whole : y < 180 ? upper : lower)++;
		EXPECT_GT(whole, 1000) << side;
		EXPECT_GT(upper, 5000) << side;
		EXPECT_GT(lower, 5000) << side;
	}
}

TEST(Picture, EmptyAndUnfinishedMeshesGiveTheBackground)
{
	const PictureOptions options = Mask(20, 1);
	const std::vector<std::uint8_t> black(20 * 20 * 3, 0);
	PictureMesh mesh;
	EXPECT_EQ(RenderPicture(mesh, FitView(mesh, {0, 0, 1}, {0, 1, 0}, options), options).rgb, black);
	EXPECT_EQ(RenderLabelPicture(mesh, {0, 0, 1}, {0, 1, 0}, options).rgb, black);
	mesh = Square(1);
	for (Point3d& p : mesh.positions) p[0] = std::numeric_limits<double>::quiet_NaN();
	EXPECT_EQ(RenderPicture(mesh, FitView(mesh, {0, 0, 1}, {0, 1, 0}, options), options).rgb, black);
}

TEST(Picture, WrongInputIsRefused)
{
	PictureMesh mesh = Square(1);
	const PictureView view = ViewAlong({0, 0, 1}, {0, 1, 0}, 2);
	EXPECT_THROW(RenderPicture(mesh, ViewAlong({0, 0, 1}, {0, 0, 2}, 2), Mask(9, 1)), std::invalid_argument);
	EXPECT_THROW(RenderPicture(mesh, ViewAlong({0, 0, 1}, {0, 1, 0}, 0), Mask(9, 1)), std::invalid_argument);
	EXPECT_THROW(RenderPicture(mesh, view, Mask(0, 1)), std::invalid_argument);
	mesh.colors.push_back(red);
	EXPECT_THROW(RenderPicture(mesh, view, Mask(9, 1)), std::invalid_argument);
	mesh.colors.clear();
	mesh.triangles.push_back({0, 1, 4});
	EXPECT_THROW(RenderPicture(mesh, view, Mask(9, 1)), std::invalid_argument);
}

// A small label on a large part: the faces around it reach far out of the picture.
TEST(Picture, FacesFarLargerThanThePictureAreSeen)
{
	for (const double half : {3.0, 3e3, 1e6, 1e9, 1e13})
		for (const double shift : {0.0, 0.4}) {
			PictureMesh mesh;
			Append(mesh, Square(half), {shift * half, -shift * half, 0}, red);
			Append(mesh, Square(0.5), {0, 0, 1}, blue);
			const Picture picture = RenderPicture(mesh, ViewAlong({0.3, 0.2, 1}, {0, 1, 0}, 2), Mask(33, 1));
			int blues = 0, others = 0;
			for (int y = 0; y < 33; y++)
				for (int x = 0; x < 33; x++) {
					blues += picture.at(x, y) == blue;
					others += picture.at(x, y) != blue && picture.at(x, y) != red;
				}
			EXPECT_EQ(others, 0) << half;
			EXPECT_GT(blues, 100) << half;
		}
}

TEST(WritePicture, PngHoldsThePixels)
{
	PictureMesh mesh;
	Append(mesh, Square(1), {0, 0, 0}, red);
	PictureOptions options = Mask(31, 1);  // a width whose rows do not end on a multiple of four bytes
	const Picture picture = RenderPicture(mesh, ViewAlong({0, 0, 1}, {0, 1, 0}, 3), options);
	const std::string path = testing::TempDir() + "textlabel-picture-\xc3\xa4 1.png";
	ASSERT_TRUE(WritePicture(picture, path));
	const QImage image(QString::fromStdString(path));
	ASSERT_EQ(image.width(), 31);
	ASSERT_EQ(image.height(), 31);
	for (int y = 0; y < 31; y++)
		for (int x = 0; x < 31; x++) {
			const QRgb p = image.pixel(x, y);
			EXPECT_EQ(picture.at(x, y),
			          (PictureColor{std::uint8_t(qRed(p)), std::uint8_t(qGreen(p)), std::uint8_t(qBlue(p))}));
		}
	std::remove(path.c_str());
	EXPECT_FALSE(WritePicture(picture, testing::TempDir() + "no/such/folder/picture.png"));
}
