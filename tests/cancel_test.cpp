// Cancelled at any report of progress, whatever the label: the mesh is as it was, and nothing goes on.

#include "vcg_ext/text_label.h"

#include <algorithm>
#include <gtest/gtest.h>

#include "filter_textlabel/label_service.h"
#include "fuzz_label_judge.h"
#include "random_label.h"
#include "test_mesh.h"

namespace {

using namespace vcg::textlabel;
using vcg::textlabel::test::LabelCase;
using vcg::textlabel::test::Random;

/// What came of a run that says stop at its n-th report (0: never).
struct Outcome {
	std::vector<int> reports;  ///< percent
	bool isMade = false;
	ErrorCode code{};
	int attempts = 0;  ///< when made
	bool isChanged = false;
};

template <class MeshType>
Outcome RunCase(const LabelCase& c, int stopAt)
{
	Outcome run;
	MeshType m;
	vcg::textlabel::test::detail::Fill(m, c.mesh);
	const auto before = vcg::textlabel::test::detail::SoupOf(m);
	LabelOptions options;
	options.height = c.height;
	options.along = c.along;
	options.maxStretch = c.maxStretch;
	options.progress = [&](int percent) {
		run.reports.push_back(percent);
		return int(run.reports.size()) != stopAt;
	};
	try {
		run.attempts = LabelMesh(m, c.outline, c.frame, options).attempts;
		run.isMade = true;
	} catch (const Error& e) {
		run.code = e.code;
	}
	run.isChanged = !vcg::textlabel::test::detail::AreSame(before, vcg::textlabel::test::detail::SoupOf(m));
	return run;
}

/// Stop at each report in turn.
/// @return the run that was not stopped
template <class MeshType>
Outcome CancelEverywhere(const LabelCase& c)
{
	const Outcome whole = RunCase<MeshType>(c, 0);
	EXPECT_TRUE(std::is_sorted(whole.reports.begin(), whole.reports.end())) << "the progress went back";
	for (const int percent : whole.reports) {
		EXPECT_GE(percent, 0);
		EXPECT_LE(percent, 100);
	}
	for (int stop = 1; stop <= int(whole.reports.size()); ++stop) {
		const Outcome stopped = RunCase<MeshType>(c, stop);
		EXPECT_FALSE(stopped.isMade);
		EXPECT_EQ(int(stopped.code), int(ErrorCode::Cancelled)) << "at report " << stop;
		EXPECT_EQ(int(stopped.reports.size()), stop) << "went on after the stop";
		EXPECT_FALSE(stopped.isChanged);
	}
	return whole;
}

TEST(Cancel, AtEveryReportOfAnyLabel)
{
	int made = 0, refused = 0, shifted = 0;
	std::vector<std::uint64_t> seeds{2311, 2835};  // of labels that take several attempts, which few do
	for (std::uint64_t seed = 1; seed <= 60; ++seed) seeds.push_back(seed);
	for (const std::uint64_t seed : seeds) {
		SCOPED_TRACE(testing::Message() << "seed " << seed);
		Random random(seed);
		const LabelCase c = MakeLabelCase(random);
		const Outcome whole = c.isFloat ? CancelEverywhere<vcg::textlabel::test::detail::FloatMesh>(c)
		                                : CancelEverywhere<vcg::textlabel::test::detail::DoubleMesh>(c);
		++(whole.isMade ? made : refused);
		shifted += whole.attempts > 1;
		if (whole.isMade) { EXPECT_GE(whole.reports.size(), 3u); }
	}
	EXPECT_GT(made, 30);
	EXPECT_GT(refused, 5);
	EXPECT_GT(shifted, 0) << "the seeds have lost their purpose";
}

// A refusal says how high the letters may rise; what they meet there is seen beside them, and so looked for once more. That can be
// stopped as well.
TEST(Cancel, WhileTheHeightThatFitsIsLookedFor)
{
	const test_mesh::Shape hovering =
		test_mesh::Box(1, 1, 0.5).moved([](const vcg::Point3d& p) { return p + vcg::Point3d(8, 0, 7.5); });
	const test_mesh::Shape both = test_mesh::Slab(30, 20, 4, 15, 10).joined(hovering);
	LabelCase c;
	for (const vcg::Point3d& p : both.points) c.mesh.add(p);
	c.mesh.faces = both.faces;
	c.outline.contours.push_back({{{6, -2}, {8, -2}, {8, 2}, {6, 2}}, 0, 0});
	c.outline.partCount = 1;
	c.frame.perspective = true;
	c.frame.center = {0, 0, 10};
	c.height = 8;
	for (const ExtrudeAlong along : {ExtrudeAlong::LabelNormal, ExtrudeAlong::SurfaceNormal}) {
		c.along = along;
		const Outcome whole = CancelEverywhere<vcg::textlabel::test::detail::FloatMesh>(c);
		EXPECT_FALSE(whole.isMade);
		EXPECT_EQ(int(whole.code), int(ErrorCode::HitsSurface));
		EXPECT_GT(whole.reports.size(), 12u) << "one for each height that is tried";
	}
}

// The filter as a host runs it, with the size left to it: the stop ends all attempts, not one.
TEST(Cancel, TheFilterAtEveryReport)
{
	const test_mesh::Shape plate = test_mesh::Slab(30, 20, 4, 15, 10);
	for (const auto style : {textlabel::LabelStyle::Emboss, textlabel::LabelStyle::Flat}) {
		textlabel::LabelRequest request;
		request.style = style;
		request.placement = textlabel::PlacementKind::PointAndDirection;
		request.position = {13, 0, 0};  // so near to the edge that the first sizes are refused
		int reports = 0;
		for (int stop = 0; stop == 0 || stop <= reports; ++stop) {
			test_mesh::RichMesh m;
			test_mesh::Fill(m, plate);
			const std::string bytes = test_mesh::Bytes(m);
			int calls = 0;
			textlabel::ServiceHost host;
			host.progress = [&](int) { return ++calls != stop; };
			textlabel::ErrorContext context;
			textlabel::LabelJob<test_mesh::RichMesh> job(m, LabelFrame::Identity(), host, context);
			if (stop == 0) {
				EXPECT_NO_THROW(job.run(request));
				reports = calls;
				EXPECT_GE(reports, 3);
				continue;
			}
			try {
				job.run(request);
				ADD_FAILURE() << "not stopped at report " << stop;
			} catch (const Error& e) {
				EXPECT_EQ(int(e.code), int(ErrorCode::Cancelled));
			}
			EXPECT_EQ(calls, stop) << "went on after the stop";
			EXPECT_TRUE(test_mesh::Bytes(m) == bytes);
		}
	}
}

}  // namespace
