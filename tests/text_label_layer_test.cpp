// Layers with a matrix, far and tiny parts, MeshLab's own mesh: the same label in other coordinates is the same label.

#include "vcg_ext/text_label.h"

#include <gtest/gtest.h>
#include <random>

#include "label_check.h"
#include "test_mesh.h"

#if defined(MESHLAB_SCALAR) && __has_include("common/ml_mesh_type.h")
#include "common/ml_mesh_type.h"  // of 2020; that of later ones needs MeshLab's library
#define HAS_MESHLAB_MESH
#endif

namespace {

using namespace label_check;
using test_mesh::Shape;

Shape Part() { return test_mesh::Slab(30, 20, 4, 15, 10); }

// The label is cut in world coordinates; the mesh is stored before the layer's matrix. Volume, in mesh units, is that of the world
// divided by the matrix's determinant, whatever the matrix: a shear, a scale, a mirror.
TEST(Layer, VolumeIsThatOfTheWorld)
{
	struct Matrix {
		Point3d x, y, z;
	};
	const std::vector<Matrix> matrices = {
		{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}},          {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
		{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},         {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
		{{1e-3, 0, 0}, {0, 1e-3, 0}, {0, 0, 1e-3}}, {{1, 0.2, 0}, {0.1, 0.5, 0}, {0.3, 0.1, 3}},
	};
	for (const Matrix& a : matrices)
		for (const double height : {0.75, -0.75}) {
			const double det = (a.x ^ a.y) * a.z, size = std::cbrt(std::abs(det));
			LabelFrame frame;
			for (int i = 0; i < 3; ++i) {
				frame.toWorld.ElementAt(i, 0) = a.x[i];
				frame.toWorld.ElementAt(i, 1) = a.y[i];
				frame.toWorld.ElementAt(i, 2) = a.z[i];
				frame.toWorld.ElementAt(i, 3) = 5.0 - i;
			}
			frame.origin = {5, 4, 3 + (a.z[2] < 0 ? 4 * std::abs(a.z[2]) : 0)};
			const Outline letters = Moved(ThreeLetters(), 0.5 * size, 0.01 * size, 0);
			test_mesh::FloatMesh m;
			test_mesh::Fill(m, Part());
			const Shape before = test_mesh::ToShape(m);
			LabelOptions options;
			options.height = height * size;
			Error error(ErrorCode::Cancelled);
			ASSERT_EQ(Refusal(m, letters, frame, options, &error), "no error")
				<< "determinant " << det << ", code " << int(error.code);
			ExpectSameKind(before, m);
			const double expected = Area(letters) * options.height / std::abs(det);
			EXPECT_NEAR(Volume(test_mesh::ToShape(m)) - Volume(before), expected, 1e-4 * std::abs(expected))
				<< "determinant " << det;
		}
}

// Turned, moved and scaled together, part and frame give the same label: the same counts, the same volume in units of the scale.
TEST(Layer, LabelMovesWithThePart)
{
	std::mt19937 random(1);
	std::uniform_real_distribution<double> unit(-1, 1);
	test_mesh::DoubleMesh reference;
	test_mesh::Fill(reference, Part());
	LabelOptions options;
	options.height = 0.75;
	const LabelResult expected = LabelMesh(reference, ThreeLetters(), FromAbove(), options);
	for (const double scale : {1e-6, 1.0, 1e5})
		for (int n = 0; n < 5; ++n) {
			const LabelFrame turned = FrameFromDirection({0, 0, 0}, {unit(random), unit(random), unit(random)},
			                                             {unit(random), unit(random), unit(random)});
			const Point3d shift = Point3d(unit(random), unit(random), unit(random)) * (scale * 100);
			const auto place = [&](const Point3d& p) {
				return (turned.u * p[0] + turned.v * p[1] + turned.w * p[2]) * scale + shift;
			};
			test_mesh::FloatMesh m;
			test_mesh::Fill(m, Part().moved(place));
			const Shape before = test_mesh::ToShape(m);
			LabelFrame frame = turned;
			frame.origin = shift;
			LabelOptions scaled = options;
			scaled.height = options.height * scale;
			const LabelResult result = LabelMesh(m, Moved(ThreeLetters(), scale, 0, 0), frame, scaled);
			ExpectSameKind(before, m);
			EXPECT_EQ(result.topFaces.size(), expected.topFaces.size());
			EXPECT_EQ(result.wallFaces.size(), expected.wallFaces.size());
			const double cube = scale * scale * scale;
			EXPECT_NEAR(result.addedVolume / cube, expected.addedVolume, 1e-4 * expected.addedVolume);
			EXPECT_NEAR(result.labelArea / (scale * scale), expected.labelArea, 1e-4 * expected.labelArea);
		}
}

// A part in map coordinates, in doubles: float32 cannot carry the letters there, doubles can, and the result says so.
TEST(Layer, DoublesCarryWhatFloatsCannot)
{
	const Point3d utm(500000, 4000000, 100);
	const Shape part = Part().moved([&](const Point3d& p) { return p + utm; });
	LabelFrame frame;
	frame.origin = utm;
	LabelOptions options;
	options.height = 0.75;
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, part);
	const LabelResult result = LabelMesh(m, Moved(ThreeLetters(), 0.5, 0, 0), frame, options);
	EXPECT_FALSE(result.survivesFloat32);
	EXPECT_NEAR(result.addedVolume, Area(ThreeLetters()) / 4 * 0.75, 1e-6);
	const MeshReport report = MakeReport(m);
	EXPECT_TRUE(IsSound(report)) << ToText(report);

	test_mesh::DoubleMesh near;
	test_mesh::Fill(near, Part());
	EXPECT_TRUE(LabelMesh(near, ThreeLetters(), FromAbove(), options).survivesFloat32);
	test_mesh::FloatMesh coarse;
	test_mesh::Fill(coarse, part);
	Error error(ErrorCode::Cancelled);
	Refusal(coarse, Moved(ThreeLetters(), 0.5, 0, 0), frame, options, &error);
	EXPECT_EQ(error.code, ErrorCode::TooFine);
}

// A wall so far from the origin that float32 has only a few steps within it: what doubles carry is made, what they don't is refused
// with a depth that works.
TEST(Layer, DoublesCarryThinWallsThatFloatsCannot)
{
	const Point3d far(16777216, 0, 0);  // float32 has steps of 2 from here on
	const auto made = [&](double thickness, double height, Error& error) {
		const Shape wall =
			test_mesh::Slab(2000, 1000, thickness, 4, 2).moved([&](const Point3d& p) { return p * 2 + far; });
		LabelFrame frame;
		double top = -1e9;
		for (const Point3d& p : wall.points) top = std::max(top, p[2]);
		frame.origin = far + Point3d(0, 0, top);
		LabelOptions options;
		options.height = height;
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, wall);
		try {
			const LabelResult result = LabelMesh(m, Moved(ThreeLetters(), 100, 0, 0), frame, options);
			EXPECT_FALSE(result.survivesFloat32);
			EXPECT_TRUE(IsSound(MakeReport(m))) << ToText(MakeReport(m));
			return true;
		} catch (const Error& e) {
			error = e;
			return false;
		}
	};
	Error error(ErrorCode::Cancelled);
	EXPECT_TRUE(made(8, -12, error)) << error.what();
	EXPECT_FALSE(made(8, -16, error));
	EXPECT_EQ(error.code, ErrorCode::HitsSurface);
	EXPECT_TRUE(made(8, -error.limit, error)) << error.limit;
}

// Two vertices of the part that float32 takes for one: no label on them survives it, even if the letters are far from them.
TEST(Layer, APartFinerThanFloatsDoesNotSurviveThem)
{
	for (const double strip : {1.0, 1e-9}) {
		const Shape part = test_mesh::Slab(30, 20, 4, 15, 10).moved([&](const Point3d& p) {
			return std::abs(p[0] - 1) < 0.1 ? Point3d(-1 + strip, p[1], p[2]) : p;
		});
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, part.moved([](const Point3d& p) { return p + Point3d(100, 0, 0); }));
		LabelFrame frame;
		frame.origin = {100, 0, 0};
		LabelOptions options;
		options.height = 0.5;
		const LabelResult result =
			LabelMesh(m, Letters({Rectangle(-6, -2, -4, 2), Rectangle(4, -2, 6, 2)}), frame, options);
		EXPECT_EQ(result.survivesFloat32, strip == 1);
	}
}

// A plate a step of float32 above another one: the same place to floats, two surfaces to doubles.
TEST(Layer, DoublesTellSurfacesApartThatFloatsCannot)
{
	const Shape plate = Part();
	const Shape both = plate.joined(plate.moved([](const Point3d& p) { return p - Point3d(0, 0, 4 + 1e-6); }));
	for (const double height : {0.75, -0.75}) {
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, both.moved([](const Point3d& p) { return Point3d(p[0], p[1], p[2] * 1e-6 / 4); }));
		LabelOptions options;
		options.height = height * 1e-6;
		const LabelResult result = LabelMesh(m, ThreeLetters(), FromAbove(), options);
		EXPECT_FALSE(result.survivesFloat32);
		EXPECT_TRUE(IsSound(MakeReport(m))) << ToText(MakeReport(m));
	}
}

// A depth finer than float32 has steps is a depth to doubles.
TEST(Layer, DoublesCarryADepthThatFloatsCannot)
{
	const Shape high = Part().moved([](const Point3d& p) { return p + Point3d(0, 0, 100); });
	LabelFrame frame;
	frame.origin = {0, 0, 100};
	LabelOptions options;
	options.height = 1e-6;
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, high);
	const LabelResult result = LabelMesh(m, ThreeLetters(), frame, options);
	EXPECT_FALSE(result.survivesFloat32);
	EXPECT_NEAR(result.addedVolume, Area(ThreeLetters()) * 1e-6, 1e-10);
	EXPECT_TRUE(IsSound(MakeReport(m))) << ToText(MakeReport(m));
}

// The depth that a refusal names is one that the file keeps, too, where there is such a depth.
TEST(Layer, TheDepthThatIsToldSurvivesFloat32)
{
	const Shape thin =
		test_mesh::Slab(30, 20, 1.25, 15, 10).moved([](const Point3d& p) { return p + Point3d(4000, 4000, 0); });
	LabelFrame frame;
	frame.origin = {4000, 4000, 0};
	for (const ExtrudeAlong along : {ExtrudeAlong::Viewpoint, ExtrudeAlong::SurfaceNormal}) {
		LabelOptions options;
		options.height = -1.5;
		options.along = along;
		test_mesh::DoubleMesh m;
		test_mesh::Fill(m, thin);
		Error error(ErrorCode::Cancelled);
		Refusal(m, ThreeLetters(), frame, options, &error);
		EXPECT_EQ(error.code, ErrorCode::HitsSurface);
		options.height = -error.limit;
		EXPECT_TRUE(LabelMesh(m, ThreeLetters(), frame, options).survivesFloat32) << error.limit;
	}
	// a depth between that and the wall's thickness is made all the same, by doubles alone
	LabelOptions options;
	options.height = -1.2495;
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, thin);
	EXPECT_FALSE(LabelMesh(m, ThreeLetters(), frame, options).survivesFloat32);
	EXPECT_TRUE(IsSound(MakeReport(m))) << ToText(MakeReport(m));
}

// In a groove, tops raised along the normals all but meet in the axis: by less than float32 has steps there.
TEST(Layer, DoublesCarryTopsThatAllButMeet)
{
	const Shape groove = test_mesh::Groove().moved([](const Point3d& p) { return p + Point3d(4096, 4096, 0); });
	LabelFrame frame;
	frame.origin = {4096, 4096, 0};
	const Outline letter = Letters({Rectangle(-3.3, -4, 3.1, 4)});
	const auto made = [&](auto m, double height, Error& error, LabelResult& result) {
		test_mesh::Fill(m, groove);
		LabelOptions options;
		options.height = height;
		options.along = ExtrudeAlong::SurfaceNormal;
		try {
			result = LabelMesh(m, letter, frame, options);
			return true;
		} catch (const Error& e) {
			error = e;
			return false;
		}
	};
	Error error(ErrorCode::Cancelled);
	LabelResult result;
	double low = 2, high = 7;
	for (int step = 0; step < 30; ++step) {
		const double height = (low + high) / 2;
		(made(test_mesh::DoubleMesh(), height, error, result) ? low : high) = height;
	}
	EXPECT_FALSE(made(test_mesh::FloatMesh(), low, error, result));
	EXPECT_EQ(int(error.code), int(ErrorCode::HitsItself));
	ASSERT_TRUE(made(test_mesh::DoubleMesh(), low, error, result));
	EXPECT_FALSE(result.survivesFloat32);
}

/// A box that leans, and a tetrahedron leaning over it, all in floats.
Shape LeaningPair(std::mt19937& generator)
{
	const auto draw = [&](double low, double high) {
		return std::uniform_real_distribution<double>(low, high)(generator);
	};
	const auto rounded = [](const Point3d& p) { return Point3d(float(p[0]), float(p[1]), float(p[2])); };
	const double slope = draw(0.2, 0.8), left = draw(6, 8), height = draw(3, 5);
	Shape s = test_mesh::Box(20, 20, 6).moved([&](const Point3d& p) {
		return rounded({p[0] * 1.01, p[1] * 1.013, p[2] + slope * p[0]});
	});
	Shape t;
	for (const Point3d& p : {Point3d(-left, -8, height), Point3d(-left, 8, height), Point3d(-left, 0, height + 5)})
		t.add(rounded(p + Point3d(draw(-0.3, 0.3), draw(-1, 1), draw(-0.5, 0.5))));
	t.add(rounded({-left - 4, draw(-1, 1), height + draw(1, 2)}));
	t.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
	return s.joined(t);
}

// Letters that all but touch another surface: what is clear of it once it is rounded must be so as a double mesh holds it, too.
TEST(Layer, ADoubleMeshIsSoundAsItIsAndRounded)
{
	std::mt19937 generator(1);
	int made = 0;
	for (int part = 0; part < 12; ++part) {
		const Shape shape = LeaningPair(generator);
		const Outline letter = Letters({RegularPolygon(-1, 0, 3, 7)});
		double low = 0.5, high = 12;
		for (int step = 0; step < 40; ++step) {  // to the least height that is refused
			LabelOptions options;
			options.height = (low + high) / 2;
			options.along = ExtrudeAlong::SurfaceNormal;
			test_mesh::DoubleMesh m;
			test_mesh::Fill(m, shape);
			try {
				LabelMesh(m, letter, FromAbove(), options);
				low = options.height;
			} catch (const Error&) {
				high = options.height;
				continue;
			}
			++made;
			EXPECT_EQ(FindCrossings(ToIndexedMesh(m)).size(), 0u) << "part " << part << ", height " << low;
		}
	}
	EXPECT_GT(made, 100);
}

// Between an edge and the facets beside it the normal turns steadily, so that letters can sink well below facets' width. Between two
// spheres areas go with the squares of the radii; smoothing, which sees one side at the letters' rim, holds the normals there back by
// a share of a facet, and so less on a finer sphere.
TEST(Layer, LettersSinkAlongTheNormalsOfASphere)
{
	constexpr double radius = 30;
	for (const double height : {-2.0, -0.5, 2.0}) {
		double error[2];  // of the volume, as a share of it
		for (int fine = 0; fine < 2; ++fine) {
			test_mesh::FloatMesh m;
			test_mesh::Fill(m, test_mesh::Sphere(radius, fine ? 400 : 100, fine ? 320 : 80));
			LabelOptions options;
			options.height = height;
			options.along = ExtrudeAlong::SurfaceNormal;
			const LabelResult result = LabelMesh(m, ThreeLetters(), FromAbove(), options);
			const MeshReport report = MakeReport(m);
			EXPECT_TRUE(IsSound(report)) << ToText(report);
			const double expected = result.surfaceArea * radius / 3 * (std::pow(1 + height / radius, 3) - 1);
			error[fine] = std::abs(result.addedVolume / expected - 1);
		}
		EXPECT_LT(error[0], 0.03) << height;
		EXPECT_LT(error[1], error[0] / 2) << height;
	}
}

#ifdef HAS_MESHLAB_MESH
// MeshLab's mesh keeps optional attributes outside of its faces and vertices; they have to grow with them.
TEST(Layer, MeshLabsOwnMesh)
{
	for (const bool optional : {false, true}) {
		CMeshO m;
		test_mesh::Fill(m, Part());
		if (optional) {
			m.vert.EnableTexCoord();
			m.face.EnableColor();
			m.face.EnableQuality();
			m.face.EnableWedgeTexCoord();
			for (auto& v : m.vert) v.T().u() = float(v.cP()[0]);
			for (size_t i = 0; i < m.face.size(); ++i) {
				m.face[i].Q() = typename CMeshO::FaceType::QualityType(i);
				for (int k = 0; k < 3; ++k) m.face[i].WT(k).v() = float(m.face[i].cV(k)->cP()[1]);
			}
		}
		const Shape before = test_mesh::ToShape(m);
		LabelOptions options;
		options.height = 0.75;
		const LabelResult result = LabelMesh(m, ThreeLetters(), FromAbove(), options);
		ExpectSameKind(before, m);
		EXPECT_NEAR(Volume(test_mesh::ToShape(m)) - Volume(before), Area(ThreeLetters()) * 0.75,
		            1e-4 * Area(ThreeLetters()));
		if (!optional) continue;
		for (size_t i = size_t(result.firstNewVertex); i < m.vert.size(); ++i)
			EXPECT_NEAR(m.vert[i].cT().u(), m.vert[i].cP()[0], 1e-5);
		for (const int f : result.topFaces) {
			const auto& face = m.face[size_t(f)];
			EXPECT_LT(face.cQ(), before.faces.size());
			for (int k = 0; k < 3; ++k) EXPECT_NEAR(face.cWT(k).v(), face.cV(k)->cP()[1], 1e-5);
		}
	}
}
#endif

}  // namespace
