// Labels wrapped round an axis: where their points come to, what they can't do, and that what comes out is a mesh.

#include "label_check.h"
#include "refusal_case.h"

namespace {

using namespace refusal_case;
using test_mesh::Shape;

constexpr double radius = 10;

/// From the front (+z) at a cylinder round y.
LabelFrame Round(double wrapRadius = radius)
{
	LabelFrame f;
	f.origin = {0, 0, std::abs(wrapRadius)};
	f.wrapRadius = wrapRadius;
	return f;
}

/// On the inside of a pipe round y, seen from its axis.
LabelFrame Inside()
{
	LabelFrame f;
	f.origin = {0, 0, -radius};
	f.wrapRadius = -radius;
	return f;
}

/// A pipe round y.
Shape Pipe(double inner, double outer, double length, int sides, int rings)
{
	Shape s;
	for (const double r : {outer, inner})
		for (int j = 0; j <= rings; ++j)
			for (int i = 0; i < sides; ++i) {
				const double a = 2 * M_PI * i / sides;
				s.add({r * std::sin(a), length * (double(j) / rings - 0.5), r * std::cos(a)});
			}
	const int in = (rings + 1) * sides;
	const auto at = [&](int i, int j) { return j * sides + i % sides; };
	for (int i = 0; i < sides; ++i) {
		for (int j = 0; j < rings; ++j) {
			s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
			s.quad(in + at(i + 1, j), in + at(i, j), in + at(i, j + 1), in + at(i + 1, j + 1));
		}
		s.quad(at(i, 0), in + at(i, 0), in + at(i + 1, 0), at(i + 1, 0));
		s.quad(in + at(i, rings), at(i, rings), at(i + 1, rings), in + at(i + 1, rings));
	}
	return s;
}

/// Three letters, and again, all the way round but for a gap.
Outline AllRound()
{
	Outline all;
	for (int i = -1; i <= 1; ++i)
		for (Contour c : Moved(ThreeLetters(), 1, 19.5 * i, 0).contours) {
			c.part += 4 * (i + 1);
			c.letter += 4 * (i + 1);
			all.contours.push_back(c);
		}
	all.partCount = 12;
	return all;
}

LabelOptions Raised(double height, ExtrudeAlong along = ExtrudeAlong::Viewpoint)
{
	LabelOptions options;
	options.height = height;
	options.along = along;
	return options;
}

TEST(LabelWrap, SpaceThereAndBack)
{
	for (const double turn : {0.0, M_PI / 2, 0.7})
		for (const double wrapRadius : {radius, -radius}) {
			LabelFrame f = Round(wrapRadius);
			f.u = {std::cos(turn), std::sin(turn), 0};
			f.v = {-std::sin(turn), std::cos(turn), 0};
			const LabelSpace space(f, {3, 1});
			EXPECT_TRUE(space.wraps());
			EXPECT_NEAR(space.circumference(), 2 * M_PI * radius, 1e-12);
			for (const Point3d& p : {Point3d(1, 2, 11), Point3d(-7, 5, 4), Point3d(4, -3, 9), Point3d(0.5, 0, 13)})
				EXPECT_LT((space.toMesh(space.toLabel(p)) - p).Norm(), 1e-12) << turn << ' ' << wrapRadius;
			// near the origin it is the frame itself
			for (const Point3d& p : {Point3d(1, 0, 0), Point3d(0, 1, 0), Point3d(0, 0, 1)}) {
				const Point3d q = space.toLabel(f.origin + p * 1e-5) * 1e5;
				EXPECT_LT((q - Point3d(p * f.u, p * f.v, p * f.w)).Norm(), 1e-5);
				EXPECT_LT((space.vectorToMesh(f.origin, {p * f.u, p * f.v, p * f.w}) - p).Norm(), 1e-12);
			}
		}
}

TEST(LabelWrap, ArcsAreAsLongAsInTheLabel)
{
	const LabelSpace space(Round());
	const double angle = 2.5;
	const Point3d q = space.toLabel({radius * std::sin(angle), 3, radius * std::cos(angle)});
	EXPECT_NEAR(q[0], radius * angle, 1e-12);
	EXPECT_NEAR(q[1], 3, 1e-12);
	EXPECT_NEAR(q[2], 0, 1e-12);
	const Point3d out = space.vectorToMesh({radius * std::sin(angle), 3, radius * std::cos(angle)}, {0, 0, 2});
	EXPECT_LT((out - Point3d(2 * std::sin(angle), 0, 2 * std::cos(angle))).Norm(), 1e-12);
}

TEST(LabelWrap, AllTheWayRound)
{
	const Shape shape = test_mesh::Cylinder(radius, 20, 64, 6);
	for (const double height : {0.0, 0.5, -0.5, 3.0, -3.0})
		for (const ExtrudeAlong along :
		     {ExtrudeAlong::Viewpoint, ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal}) {
			FloatMesh m;
			test_mesh::Fill(m, shape);
			LabelResult result;
			ASSERT_NO_THROW(result = LabelMesh(m, AllRound(), Round(), Raised(height, along))) << height;
			ExpectSameKind(shape, m);
			EXPECT_NEAR(result.labelArea, std::abs(Area(AllRound())), 1e-3);
			EXPECT_NEAR(result.surfaceArea, result.labelArea, 0.01 * result.labelArea);
			double least = 1e9, most = 0;
			for (const int f : result.topFaces)
				for (int k = 0; k < 3; ++k) {
					const auto& p = m.face[size_t(f)].cP(k);
					least = std::min(least, std::hypot(double(p[0]), double(p[2])));
					most = std::max(most, std::hypot(double(p[0]), double(p[2])));
				}
			EXPECT_NEAR(most, radius + height, 1e-5);
			EXPECT_GT(least, (radius + height) * std::cos(M_PI / 64) - 1e-5);  // as plane as the facets below
		}
}

// Facets of 60 and of 90 degrees: the corners unroll to elsewhere than the middles of the facets.
TEST(LabelWrap, RoundANutAndABox)
{
	for (const int sides : {4, 6, 12})  // a facet over the cut holds no letters
		for (const double height : {0.0, 0.4, -0.4}) {
			const Shape shape = test_mesh::Cylinder(radius, 20, sides, 1);
			FloatMesh m;
			test_mesh::Fill(m, shape);
			ASSERT_NO_THROW(LabelMesh(m, Moved(AllRound(), 0.6, 0, 0), Round(), Raised(height))) << sides;
			ExpectSameKind(shape, m);
		}
}

// A facet over the cut, and letters on it.
TEST(LabelWrap, OverTheCut)
{
	const Shape shape = test_mesh::Cylinder(radius, 20, 3, 1);
	EXPECT_CODE(Refused(shape, AllRound(), Round()), BehindCamera);
	EXPECT_CODE(Refused(shape, Letters({Rectangle(-22, -1, 22, 1)}), Round()), BehindCamera);
	for (const double height : {0.0, 0.4, -0.4}) {
		FloatMesh m;
		test_mesh::Fill(m, shape);
		ASSERT_NO_THROW(LabelMesh(m, Moved(ThreeLetters(), 2, 0, 0), Round(), Raised(height)));
		ExpectSameKind(shape, m);
	}
}

TEST(LabelWrap, AlongTheAxisAndAslant)
{
	const Shape shape = test_mesh::Cylinder(radius, 60, 48, 9);
	for (const double turn : {M_PI / 2, -M_PI / 2, 0.6, M_PI})
		for (const double height : {0.5, -0.5}) {
			LabelFrame f = Round();
			f.u = {std::cos(turn), std::sin(turn), 0};
			f.v = {-std::sin(turn), std::cos(turn), 0};
			FloatMesh m;
			test_mesh::Fill(m, shape);
			ASSERT_NO_THROW(LabelMesh(m, Moved(ThreeLetters(), 2, 0, 0), f, Raised(height))) << turn;
			ExpectSameKind(shape, m);
		}
}

TEST(LabelWrap, PipeFromOutsideAndFromInside)
{
	const Shape shape = Pipe(radius, radius + 1, 20, 50, 5);
	for (const bool inside : {false, true})
		for (const double height : {0.0, 0.5, -0.5}) {
			LabelFrame f = inside ? Inside() : Round(radius + 1);
			FloatMesh m;
			test_mesh::Fill(m, shape);
			ASSERT_NO_THROW(LabelMesh(m, AllRound(), f, Raised(height))) << inside << ' ' << height;
			ExpectSameKind(shape, m);
		}
}

TEST(LabelWrap, SunkThroughTheWall)
{
	const Shape shape = Pipe(radius, radius + 1, 20, 50, 5);
	const Error e = Refused(shape, AllRound(), Round(radius + 1), -1.5);
	EXPECT_CODE(e, HitsSurface);
	EXPECT_GT(e.limit, 0.5);
	EXPECT_LT(e.limit, 1);
}

// Label normals stay on the same cylinder's radii, so a label that rises inside a pipe to its axis has nowhere to go.
TEST(LabelWrap, RisesToTheAxis)
{
	const Shape shape = Pipe(radius, radius + 1, 20, 50, 5);
	EXPECT_CODE(Refused(shape, AllRound(), Inside(), radius), BehindCamera);
	EXPECT_CODE(Refused(test_mesh::Cylinder(radius, 20, 50, 5), AllRound(), Round(), -radius), BehindCamera);
}

TEST(LabelWrap, LongerThanTheWayRound)
{
	const Error e = Refused(test_mesh::Cylinder(radius, 20, 50, 5), Moved(AllRound(), 1.25, 0, 0), Round());
	EXPECT_CODE(e, TooLong);
	EXPECT_NEAR(e.limit, 2 * M_PI * radius, 1e-9);
	EXPECT_GT(e.value, e.limit);
}

// As far from the axis as it was measured at, and nearer.
TEST(LabelWrap, OnThinnerParts)
{
	for (const double part : {1.0, 0.3, 0.1}) {
		const Shape shape = test_mesh::Cylinder(part * radius, 20, 50, 5);
		FloatMesh m;
		if (part < LabelOptions().minStretch) {
			const Error e = Refused(shape, ThreeLetters(), Round());
			EXPECT_CODE(e, Squeezed);
			EXPECT_NEAR(e.value, part, 0.01 * part);
			EXPECT_EQ(e.limit, LabelOptions().minStretch);
			continue;
		}
		test_mesh::Fill(m, shape);
		const LabelResult result = LabelMesh(m, ThreeLetters(), Round(), Raised(0.1));
		EXPECT_NEAR(result.leastStretch, part, 0.01 * part);
		EXPECT_NEAR(result.surfaceArea, part * result.labelArea, 0.01 * part * result.labelArea);
	}
}

// A vertex on the diagonal of a nut's side, with a cap beside it: unrolling bends the diagonal, so that there the cap has an area.
TEST(LabelWrap, OverACapOnAWideFacet)
{
	Shape nut = test_mesh::Cylinder(radius, 10, 6, 1);
	const auto turn = [](const Point3d& p) { return std::atan2(p[0], p[2]) * 180 / M_PI; };
	const size_t faces = nut.faces.size();
	int capped = 0;
	for (size_t f = 0; f < faces && capped == 0; ++f)
		for (size_t k = 0; k < 3; ++k) {
			const int from = nut.faces[f][k], to = nut.faces[f][(k + 1) % 3];
			const Point3d a = nut.points[size_t(from)], b = nut.points[size_t(to)];
			const bool isDiagonal =
				std::abs(turn(a) + turn(b) - 60) < 1 && std::abs(turn(a) - turn(b)) > 50 && std::abs(a[1] - b[1]) > 9;
			if (!isDiagonal) continue;
			for (size_t g = 0; g < faces; ++g)
				for (size_t i = 0; i < 3; ++i) {
					auto& face = nut.faces[g];
					if (face[i] != to || face[(i + 1) % 3] != from) continue;
					const int beyond = face[(i + 2) % 3], middle = nut.add(a * 0.75 + b * 0.25);
					face = {to, middle, beyond};
					nut.faces.push_back({middle, from, beyond});
					nut.faces.push_back({to, from, middle});
					++capped;
					const double side = radius * std::cos(M_PI / 6);
					LabelFrame frame = Round(side);
					const Point3d towards(0.5, 0, std::sqrt(0.75));
					frame.w = towards;
					frame.u = frame.v ^ frame.w;
					frame.origin = towards * side;
					FloatMesh m;
					test_mesh::Fill(m, nut);
					const Point3d p = nut.points[size_t(middle)];
					const double u = p * frame.u, v = p[1];
					const Outline letter = Letters({Rectangle(u - 1, v - 0.8, u + 1.2, v + 1)});
					LabelResult result;
					ASSERT_NO_THROW(result = LabelMesh(m, letter, frame, Raised(0.3)));
					EXPECT_GT(result.leastStretch, 0.99);
					ExpectSameKind(nut, m);
					return;
				}
		}
	ADD_FAILURE() << "no diagonal";
}

// Anchored at its left end, the label reaches three quarters round to the right: the cut is opposite to its middle.
TEST(LabelWrap, AnchoredAtItsEnd)
{
	const Shape shape = test_mesh::Cylinder(radius, 20, 50, 5);
	FloatMesh m;
	test_mesh::Fill(m, shape);
	ASSERT_NO_THROW(LabelMesh(m, Moved(AllRound(), 1, 27, 0), Round(), Raised(0.5)));
	ExpectSameKind(shape, m);
}

// Over the lid of a solid cylinder, whose middle lies on the axis, and over that of one whose lid is open.
TEST(LabelWrap, OverTheEnd)
{
	const Shape shape = test_mesh::Cylinder(radius, 20, 50, 5);
	EXPECT_CODE(Refused(shape, Moved(AllRound(), 1, 0, 9), Round(), 0.5), OffSurface);
	EXPECT_CODE(Refused(shape, Letters({Rectangle(-1, 8, 1, 11)}), Round(), 0.5), BehindCamera);
	const Shape pipe = Pipe(radius, radius + 1, 20, 50, 5);
	EXPECT_CODE(Refused(pipe, Letters({Rectangle(-1, 8, 1, 11)}), Round(radius + 1), 0.5), Silhouette);
}

// A plate through the axis, across the letters: it can't be unrolled, but it must not be met.
TEST(LabelWrap, PlateThroughTheAxis)
{
	const Shape pipe = Pipe(radius, radius + 1, 20, 50, 5);
	const Shape plate =
		test_mesh::Box(19.5, 2, 2).moved([](const Point3d& p) { return Point3d(p[0], p[1], p[2] + 1); });
	const Shape both = pipe.joined(plate);
	FloatMesh m;
	test_mesh::Fill(m, both);
	ASSERT_NO_THROW(LabelMesh(m, AllRound(), Round(radius + 1), Raised(-0.5)));
	ExpectSameKind(both, m);
	EXPECT_CODE(Refused(both, AllRound(), Inside(), 0.4), Occluded);
}

TEST(LabelWrap, ALayerThatMirrorsAndScales)
{
	const Shape shape = test_mesh::Cylinder(radius, 20, 64, 6);
	LabelFrame f = Round(2 * radius);
	f.toWorld.ElementAt(0, 0) = -2;
	f.toWorld.ElementAt(1, 1) = f.toWorld.ElementAt(2, 2) = 2;
	FloatMesh m;
	test_mesh::Fill(m, shape);
	ASSERT_NO_THROW(LabelMesh(m, Moved(AllRound(), 2, 0, 0), f, Raised(1)));
	ExpectSameKind(shape, m);
	EXPECT_GT(Volume(test_mesh::ToShape(m)), Volume(shape));
}

// A letter whose corner rises to a corner of something that stands on the axis, and so has no place in the unrolled plane.
TEST(LabelWrap, TouchesWhatStandsOnTheAxis)
{
	Shape both = Pipe(2, 3, 6, 16, 2).moved([](Point3d p) {
		for (int k = 0; k < 3; ++k) p[k] = std::abs(p[k]) < 1e-9 ? 0 : p[k];
		return p;
	});
	const int first = int(both.points.size());
	for (const Point3d& p : {Point3d(1, 0, 0), Point3d(-1, 0, 0), Point3d(0, 1, 0), Point3d(0, -1, 0), Point3d(0, 0, 1),
	                         Point3d(0, 0, -1)})
		both.add(p);
	for (const std::array<int, 3>& f :
	     {std::array<int, 3>{2, 4, 0}, {2, 0, 5}, {2, 5, 1}, {2, 1, 4}, {3, 0, 4}, {3, 5, 0}, {3, 1, 5}, {3, 4, 1}})
		both.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
	LabelFrame f;
	f.origin = {0, 0, -2};
	f.wrapRadius = -2;
	FloatMesh m;
	test_mesh::Fill(m, both);
	LabelResult result;
	ASSERT_NO_THROW(result = LabelMesh(m, Letters({{{0, 0}, {0.6, 0}, {0.6, 0.5}, {0, 0.5}}}), f, Raised(1)));
	EXPECT_GT(result.attempts, 1);  // shifted, until they are two points
	ExpectSameKind(both, m);
}

// One facet of nearly half the way round: sunk, it would pass through the axis and meet what lies beyond.
TEST(LabelWrap, SunkBeyondTheAxis)
{
	Shape s;
	for (const Point3d& p : {Point3d(0, 1, 0.2), Point3d(-0.985, 0, 0.1736), Point3d(0.985, 0, 0.1736)}) s.add(p);
	s.faces = {{0, 1, 2}};
	const Error e = Refused(s, Letters({Rectangle(-0.3, 0.15, 0.3, 0.45)}), Round(1), -0.5);
	EXPECT_CODE(e, BehindCamera);
}

// A void in the middle of a prism, nearer to the axis than anything that can be unrolled.
TEST(LabelWrap, SinksRoundAVoid)
{
	for (const double z : {0.0008, 0.01}) {
		const Point3d c(0, 0.1, z);
		Shape hollow = test_mesh::Cylinder(1, 10, 3, 1).moved([](const Point3d& p) {
			return Point3d(std::cos(M_PI) * p[0], p[1], std::cos(M_PI) * p[2]);  // a facet in front
		});
		const int first = int(hollow.points.size());
		for (const Point3d& d : {Point3d(1, 1, 1), Point3d(-1, -1, 1), Point3d(-1, 1, -1), Point3d(1, -1, -1)})
			hollow.add(c + d * 5e-5);
		for (const std::array<int, 3>& f : {std::array<int, 3>{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})
			hollow.faces.push_back({f[0] + first, f[1] + first, f[2] + first});
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, hollow);
		Error error(ErrorCode::OutOfMemory);
		Refusal(m, Letters({Rectangle(-0.9, -1, 0.9, 1)}), Round(1), Raised(-0.9989), &error);
		EXPECT_NE(error.code, ErrorCode::OutOfMemory) << z;
	}
}

/// Of the faces of the letters, as the mesh has them.
double TopArea(const test_mesh::DoubleMesh& m, const LabelResult& r)
{
	double area = 0;
	for (const int f : r.topFaces) {
		const auto& face = m.face[size_t(f)];
		area += ((face.cP(1) - face.cP(0)) ^ (face.cP(2) - face.cP(0))).Norm() / 2;
	}
	return area;
}

// Further from the axis than the place, letters are wider; on a facet they are narrower at its ends and wider in its middle.
TEST(LabelWrap, AreaAndStretchAreThoseOfTheSurface)
{
	const auto label = [](const Shape& shape, const Outline& outline, const LabelFrame& frame, double most) {
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, shape);
		LabelOptions options;
		options.maxStretch = most;
		const LabelResult r = LabelMesh(m, outline, frame, options);
		EXPECT_NEAR(r.surfaceArea, TopArea(m, r), 1e-6 * r.surfaceArea);
		return r;
	};
	const Shape cone = test_mesh::Cylinder(1, 12, 64, 1).moved([](const Point3d& p) {
		const double r = p[1] + 7;  // 1 where the label is anchored, 10 where it is
		return Point3d(p[0] * r, p[1], p[2] * r);
	});
	LabelFrame frame = Round(1);
	frame.origin[1] = -6;
	const Outline square = Letters({Rectangle(-0.5, 9, 0.5, 10)});
	const LabelResult wide = label(cone, square, frame, 20);
	EXPECT_GT(wide.stretch, 10);
	EXPECT_GT(wide.surfaceArea, 10 * wide.labelArea);
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, cone);
	Error error(ErrorCode::OutOfMemory);
	Refusal(m, square, frame, Raised(0), &error);
	EXPECT_EQ(error.code, ErrorCode::Grazing);
	for (const int sides : {3, 4, 6}) {
		const LabelResult r =
			label(test_mesh::Cylinder(10, 20, sides, 1), Letters({Rectangle(-4, -2, 4, 2)}), Round(), 8);
		EXPECT_LT(r.surfaceArea, r.labelArea) << sides;
	}
}

TEST(LabelWrap, BeyondAllNumbers)
{
	Shape s = test_mesh::Cylinder(radius, 20, 16, 4);
	const int far = s.add({1.6e308, 0, 0}), high = s.add({0, 1, 0}), low = s.add({0, -1, 0});
	s.faces.push_back({far, high, low});
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, s);
	LabelFrame f = Round();
	f.toWorld.ElementAt(0, 0) = 0.999999;
	Error error(ErrorCode::OutOfMemory);
	EXPECT_NO_THROW(Refusal(m, Letters({Rectangle(-3, -3, 3, 3)}), f, Raised(0.5), &error));
}

TEST(LabelWrap, BadFrames)
{
	const auto refused = [](const std::function<void(LabelFrame&)>& spoil) {
		LabelFrame f = Round();
		spoil(f);
		return Refused(test_mesh::Cylinder(radius, 20, 64, 6), AllRound(), f);
	};
	EXPECT_CODE(refused([](LabelFrame& f) { f.wrapRadius = NAN; }), BadFrame);
	EXPECT_CODE(refused([](LabelFrame& f) { f.wrapRadius = INFINITY; }), BadFrame);
	EXPECT_CODE(refused([](LabelFrame& f) { f.wrapAxis = {0, 0, 1}; }), BadFrame);
	EXPECT_CODE(refused([](LabelFrame& f) { f.wrapAxis = {0, 2, 0}; }), BadFrame);
	EXPECT_CODE(refused([](LabelFrame& f) {
					f.perspective = true;
					f.center = {0, 0, 100};
				}),
	            BadFrame);
}

}  // namespace
