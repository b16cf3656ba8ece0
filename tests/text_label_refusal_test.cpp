// Every error of a request, a mesh and a place: provoked by an input that a user could bring, with the right words, and the mesh as
// it was. What is too steep is in text_label_steep_test.cpp, what would come out wrong in text_label_refused_result_test.cpp.

#include "refusal_case.h"

namespace {

using namespace refusal_case;
using test_mesh::Shape;

Shape FlatSheet(double size)
{
	return test_mesh::Sheet(10, 10, [&](int i, int j) { return Point3d(size * (i - 5), size * (j - 5), 0); });
}

// ---- the request ----

TEST(Refusal, EmptyLabel) { EXPECT_CODE(Refused(Plate(), Outline{}), EmptyLabel); }

TEST(Refusal, ContourOfTwoPoints)
{
	const Error e = Refused(Plate(), Letters({Rectangle(-5, -2, -3, 2), {{0, 0}, {1, 0}}}));
	EXPECT_CODE(e, BadContour);
}

TEST(Refusal, ContourThatIsNotFinite)
{
	for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
		Outline o = Letters({Rectangle(-5, -2, -3, 2), Rectangle(0, -2, 2, 2)});
		o.contours[1].points[2][0] = bad;
		const Error e = Refused(Plate(), o);
		EXPECT_CODE(e, BadContour);
		EXPECT_EQ(e.letter, 1);
	}
}

// What no text gives, but a caller of the library could: it has to be found, not written into the mesh.
TEST(Refusal, ContoursThatAreNoLetters)
{
	const std::vector<std::pair<std::string, Outline>> bad = {
		{"clockwise letter", Letters({Hole(Rectangle(-3, -3, 3, 3))})},
		{"bow tie", Letters({{{-3, -3}, {3, 3}, {3, -3}, {-3, 4}}})},
		{"crossing letters", Letters({Rectangle(-3, -3, 1, 3), Rectangle(-1, -2, 4, 2)})},
		{"letter in a letter", Letters({Rectangle(-3, -3, 3, 3), Rectangle(-1, -1, 1, 1)})},
		{"hole beside its letter", Letters({Rectangle(-5, -3, -1, 3), Hole(Rectangle(1, -1, 3, 1))})},
		{"hole across its letter", Letters({Rectangle(-5, -3, -1, 3), Hole(Rectangle(-2, -1, 3, 1))})},
		{"the same letter twice", Letters({Rectangle(-3, -3, 3, 3), Rectangle(-3, -3, 3, 3)})},
	};
	for (const Shape& shape : {Plate(), test_mesh::Box(60, 60, 4)})
		for (const auto& [name, outline] : bad)
			for (const double height : {1.0, -1.0, 0.0}) {
				SCOPED_TRACE(name);
				EXPECT_CODE(Refused(shape, outline, {}, height), BadContour);
			}
}

TEST(Refusal, BadFrames)
{
	const auto frameWith = [](const std::function<void(LabelFrame&)>& spoil) {
		LabelFrame f;
		spoil(f);
		return f;
	};
	const std::vector<LabelFrame> frames = {
		frameWith([](LabelFrame& f) { f.origin[1] = std::nan(""); }),
		frameWith([](LabelFrame& f) {
			f.u = {2, 0, 0};
		}),
		frameWith([](LabelFrame& f) {
			f.u = {0, 0, 0};
		}),
		frameWith([](LabelFrame& f) {
			f.w = {0, 0, -1};
		}),
		frameWith([](LabelFrame& f) { f.v = f.u; }),
		frameWith([](LabelFrame& f) { f.perspective = true; }),
		frameWith([](LabelFrame& f) {
			f.perspective = true;
			f.center = {0, 0, -10};
		}),
		frameWith([](LabelFrame& f) {
			f.perspective = true;
			f.center = {0, 0, std::numeric_limits<double>::infinity()};
		}),
		frameWith([](LabelFrame& f) { f.toWorld.ElementAt(2, 2) = 0; }),
		frameWith([](LabelFrame& f) { f.toWorld.ElementAt(0, 3) = std::nan(""); }),
	};
	for (size_t i = 0; i < frames.size(); ++i) {
		SCOPED_TRACE(i);
		EXPECT_CODE(Refused(Plate(), ThreeLetters(), frames[i]), BadFrame);
	}
}

TEST(Refusal, BadHeights)
{
	const double infinity = std::numeric_limits<double>::infinity();
	for (const double height : {std::nan(""), infinity, -infinity, 1e30, 1000.0})
		EXPECT_CODE(Refused(Plate(), ThreeLetters(), {}, height), BadHeight);
}

// What has been deleted, or belongs to no place, does not make the part larger.
TEST(Refusal, HigherThanWhatIsLeftOfThePart)
{
	FloatMesh m;
	test_mesh::Fill(m, Plate());
	auto far = vcg::tri::Allocator<FloatMesh>::AddVertices(m, 2);
	far->P() = {0, 0, 1e6f};
	(++far)->P() = {0, std::nanf(""), 0};
	vcg::tri::Allocator<FloatMesh>::DeleteVertex(m, m.vert[m.vert.size() - 2]);
	LabelOptions options;
	options.height = 1000;
	const Error e = RefusedMesh(m, ThreeLetters(), FromAbove(), options);
	EXPECT_CODE(e, BadHeight);
	EXPECT_NEAR(e.limit, std::sqrt(30.0 * 30 + 20 * 20 + 4 * 4), 1e-3);
}

// ---- the mesh ----

TEST(Refusal, MoreThanCanBeNumbered)
{
	constexpr size_t most = size_t(std::numeric_limits<int>::max()) / 4;
	EXPECT_NO_THROW(vcg::textlabel::RequireCountable(most, most));
	for (const auto& [vertices, faces] : {std::pair{most + 1, size_t(1)}, {size_t(3), most + 1}}) {
		try {
			vcg::textlabel::RequireCountable(vertices, faces);
			ADD_FAILURE() << "no error";
		} catch (const Error& e) {
			EXPECT_CODE(e, TooLarge);
			EXPECT_EQ(e.value, double(most + 1));
			EXPECT_EQ(e.limit, double(most));
		}
	}
}

TEST(Refusal, EmptyMeshes)
{
	EXPECT_CODE(Refused(Shape{}, ThreeLetters()), EmptyMesh);
	Shape cloud = Plate();
	cloud.faces.clear();
	EXPECT_CODE(Refused(cloud, ThreeLetters()), EmptyMesh);
	const Shape nowhere = Plate().moved([](const Point3d& p) { return Point3d(p[0], p[1], std::nan("")); });
	EXPECT_CODE(Refused(nowhere, ThreeLetters()), EmptyMesh);
}

// ---- the place ----

TEST(Refusal, BesideThePart)
{
	const Error e = Refused(Plate(), Letters({Rectangle(-5, -2, -3, 2), Rectangle(20, -2, 22, 2)}));
	EXPECT_CODE(e, OffSurface);
	EXPECT_EQ(e.letter, 1);
	ExpectPlace(e, {20, 0, 0}, 3);
}

TEST(Refusal, PartThatShowsItsBack)
{
	Shape inside = Plate();
	for (auto& f : inside.faces) std::swap(f[1], f[2]);
	const Error e = Refused(inside, ThreeLetters());
	EXPECT_CODE(e, FacesAway);
	EXPECT_GE(e.letter, 0);
	ASSERT_GE(e.face, 0);
	ExpectPlace(e, {0, 0, 0}, 8);

	LabelFrame below;
	below.u = {-1, 0, 0};
	below.w = {0, 0, -1};
	EXPECT_CODE(Refused(FlatSheet(4), ThreeLetters(), below), FacesAway);
}

// A letter that finds nothing but a back is told so, however deep that lies.
TEST(Refusal, LetterOverADeepBack)
{
	Shape back = FlatSheet(2).moved([](const Point3d& p) { return p + Point3d(50, 0, -200); });
	for (auto& f : back.faces) std::swap(f[1], f[2]);
	const Outline letters = Letters({Rectangle(-5, -2, -3, 2), Rectangle(48.7, -1, 51, 1)});
	const Error e = Refused(Plate().joined(back), letters);
	EXPECT_CODE(e, FacesAway);
	EXPECT_EQ(e.letter, 1);
	ExpectPlace(e, {50, 0, -200}, 2);
	EXPECT_CODE(Refused(Plate(), letters), OffSurface);
}

TEST(Refusal, OverTheBorder)
{
	const Outline letters = Letters({Rectangle(-5, -2, -3, 2), Rectangle(18, 1, 22, 3)});  // the sheet ends at 20
	const Error e = Refused(FlatSheet(4), letters);
	EXPECT_CODE(e, Border);
	EXPECT_EQ(e.letter, 1);
	ExpectPlace(e, {20, 2, 0}, 2);
}

TEST(Refusal, AroundAHole)
{
	Shape sheet = FlatSheet(4);
	sheet.faces.erase(sheet.faces.begin() + 2 * 55);  // half of the square (0,0)-(4,4), well within the letter
	const Error e = Refused(sheet, Letters({Rectangle(-7, -7, 9, 9)}));
	EXPECT_CODE(e, Border);
	EXPECT_EQ(e.letter, 0);
	ExpectPlace(e, {2, 2, 0}, 3);
}

TEST(Refusal, OverTheEdgeOfABox)
{
	const Error e = Refused(Plate(), Letters({Rectangle(-5, -2, -3, 2), Rectangle(13, 1, 17, 3)}));
	EXPECT_CODE(e, Silhouette);
	EXPECT_EQ(e.letter, 1);
	ExpectPlace(e, {15, 2, 0}, 2);
}

// Where a contour leaves a long edge, from either of its sides.
TEST(Refusal, SaysWhereAlongAnEdge)
{
	const Shape cube = test_mesh::Box(100, 100, 100);
	Shape turned = cube;
	std::reverse(turned.faces.begin(), turned.faces.end());
	for (const Shape* shape : {&cube, static_cast<const Shape*>(&turned)})
		for (const double y : {-40.0, 30.0}) {
			const Error e = Refused(*shape, Letters({Rectangle(37, y - 1, 53, y + 1)}));
			EXPECT_CODE(e, Silhouette);
			ExpectPlace(e, {50, y, 0}, 1.5);
		}
}

TEST(Refusal, OverTheHorizonOfABall)
{
	const Shape ball = test_mesh::Sphere(12, 60, 40);
	EXPECT_CODE(Refused(ball, Letters({Rectangle(-2, -2, 11.9, 2)})), Silhouette);
	const Error e = Refused(ball, Letters({Rectangle(-20, -20, 20, 20)}));
	EXPECT_CODE(e, OffSurface);
}

TEST(Refusal, FinUnderALetter)
{
	Shape fin = Plate();
	// a third face on the edge from (0,0) to (2,0), standing on it
	const auto at = [&](double x, double y) {
		for (size_t i = 0; i < fin.points.size(); ++i)
			if ((fin.points[i] - Point3d(x, y, 0)).Norm() < 1e-9) return int(i);
		return -1;
	};
	const int a = at(-1, 0), b = at(1, 0);
	ASSERT_GE(std::min(a, b), 0);
	fin.faces.push_back({a, b, fin.add({0, 0, 3})});
	for (const Outline& letter : {Letters({Rectangle(-3, -3, 3, 3)}), Letters({Rectangle(-0.5, -3, 0.5, 3)})}) {
		const Error e = Refused(fin, letter);
		EXPECT_CODE(e, NonManifold);
		EXPECT_EQ(e.letter, 0);
		ExpectPlace(e, {0, 0, 0}, 1.5);
	}
}

TEST(Refusal, NeighboursOfOppositeOrientation)
{
	Shape plate = Plate();
	const size_t index = 2 * (5 * 15 + 7);  // one of the two triangles around (0, 1)
	std::swap(plate.faces[index][1], plate.faces[index][2]);
	const Error e = Refused(plate, Letters({Rectangle(-5, -4, 5, 5)}));
	EXPECT_CODE(e, NonManifold);
	ExpectPlace(e, {0, 1, 0}, 2);
}

TEST(Refusal, PlateThatHovers)
{
	const Shape hovering = test_mesh::Box(1, 1, 0.5).moved([](const Point3d& p) { return p + Point3d(0, 0, 5); });
	const Shape both = Plate().joined(hovering);
	const int first = int(Plate().faces.size());
	const Error e = Refused(both, Letters({Rectangle(-3, -3, 3, 3)}));
	EXPECT_CODE(e, Occluded);
	EXPECT_GE(e.face, first);
	EXPECT_EQ(e.letter, 0);
	ExpectPlace(e, {0, 0, 0}, 6);
	// and when the letter's contour runs under it
	const Error under = Refused(both, Letters({Rectangle(-3, -3, 0, 3)}));
	EXPECT_CODE(under, Occluded);
	// in the hole of the letter it does no harm
	FloatMesh m;
	test_mesh::Fill(m, both);
	EXPECT_NO_THROW(LabelMesh(m, Letters({Rectangle(-3, -3, 3, 3), Hole(Rectangle(-2, -2, 2, 2))}), FromAbove()));
}

// A spiral staircase: from storey to storey it covers itself, and no edge leads out of it.
TEST(Refusal, StaircaseThatCoversItself)
{
	const Shape stairs = test_mesh::Helicoid(4, 20, 3, 2.5, 120, 8);
	const std::vector<Point2d> around = RegularPolygon(0, 0, 15, 60), within = Hole(RegularPolygon(0, 0, 8, 60));
	for (const double height : {0.5, -0.5, 0.0}) {
		const Error e = Refused(stairs, Letters({around, within}), {}, height);
		EXPECT_TRUE(e.code == ErrorCode::Occluded || e.code == ErrorCode::Border) << int(e.code) << ' ' << e.what();
	}
	// on the top storey there is room
	FloatMesh m;
	test_mesh::Fill(m, stairs);
	const Shape before = test_mesh::ToShape(m);
	LabelOptions options;
	options.height = 0.5;
	LabelMesh(m, Letters({Rectangle(-14, -3, -8, -1)}), FromAbove(), options);
	ExpectSameKind(before, m);
}

TEST(Refusal, RampThatRisesBehindTheCamera)
{
	const Shape ramp =
		test_mesh::Sheet(1, 1, [](int i, int j) { return Point3d(100 * i - 50, 100 * j - 50, 60.0 * i - 30); });
	EXPECT_CODE(Refused(ramp, Letters({Rectangle(-1, -1, 1, 1)}), FromAbovePerspective(20)), BehindCamera);
}

// The same in strips: the letter starts on one that is seen whole, and runs to one that is not.
TEST(Refusal, StripsThatRiseBehindTheCamera)
{
	const Shape top =
		test_mesh::Sheet(10, 1, [](int i, int j) { return Point3d(10 * i - 50, 100 * j - 50, 6.0 * i - 30); });
	const Shape ramp = test_mesh::Thickened(top, 10, 1, {0, 0, -40});
	EXPECT_CODE(Refused(ramp, Letters({Rectangle(-1, -1, 400, 1)}), FromAbovePerspective(20), 0.1), BehindCamera);
}

/// A plate with a triangle that stands on its vertex (1, 0, 0) and reaches up to z = 30.
Shape Fin(const Point3d& a, const Point3d& b)
{
	Shape fin = Plate();
	const auto under = std::find_if(fin.points.begin(), fin.points.end(),
	                                [](const Point3d& p) { return (p - Point3d(1, 0, 0)).Norm() < 1e-9; });
	const int foot = int(under - fin.points.begin()), first = fin.add(a), second = fin.add(b);
	fin.faces.push_back({foot, first, second});
	return fin;
}

// A vertex under the letter belongs to a triangle that reaches behind the camera too: it would be dragged along.
TEST(Refusal, AFinThatReachesBehindTheCamera)
{
	const Outline letter = Letters({Rectangle(-1.5, -1.5, 1.5, 1.5)});
	const Shape edgeOn = Fin({1, 0, 30}, {0.5, 0, 30}), across = Fin({1, 0.5, 30}, {1, -0.5, 30});
	EXPECT_CODE(Refused(edgeOn, letter, FromAbovePerspective(20), -0.5), NonManifold);
	const Error hidden = Refused(across, letter, FromAbovePerspective(20), -0.5);
	EXPECT_CODE(hidden, Occluded);
	EXPECT_EQ(hidden.face, int(across.faces.size()) - 1);
}

// A lid over the label that reaches behind the camera is seen in part, and hides what is below it; one that is behind the plate does not.
TEST(Refusal, UnderALidThatReachesBehindTheCamera)
{
	for (const double bottom : {2.0, -30.0}) {
		Shape both = test_mesh::Slab(20, 20, 2, 10, 10);
		const int a = both.add({-6, -6, bottom}), b = both.add({6, -6, bottom}), c = both.add({0, 60, bottom + 50}),
				  d = both.add({0, 40, bottom + 20});
		for (const std::array<int, 3>& f : {std::array<int, 3>{a, b, c}, {a, c, d}, {b, d, c}, {a, d, b}})
			both.faces.push_back(f);
		const Outline letter = Letters({Rectangle(-1, -1, 1, 1)});
		for (const double height : {0.5, 0.0}) {
			if (bottom > 0) {
				EXPECT_CODE(Refused(both, letter, FromAbovePerspective(10), height), Occluded);
				continue;
			}
			FloatMesh m;
			test_mesh::Fill(m, both);
			LabelOptions options;
			options.height = height;
			EXPECT_NO_THROW(LabelMesh(m, letter, FromAbovePerspective(10), options));
		}
	}
}

// A long bar runs over a hole, far from its corners and near to a dot.
TEST(Refusal, NamesTheLetterThatIsWrongAndNotOneBesideIt)
{
	Shape holed = FlatSheet(2);
	const auto isHole = [&](const std::array<int, 3>& f) {
		const Point3d middle =
			(holed.points[size_t(f[0])] + holed.points[size_t(f[1])] + holed.points[size_t(f[2])]) / 3;
		return middle[0] > 0 && middle[0] < 2 && middle[1] > 0 && middle[1] < 2;
	};
	holed.faces.erase(std::remove_if(holed.faces.begin(), holed.faces.end(), isHole), holed.faces.end());
	const Error e = Refused(holed, Letters({Rectangle(-9, 0.5, 9, 1.5), RegularPolygon(0.5, -0.6, 0.4, 24)}));
	EXPECT_CODE(e, Border);
	EXPECT_EQ(e.letter, 0);
}

// A plate covers the label once, and the first letter stands on it; the second stands on a sheet that dips into the plate.
TEST(Refusal, LetterThatDipsIntoAnotherSurface)
{
	const Shape sheet = test_mesh::Sheet(
		1, 1, [](int i, int j) { return Point3d(5 + 6 * i, 4 * j - 2, 0.6 - 1.2 * i); });  // at z = 0 where x is 8
	const Shape both = Plate().joined(sheet);
	const Outline letters = Letters({Rectangle(-4.7, -0.9, -3, 1), Rectangle(6.2, -0.9, 10, 1)});
	for (const double height : {0.0, 0.3}) EXPECT_CODE(Refused(both, letters, {}, height), Occluded);
	FloatMesh m;
	test_mesh::Fill(m, both);
	EXPECT_NO_THROW(LabelMesh(m, Letters({Rectangle(-4.7, -0.9, -3, 1), Rectangle(6.2, -0.9, 7.5, 1)}), FromAbove()));
}

// Of several letters it is one of the two that cross.
TEST(Refusal, NamesALetterThatCrossesAnother)
{
	const Error e = Refused(Plate(), Letters({Rectangle(-9, -3, -7, 3), Rectangle(-3, -1, 3, 1),
	                                          Rectangle(-1, -3, 1, 3), Rectangle(6, -3, 8, 3)}));
	EXPECT_CODE(e, BadContour);
	EXPECT_TRUE(e.letter == 1 || e.letter == 2) << e.letter;
}

// What the coordinates do not carry is shown on the surface, wherever the label plane is.
TEST(Refusal, TooFineNamesAPlaceOnTheSurface)
{
	// at 1e6 float32 goes in steps of 1/16, and the squares are two of them wide
	const Shape far = test_mesh::Slab(8, 8, 4, 64, 64).moved([](const Point3d& p) { return p + Point3d(1e6, 1e6, 0); });
	const LabelFrame frame = FrameFromDirection({1e6, 1e6, -3}, {0, 0, 1}, {0, 1, 0});
	const Error e = Refused(far, Letters({RegularPolygon(0, 0, 3, 30)}), frame, 1);
	EXPECT_CODE(e, TooFine);
	ExpectPlace(e, {1e6, 1e6, 0}, 5);
	EXPECT_NEAR(e.place[2], 0, 0.01);
}

}  // namespace
