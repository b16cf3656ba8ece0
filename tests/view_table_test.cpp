// A few labels of the table of real parts seen from all sides (view_table_main.cpp), which as a whole takes minutes.

#include <gtest/gtest.h>

#include "view_label.h"

namespace {

using namespace view_label;

/// A part of the table, and whether every one of these labels can be made on it.
struct Sample {
	const char* file;
	bool takesAll;
};

TEST(ViewTable, SomeLabels)
{
	const char* programs = std::getenv("TEXTLABEL_BUILD_DIR");
	const bool hasJudges = programs && std::filesystem::exists(std::filesystem::path(programs) / "oracle_cgal") &&
	                       std::system("command -v admesh >/dev/null") == 0;
	const std::vector<Point3d> directions = ViewDirections();
	int made = 0;
	for (const Sample& sample : {Sample{"voron-cube.stl", true},
	                             {"spot.ply", true},
	                             {"rbc-1e-6-derived.stl", true},
	                             {"prusa-fs-lever-utm-derived.obj", true},
	                             {"assimp-spider.stl", false}}) {
		const std::filesystem::path file = Folder() / sample.file;
		if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
		const Part part(file);
		std::optional<OtherJudges> judges;
		if (hasJudges) judges.emplace(part.shape, part.isFloat, programs);
		for (const size_t d : {size_t(3), size_t(8)})
			for (const LabelStyle style : {LabelStyle::Emboss, LabelStyle::Engrave, LabelStyle::Flat}) {
				SCOPED_TRACE(testing::Message() << sample.file << ", view " << d << ", style " << int(style));
				textlabel::LabelRequest request = RequestFrom(part, directions[d]);
				request.style = style;
				request.text = ViewTexts()[d % ViewTexts().size()];
				const Labelled label = Label(part, request);
				EXPECT_EQ(label.fault, "");
				if (sample.takesAll) { EXPECT_TRUE(label.isMade) << label.sentence; }
				if (!label.isMade) continue;
				++made;
				if (judges) { EXPECT_EQ(judges->fault(label.shape, part.isFloat && label.survivesFloat32), ""); }
			}
	}
	EXPECT_GE(made, 24);
}

}  // namespace
