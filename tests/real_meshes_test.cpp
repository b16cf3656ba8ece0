// Real parts, labelled: each closed one must come out as clean as it was, also as an STL file, by our own report and by admesh.
// The others (open, non-manifold, in map coordinates) may refuse the label, but must not get worse.

#include "vcg_ext/text_label.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <map>
#include <unistd.h>

#include "filter_textlabel/auto_placement.h"
#include "label_check.h"
#include "oracle_mesh_file.h"
#include "test_mesh.h"
#include "text_outline.h"

namespace {

using namespace label_check;
using test_mesh::FloatMesh;
using test_mesh::Shape;

std::filesystem::path Folder()
{
	if (const char* given = std::getenv("TEXTLABEL_REAL_MESHES")) return given;
	return std::filesystem::path(TEXTLABEL_SOURCE_DIR) / "../shared/meshes";
}

IndexedMesh ToIndexed(const Shape& s)
{
	IndexedMesh m;
	m.positions = s.points;
	for (const auto& f : s.faces) m.faces.push_back({f[0], f[1], f[2]});
	return m;
}

/// The mesh of a file with equal points merged.
Shape Load(const std::filesystem::path& file, bool asFloat32)
{
	const oracle::MeshFile raw = oracle::ReadMeshFile(file.string());
	Shape s;
	for (const auto& p : raw.points) s.points.emplace_back(p[0], p[1], p[2]);
	s.faces = raw.faces;
	const IndexedMesh merged = PrepareForReport(ToIndexed(s), {asFloat32, true});
	s.points = merged.positions;
	s.faces.clear();
	for (const auto& f : merged.faces) s.faces.push_back({f[0], f[1], f[2]});
	return s;
}

MeshReport ReportOf(const Shape& s, bool asFloat32)
{
	return MakeReport(PrepareForReport(ToIndexed(s), {asFloat32, true}));
}

bool IsClosedManifold(const MeshReport& r) { return IsClosed(r) && IsManifold(r) && IsOriented(r); }

/// No fault has become more frequent, and borders, pieces and handles are what they were.
void ExpectNoWorse(const MeshReport& before, const MeshReport& after)
{
	const std::vector<std::pair<const char*, int MeshReport::*>> counts = {
		{"repeatedIndexFaces", &MeshReport::repeatedIndexFaces},   {"collinearFaces", &MeshReport::collinearFaces},
		{"duplicateFaces", &MeshReport::duplicateFaces},           {"nonManifoldEdges", &MeshReport::nonManifoldEdges},
		{"nonManifoldVertices", &MeshReport::nonManifoldVertices}, {"flippedEdges", &MeshReport::flippedEdges},
		{"unbalancedEdges", &MeshReport::unbalancedEdges},         {"notFinite", &MeshReport::notFinite}};
	for (const auto& [name, member] : counts) EXPECT_LE(after.*member, before.*member) << name;
	EXPECT_EQ(after.borderEdges, before.borderEdges);
	EXPECT_EQ(after.borderLoops, before.borderLoops);
	EXPECT_EQ(after.components, before.components);
	EXPECT_EQ(after.genus, before.genus);
}

void WriteStl(const Shape& s, const std::string& file)
{
	std::ofstream out(file, std::ios::binary);
	const std::string head(80, ' ');
	out.write(head.data(), 80);
	const auto put = [&out](const auto& x) { out.write(reinterpret_cast<const char*>(&x), sizeof x); };
	put(static_cast<std::uint32_t>(s.faces.size()));
	for (const auto& f : s.faces) {
		for (int i = 0; i < 3; ++i) put(0.0f);
		for (const int v : f)
			for (int i = 0; i < 3; ++i) put(static_cast<float>(s.points[size_t(v)][i]));
		put(static_cast<std::uint16_t>(0));
	}
}

/// What oracle_admesh.sh says of a file: key to value; empty without admesh.
std::map<std::string, double> AskAdmesh(const std::string& file)
{
	std::map<std::string, double> answer;
	const std::string command = "bash " TEXTLABEL_SOURCE_DIR "/tests/oracle_admesh.sh '" + file + "' 2>/dev/null";
	FILE* pipe = popen(command.c_str(), "r");
	if (pipe == nullptr) return answer;
	char line[256];
	while (std::fgets(line, sizeof line, pipe) != nullptr) {
		const std::string text = line;
		const size_t equals = text.find('=');
		if (equals != std::string::npos) answer[text.substr(0, equals)] = std::atof(text.c_str() + equals + 1);
	}
	pclose(pipe);
	return answer;
}

void ExpectAdmeshHasNothingToDo(const Shape& s, const std::string& name, int parts)
{
	const std::string file = testing::TempDir() + std::to_string(getpid()) + name + ".stl";
	WriteStl(s, file);
	std::map<std::string, double> answer = AskAdmesh(file);
	if (!answer.empty()) {
		for (const char* key : {"disconnected_1", "disconnected_2", "disconnected_3", "degenerate", "edges_fixed",
		                        "removed", "added", "reversed", "backwards"}) {
			ASSERT_EQ(answer.count(key), 1u) << key;
			EXPECT_EQ(answer[key], 0) << key << " in " << file;
		}
		EXPECT_EQ(answer["parts"], parts);
	}
	if (!testing::Test::HasFailure()) std::filesystem::remove(file);
}

struct Text {
	const char* name;
	textlabel::TextOutline outline;  ///< at capital height 1

	Text(const char* n, const std::string& utf8) : name(n)
	{
		textlabel::TextOptions options;
		options.size = 1;
		outline = textlabel::MakeTextOutline(utf8, options);
	}
	double width() const { return outline.boxMax[0] - outline.boxMin[0]; }
	double height() const { return outline.boxMax[1] - outline.boxMin[1]; }
};

struct Attempt {
	std::string refused;  ///< why places were refused, one line each; empty when it worked
	LabelResult result;
	double height = 0;
};

/// Put a text on the first of the offered places that the library takes.
template <class MeshType>
Attempt LabelSomewhere(MeshType& m, const Shape& part, const Text& text, double depth)
{
	textlabel::PlaceQuery query{part.points, part.faces};
	query.labelWidth = text.width();
	query.labelHeight = text.height();
	const Point2d middle = (text.outline.boxMin + text.outline.boxMax) / 2;
	Attempt attempt;
	const bool isMade = textlabel::OfferPlaces(query, [&](const textlabel::Place& place) {
		LabelOptions options;
		options.height = attempt.height = std::max(depth * place.size, -place.wall / 2);
		const Outline outline =
			Moved(text.outline.outline, place.size, -middle[0] * place.size, -middle[1] * place.size);
		try {
			attempt.result =
				LabelMesh(m, outline, FrameFromDirection(place.position, place.direction, place.up), options);
			return true;
		} catch (const Error& e) {
			attempt.refused += std::string(e.what()) + " (code " + std::to_string(int(e.code)) + ")\n";
			return false;
		}
	});
	if (isMade) attempt.refused.clear();
	else if (attempt.refused.empty()) attempt.refused = "no place\n";
	return attempt;
}

/// @param asFloat32  the mesh has float32 coordinates, and is judged as an STL file
template <class MeshType>
void LabelAndJudge(const std::string& name, bool asFloat32)
{
	const Shape part = Load(Folder() / name, asFloat32);
	const MeshReport before = ReportOf(part, asFloat32);
	const bool crossesBefore = !FindCrossings(ToIndexed(part), {true}).empty();
	int refused = 0, made = 0;
	for (const Text& text : {Text("A43", "A43"), Text("SN", "SN-0123456789 gqy%&@")})
		for (const double depth : {0.15, -0.1, 0.0}) {
			SCOPED_TRACE(std::string(text.name) + " " + std::to_string(depth));
			MeshType m;
			test_mesh::Fill(m, part);
			const std::string bytes = test_mesh::Bytes(m);
			const Attempt attempt = LabelSomewhere(m, part, text, depth);
			if (IsSound(before)) { EXPECT_EQ(attempt.refused, ""); }
			if (!attempt.refused.empty()) {
				++refused;
				EXPECT_TRUE(test_mesh::Bytes(m) == bytes) << "refused, and changed";
				continue;
			}
			++made;
			const Shape labelled = test_mesh::ToShape(m);
			ExpectNoWorse(before, ReportOf(labelled, asFloat32));
			if (!crossesBefore) {  // each piece of a face that crossed others may cross them
				EXPECT_EQ(FindCrossings(ToIndexed(labelled)).size(), 0u);
			}
			if (!IsClosedManifold(before)) continue;
			// parallel, along the rays: volume is area times height, whatever the surface
			const double added = Volume(labelled) - Volume(part), expected = attempt.result.labelArea * attempt.height;
			EXPECT_NEAR(added, expected, 1e-4 * std::abs(expected) + 2e-6 * std::abs(Volume(part)));
			if (asFloat32 && IsSound(before))
				ExpectAdmeshHasNothingToDo(labelled, name + "_" + text.name + "_" + std::to_string(depth),
				                           before.components);
		}
	std::cout << made << " labels made, " << refused << " refused\n";
}

class RealMesh : public testing::TestWithParam<std::string> {};

TEST_P(RealMesh, IsAsCleanWithALabel) { LabelAndJudge<FloatMesh>(GetParam(), true); }

TEST_P(RealMesh, IsAsCleanWithALabelInDoubles) { LabelAndJudge<test_mesh::DoubleMesh>(GetParam(), false); }

std::vector<std::string> Files()
{
	std::vector<std::string> files;
	std::error_code none;
	for (const auto& entry : std::filesystem::directory_iterator(Folder(), none)) {
		const std::string type = entry.path().extension().string();
		if (type == ".stl" || type == ".ply" || type == ".obj") files.push_back(entry.path().filename().string());
	}
	std::sort(files.begin(), files.end());
	return files;
}

std::string NameOf(const testing::TestParamInfo<std::string>& p)
{
	std::string name = p.param;
	for (char& c : name)
		if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
	return name;
}

INSTANTIATE_TEST_SUITE_P(Label, RealMesh, testing::ValuesIn(Files()), NameOf);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RealMesh);

TEST(RealMeshes, AreThere)
{
	if (Files().empty()) GTEST_SKIP() << "no real meshes in " << Folder();
}

}  // namespace
