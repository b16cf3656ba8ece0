// The commit: what is not touched stays bit for bit, what is cut carries its attributes along, what fails leaves the mesh alone.

#include "vcg_ext/patch_commit.h"

#include <gtest/gtest.h>
#include <set>

#include "label_check.h"
#include "test_mesh.h"

namespace {

using namespace label_check;
using test_mesh::RichMesh;
using test_mesh::Shape;

// Linear functions of the place on the surface; coefficients that float32 and a byte hold exactly enough.
double QualityAt(const Point3d& p) { return 3 + 0.25 * p[0] - 0.5 * p[1] + 0.125 * p[2]; }
double RedAt(const Point3d& p) { return 120 + 4 * p[0] - 3 * p[1] + p[2]; }
double GreenAt(const Point3d& p) { return 90 - 2 * p[0] + 5 * p[1]; }
Point2d TextureAt(const Point3d& p) { return {0.5 + p[0] / 64 + p[2] / 16, 0.25 - p[1] / 32}; }

Point3d PlaceOf(const RichMesh::VertexType& v) { return {double(v.cP()[0]), double(v.cP()[1]), double(v.cP()[2])}; }

void Paint(RichMesh& m)
{
	for (auto& v : m.vert) {
		const Point3d p = PlaceOf(v);
		v.Q() = float(QualityAt(p));
		v.C() = vcg::Color4b(static_cast<unsigned char>(std::lround(RedAt(p))),
		                     static_cast<unsigned char>(std::lround(GreenAt(p))), 7, 200);
		v.T().u() = float(TextureAt(p)[0]);
		v.T().v() = float(TextureAt(p)[1]);
		v.T().n() = 3;
	}
	for (size_t i = 0; i < m.face.size(); ++i) {
		auto& f = m.face[i];
		f.C() = vcg::Color4b(static_cast<unsigned char>(i), static_cast<unsigned char>(i / 256), 11, 255);
		f.Q() = float(i);
		if (i % 3 == 0) f.SetS();
		for (int k = 0; k < 3; ++k) {
			const Point2d t = TextureAt(PlaceOf(*f.cV(k)));
			f.WT(k).u() = float(t[0]);
			f.WT(k).v() = float(t[1]) + float(i % 2);  // a seam between neighbours: wedges differ where faces meet
			f.WT(k).n() = short(i % 5);
		}
	}
}

Shape Slanted()
{
	return test_mesh::Slab(30, 20, 6, 15, 10).moved([](const Point3d& p) {
		return p + Point3d(0, 0, 0.3 * p[0] + 0.2 * p[1]);
	});
}

// A strip two steps of the coordinates wide ends under the letter: what is cut there is collapsed into its neighbour.
TEST(Commit, TextureStaysWhereShortEdgesAreCollapsed)
{
	constexpr double strip = 1.6e-4, far = 90;
	Shape s;
	const auto add = [&](double x, double y) { return s.add({x + far, y + far, 0}); };
	const int a = add(-18, -18), b = add(0, -18), b2 = add(strip, -18), c = add(18, -18), e = add(18, 18),
			  apex = add(0, 17), g = add(-18, 18);
	s.faces = {{a, b, apex}, {b, b2, apex}, {b2, c, apex}, {c, e, apex}, {e, g, apex}, {g, a, apex}};
	for (const double top : {12.0, 15.0, 15.5, 16.0, 16.5})
		for (const double height : {0.0, 0.5}) {
			RichMesh m;
			test_mesh::Fill(m, s);
			for (auto& f : m.face)
				for (int k = 0; k < 3; ++k) {
					f.WT(k).u() = f.cV(k)->cP()[0] / 40;
					f.WT(k).v() = f.cV(k)->cP()[1] / 40;
				}
			LabelFrame frame;
			frame.origin = {far, far, 0};
			LabelOptions options;
			options.height = height;
			LabelMesh(m, Letters({Rectangle(-5.1, top - 20, 6.3, top)}), frame, options);
			for (const auto& f : m.face)
				for (int k = 0; k < 3; ++k) {
					EXPECT_NEAR(f.cWT(k).u(), f.cV(k)->cP()[0] / 40, 1e-5) << top;
					EXPECT_NEAR(f.cWT(k).v(), f.cV(k)->cP()[1] / 40, 1e-5) << top;
				}
		}
}

// VCGlib does not initialise what it appends, and loses those of type bool.
TEST(Commit, CustomAttributesAreThoseOfTheOldFaceAndOfAnOldVertex)
{
	using Allocator = vcg::tri::Allocator<RichMesh>;
	for (const double height : {0.0, 0.5}) {
		RichMesh m;
		test_mesh::Fill(m, Slanted());
		Paint(m);
		auto onFaces = Allocator::AddPerFaceAttribute<vcg::Point3f>(m, "place");
		auto onVertices = Allocator::AddPerVertexAttribute<vcg::Point3f>(m, "place");
		auto truths = Allocator::AddPerFaceAttribute<bool>(m, "truth");
		auto names = Allocator::AddPerVertexAttribute<std::string>(m, "name");
		const auto placeOf = [](size_t i) { return vcg::Point3f(float(i), 0.5f, -float(i)); };
		const size_t oldFaces = m.face.size(), oldVertices = m.vert.size();
		for (size_t i = 0; i < oldFaces; ++i) {
			onFaces[i] = placeOf(i);
			truths[i] = i % 3 == 0;
		}
		for (size_t i = 0; i < oldVertices; ++i) {
			onVertices[i] = placeOf(i);
			names[i] = std::to_string(i);
		}
		std::vector<Point3d> before;
		for (const auto& v : m.vert) before.push_back(PlaceOf(v));
		LabelOptions options;
		options.height = height;
		const LabelResult result = LabelMesh(m, Moved(ThreeLetters(), 1, 0.1, 0.2, 0.05), FromAbove(), options);
		ASSERT_GT(m.face.size(), oldFaces);
		for (size_t i = 0; i < m.face.size(); ++i)  // Paint has numbered the faces
			EXPECT_EQ(std::make_pair(vcg::Point3f(onFaces[i]), bool(truths[i])),
			          std::make_pair(placeOf(size_t(m.face[i].cQ())), size_t(m.face[i].cQ()) % 3 == 0))
				<< i;
		for (size_t i = 0; i < m.vert.size(); ++i) {
			const size_t from = size_t(onVertices[i][0]);
			EXPECT_EQ(onVertices[i], placeOf(from)) << i;
			EXPECT_EQ(names[i], std::to_string(from)) << i;
			if (i < oldVertices) { EXPECT_EQ(from, i); }
			ASSERT_LT(from, oldVertices);
			EXPECT_LE((PlaceOf(m.vert[i]) - before[from]).Norm(), 2.2) << "as far as a cell is wide: " << i;
		}
		for (const char* name : {"place", "truth"})
			Allocator::DeletePerFaceAttribute(m, name);  // a mesh leaves them behind
		for (const char* name : {"place", "name"}) Allocator::DeletePerVertexAttribute(m, name);
	}
}

/// An attribute whose assignment fails after so many.
struct Failing {
	int value = 0;
	static int left;

	Failing() = default;
	Failing(const Failing&) = default;
	Failing& operator=(const Failing& other)
	{
		if (left >= 0 && left-- == 0) throw std::bad_alloc();
		value = other.value;
		return *this;
	}
};
int Failing::left = -1;

TEST(Commit, AnAttributeThatCannotBeCopiedLeavesTheMeshAsItWas)
{
	using Allocator = vcg::tri::Allocator<RichMesh>;
	for (const int copies : {0, 1, 40, 200}) {
		RichMesh m;
		test_mesh::Fill(m, Slanted());
		Allocator::AddPerFaceAttribute<Failing>(m, "f");
		Allocator::AddPerVertexAttribute<Failing>(m, "v");
		const size_t faces = m.face.size(), vertices = m.vert.size();
		LabelOptions options;
		options.height = 0.5;
		Failing::left = copies;
		try {
			LabelMesh(m, Moved(ThreeLetters(), 1, 0.1, 0.2, 0.05), FromAbove(), options);
			FAIL() << copies;
		} catch (const Error& e) {
			EXPECT_EQ(e.code, ErrorCode::OutOfMemory);
		}
		Failing::left = -1;
		EXPECT_EQ(m.face.size(), faces);
		EXPECT_EQ(m.vert.size(), vertices);
		EXPECT_EQ(m.fn, int(faces));
		RichMesh untouched;
		test_mesh::Fill(untouched, Slanted());
		for (size_t i = 0; i < faces; ++i)
			for (int k = 0; k < 3; ++k)
				EXPECT_EQ(vcg::tri::Index(m, m.face[i].cV(k)), vcg::tri::Index(untouched, untouched.face[i].cV(k)));
		Allocator::DeletePerFaceAttribute(m, "f");
		Allocator::DeletePerVertexAttribute(m, "v");
	}
}

struct Labelled {
	RichMesh before, after;
	LabelResult result;

	Labelled(const LabelFrame& frame, double height)
	{
		const Shape shape = Slanted();
		for (RichMesh* m : {&before, &after}) {
			test_mesh::Fill(*m, shape);
			Paint(*m);
		}
		LabelOptions options;
		options.height = height;
		result = LabelMesh(after, Moved(ThreeLetters(), 1, 0.1, 0.2, 0.05), frame, options);
	}
};

/// The bytes of some values, one after the other.
template <class... Values>
std::string BytesOf(const Values&... values)
{
	std::string out;
	(out.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
	return out;
}

std::string FaceBytes(const RichMesh& m, size_t i)
{
	const auto& f = m.face[i];
	std::string out = BytesOf(f.cFlags(), f.cC(), f.cQ());
	for (int k = 0; k < 3; ++k)
		out += BytesOf(f.cV(k) - m.vert.data(), f.cN()[k], f.cWT(k).u(), f.cWT(k).v(), f.cWT(k).n());
	return out;
}

std::string VertexBytes(const RichMesh& m, size_t i)
{
	const auto& v = m.vert[i];
	std::string out = BytesOf(v.cFlags(), v.cC(), v.cQ(), v.cT().u(), v.cT().v(), v.cT().n());
	for (int k = 0; k < 3; ++k) out += BytesOf(v.cP()[k], v.cN()[k]);
	return out;
}

std::set<int> ChangedFaces(const LabelResult& r)
{
	std::set<int> changed(r.topFaces.begin(), r.topFaces.end());
	changed.insert(r.wallFaces.begin(), r.wallFaces.end());
	changed.insert(r.outsideFaces.begin(), r.outsideFaces.end());
	return changed;
}

TEST(Commit, UntouchedFacesAndVerticesKeepEveryBit)
{
	const Outline letters = Moved(ThreeLetters(), 1, 0.1, 0.2, 0.05);
	for (const double height : {0.8, -0.8, 0.0}) {
		const Labelled l(FromAbove(), height);
		const std::set<int> changed = ChangedFaces(l.result);
		int untouched = 0;
		for (size_t i = 0; i < l.before.face.size(); ++i) {
			const auto& f = l.before.face[i];
			// by the test's own measure: away from all contours and outside the letters
			const Point3d middle = (PlaceOf(*f.cV(0)) + PlaceOf(*f.cV(1)) + PlaceOf(*f.cV(2))) / 3;
			const bool facing =
				((PlaceOf(*f.cV(1)) - PlaceOf(*f.cV(0))) ^ (PlaceOf(*f.cV(2)) - PlaceOf(*f.cV(0))))[2] > 0;
			const Point2d inPlane(middle[0], middle[1]);
			const bool away = !facing || (Winding(letters, inPlane) == 0 && ContourDistance(letters, inPlane) > 2.01);
			if (away) { EXPECT_EQ(changed.count(int(i)), 0u) << "face " << i << " is away from the letters"; }
			if (changed.count(int(i)) != 0) continue;
			++untouched;
			ASSERT_TRUE(FaceBytes(l.before, i) == FaceBytes(l.after, i)) << "face " << i;
		}
		EXPECT_EQ(untouched, l.before.fn - l.result.touchedFaces);
		for (size_t i = 0; i < l.before.vert.size(); ++i) {
			const Point3d p = PlaceOf(l.before.vert[i]);
			if (p[2] > -3 + 0.3 * p[0] + 0.2 * p[1] && Winding(letters, {p[0], p[1]}) == 1 && height != 0) continue;
			ASSERT_TRUE(VertexBytes(l.before, i) == VertexBytes(l.after, i)) << "vertex " << i;
		}
	}
}

/// The place on the surface from which a point of the labelled mesh was raised along z.
Point3d OnSurface(const Point3d& p) { return {p[0], p[1], 0.3 * p[0] + 0.2 * p[1]}; }

// Linear functions stay what they are, in parallel and in perspective projection alike: the mixture is made in space.
TEST(Commit, AttributesOfNewVerticesAreInterpolated)
{
	for (const LabelFrame& frame : {FromAbove(), FromAbovePerspective(25)})
		for (const double height : {0.8, 0.0}) {
			if (frame.perspective && height != 0) continue;  // raised along rays: OnSurface does not know them
			const Labelled l(frame, height);
			ASSERT_GT(l.result.newVertices, 50);
			for (size_t i = size_t(l.result.firstNewVertex); i < l.after.vert.size(); ++i) {
				const auto& v = l.after.vert[i];
				const Point3d p = OnSurface(PlaceOf(v));
				EXPECT_NEAR(v.cQ(), QualityAt(p), 1e-5);
				EXPECT_NEAR(v.cC()[0], RedAt(p), 1.01) << "bytes are rounded twice";
				EXPECT_NEAR(v.cC()[1], GreenAt(p), 1.01);
				EXPECT_EQ(v.cC()[2], 7);
				EXPECT_EQ(v.cC()[3], 200);
				EXPECT_NEAR(v.cT().u(), TextureAt(p)[0], 1e-6);
				EXPECT_NEAR(v.cT().v(), TextureAt(p)[1], 1e-6);
				EXPECT_EQ(v.cT().n(), 3);
			}
		}
}

TEST(Commit, NewFacesTakeTheAttributesOfTheirBirthFace)
{
	const Labelled l(FromAbove(), 0.8);
	for (const int f : ChangedFaces(l.result)) {
		const auto& face = l.after.face[size_t(f)];
		const size_t birth = size_t(std::lround(face.cQ()));
		ASSERT_LT(birth, l.before.face.size());
		const auto& from = l.before.face[birth];
		EXPECT_EQ(face.cC(), from.cC());
		EXPECT_EQ(face.IsS(), from.IsS());
		for (int k = 0; k < 3; ++k) {
			const Point3d p = OnSurface(PlaceOf(*face.cV(k)));
			EXPECT_NEAR(face.cWT(k).u(), TextureAt(p)[0], 1e-6);
			EXPECT_NEAR(face.cWT(k).v(), TextureAt(p)[1] + double(birth % 2), 1e-6);
			EXPECT_EQ(face.cWT(k).n(), short(birth % 5));
		}
	}
}

// Each slot of a face that was cut is taken again: no hole in the numbering, and every birth face lives on in its own slot.
TEST(Commit, FirstPieceTakesTheSlotOfItsBirthFace)
{
	const Labelled l(FromAbove(), 0.8);
	int taken = 0;
	for (const int f : ChangedFaces(l.result)) {
		if (f >= l.before.fn) continue;
		++taken;
		EXPECT_EQ(l.after.face[size_t(f)].cQ(), float(f));
	}
	EXPECT_EQ(taken, l.result.touchedFaces);
}

// A layer whose matrix mirrors: faces are stored the other way round and must stay so, with their texture.
TEST(Commit, MirroringLayer)
{
	RichMesh m;
	test_mesh::Fill(m, Slanted());
	Paint(m);
	LabelFrame frame;
	frame.toWorld.ElementAt(2, 2) = -1;  // seen from below in mesh coordinates
	frame.origin = {0, 0, 6};
	frame.w = {0, 0, 1};
	const Shape before = test_mesh::ToShape(m);
	LabelOptions options;
	options.height = 0.8;
	const Outline letters = ThreeLetters();
	const LabelResult result = LabelMesh(m, letters, frame, options);
	ExpectSameKind(before, m);
	EXPECT_NEAR(Volume(test_mesh::ToShape(m)) - Volume(before), Area(letters) * 0.8, 1e-4 * Area(letters));
	EXPECT_NEAR(result.addedVolume, Area(letters) * 0.8, 1e-4 * Area(letters));
	for (const int f : ChangedFaces(result)) {
		const auto& face = m.face[size_t(f)];
		const auto birth = size_t(std::lround(face.cQ()));
		for (int k = 0; k < 3; ++k) {
			Point3d p = PlaceOf(*face.cV(k));
			p[2] = 0.3 * p[0] + 0.2 * p[1] - 6;
			EXPECT_NEAR(face.cWT(k).u(), TextureAt(p)[0], 1e-6);
			EXPECT_NEAR(face.cWT(k).v(), TextureAt(p)[1] + double(birth % 2), 1e-6);
		}
	}
}

// A mesh with room behind its vectors, and one whose vectors have to move: pointers are right in both.
TEST(Commit, PointersSurviveGrowth)
{
	for (const bool reserve : {false, true}) {
		test_mesh::FloatMesh m;
		test_mesh::Fill(m, Slanted());
		if (reserve) {
			vcg::tri::Allocator<test_mesh::FloatMesh>::AddVertices(m, 0);
			m.vert.reserve(100000);
			m.face.reserve(100000);
			test_mesh::Fill(m, Slanted());
		}
		const Shape before = test_mesh::ToShape(m);
		LabelMesh(m, ThreeLetters(), FromAbove());
		for (const auto& f : m.face)
			for (int k = 0; k < 3; ++k) {
				ASSERT_GE(f.cV(k), m.vert.data());
				ASSERT_LT(f.cV(k), m.vert.data() + m.vert.size());
			}
		ExpectSameKind(before, m);
	}
}

// Deleted elements are no part of the surface and stay deleted.
TEST(Commit, DeletedElementsAreLeftAlone)
{
	test_mesh::FloatMesh m;
	test_mesh::Fill(
		m, Slanted().joined(test_mesh::Box(3, 3, 1).moved([](const Point3d& p) { return p + Point3d(0, 0, 9); })));
	using Allocator = vcg::tri::Allocator<test_mesh::FloatMesh>;
	const size_t hovering = Slanted().faces.size(), points = Slanted().points.size();
	for (size_t f = hovering; f < m.face.size(); ++f) Allocator::DeleteFace(m, m.face[f]);
	for (size_t v = points; v < m.vert.size(); ++v) Allocator::DeleteVertex(m, m.vert[v]);
	const int fn = m.fn, vn = m.vn;
	const LabelResult r = LabelMesh(m, ThreeLetters(), FromAbove());  // the box would hide the letters
	EXPECT_EQ(m.fn, fn + r.newFaces);
	EXPECT_EQ(m.vn, vn + r.newVertices);
	for (size_t f = hovering; f < hovering + 12; ++f) EXPECT_TRUE(m.face[f].IsD());
	for (size_t v = points; v < points + 8; ++v) EXPECT_TRUE(m.vert[v].IsD());
}

}  // namespace
