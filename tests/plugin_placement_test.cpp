// Lines of sight, and where requests put the label, on a box and a bowl whose answers are known.

#include "filter_textlabel/mesh_numbers.h"
#include "filter_textlabel/placement.h"
#include "filter_textlabel/request_error.h"
#include "test_mesh.h"

#include <gtest/gtest.h>
#include <random>
#include <vcg/complex/algorithms/create/platonic.h>

using namespace textlabel;
using vcg::Point3d;
using Mesh = test_mesh::FloatMesh;

namespace {

/// Several chunks on small meshes, where there are cores.
[[maybe_unused]] const size_t chunk = vcg::textlabel::leastChunk = 5;

/// A box from (0, 0, 0) to (60, 40, 10), two triangles for each side.
Mesh& Box()
{
	static Mesh m;
	if (m.fn > 0) return m;
	for (int i = 0; i < 8; ++i)
		vcg::tri::Allocator<Mesh>::AddVertex(m, {i & 1 ? 60.f : 0.f, i & 2 ? 40.f : 0.f, i & 4 ? 10.f : 0.f});
	const int f[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
	                      {1, 3, 7}, {1, 7, 5}, {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}};
	for (const auto& t : f)
		vcg::tri::Allocator<Mesh>::AddFace(m, &m.vert[size_t(t[0])], &m.vert[size_t(t[1])], &m.vert[size_t(t[2])]);
	return m;
}

vcg::Matrix44d Identity() { return vcg::textlabel::LabelFrame::Identity(); }

PartProbe ProbeOf(const Mesh& m, const vcg::Matrix44d& toWorld = Identity())
{
	return {BoxesOf(m, toWorld).world, [&m, toWorld](const SightLine& line) { return HitsOnLine(m, toWorld, line); },
	        [&m, toWorld] { return GeometryOf(m, toWorld); }};
}

std::vector<Attempt> Plan(const LabelRequest& request, const PartProbe& part = ProbeOf(Box()))
{
	TextSetter text(request);
	const Camera camera = request.placement == PlacementKind::Camera ? RequestedCamera(request) : Camera();
	std::vector<Attempt> attempts;
	OfferAttempts(request, camera, part, text, [&](const Attempt& attempt) {
		attempts.push_back(attempt);
		return false;
	});
	return attempts;
}

LabelRequest AtPoint(const Point3d& position, const Point3d& direction)
{
	LabelRequest request;
	request.placement = PlacementKind::PointAndDirection;
	request.position = position;
	request.direction = direction;
	request.size = 5;
	return request;
}

LabelRequest FromCamera(const Point3d& viewpoint, const Point3d& direction)
{
	LabelRequest request = AtPoint(viewpoint, direction);
	request.placement = PlacementKind::Camera;
	return request;
}

void ExpectNear(const Point3d& a, const Point3d& b, double tolerance = 1e-9)
{
	EXPECT_LE((a - b).Norm(), tolerance) << a[0] << " " << a[1] << " " << a[2];
}

template <class Work>
RequestProblem ProblemOf(const Work& work)
{
	try {
		work();
	} catch (const RequestError& error) {
		return error.problem;
	}
	ADD_FAILURE() << "no error";
	return RequestProblem::EmptyPart;
}

}  // namespace

TEST(SightLine, NeverSlipsBetweenTwoFaces)
{
	// Through the diagonal of the top, through an edge of the box, through a vertex, and through random places on them: never
	// zero hits, and the first is on the top.
	std::mt19937 random(1);
	for (int i = 0; i < 2000; ++i) {
		const double s = i == 0 ? 0 : i == 1 ? 1 : double(random()) / double(random.max());
		const Point3d place = i % 2 ? Point3d(60 * s, 40 * s, 10) : Point3d(60 * s, 0, 10);
		const Point3d towards = Point3d(double(random() % 100) - 50, -1 - double(random() % 50), 60);
		const auto hits = HitsOnLine(Box(), Identity(), {place + towards * 3, Point3d(0, 0, 0) - towards});
		ASSERT_GE(hits.size(), 1u);
		EXPECT_TRUE(hits.front().facing);
		EXPECT_NEAR(hits.front().distance, 3 * towards.Norm(), 1e-6);
	}
}

TEST(SightLine, SortsHitsAndKnowsTheirSides)
{
	const auto hits = HitsOnLine(Box(), Identity(), {{31, 17, 110}, {0, 0, -5}});
	ASSERT_EQ(hits.size(), 2u);
	EXPECT_DOUBLE_EQ(hits[0].distance, 100);
	EXPECT_TRUE(hits[0].facing);
	EXPECT_DOUBLE_EQ(hits[1].distance, 110);
	EXPECT_FALSE(hits[1].facing);
	EXPECT_TRUE(HitsOnLine(Box(), Identity(), {{61, 17, 110}, {0, 0, -1}}).empty());
	EXPECT_THROW(HitsOnLine(Box(), Identity(), {{0, 0, 0}, {0, 0, 0}}), vcg::textlabel::Error);
}

TEST(SightLine, MeetsAFaceBetweenItsCornersHoweverSteep)
{
	std::mt19937 random(1);
	const auto number = [&] { return double(random()) / double(random.max()) * 2 - 1; };
	int met = 0, withoutSlope = 0;
	for (int i = 0; i < 20000; ++i) {
		// three points on a line through the axis, but for what doubles lose, at any height
		const double slope = number(), x[3] = {number(), number(), number()};
		const Point3d q[3] = {{x[0], x[0] * slope, 1}, {x[1], x[1] * slope, 2}, {x[2], x[2] * slope, 4}};
		const int turn = textlabel::detail::TurnAroundAxis(q);
		if (turn == 0) continue;
		++met;
		withoutSlope += !(((q[1] - q[0]) ^ (q[2] - q[0]))[2] * turn > 0);
		const double height = textlabel::detail::HeightOnAxis(q, turn);
		EXPECT_GE(height, 1 - 1e-12);
		EXPECT_LE(height, 4 + 1e-12);
	}
	EXPECT_GT(met, 100);
	EXPECT_GT(withoutSlope, 10) << "faces whose normal says nothing";
}

TEST(SightLine, GoesThroughMovedAndMirroredLayers)
{
	vcg::Matrix44d mirror = Identity();
	mirror.ElementAt(0, 0) = -2;  // x from -120 to 0: twice as long, and mirrored
	mirror.ElementAt(2, 3) = 1000;
	const auto hits = HitsOnLine(Box(), mirror, {{-100, 17, 1110}, {0, 0, -1}});
	ASSERT_EQ(hits.size(), 2u);
	EXPECT_DOUBLE_EQ(hits[0].distance, 100);
	EXPECT_TRUE(hits[0].facing);
	const PartGeometry part = GeometryOf(Box(), mirror);
	double volume = 0;
	for (const auto& t : part.triangles)
		volume += part.positions[size_t(t[0])] * (part.positions[size_t(t[1])] ^ part.positions[size_t(t[2])]) / 6;
	EXPECT_NEAR(volume, 2 * 24000, 1e-6);  // positive: still turned outwards
	EXPECT_NEAR(SumFaces(Box(), {0, 0, 0}).volume, 24000, 1e-9);
}

TEST(SightLine, PassesByWhatIsNotFinite)
{
	Mesh m;
	vcg::tri::Append<Mesh, Mesh>::MeshCopy(m, Box());
	m.vert[4].P()[2] = NAN;
	const auto hits = HitsOnLine(m, Identity(), {{40, 5, 110}, {0, 0, -1}});
	ASSERT_EQ(hits.size(), 1u);  // the top has lost its faces there
	EXPECT_DOUBLE_EQ(hits[0].distance, 110);
	EXPECT_EQ(BoxesOf(m, Identity()).world.max[2], 10);
}

TEST(PointAndDirection, ComesDownOnTheSurface)
{
	for (const double z : {10.0, 9.993, 13.0, 200.0}) {
		const auto attempts = Plan(AtPoint({30, 20, z}, {0, 0, 7}));
		ASSERT_EQ(attempts.size(), 1u);
		ExpectNear(attempts[0].frame.origin, {30, 20, 10});
		ExpectNear(attempts[0].frame.w, {0, 0, 1});
		ExpectNear(attempts[0].frame.v, {0, 1, 0});  // as on a sheet on the table
		EXPECT_FALSE(attempts[0].frame.perspective);
		EXPECT_EQ(attempts[0].size, 5);
	}
	const auto side = Plan(AtPoint({30, 0, 5}, {0, -1, 0}))[0].frame;
	ExpectNear(side.v, {0, 0, 1});  // upright on a wall
	ExpectNear(side.u, {1, 0, 0});
}

TEST(PointAndDirection, TakesAnyVertexOfACurvedSurface)
{
	Mesh ball;
	vcg::tri::Sphere(ball, 3);
	for (const auto& v : ball.vert) {
		const Point3d p = Point3d::Construct(v.cP());
		if (p[2] < 0.3) continue;
		for (const double above :
		     {0.0, 0.3, -0.3}) {  // it is met in faces around it, at distances that differ in the last digit
			ExpectNear(Plan(AtPoint(p * (1 + above), p), ProbeOf(ball)).front().frame.origin, p, 1e-7);
			const Point3d up(0, 0, 1);
			ExpectNear(Plan(AtPoint(p + up * above, up), ProbeOf(ball)).front().frame.origin, p, 1e-7);
		}
	}
}

TEST(PointAndDirection, ShiftsAndTurns)
{
	LabelRequest request = AtPoint({30, 20, 10}, {0, 0, 1});
	request.offsetU = 7;
	request.offsetV = -3;
	request.rotation = 90;
	const auto frame = Plan(request)[0].frame;
	ExpectNear(frame.origin, {37, 17, 10});  // as the viewer sees it, before it is turned
	EXPECT_EQ(frame.u, Point3d(0, 1, 0));    // right angles are exact
	EXPECT_EQ(frame.v, Point3d(-1, 0, 0));
	request.rotation = -330;
	ExpectNear(Plan(request)[0].frame.u, {std::sqrt(0.75), 0.5, 0});
	request.rotation = 0;
	request.up = {0, -2, 5};
	ExpectNear(Plan(request)[0].frame.v, {0, -1, 0});
}

TEST(PointAndDirection, RefusesWhatIsNoPlace)
{
	EXPECT_EQ(ProblemOf([] { Plan(AtPoint({30, 20, 10}, {0, 0, 0})); }), RequestProblem::DirectionZero);
	EXPECT_EQ(ProblemOf([] { Plan(AtPoint({300, 20, 10}, {0, 0, 1})); }), RequestProblem::PointMissesPart);
	LabelRequest along = AtPoint({30, 20, 10}, {0, 0, 1});
	along.up = {0, 0, -3};
	EXPECT_EQ(ProblemOf([&] { Plan(along); }), RequestProblem::UpAlongDirection);
	// A second box floats 20 above: its top is before the place that was asked for.
	Mesh two;
	vcg::tri::Append<Mesh, Mesh>::MeshCopy(two, Box());
	for (auto& v : two.vert) v.P()[2] += 30;
	vcg::tri::Append<Mesh, Mesh>::Mesh(two, Box());
	EXPECT_EQ(ProblemOf([&] { Plan(AtPoint({30, 20, 10}, {0, 0, 1}), ProbeOf(two)); }), RequestProblem::HiddenPlace);
	ExpectNear(Plan(AtPoint({30, 20, 39}, {0, 0, 1}), ProbeOf(two))[0].frame.origin, {30, 20, 40});
	Mesh insideOut;
	vcg::tri::Append<Mesh, Mesh>::MeshCopy(insideOut, Box());
	for (auto& f : insideOut.face) std::swap(f.V(1), f.V(2));
	EXPECT_EQ(ProblemOf([&] {
				  Plan(AtPoint({30, 20, 10}, {0, 0, 1}), ProbeOf(insideOut));
			  }),
	          RequestProblem::HiddenByBack);
	Mesh sheet;  // the bottom alone: from above there is only its back
	vcg::tri::Append<Mesh, Mesh>::MeshCopy(sheet, Box());
	sheet.face.resize(2);
	sheet.fn = 2;
	EXPECT_EQ(ProblemOf([&] { Plan(AtPoint({30, 20, 0}, {0, 0, 1}), ProbeOf(sheet)); }), RequestProblem::PointSeesBack);
	ExpectNear(Plan(AtPoint({30, 20, 0}, {0, 0, -1}), ProbeOf(sheet))[0].frame.origin, {30, 20, 0});
}

TEST(CameraPlacement, LabelsTheCentreOfTheView)
{
	const Point3d viewpoint(20, -30, 90), direction(0, -1, 2);
	const auto frame = Plan(FromCamera(viewpoint, direction))[0].frame;
	ExpectNear(frame.origin, viewpoint - direction * 40);  // where z has come down from 90 to 10
	EXPECT_TRUE(frame.perspective);
	ExpectNear(frame.center, viewpoint);
	ExpectNear(frame.w, direction / direction.Norm());
	LabelRequest shifted = FromCamera({30, 20, 110}, {0, 0, 1});
	shifted.offsetU = 10;
	ExpectNear(Plan(shifted)[0].frame.origin, {40, 20, 10});
	LabelRequest parallel = FromCamera({30, 20, -500}, {0, 0, 1});
	parallel.fieldOfView = 5;
	EXPECT_FALSE(Plan(parallel)[0].frame.perspective);
	ExpectNear(Plan(parallel)[0].frame.origin, {30, 20, 10});  // a parallel view has no place to be behind
}

// Beside the top the part is 40 lower: the shift is as long there, though it is seen from afar.
TEST(CameraPlacement, ShiftsByTheLengthThatWasAskedForOnWhatLiesDeeper)
{
	Mesh steps;
	vcg::tri::Append<Mesh, Mesh>::MeshCopy(steps, Box());
	for (auto& v : steps.vert) v.P() += Mesh::CoordType(61, 0, -40);
	vcg::tri::Append<Mesh, Mesh>::Mesh(steps, Box());
	for (const double fieldOfView : {60.0, 5.0}) {
		LabelRequest request = FromCamera({30, 20, 110}, {0, 0, 1});
		request.fieldOfView = fieldOfView;
		request.offsetU = 50;
		request.offsetV = -3;
		ExpectNear(Plan(request, ProbeOf(steps))[0].frame.origin, {80, 17, -30});
	}
}

// The line beside the axis starts within a block that stands beside the camera; the place is in plain sight.
TEST(CameraPlacement, ShiftsPastWhatStandsBesideTheCamera)
{
	Mesh both;
	vcg::tri::Append<Mesh, Mesh>::MeshCopy(both, Box());
	for (auto& v : both.vert) v.P() = Mesh::CoordType(38 + v.P()[0] * 22 / 60, v.P()[1], 30 + v.P()[2] * 5);
	vcg::tri::Append<Mesh, Mesh>::Mesh(both, Box());
	LabelRequest request = FromCamera({30, 20, 50}, {0, 0, 1});
	request.offsetU = 10;
	ExpectNear(Plan(request, ProbeOf(both))[0].frame.origin, {40, 20, 10});
	request.offsetU = 25;  // hidden by the block: its underside shows its back, and the floor can't be seen
	ExpectNear(Plan(request, ProbeOf(both))[0].frame.origin, {55, 20, 10});
}

TEST(CameraPlacement, TurnsTheTextWhereUpIsTold)
{
	LabelRequest request = FromCamera({30, 20, 110}, {0, 0, 1});
	request.camera = WriteCamera(RequestedCamera(request));
	ExpectNear(Plan(request)[0].frame.v, {0, 1, 0});
	request.up = {3, 0, 1};
	ExpectNear(Plan(request)[0].frame.v, {1, 0, 0});
	ExpectNear(Plan(request)[0].frame.u, {0, -1, 0});
	EXPECT_TRUE(Plan(request)[0].frame.perspective);
	request.up = {0, 0, 2};
	EXPECT_EQ(ProblemOf([&] { Plan(request); }), RequestProblem::UpAlongDirection);
}

TEST(CameraPlacement, RefusesViewsThatShowNoOutside)
{
	EXPECT_EQ(ProblemOf([] { Plan(FromCamera({30, 20, 5}, {0, 0, 1})); }), RequestProblem::ViewFromInside);
	EXPECT_EQ(ProblemOf([] { Plan(FromCamera({30, 20, -5}, {0, 0, 1})); }), RequestProblem::ViewMissesPart);
	EXPECT_EQ(ProblemOf([] { Plan(FromCamera({90, 20, 50}, {0, 0, 1})); }), RequestProblem::ViewMissesPart);
}

TEST(ChosenSize, StartsLargeAndShrinks)
{
	LabelRequest request = AtPoint({30, 20, 10}, {0, 0, 1});
	request.size = ChosenToFit;
	const auto attempts = Plan(request);
	ASSERT_GE(attempts.size(), 5u);
	EXPECT_LT(attempts[0].size, 40);
	EXPECT_GT(attempts[0].size, 1);
	for (size_t i = 1; i < attempts.size(); ++i) EXPECT_LT(attempts[i].size, attempts[i - 1].size);
	request.text = "a much longer text than before";
	EXPECT_LT(Plan(request)[0].size, attempts[0].size);
	request.fitWidth = 20;
	const auto fitted = Plan(request);
	ASSERT_EQ(fitted.size(), 1u);
	const TextOutline outline = MakeTextOutline(request.text, TextOptionsOf(request, fitted[0].size));
	EXPECT_NEAR(outline.boxMax[0] - outline.boxMin[0], 20, 0.01);
}

TEST(AutomaticPlacement, PutsTheTextsBoxOnAFlatRegion)
{
	LabelRequest request;
	request.text = "gA";  // its box is not centred on its anchor
	request.anchor = Anchor::Baseline;
	request.size = 8;
	std::vector<Attempt> attempts = Plan(request);
	ASSERT_GE(attempts.size(), 2u);
	attempts.resize(2);  // the last resort is to go over an edge
	for (const auto& attempt : attempts) {
		const TextOutline outline = MakeTextOutline(request.text, TextOptionsOf(request, attempt.size));
		for (const vcg::Point2d& p : {outline.boxMin, outline.boxMax}) {
			const Point3d corner = attempt.frame.origin + attempt.frame.u * p[0] + attempt.frame.v * p[1];
			EXPECT_TRUE(ProbeOf(Box()).box.IsIn(corner - attempt.frame.w * 0.01))
				<< corner[0] << " " << corner[1] << " " << corner[2];
		}
	}
	request.size = 45;  // no side is as high
	EXPECT_EQ(ProblemOf([&] { Plan(request); }), RequestProblem::NoPlace);
}

TEST(AutomaticPlacement, TellsAnAnchorOnTheSurface)
{
	Mesh ball;
	vcg::tri::Sphere(ball, 5);
	LabelRequest request;
	request.text = "AB";
	request.size = 0.1;
	request.offsetU = 0.05;
	for (const Align align : {Align::Left, Align::Right}) {
		request.align = align;
		for (const Attempt& attempt : Plan(request, ProbeOf(ball))) EXPECT_NEAR(attempt.frame.origin.Norm(), 1, 1e-3);
	}
}
