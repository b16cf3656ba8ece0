// Requests for a wrapped label, from the parameters to the report: where it goes, how large it gets, and what is refused.

#include "filter_textlabel/label_service.h"
#include "test_mesh.h"

#include <gtest/gtest.h>
#include <optional>

using namespace textlabel;
using test_mesh::Shape, test_mesh::Turned;
using vcg::Point3d;
using vcg::textlabel::LabelFrame;

namespace {

LabelRequest Round()
{
	LabelRequest request;
	request.text = "ROUND AND ROUND IT GOES";
	request.placement = PlacementKind::PointAndDirection;
	request.position = {0, 0, 12};
	request.up = {0, 1, 0};
	request.size = 2;
	request.depth = 0.3;
	request.wrap = true;
	return request;
}

LabelReport RunOn(const Shape& part, const LabelRequest& request)
{
	test_mesh::RichMesh m;
	test_mesh::Fill(m, part);
	const ServiceHost host;
	ErrorContext context;
	LabelJob<test_mesh::RichMesh> job(m, LabelFrame::Identity(), host, context);
	return job.run(request);
}

LabelReport RunOnCylinder(const LabelRequest& request) { return RunOn(test_mesh::Cylinder(10, 30, 60, 4), request); }

/// What a request is refused for; nothing when the label is made.
std::optional<RequestProblem> ProblemOf(const LabelRequest& request,
                                        const Shape& part = test_mesh::Cylinder(10, 30, 60, 4))
{
	try {
		RunOn(part, request);
	} catch (const RequestError& error) {
		return error.problem;
	}
	return std::nullopt;
}

TEST(WrapRequest, IsMadeAndReported)
{
	for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave, LabelStyle::Flat}) {
		LabelRequest request = Round();
		request.style = style;
		const LabelReport report = RunOnCylinder(request);
		EXPECT_NEAR(report.view.wrapRadius, 10, 1e-5);
		EXPECT_EQ(report.before.genus, report.after.genus);
		EXPECT_EQ(report.after.nonManifoldEdges, 0);
		EXPECT_NEAR(report.stretch, 1, 1e-6);
		EXPECT_NE(ReportJson(report).find("\"wrap_radius\":"), std::string::npos);
		EXPECT_NEAR(report.surfaceArea, report.labelArea, 0.01 * report.labelArea);  // arcs and chords
		EXPECT_LT(report.surfaceArea, 0.9999 * report.labelArea);
	}
	LabelRequest flat = Round();
	flat.wrap = false;
	flat.text = "A";
	EXPECT_EQ(ReportJson(RunOnCylinder(flat)).find("wrap_"), std::string::npos);
}

TEST(WrapRequest, RadiusThatIsGiven)
{
	LabelRequest request = Round();
	request.wrapRadius = 10;
	EXPECT_EQ(RunOnCylinder(request).view.wrapRadius, 10);
	request.wrapRadius = 1e9;
	EXPECT_EQ(ProblemOf(request), RequestProblem::OutOfRange);
	request.wrapRadius = NAN;
	EXPECT_EQ(ProblemOf(request), RequestProblem::NotANumber);
}

// Moved onto a thinner shaft letters are squeezed: the widths that are asked for are those on the surface.
TEST(WrapRequest, StrokesOnAThinnerShaft)
{
	LabelRequest request = Round();
	request.text = "III";
	request.position = {0, 6, 12};
	request.offsetV = -12;
	const auto run = [&] { return RunOn(Turned({3, 3, 3, 10, 10, 10}, 64, 4), request); };
	const LabelReport report = run();
	EXPECT_NEAR(report.leastStretch, 0.3, 1e-3);
	EXPECT_NE(ReportJson(report).find("\"least_stretch\":"), std::string::npos) << ReportJson(report);
	for (double LabelRequest::*width : {&LabelRequest::minStroke, &LabelRequest::minGap}) {
		const double flat = width == &LabelRequest::minGap ? report.narrowestGap : report.thinnestStroke;
		request.*width = 0.2 * flat;
		EXPECT_NO_THROW(run());
		request.*width = 0.5 * flat;
		try {
			run();
			ADD_FAILURE() << "no refusal";
		} catch (const vcg::textlabel::Error& error) {
			EXPECT_EQ(int(error.code), int(vcg::textlabel::ErrorCode::Squeezed)) << error.what();
			EXPECT_NEAR(error.value, 0.3, 1e-3);
		}
		request.*width = 0;
	}
}

TEST(WrapRequest, SizeLeftToTheFilter)
{
	LabelRequest request = Round();
	request.size = request.depth = ChosenToFit;
	for (const char* text : {"A", "ROUND", "ROUND AND ROUND IT GOES AND NEVER COMES TO ITS END"}) {
		request.text = text;
		EXPECT_GT(RunOnCylinder(request).size, 0.6) << text;  // the last one goes half the way round
	}
	request.rotation = 90;  // along the part it has the part's length
	EXPECT_GT(RunOnCylinder(request).size, 0.3);
	EXPECT_LT(RunOnCylinder(request).size, 0.5);
}

// A sheet that is bent a little does not go round its axis: its own width counts.
TEST(WrapRequest, SizeOnABentSheet)
{
	const Shape sheet = test_mesh::Sheet(40, 10, [](int i, int j) {
		const double a = (i - 20) * 0.01;
		return Point3d(100 * std::sin(a), j - 5, 100 * std::cos(a));
	});
	LabelRequest request = Round();
	request.size = request.depth = ChosenToFit;
	request.position = {0, 0, 101};
	const LabelReport report = RunOn(sheet, request);
	EXPECT_NEAR(report.view.wrapRadius, 100, 0.1);
	const TextOutline outline = MakeTextOutline(request.text, TextOptionsOf(request, report.size));
	EXPECT_NEAR(outline.boxMax[0] - outline.boxMin[0], 20, 0.1) << "half of 40";
}

// Seen on the lines across the axis, something stands before the place: the letters would land on that.
TEST(WrapRequest, RefusesWhatIsHidden)
{
	const Shape shaft = Turned({10, 10, 10, 10}, 48, 8), rod = Turned({4, 4, 4, 4}, 48, 8);
	for (const double gap : {1.0, 5.0, 40.0}) {
		const Shape wall =
			test_mesh::Slab(60, 24, 4, 2, 2).moved([&](const Point3d& p) { return p + Point3d(0, 0, 14 + gap); });
		for (const double radius : {0.0, 10.0}) {
			LabelRequest request = Round();
			request.text = "A";
			request.position = {0, 0, 10};
			request.wrapRadius = radius;
			EXPECT_EQ(ProblemOf(request, shaft.joined(wall)), RequestProblem::HiddenRound) << gap;
			request.offsetU = 31;
			EXPECT_EQ(ProblemOf(request, shaft.joined(wall)), std::nullopt) << "on the other side nothing is before it";
		}
	}
	Shape bore = shaft;
	for (auto& f : bore.faces) std::swap(f[1], f[2]);
	LabelRequest inside = Round();
	inside.text = "A";
	inside.position = {0, 0, -10};
	EXPECT_EQ(ProblemOf(inside, bore.joined(rod)), RequestProblem::HiddenRound);
	EXPECT_EQ(ProblemOf(inside, bore.joined(rod.moved([](const Point3d& p) { return p + Point3d(0, 0, 5); }))),
	          std::nullopt)
		<< "beyond the axis nothing hides it";
}

// A shift goes round the part; a width may be nearly all the way.
TEST(WrapRequest, ShiftedRound)
{
	LabelRequest request = Round();
	request.text = "A";
	request.offsetU = 20;
	request.offsetV = -3;
	const LabelReport report = RunOnCylinder(request);
	EXPECT_LT((report.view.anchor - Point3d(10 * std::sin(2.0), -3, 10 * std::cos(2.0))).Norm(), 1e-5);
	EXPECT_LT((report.view.direction - Point3d(std::sin(2.0), 0, std::cos(2.0))).Norm(), 1e-6);
	request = Round();
	request.fitWidth = 58;
	EXPECT_GT(RunOnCylinder(request).labelArea, 60);
}

// Inside a pipe a label is read from the axis, though the far wall lies between.
TEST(WrapRequest, InsideAPipe)
{
	Shape pipe = Turned({10, 10, 10, 10}, 48, 8).joined(Turned({9, 9, 9, 9}, 48, 8));
	for (size_t f = pipe.faces.size() / 2; f < pipe.faces.size(); ++f) std::swap(pipe.faces[f][1], pipe.faces[f][2]);
	LabelRequest request = Round();
	request.position = {0, 0, -9};
	EXPECT_NEAR(RunOn(pipe, request).view.wrapRadius, -9, 1e-5);
}

TEST(WrapRequest, Rotated)
{
	LabelRequest request = Round();
	request.text = "HELIX";
	request.rotation = 30;
	EXPECT_NEAR(RunOnCylinder(request).stretch, 1, 1e-6);
}

TEST(WrapRequest, NeedsAPlaceAndAnAxis)
{
	LabelRequest request = Round();
	request.placement = PlacementKind::Automatic;
	EXPECT_EQ(ProblemOf(request), RequestProblem::WrapNeedsPlace);
	request = Round();
	request.position = {1, 40, 2};
	request.direction = {0, 1, 0};
	request.up = {0, 0, 1};
	EXPECT_EQ(ProblemOf(request), RequestProblem::NoAxis);
}

}  // namespace
