// A whole run with a drawing in place of a text: what it does to the part, what is chosen for it, and what the report tells.

#include "filter_textlabel/label_service.h"
#include "drawing_case.h"
#include "test_mesh.h"

#include <gtest/gtest.h>

using namespace textlabel;
using vcg::textlabel::LabelFrame;

namespace {

/// A frame 40 wide and 20 high around a hole, with a block in it: 450 square units.
const std::string kFrame = drawing_case::Document(
	"<path fill-rule='evenodd' d='M0 0h40v20h-40zM5 2.5h30v15h-30z'/><rect x='10' y='7.5' width='20' height='5'/>");
constexpr double kFrameArea = 800 - 450 + 100;

LabelRequest OnTop()
{
	LabelRequest request;
	request.drawing = drawing_case::FileOf(kFrame);
	request.placement = PlacementKind::PointAndDirection;
	request.position = {0, 0, 0};
	return request;
}

/// On a plate of 100 by 60 by 10, its top at z = 0.
LabelReport RunOnPlate(const LabelRequest& request)
{
	test_mesh::RichMesh m;
	test_mesh::Fill(m, test_mesh::Slab(100, 60, 10, 9, 7));
	const ServiceHost host;
	ErrorContext context;
	LabelJob<test_mesh::RichMesh> job(m, LabelFrame::Identity(), host, context);
	return job.run(request);
}

TEST(DrawingService, ChangesTheVolumeByAreaTimesDepth)
{
	for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave}) {
		LabelRequest request = OnTop();
		request.size = 10;
		request.depth = 2;
		request.style = style;
		const LabelReport report = RunOnPlate(request);
		const double volume = (style == LabelStyle::Emboss ? 2 : -2) * kFrameArea / 4;
		EXPECT_NEAR(report.after.volume - report.before.volume, volume, 1e-3);
		EXPECT_NEAR(report.labelArea, kFrameArea / 4, 1e-3);
		EXPECT_EQ(report.after.nonManifoldEdges, 0);
		EXPECT_EQ(report.after.genus, report.before.genus);
		EXPECT_EQ(report.after.components, report.before.components);
	}
}

TEST(DrawingService, ChoosesSizeAndDepth)
{
	const LabelReport report = RunOnPlate(OnTop());
	EXPECT_NEAR(report.size, 25, 1e-6) << "twice as wide as high, and half as wide as the plate";
	EXPECT_NEAR(report.depth, report.size / 20, 1e-9);
	LabelRequest anywhere = OnTop();
	anywhere.placement = PlacementKind::Automatic;
	const LabelReport found = RunOnPlate(anywhere);
	EXPECT_NEAR(found.labelArea, kFrameArea * std::pow(found.size / 20, 2), 1e-2);
}

TEST(DrawingService, TheTextIsNotInTheReport)
{
	LabelRequest request = OnTop();
	request.text = "not read \xff";
	const std::string json = ReportJson(RunOnPlate(request));
	EXPECT_NE(json.find("\"text\":\"\""), std::string::npos) << json;
	EXPECT_NE(json.find("\"drawing\":\"" + request.drawing + "\""), std::string::npos) << json;
}

TEST(DrawingService, IsNotWrittenOver)
{
	for (std::string LabelRequest::*const file :
	     {&LabelRequest::outline, &LabelRequest::picture, &LabelRequest::report}) {
		LabelRequest request = OnTop();
		request.*file = ::testing::TempDir() + "./" + request.drawing.substr(::testing::TempDir().size());
		try {
			RunOnPlate(request);
			ADD_FAILURE() << "no error";
		} catch (const RequestError& error) {
			EXPECT_EQ(error.problem, RequestProblem::OverDrawing);
			EXPECT_NE(ErrorText(error).find("would be written over the drawing"), std::string::npos);
		}
		request.*file = request.drawing + ".other";
		EXPECT_NO_THROW(RunOnPlate(request));
	}
}

TEST(DrawingService, RefusesAsForATextThatIsWrong)
{
	const auto codeOf = [](const LabelRequest& request) {
		try {
			RunOnPlate(request);
		} catch (const TextError& error) {
			return error.code;
		}
		ADD_FAILURE() << "no error";
		return TextErrorCode::Unsound;
	};
	LabelRequest request = OnTop();
	request.code = CodeKind::QrCode;
	EXPECT_EQ(codeOf(request), TextErrorCode::DrawingAndCode);
	request = OnTop();
	request.drawing = "nowhere.svg";
	EXPECT_EQ(codeOf(request), TextErrorCode::DrawingUnreadable);
	request = OnTop();
	request.size = 10;
	request.minStroke = 2;
	EXPECT_EQ(codeOf(request), TextErrorCode::TooThin);
}

}  // namespace
