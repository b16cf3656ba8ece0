// Dirty meshes: what is decided about each kind of dirt, away from the label and under it.
//
// The rule: what the letters do not touch may be as it likes, and stays as it is; what they touch must be a surface, or the label is
// refused and the mesh is as it was, bit for bit. A label that is made adds no fault to those that were there.

#include "vcg_ext/text_label.h"

#include <gtest/gtest.h>
#include <optional>

#include "label_check.h"
#include "test_mesh.h"

namespace {

using namespace label_check;
using test_mesh::FloatMesh;
using test_mesh::Shape;
using Code = std::optional<ErrorCode>;  // nothing: the label must be made
using Allocator = vcg::tri::Allocator<FloatMesh>;

constexpr Code kMade = std::nullopt;
constexpr double kDepth = 0.75;

/// 30 x 20 x 4, its top at z = 0 in squares of side 2, corners at odd x and even y.
Shape Plate() { return test_mesh::Slab(30, 20, 4, 15, 10); }

/// Where the dirt is: under the letters, which reach from (-5, -3) to (5, 3), or away from them.
struct Spot {
	double x, y;  ///< the middle of a square of the plate
};
constexpr Spot kUnder{0, 1}, kAway{12, 7};

Outline Letters() { return label_check::Letters({Rectangle(-5, -3, 2, 3), RegularPolygon(3.5, 0, 1.2, 16)}); }

int VertexAt(const Shape& s, const Point3d& p)
{
	for (size_t i = 0; i < s.points.size(); ++i)
		if ((s.points[i] - p).Norm() < 1e-9) return int(i);
	throw std::logic_error("no vertex there");
}

/// A corner of a square; dx and dy are -1 or 1.
int CornerOf(const Shape& s, const Spot& spot, double dx, double dy)
{
	return VertexAt(s, {spot.x + dx, spot.y + dy, 0});
}

/// The lower right triangle of a square.
size_t FaceAt(const Shape& s, const Spot& spot)
{
	std::array<int, 3> wanted{CornerOf(s, spot, -1, -1), CornerOf(s, spot, 1, -1), CornerOf(s, spot, 1, 1)};
	std::sort(wanted.begin(), wanted.end());
	for (size_t f = 0; f < s.faces.size(); ++f) {
		std::array<int, 3> t = s.faces[f];
		std::sort(t.begin(), t.end());
		if (t == wanted) return f;
	}
	throw std::logic_error("no face there");
}

// ---- kinds of dirt ----

Shape RepeatedIndex(Shape s, const Spot& spot)
{
	const int a = CornerOf(s, spot, -1, -1), b = CornerOf(s, spot, 1, -1);
	s.faces.push_back({a, a, b});
	return s;
}

/// A closed plate with a face without area: the face's edge is divided, and the gap to its neighbour closed by a cap.
Shape Collinear(Shape s, const Spot& spot)
{
	const size_t f = FaceAt(s, spot);
	const int a = CornerOf(s, spot, -1, -1), b = CornerOf(s, spot, 1, -1);
	const int c = s.faces[f][0] + s.faces[f][1] + s.faces[f][2] - a - b;
	const int middle = s.add({spot.x, spot.y - 1, 0});
	s.faces[f] = {a, middle, c};
	s.faces.push_back({middle, b, c});
	s.faces.push_back({a, b, middle});
	return s;
}

/// The same without the cap: a point of one side lies on an edge of the other.
Shape TJunction(Shape s, const Spot& spot)
{
	s = Collinear(s, spot);
	s.faces.pop_back();
	return s;
}

Shape Duplicate(Shape s, const Spot& spot)
{
	s.faces.push_back(s.faces[FaceAt(s, spot)]);
	return s;
}

Shape Flipped(Shape s, const Spot& spot)
{
	auto& f = s.faces[FaceAt(s, spot)];
	std::swap(f[1], f[2]);
	return s;
}

Shape Fin(Shape s, const Spot& spot)
{
	const int a = CornerOf(s, spot, -1, -1), b = CornerOf(s, spot, 1, -1);
	s.faces.push_back({a, b, s.add({spot.x, spot.y - 1, 3})});
	return s;
}

/// Three faces on an edge as well, the third one within the solid, where no viewer sees it.
Shape InnerFin(Shape s, const Spot& spot)
{
	const int a = CornerOf(s, spot, -1, -1), b = CornerOf(s, spot, 1, -1);
	s.faces.push_back({a, b, s.add({spot.x, spot.y - 1, -3})});
	return s;
}

/// A tetrahedron that hangs on a vertex of the plate within the solid: two fans around one vertex.
Shape TwoFans(Shape s, const Spot& spot)
{
	const int a = CornerOf(s, spot, -1, -1);
	const Point3d p = s.points[size_t(a)];
	const int b = s.add(p + Point3d(0.5, 0, -2)), c = s.add(p + Point3d(-0.5, 0.5, -2)),
			  d = s.add(p + Point3d(-0.5, -0.5, -2));
	for (const auto& f : {std::array<int, 3>{a, b, c}, {a, c, d}, {a, d, b}, {b, d, c}}) s.faces.push_back(f);
	return s;
}

Shape Hole(Shape s, const Spot& spot)
{
	s.faces.erase(s.faces.begin() + long(FaceAt(s, spot)));
	return s;
}

Shape NotFinite(Shape s, const Spot& spot, double x)
{
	s.points[size_t(CornerOf(s, spot, -1, -1))][2] = x;
	return s;
}

/// Faces around a spot with corners of their own, moved by so much: as an STL file that was not welded.
Shape Unwelded(Shape s, const Spot& spot, double gap)
{
	const size_t f = FaceAt(s, spot);
	for (int& v : s.faces[f]) v = s.add(s.points[size_t(v)] + Point3d(gap, gap, 0));
	return s;
}

Shape WithBox(const Shape& s, const Point3d& top, double size)
{
	return s.joined(test_mesh::Box(size, size, size).moved([&](const Point3d& p) { return p + top; }));
}

/// A bubble in the solid: a box turned inside out.
Shape WithBubble(const Shape& s, const Point3d& top, double size)
{
	Shape bubble = test_mesh::Box(size, size, size).moved([&](const Point3d& p) { return p + top; });
	for (auto& f : bubble.faces) std::swap(f[1], f[2]);
	return s.joined(bubble);
}

Shape WithUnusedVertices(Shape s)
{
	s.points.insert(s.points.begin(), {0, 0, 1});
	for (auto& f : s.faces)
		for (int& v : f) ++v;
	s.add({1e6, 0, 0});
	s.add({std::nan(""), 0, 0});
	return s;
}

// ---- the table ----

struct Row {
	std::string name;
	Shape shape;
	Code raised = kMade, sunk = raised, flat = raised;
};

std::vector<Row> Rows()
{
	const double infinity = std::numeric_limits<double>::infinity();
	const Shape plate = Plate();
	return {
		{"Clean", plate},
		{"RepeatedIndexAway", RepeatedIndex(plate, kAway)},
		{"RepeatedIndexUnder", RepeatedIndex(plate, kUnder)},
		{"CollinearAway", Collinear(plate, kAway)},
		{"CollinearUnder", Collinear(plate, kUnder)},
		{"TJunctionAway", TJunction(plate, kAway)},
		{"TJunctionUnder", TJunction(plate, kUnder), ErrorCode::Border},
		{"DuplicateAway", Duplicate(plate, kAway)},
		{"DuplicateUnder", Duplicate(plate, kUnder), ErrorCode::NonManifold},
		{"FlippedAway", Flipped(plate, kAway)},
		{"FlippedUnder", Flipped(plate, kUnder), ErrorCode::NonManifold},
		{"FinAway", Fin(plate, kAway)},
		{"FinUnder", Fin(plate, kUnder), ErrorCode::NonManifold},
		{"InnerFinAway", InnerFin(plate, kAway)},
		{"InnerFinUnder", InnerFin(plate, kUnder), ErrorCode::NonManifold},
		{"TwoFansAway", TwoFans(plate, kAway)},
		{"TwoFansUnder", TwoFans(plate, kUnder), ErrorCode::NonManifold, ErrorCode::HitsSurface, kMade},
		{"HoleAway", Hole(plate, kAway)},
		{"HoleUnder", Hole(plate, kUnder), ErrorCode::Border},
		{"NanAway", NotFinite(plate, kAway, std::nan(""))},
		{"NanUnder", NotFinite(plate, kUnder, std::nan("")), ErrorCode::Border},
		{"InfinityAway", NotFinite(plate, kAway, infinity)},
		{"InfinityUnder", NotFinite(plate, kUnder, -infinity), ErrorCode::Border},
		{"UnweldedAway", Unwelded(plate, kAway, 0)},
		{"UnweldedUnder", Unwelded(plate, kUnder, 0), ErrorCode::Border},
		{"GapOfAMillionthAway", Unwelded(plate, kAway, 3e-5)},
		{"GapOfAMillionthUnder", Unwelded(plate, kUnder, 3e-5), ErrorCode::Border},
		{"ShellBeside", WithBox(plate, {40, 0, 0}, 5)},
		{"ShellInFront", WithBox(plate, {0, 0, 8}, 3), ErrorCode::Occluded},
		{"ShellFarBehind", WithBox(plate, {0, 0, -50}, 5)},
		{"ShellThatCrossesAway", WithBox(plate, {12, 7, 1}, 2)},
		{"ShellThatCrossesUnder", WithBox(plate, {-2, 0.5, 1}, 2), ErrorCode::Occluded},
		{"BubbleDeepUnder", WithBubble(plate, {0, 0, -2}, 1.5)},
		{"BubbleJustUnder", WithBubble(plate, {-2, 0, -0.5}, 1.5), kMade, ErrorCode::HitsSurface, kMade},
		{"SamePlateTwice", plate.joined(plate), ErrorCode::Occluded},
		{"UnusedVertices", WithUnusedVertices(plate)},
	};
}

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

/// Faults of a mesh as a file would hold it; none may become more frequent.
std::vector<std::pair<const char*, int>> FaultsOf(const MeshReport& r)
{
	return {{"repeated index", r.repeatedIndexFaces},
	        {"collinear", r.collinearFaces},
	        {"duplicate", r.duplicateFaces},
	        {"border edges", r.borderEdges},
	        {"border loops", r.borderLoops},
	        {"non-manifold edges", r.nonManifoldEdges},
	        {"non-manifold vertices", r.nonManifoldVertices},
	        {"flipped edges", r.flippedEdges},
	        {"unbalanced edges", r.unbalancedEdges},
	        {"not finite", r.notFinite},
	        {"components", r.components}};
}

MeshReport ReportOf(const Shape& s)
{
	IndexedMesh m;
	m.positions = s.points;
	m.faces = s.faces;
	return MakeReport(PrepareForReport(m, {true, true}));
}

/// No more faults than before, and the raised faces cross nothing.
void ExpectNoWorse(const Shape& before, const FloatMesh& m, const LabelResult& result)
{
	const auto a = FaultsOf(ReportOf(before)), b = FaultsOf(ReportOf(test_mesh::ToShape(m)));
	for (size_t i = 0; i < a.size(); ++i) EXPECT_LE(b[i].second, a[i].second) << a[i].first;
	std::vector<char> isRaised(m.face.size(), 0);
	for (const int f : result.wallFaces) isRaised[size_t(f)] = 1;
	for (const int f : result.topFaces) isRaised[size_t(f)] = !result.wallFaces.empty();
	std::vector<Corners> raised, others;
	for (size_t f = 0; f < m.face.size(); ++f) {
		if (m.face[f].IsD()) continue;
		const auto at = [&](int k) { return Point3d::Construct(m.face[f].cP(k)); };
		(isRaised[f] ? raised : others).push_back({at(0), at(1), at(2)});
	}
	EXPECT_EQ(FindCrossings(raised, others).size(), 0u);
}

std::string InWords(const Code& code) { return code ? "code " + std::to_string(int(*code)) : "made"; }

/// Label a mesh, which must come out as decided.
void Decide(FloatMesh& m, double height, const Code& expected)
{
	SCOPED_TRACE(testing::Message() << "height " << height);
	const std::string bytes = test_mesh::Bytes(m);
	const Shape before = test_mesh::ToShape(m);
	LabelOptions options;
	options.height = height;
	try {
		const LabelResult result = LabelMesh(m, Letters(), FromAbove(), options);
		EXPECT_EQ("made", InWords(expected));
		ExpectNoWorse(before, m, result);
		EXPECT_NEAR(result.addedVolume, Area(Letters()) * height, 1e-4);
		EXPECT_NEAR(result.surfaceArea, Area(Letters()), 1e-4);
		EXPECT_NEAR(result.stretch, 1, 1e-6);
	} catch (const Error& e) {
		EXPECT_EQ(InWords(e.code), InWords(expected)) << e.what();
		EXPECT_TRUE(test_mesh::Bytes(m) == bytes) << "refused, and changed";
		EXPECT_TRUE(e.hasPlace || e.face >= 0) << "the user is not told where";
	}
}

class DirtyInput : public testing::TestWithParam<Row> {};

TEST_P(DirtyInput, IsDecidedOnPurpose)
{
	for (const auto& [height, expected] :
	     {std::pair{kDepth, GetParam().raised}, {-kDepth, GetParam().sunk}, {0.0, GetParam().flat}}) {
		FloatMesh m;
		test_mesh::Fill(m, GetParam().shape);
		Decide(m, height, expected);
	}
}

INSTANTIATE_TEST_SUITE_P(Label, DirtyInput, testing::ValuesIn(Rows()), [](const auto& p) { return p.param.name; });

// Deleted elements are not there: a deleted face is a hole, and what was deleted stays so.
TEST(DirtyInput, DeletedFaces)
{
	for (const auto& [spot, expected] : {std::pair{kAway, kMade}, {kUnder, Code(ErrorCode::Border)}}) {
		const Shape plate = Plate();
		FloatMesh m;
		test_mesh::Fill(m, plate);
		Allocator::DeleteFace(m, m.face[FaceAt(plate, spot)]);
		Decide(m, kDepth, expected);
		EXPECT_TRUE(m.face[FaceAt(plate, spot)].IsD());
	}
}

// A cap lower than the coordinates' resolution may stand as steep as it likes: which way it faces says nothing.
TEST(DirtyInput, ACapThatStandsUprightIsNotSteep)
{
	for (const double up : {1e-6, 2e-6, 3e-6}) {
		Shape s = Collinear(Plate(), kUnder);
		s.points.back() += Point3d(0, 1e-7, up);
		for (const double height : {kDepth, -kDepth, 0.0}) {
			FloatMesh m;
			test_mesh::Fill(m, s);
			LabelOptions options;
			options.height = height;
			EXPECT_NO_THROW(LabelMesh(m, Letters(), FromAbove(), options)) << up << ' ' << height;
		}
	}
}

class PaintedVertex;
class PaintedFace;
struct PaintedTypes : vcg::UsedTypes<vcg::Use<PaintedVertex>::AsVertexType, vcg::Use<PaintedFace>::AsFaceType> {};
class PaintedVertex
	: public vcg::Vertex<PaintedTypes, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::BitFlags> {};
class PaintedFace : public vcg::Face<PaintedTypes, vcg::face::VertexRef, vcg::face::Normal3f, vcg::face::BitFlags,
                                     vcg::face::Color4b> {};
class PaintedMesh : public vcg::tri::TriMesh<std::vector<PaintedVertex>, std::vector<PaintedFace>> {};

// A cap is flipped away; it had no area to show its colour on, so its pieces take that of the face that gives way.
TEST(DirtyInputColours, ACapUnderTheLabelSmearsNone)
{
	const vcg::Color4b green(10, 200, 30, 255), red(250, 0, 0, 255);
	for (const double height : {kDepth, -kDepth, 0.0}) {
		PaintedMesh m;
		test_mesh::Fill(m, Collinear(Plate(), kUnder));
		for (auto& f : m.face) f.C() = green;
		m.face.back().C() = red;  // the cap
		LabelOptions options;
		options.height = height;
		LabelMesh(m, Letters(), FromAbove(), options);
		int wrong = 0;
		for (const auto& f : m.face) wrong += vcg::DoubleArea(f) > 1e-6 && f.cC() != green;
		EXPECT_EQ(wrong, 0) << height;
	}
}

}  // namespace
