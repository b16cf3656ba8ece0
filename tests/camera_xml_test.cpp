// MeshLab's copied camera, against MeshLab's own reader and writer (VCGlib's shot_qt.h), and hostile texts.

#include "filter_textlabel/camera_xml.h"
#include "filter_textlabel/request_error.h"

#include <QtXml>
#include <gtest/gtest.h>
#include <random>
#include <vcg/math/shot.h>
#include <wrap/qt/shot_qt.h>

using namespace textlabel;

namespace {

using Shot = vcg::Shot<float>;

Shot RandomShot(unsigned seed)
{
	std::mt19937 random(seed);
	const auto number = [&](double size) { return float(size * (double(random()) / double(random.max()) * 2 - 1)); };
	Shot shot;
	vcg::Matrix44f rotation;
	vcg::Point3f axis(number(1), number(1), number(1));
	rotation.SetRotateRad(number(3), axis.Normalize());
	shot.Extrinsics.SetRot(rotation);
	shot.Extrinsics.SetTra({number(100), number(100), number(1e5)});
	shot.Intrinsics.cameraType = seed % 2 ? vcg::Camera<float>::ORTHO : vcg::Camera<float>::PERSPECTIVE;
	shot.Intrinsics.FocalMm = 27.5f;
	shot.Intrinsics.PixelSizeMm = {0.0369161f, 0.0369161f};
	shot.Intrinsics.ViewportPx = {801, 600};
	shot.Intrinsics.CenterPx = {400, 300};
	return shot;
}

/// The document that MeshLab copies.
std::string Copied(const Shot& shot, bool binary = false)
{
	QDomDocument document("ViewState");
	QDomElement root = document.createElement("project");
	document.appendChild(root);
	root.appendChild(binary ? WriteShotToQDomNodeBinary(shot, document) : WriteShotToQDomNode(shot, document));
	QDomElement settings = document.createElement("ViewSettings");
	settings.setAttribute("TrackScale", 0.5);
	root.appendChild(settings);
	return document.toString().toStdString();
}

void ExpectSameView(const Camera& camera, const Shot& shot, double tolerance)
{
	const auto near = [&](const vcg::Point3d& a, const vcg::Point3f& b) {
		EXPECT_LE((a - vcg::Point3d::Construct(b)).Norm(), tolerance * (1 + vcg::Point3d::Construct(b).Norm()));
	};
	near(camera.viewpoint, shot.GetViewPoint());
	near(camera.right, shot.Axis(0));
	near(camera.up, shot.Axis(1));
	near(camera.backwards, shot.Axis(2));
	EXPECT_EQ(camera.perspective, shot.Intrinsics.cameraType == 0);
	EXPECT_EQ(camera.viewportPx, (std::array<int, 2>{801, 600}));
}

/// The problem of reading a text, or nothing when it can be read.
std::optional<RequestProblem> ProblemOf(const std::string& xml)
{
	try {
		ReadCamera(xml);
		return {};
	} catch (const RequestError& error) {
		EXPECT_EQ(error.parameter, "camera");
		return error.problem;
	}
}

}  // namespace

TEST(Camera, ReadsWhatMeshLabCopies)
{
	constexpr double sixDigits = 2e-5, single = 1e-6;
	for (unsigned seed = 0; seed < 50; ++seed) {
		const Shot shot = RandomShot(seed);
		ExpectSameView(ReadCamera(Copied(shot)), shot, sixDigits);
		ExpectSameView(ReadCamera(Copied(shot, true)), shot, single);
	}
}

TEST(Camera, LooksWhereTheShotProjects)
{
	// A point before the viewpoint on the axis must come to the centre of the picture, one to the right of it to the right.
	Shot shot = RandomShot(4);
	shot.Extrinsics.SetTra({1, 2, 3});
	const Camera camera = ReadCamera(Copied(shot));
	const vcg::Point3d ahead = camera.viewpoint - camera.backwards * 10.0;
	const vcg::Point2f center = shot.Project(vcg::Point3f::Construct(ahead));
	EXPECT_NEAR(center[0], 400, 0.05);
	EXPECT_NEAR(center[1], 300, 0.05);
	EXPECT_GT(shot.Project(vcg::Point3f::Construct(ahead + camera.right))[0], center[0] + 10);
	EXPECT_GT(shot.Project(vcg::Point3f::Construct(ahead + camera.up))[1], center[1] + 10);
}

TEST(Camera, WritesWhatMeshLabReads)
{
	for (unsigned seed = 0; seed < 20; ++seed) {
		const Camera camera = ReadCamera(Copied(RandomShot(seed)));
		QDomDocument document;
		ASSERT_TRUE(document.setContent(QByteArray::fromStdString(WriteCamera(camera))));
		Shot read;
		ASSERT_TRUE(ReadShotFromQDomNode(read, document.documentElement().firstChild()));
		ExpectSameView(camera, read, 1e-6);
		EXPECT_FLOAT_EQ(read.Intrinsics.FocalMm, 27.5f);
		EXPECT_NEAR(read.Intrinsics.CenterPx[1], 300, 1e-3);
	}
}

TEST(Camera, ReadsItsOwnTextToTheLastBit)
{
	for (unsigned seed = 0; seed < 20; ++seed) {
		const Camera once = ReadCamera(WriteCamera(ReadCamera(Copied(RandomShot(seed)))));
		const Camera twice = ReadCamera(WriteCamera(once));
		EXPECT_LE((once.backwards - twice.backwards).Norm(), 1e-15);
		EXPECT_EQ(once.viewpoint, twice.viewpoint);
		EXPECT_EQ(WriteCamera(ReadCamera(WriteCamera(once))), WriteCamera(twice));
	}
}

TEST(Camera, NamesWhatIsMissingOrUnreadable)
{
	const std::string good = Copied(RandomShot(1));
	ASSERT_FALSE(ProblemOf(good));
	for (const std::string name :
	     {"TranslationVector", "RotationMatrix", "FocalMm", "ViewportPx", "PixelSizeMm", "CenterPx"}) {
		const size_t at = good.find(name + "=\""), value = at + name.size() + 2, end = good.find('"', value);
		ASSERT_NE(at, std::string::npos) << name;
		for (const std::string bad : {"", "x", "nan nan nan nan", "1", "inf 0 0", "1e999 1e999 1e999"}) {
			if (name == "FocalMm" && bad == "1") continue;
			const std::string text = good.substr(0, value) + bad + good.substr(end);
			EXPECT_EQ(ProblemOf(text), RequestProblem::CameraIncomplete) << name << "=" << bad;
		}
		const bool isNeeded = name == "TranslationVector" || name == "RotationMatrix";
		EXPECT_EQ(ProblemOf(good.substr(0, at) + "Other" + good.substr(at)).has_value(), isNeeded) << name;
	}
}

TEST(Camera, RefusesMatricesThatAreNoRotation)
{
	for (const char* rows : {"2 0 0 0 0 1 0 0 0 0 1 0", "1 0 0 0 0 1 0 0 0 0 -1 0", "0 0 0 0 0 0 0 0 0 0 0 0",
	                         "1 0.01 0 0 0 1 0 0 0 0 1 0"}) {
		std::string text = WriteCamera(Camera());
		const std::string identity = "1 0 0 0 0 1 0 0 0 0 1 0";
		text.replace(text.find(identity), identity.size(), rows);
		EXPECT_EQ(ProblemOf(text), RequestProblem::CameraNotRotation) << rows;
	}
}

TEST(Camera, RefusesWhatIsNoCamera)
{
	EXPECT_EQ(ProblemOf(""), RequestProblem::CameraNotXml);
	EXPECT_EQ(ProblemOf("hello"), RequestProblem::CameraNotXml);
	EXPECT_EQ(ProblemOf("<a><b/></a>"), RequestProblem::CameraMissing);
	EXPECT_EQ(ProblemOf("<a>"), RequestProblem::CameraNotXml);
	EXPECT_EQ(ProblemOf(std::string("\0\xff\xfe", 3)), RequestProblem::CameraNotXml);
	std::string bomb = "<!DOCTYPE a [<!ENTITY x0 \"xxxxxxxxxx\">";
	for (int i = 1; i < 12; ++i) {
		const std::string before = "&x" + std::to_string(i - 1) + ";";
		bomb += "<!ENTITY x" + std::to_string(i) + " \"";
		for (int k = 0; k < 10; ++k) bomb += before;
		bomb += "\">";
	}
	EXPECT_EQ(ProblemOf(bomb + "]><a>&x11;</a>"), RequestProblem::CameraNotXml);
}

TEST(Camera, SurvivesDamage)
{
	const std::string good = Copied(RandomShot(2)), binary = Copied(RandomShot(3), true);
	std::mt19937 random(7);
	int readable = 0, refused = 0;
	for (const std::string& text : {good, binary}) {
		for (size_t length = 0; length < text.size(); ++length)
			ProblemOf(text.substr(0, length)) ? ++refused : ++readable;
		for (int i = 0; i < 3000; ++i) {
			std::string damaged = text;
			for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = char(random());
			ProblemOf(damaged) ? ++refused : ++readable;
		}
	}
	EXPECT_GT(refused, 1000);
	EXPECT_GT(readable, 100);  // a digit more or less is a camera, too
}
