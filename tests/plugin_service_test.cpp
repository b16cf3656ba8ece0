// A whole run on a bare mesh: what is left behind, what is reported, and that a refusal leaves nothing.

#include "filter_textlabel/label_service.h"
#include "test_mesh.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <gtest/gtest.h>
#include <set>
#include <vcg/complex/algorithms/update/normal.h>

using namespace textlabel;
using Mesh = test_mesh::RichMesh;
using vcg::Point3d;

namespace {

/// Several chunks on small meshes, where there are cores.
[[maybe_unused]] const size_t chunk = vcg::textlabel::leastChunk = 5;

/// As MeshLab computes them for a mesh that it has read.
void UpdateNormals(Mesh& m)
{
	vcg::tri::UpdateNormal<Mesh>::PerFaceNormalized(m);
	vcg::tri::UpdateNormal<Mesh>::PerVertexAngleWeighted(m);
	vcg::tri::UpdateNormal<Mesh>::NormalizePerVertex(m);
}

/// A plate of 60 x 40 whose thickness is given, its faces finely cut along x.
void MakePlate(Mesh& m, float thickness, int columns = 12)
{
	using Allocator = vcg::tri::Allocator<Mesh>;
	m.Clear();
	for (int i = 0; i <= columns; ++i)
		for (const float y : {0.f, 40.f})
			for (const float z : {0.f, thickness}) Allocator::AddVertex(m, {60.f * float(i) / float(columns), y, z});
	const auto quad = [&](int a, int b, int c, int d) {
		for (const auto& t : {std::array<int, 3>{a, b, c}, std::array<int, 3>{a, c, d}})
			Allocator::AddFace(m, &m.vert[size_t(t[0])], &m.vert[size_t(t[1])], &m.vert[size_t(t[2])]);
	};
	for (int i = 0; i < columns; ++i) {
		const int o = 4 * i;  // y0z0, y0z1, y1z0, y1z1, then the next column
		quad(o + 1, o + 5, o + 7, o + 3);
		quad(o, o + 2, o + 6, o + 4);
		quad(o, o + 4, o + 5, o + 1);
		quad(o + 2, o + 3, o + 7, o + 6);
	}
	const int last = 4 * columns;
	quad(0, 1, 3, 2);
	quad(last, last + 2, last + 3, last + 1);
	UpdateNormals(m);
	vcg::tri::UpdateBounding<Mesh>::Box(m);
	m.face[1].SetS();
}

LabelRequest OnTop(double size, double depth)
{
	LabelRequest request;
	request.placement = PlacementKind::PointAndDirection;
	request.position = {30, 20, 5};
	request.size = size;
	request.depth = depth;
	return request;
}

struct Finished {
	LabelReport report;
	vcg::textlabel::LabelResult result;
};

Finished RunOn(Mesh& m, const LabelRequest& request, const ServiceHost& host = {},
               const vcg::Matrix44d& toWorld = vcg::textlabel::LabelFrame::Identity())
{
	ErrorContext context;
	LabelJob<Mesh> job(m, toWorld, host, context);
	const LabelReport report = job.run(request);
	return {report, job.result()};
}

/// All bytes of a mesh that a host could see.
std::vector<double> Everything(const Mesh& m)
{
	std::vector<double> all{double(m.vn), double(m.fn), double(m.vert.size()), double(m.face.size())};
	for (const auto& v : m.vert) {
		for (int i = 0; i < 3; ++i) all.insert(all.end(), {double(v.cP()[i]), double(v.cN()[i])});
		all.insert(all.end(), {double(v.cC()[0]), double(v.cQ()), double(v.cFlags())});
	}
	for (const auto& f : m.face) {
		for (int k = 0; k < 3; ++k)
			all.insert(all.end(), {double(f.cV(k) - m.vert.data()), double(f.cN()[k]), double(f.cC()[k])});
		all.push_back(double(f.cFlags()));
	}
	return all;
}

}  // namespace

TEST(Service, LeavesSelectionNormalsAndBoxAsTheyShouldBe)
{
	for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave, LabelStyle::Flat}) {
		Mesh m;
		MakePlate(m, 5);
		for (auto& f : m.face)
			if (style != LabelStyle::Flat) f.SetS();
		LabelRequest request = OnTop(8, 1);
		request.style = style;
		request.text = "A8";
		const Finished run = RunOn(m, request);
		std::set<int> label(run.result.topFaces.begin(), run.result.topFaces.end());
		label.insert(run.result.wallFaces.begin(), run.result.wallFaces.end());
		for (size_t f = 0; f < m.face.size(); ++f) EXPECT_EQ(m.face[f].IsS(), label.count(int(f)) == 1);
		EXPECT_FLOAT_EQ(m.bbox.max[2], style == LabelStyle::Emboss ? 6.f : 5.f);

		Mesh fresh;
		vcg::tri::Append<Mesh, Mesh>::MeshCopy(fresh, m);
		vcg::tri::UpdateBounding<Mesh>::Box(fresh);
		EXPECT_EQ(m.bbox.min, fresh.bbox.min);
		EXPECT_EQ(m.bbox.max, fresh.bbox.max);
		UpdateNormals(fresh);
		for (size_t f = 0; f < m.face.size(); ++f) EXPECT_LE((m.face[f].N() - fresh.face[f].N()).Norm(), 1e-5);
		for (size_t v = 0; v < m.vert.size(); ++v) EXPECT_LE((m.vert[v].N() - fresh.vert[v].N()).Norm(), 1e-4) << v;
	}
}

// Letters whose contours run through vertices of the part: walls stand on these, and the part goes on around them.
TEST(Service, VerticesUnderAContourHaveTheNormalsOfAllFacesAround)
{
	for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave, LabelStyle::Flat}) {
		Mesh m;
		test_mesh::Fill(m, test_mesh::Slab(60, 40, 5, 60, 40));
		const size_t before = m.vert.size();
		vcg::tri::UpdateBounding<Mesh>::Box(m);
		UpdateNormals(m);
		for (auto& v : m.vert) v.SetV();  // as a filter before may have left them
		LabelRequest request = OnTop(16, 1);
		request.position = {0, 0, 30};
		request.style = style;
		request.text = "I";
		const Finished run = RunOn(m, request);
		std::set<size_t> onWalls;
		for (const int f : run.result.wallFaces)
			for (int k = 0; k < 3; ++k) onWalls.insert(vcg::tri::Index(m, m.face[size_t(f)].V(k)));
		const bool isRaised = style != LabelStyle::Flat;
		EXPECT_EQ(!onWalls.empty() && *onWalls.begin() < before, isRaised) << "walls on vertices of the part";
		Mesh fresh;
		vcg::tri::Append<Mesh, Mesh>::MeshCopy(fresh, m);
		UpdateNormals(fresh);
		for (size_t f = 0; f < m.face.size(); ++f) EXPECT_LE((m.face[f].N() - fresh.face[f].N()).Norm(), 1e-5);
		for (size_t v = 0; v < m.vert.size(); ++v) EXPECT_LE((m.vert[v].N() - fresh.vert[v].N()).Norm(), 1e-4) << v;
	}
}

TEST(Service, TheBoxIsThatOfAllVerticesAlsoWhereTheLabelWasAtItsBorder)
{
	const test_mesh::Shape slab = test_mesh::Slab(60, 40, 5, 60, 40), sphere = test_mesh::Sphere(30, 60, 40);
	for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave, LabelStyle::Flat})
		for (const test_mesh::Shape* shape : {&slab, &sphere}) {
			Mesh m;
			test_mesh::Fill(m, *shape);
			vcg::tri::UpdateBounding<Mesh>::Box(m);
			const float top = m.bbox.max[2];
			LabelRequest request = OnTop(16, 1);
			request.position = {0, 0, 30};
			request.style = style;
			request.text = "I";  // over the sphere's only highest vertex, and over some of the slab's many
			RunOn(m, request);
			const auto told = m.bbox;
			vcg::tri::UpdateBounding<Mesh>::Box(m);
			EXPECT_EQ(told.min, m.bbox.min);
			EXPECT_EQ(told.max, m.bbox.max);
			EXPECT_EQ(told.max[2] < top, style == LabelStyle::Engrave && shape == &sphere);
		}
}

TEST(Service, AFlatLabelLeavesTheNormalsOfTheSurfaceAlone)
{
	Mesh m;
	test_mesh::Fill(m, test_mesh::Slab(60, 40, 5, 60, 40));
	const int old = m.vn;
	for (auto& v : m.vert) v.N() = {0.6f, 0, 0.8f};  // a file's own, which its faces don't say
	LabelRequest request = OnTop(16, 1);
	request.position = {0, 0, 0};
	request.style = LabelStyle::Flat;
	request.text = "I";  // its edges run through vertices, others lie within
	const Finished run = RunOn(m, request);
	EXPECT_GT(run.result.newVertices, 0);
	for (int v = 0; v < old; ++v) EXPECT_EQ(m.vert[size_t(v)].N(), Mesh::CoordType(0.6f, 0, 0.8f)) << v;
	for (int v = old; v < m.vn; ++v) EXPECT_NEAR(m.vert[size_t(v)].N()[2], 1, 1e-6) << v;
}

TEST(Service, MarksTheLabelsTrianglesWhereFacesAreDeleted)
{
	Mesh m;
	MakePlate(m, 5);
	for (int i = 0; i < 2; ++i)
		vcg::tri::Allocator<Mesh>::DeleteFace(m, m.face[size_t(4 * i + 2)]);  // of the underside
	const Finished run = RunOn(m, OnTop(8, 1));
	const PartGeometry part = GeometryOf(m, vcg::textlabel::LabelFrame::Identity());
	const auto marked = MarkTriangles(m, {&run.result.topFaces, &run.result.wallFaces});
	ASSERT_EQ(part.triangles.size(), size_t(m.fn));
	ASSERT_EQ(marked.size(), part.triangles.size());
	for (size_t t = 0; t < marked.size(); ++t) {
		double highest = 0;
		for (const int v : part.triangles[t]) highest = std::max(highest, part.positions[size_t(v)][2]);
		EXPECT_EQ(marked[t] == 1, highest > 5) << t;
	}
}

TEST(Service, TheFirstRefusalIsTold)
{
	Mesh m;
	MakePlate(m, 5);
	LabelRequest request = OnTop(ChosenToFit, 1);
	request.position = {30, 0.5, 5};  // at the edge: no size fits
	request.minStroke = 0.5;          // and the smallest would be too thin
	EXPECT_THROW(RunOn(m, request), vcg::textlabel::Error);
}

TEST(Service, AChosenSizeGoesDownUntilTheTextFitsOnItsArc)
{
	Mesh m;
	MakePlate(m, 5);
	LabelRequest request = OnTop(ChosenToFit, 1);
	request.text = "A43";
	request.arcRadius = -2;  // the first size that is tried, of the plate's diagonal, is larger
	const LabelReport report = RunOn(m, request).report;
	EXPECT_GT(report.size, 0);
	EXPECT_LT(report.size, 2);
}

TEST(Service, AChosenSizeIsAsSmallAsALongTextOnASmallArcNeeds)
{
	Mesh m;
	MakePlate(m, 5);
	LabelRequest request = OnTop(ChosenToFit, 0.5);
	request.text = "Manufactured by Example Company Limited";
	request.arcRadius = 6;
	const LabelReport report = RunOn(m, request).report;
	EXPECT_GT(report.size, 0);
	EXPECT_LT(report.size, 0.2 * 6);
}

TEST(Service, APlaceIsToldAsItIsSeen)
{
	Mesh m;
	MakePlate(m, 5);
	vcg::Matrix44d far;
	far.SetTranslate(100, 200, 300);
	ErrorContext context;
	LabelRequest request = OnTop(8, 1);
	request.position = {159, 220, 305};  // over the edge
	const ServiceHost host;
	LabelJob<Mesh> job(m, far, host, context);
	try {
		job.run(request);
		ADD_FAILURE() << "no error";
	} catch (const vcg::textlabel::Error& error) {
		ASSERT_TRUE(error.hasPlace);
		EXPECT_LE((error.place - Point3d(160, 220, 305)).Norm(), 12);
		EXPECT_FALSE(context.isMade);
	}
}

TEST(Service, ColoursWhatIsAskedFor)
{
	for (const auto& [style, tint, colors] : {std::tuple{LabelStyle::Flat, false, true},
	                                          {LabelStyle::Emboss, true, true},
	                                          {LabelStyle::Emboss, false, false}}) {
		Mesh m;
		MakePlate(m, 5);
		LabelRequest request = OnTop(8, 1);
		request.style = style;
		request.tint = tint;
		request.color = {1, 2, 3};
		RunOn(m, request);
		for (const auto& f : m.face) EXPECT_EQ(f.cC() == vcg::Color4b(1, 2, 3, 255), colors && f.IsS());
	}
}

TEST(Service, ReportsWhatOneCanMeasure)
{
	Mesh m;
	MakePlate(m, 5);
	const int faces = m.fn, vertices = m.vn;
	LabelRequest request = OnTop(8, 1.25);
	request.style = LabelStyle::Engrave;
	const LabelReport report = RunOn(m, request).report;
	const QJsonObject json = QJsonDocument::fromJson(QByteArray::fromStdString(ReportJson(report))).object();
	EXPECT_EQ(json["text"].toString(), "A43");
	EXPECT_EQ(json["triangles_before"].toInt(), faces);
	EXPECT_EQ(json["triangles_after"].toInt(), m.fn);
	EXPECT_EQ(json["vertices_before"].toInt(), vertices);
	EXPECT_EQ(json["vertices_after"].toInt(), m.vn);
	EXPECT_NEAR(json["volume_before"].toDouble(), 60 * 40 * 5, 1e-9);
	EXPECT_NEAR(json["volume_after"].toDouble(), 12000 - 1.25 * json["label_area"].toDouble(), 0.01);
	EXPECT_NEAR(json["volume_after"].toDouble(), SumFaces(m, {0, 0, 0}).volume, 0.01);
	EXPECT_NEAR(json["surface_area"].toDouble(), json["label_area"].toDouble(), 1e-6);  // seen straight on
	for (const char* key : {"border_edges", "non_manifold_edges", "genus"})
		for (const char* when : {"_before", "_after"}) EXPECT_EQ(json[QString(key) + when].toInt(-1), 0) << key << when;
	EXPECT_EQ(json["components_after"].toInt(), 1);
	EXPECT_EQ(json["camera"].toObject()["direction"].toArray()[2].toDouble(), 1);
	EXPECT_GT(json["milliseconds"].toObject()["total"].toDouble(), 0);
}

TEST(Service, TellsLengthsAreasAndVolumesAsTheLayersMatrixScalesThem)
{
	Mesh m;
	MakePlate(m, 5);
	vcg::Matrix44d matrix;
	matrix.SetScale(10, 10, 10);
	LabelRequest request = OnTop(80, 20);
	request.position = {300, 200, 50};
	const LabelReport report = RunOn(m, request, {}, matrix).report;
	EXPECT_NEAR(report.before.volume, 60 * 40 * 5 * 1000.0, 1);
	EXPECT_NEAR(report.after.volume - report.before.volume, report.labelArea * 20, 1e-4 * report.labelArea * 20);
}

double AreaOf(const Mesh& m, const vcg::Color4b& color)
{
	double area = 0;
	for (const auto& f : m.face)
		if (!f.IsD() && f.cC() == color) area += double(vcg::DoubleArea(f)) / 2;
	return area;
}

TEST(Service, AFlatLabelIsNotPrintedOverByTheNext)
{
	Mesh m;
	MakePlate(m, 5);
	for (auto& f : m.face) f.C() = vcg::Color4b(255, 255, 255, 255);
	LabelRequest request;
	request.placement = PlacementKind::Automatic;
	request.style = LabelStyle::Flat;
	request.size = 8;
	double letters = 0;
	for (int i = 1; i <= 3; ++i) {
		request.color = {0, 0, static_cast<unsigned char>(i)};
		const LabelReport report = RunOn(m, request).report;
		if (i == 1) letters = report.labelArea;
		EXPECT_NEAR(AreaOf(m, vcg::Color4b(0, 0, 1, 255)), letters, 1e-3 * letters) << "after label " << i;
	}
	// on a painted part colours part nothing, and a label goes where it would without
	Mesh painted;
	MakePlate(painted, 5);
	for (size_t f = 0; f < painted.face.size(); ++f)
		painted.face[f].C() = vcg::Color4b(static_cast<unsigned char>(f), 0, 0, 255);
	Mesh plain;
	MakePlate(plain, 5);
	EXPECT_EQ(RunOn(painted, request).report.view.anchor, RunOn(plain, request).report.view.anchor);
}

TEST(Service, LooksForARegionThatHoldsLettersAsBoldAsAskedFor)
{
	LabelRequest request;
	request.placement = PlacementKind::Automatic;
	request.style = LabelStyle::Flat;
	request.text = "SN-0123456789";
	const auto labelled = [&](double minStroke) {
		Mesh m;
		MakePlate(m, 5);
		request.minStroke = minStroke;
		return RunOn(m, request).report;
	};
	const LabelReport usual = labelled(0);
	const LabelReport bold = labelled(1.2 * usual.thinnestStroke);
	EXPECT_GT(bold.size, usual.size);
	EXPECT_GE(bold.thinnestStroke, 1.2 * usual.thinnestStroke);
	try {
		labelled(10 * usual.thinnestStroke);
		ADD_FAILURE() << "no error";
	} catch (const TextError& error) {
		EXPECT_EQ(error.code, TextErrorCode::TooThin);
	}
}

TEST(Service, ARefusalLeavesTheMeshAlone)
{
	Mesh m;
	MakePlate(m, 5);
	const auto before = Everything(m);
	LabelRequest tooDeep = OnTop(8, 9), off = OnTop(8, 1), view = OnTop(8, 1), empty = OnTop(8, 1);
	tooDeep.style = LabelStyle::Engrave;
	off.position = {59, 20, 5};
	view.placement = PlacementKind::CurrentView;
	empty.text = " ";
	EXPECT_THROW(RunOn(m, tooDeep), vcg::textlabel::Error);
	EXPECT_THROW(RunOn(m, off), vcg::textlabel::Error);
	EXPECT_THROW(RunOn(m, view), RequestError);
	EXPECT_THROW(RunOn(m, empty), TextError);
	int calls = 0;
	ServiceHost impatient;
	impatient.progress = [&](int) { return ++calls < 2; };
	EXPECT_THROW(RunOn(m, OnTop(8, 1), impatient), vcg::textlabel::Error);
	EXPECT_EQ(calls, 2);
	EXPECT_EQ(Everything(m), before);
	Mesh cloud;
	vcg::tri::Allocator<Mesh>::AddVertex(cloud, {0, 0, 0});
	EXPECT_THROW(RunOn(cloud, OnTop(8, 1)), RequestError);
}

TEST(Service, ChoosesADepthThatTheWallAllows)
{
	Mesh m;
	MakePlate(m, 0.5f);
	LabelRequest request = OnTop(8, ChosenToFit);
	request.style = LabelStyle::Engrave;
	const LabelReport report = RunOn(m, request).report;  // a tenth of the size would come out behind
	EXPECT_LT(report.depth, 0);
	EXPECT_GT(report.depth, -0.5);
	EXPECT_NEAR(SumFaces(m, {0, 0, 0}).volume, 60 * 40 * 0.5 + report.depth * report.labelArea, 0.01);
}

TEST(Service, ChoosesASizeThatThePlaceAllows)
{
	Mesh m;
	MakePlate(m, 5);
	LabelRequest request = OnTop(ChosenToFit, ChosenToFit);
	request.position = {52, 20, 5};  // 8 from the edge: the largest sizes run over it
	request.text = "SERIAL";
	const LabelReport report = RunOn(m, request).report;
	const TextOutline outline = MakeTextOutline(request.text, TextOptionsOf(request, report.size));
	EXPECT_LT(outline.boxMax[0], 8);
	EXPECT_GT(outline.boxMax[0], 8 * 0.4);  // and not far smaller than needed
}

TEST(Service, AViewOfAWindowCanBeRunAgain)
{
	Camera camera;
	camera.viewpoint = {22.25, -8.1, 77};
	camera.backwards = Point3d(-0.1, -0.16, 0.98).Normalize();
	camera.right = (Point3d(0, 1, 0) ^ camera.backwards).Normalize();
	camera.up = camera.backwards ^ camera.right;
	ServiceHost window;
	window.currentView = [&] { return camera; };
	Mesh seen, again;
	MakePlate(seen, 5);
	MakePlate(again, 5);
	LabelRequest request = OnTop(6, 1);
	request.placement = PlacementKind::CurrentView;
	const LabelReport report = RunOn(seen, request, window).report;
	EXPECT_EQ(report.request.placement, PlacementKind::Camera);
	RunOn(again, report.request);
	EXPECT_EQ(Everything(again), Everything(seen));
}
