// Our report side by side with two independent judges, CGAL (oracle_cgal) and admesh (oracle_admesh.sh), on STL files that are
// sound, that are damaged in a known way, and that are real.

#include "vcg_ext/validate.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <unistd.h>

#include "oracle_mesh_file.h"

namespace {

using namespace vcg::textlabel;
namespace fs = std::filesystem;
using vcg::Point3d;
using Values = std::map<std::string, double>;

fs::path FromEnvironment(const char* name, const fs::path& fallback)
{
	const char* value = std::getenv(name);
	return value ? fs::path(value) : fallback;
}

const fs::path kTests = fs::path(__FILE__).parent_path();
const fs::path kCgal = FromEnvironment("TEXTLABEL_BUILD_DIR", fs::current_path()) / "oracle_cgal";
const fs::path kMeshes = FromEnvironment("TEXTLABEL_REAL_MESHES", kTests / "../../shared/meshes");

/// The key=value words that a command prints; nothing when it fails.
std::optional<Values> Ask(const std::string& command)
{
	FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r");
	if (!pipe) return std::nullopt;
	Values values;
	char word[256];
	while (std::fscanf(pipe, "%255s", word) == 1)
		if (const std::string text = word; text.find('=') != std::string::npos)
			values[text.substr(0, text.find('='))] = std::strtod(text.c_str() + text.find('=') + 1, nullptr);
	if (pclose(pipe) != 0) return std::nullopt;
	return values;
}

std::optional<Values> AskCgal(const fs::path& file) { return Ask("'" + kCgal.string() + "' '" + file.string() + "'"); }
std::optional<Values> AskAdmesh(const fs::path& file)
{
	return Ask("bash '" + (kTests / "oracle_admesh.sh").string() + "' '" + file.string() + "'");
}

IndexedMesh Read(const fs::path& path)
{
	const oracle::MeshFile file = oracle::ReadMeshFile(path.string());
	IndexedMesh mesh;
	for (const auto& p : file.points) mesh.positions.push_back(Point3d(p[0], p[1], p[2]));
	mesh.faces = file.faces;
	return PrepareForReport(mesh, {false, true});
}

/// A text STL that is removed again. The process is in its name: tests that run side by side write the same cases.
class StlFile {
public:
	StlFile(const std::string& name, const std::vector<Corners>& faces);
	~StlFile() { fs::remove(path_); }
	StlFile(const StlFile&) = delete;
	StlFile& operator=(const StlFile&) = delete;
	const fs::path& path() const { return path_; }

private:
	fs::path path_;
};

StlFile::StlFile(const std::string& name, const std::vector<Corners>& faces)
	: path_(fs::path(testing::TempDir()) / (std::to_string(getpid()) + "_validate_" + name + ".stl"))
{
	FILE* out = std::fopen(path_.c_str(), "w");
	std::fputs("solid s\n", out);
	for (const Corners& t : faces) {
		std::fputs("facet normal 0 0 0\nouter loop\n", out);
		for (const Point3d& p : t) std::fprintf(out, "vertex %.9g %.9g %.9g\n", p[0], p[1], p[2]);
		std::fputs("endloop\nendfacet\n", out);
	}
	std::fputs("endsolid s\n", out);
	std::fclose(out);
}

/// A tetrahedron of volume 1/6 with its right angles at `corner`.
std::vector<Corners> Tetrahedron(const Point3d& corner, double size = 1)
{
	const Point3d x = corner + Point3d(size, 0, 0), y = corner + Point3d(0, size, 0), z = corner + Point3d(0, 0, size);
	return {{corner, y, x}, {corner, x, z}, {corner, z, y}, {x, y, z}};
}

struct Case {
	std::string name;
	std::vector<Corners> faces;
	MeshReport expected;  ///< the fields that the damage touches
	int crossingPairs = 0;
};

std::vector<Case> Cases()
{
	std::vector<Case> cases;
	const auto sound = Tetrahedron({0, 0, 0});
	const auto add = [&](const std::string& name, std::vector<Corners> faces) -> Case& {
		cases.push_back({name, std::move(faces), {}, 0});
		cases.back().expected.components = 1;
		return cases.back();
	};
	const auto join = [](std::vector<Corners> a, const std::vector<Corners>& b) {
		a.insert(a.end(), b.begin(), b.end());
		return a;
	};
	add("sound", sound);
	add("open", {sound[0], sound[1], sound[2]}).expected.borderEdges = 3;
	add("flipped", {sound[0], sound[1], sound[2], {sound[3][1], sound[3][0], sound[3][2]}}).expected.flippedEdges = 3;
	add("repeated_point", join(sound, {{sound[0][0], sound[0][1], sound[0][1]}})).expected.repeatedIndexFaces = 1;
	// a face x, y, middle of xy without area sits between the two faces of edge xy
	const Point3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0), middle(0.5, 0.5, 0);
	Case& collinear = add("collinear", {{o, y, middle}, {o, middle, x}, {x, middle, y}, sound[1], sound[2], sound[3]});
	collinear.expected.collinearFaces = 1;
	collinear.crossingPairs = 2;  // xyz meets each half of the base in half of its edge xy, without sharing it
	add("two_apart", join(sound, Tetrahedron({5, 5, 5}))).expected.components = 2;
	// the corner of the second is in the middle of the first: three of its faces against the slanted one
	Case& crossing = add("crossing", join(sound, Tetrahedron({0.2, 0.2, 0.2})));
	crossing.expected.components = 2;
	crossing.crossingPairs = 3;
	Case& edge = add("shared_edge", join(sound, {{x, y, Point3d(2, 2, 1)},
	                                             {y, x, Point3d(2, 2, -1)},
	                                             {x, Point3d(2, 2, 1), Point3d(2, 2, -1)},
	                                             {y, Point3d(2, 2, -1), Point3d(2, 2, 1)}}));
	edge.expected.nonManifoldEdges = 1;
	Case& vertex = add("shared_vertex", join(sound, Tetrahedron({1, 0, 0})));
	vertex.expected.nonManifoldVertices = 1;
	vertex.expected.components = 2;
	Case& twice = add("face_twice", join(sound, {sound[3]}));
	twice.expected.duplicateFaces = 1;
	twice.expected.nonManifoldEdges = 3;
	twice.expected.unbalancedEdges = 3;
	twice.crossingPairs = 1;
	return cases;
}

/// What both judges see, of any mesh.
void ExpectCgalAgrees(const IndexedMesh& mesh, const Values& cgal)
{
	const MeshReport r = MakeReport(mesh);
	EXPECT_EQ(r.faces, cgal.at("faces"));
	EXPECT_EQ(r.repeatedIndexFaces, cgal.at("repeated_index"));
	EXPECT_EQ(r.collinearFaces, cgal.at("collinear"));
	EXPECT_EQ(FindCrossings(mesh).size(), cgal.at("crossing_pairs"));
	// Its test goes by indices too, and takes edges of two equal directions for non-manifold.
	const bool isSurface = IsManifold(r) && IsOriented(r);
	EXPECT_EQ(isSurface, cgal.at("manifold_oriented") == 1);
	if (!isSurface) return;
	EXPECT_EQ(IsClosed(r), cgal.at("closed") == 1);
	EXPECT_EQ(r.eulerCharacteristic, cgal.at("euler"));
	EXPECT_EQ(cgal.at("crossing_pairs"), cgal.at("manifold_crossing_pairs"));
	if (IsClosed(r)) { EXPECT_NEAR(r.volume, cgal.at("volume"), 1e-8 * std::abs(r.volume)); }
}

void ExpectAdmeshAgrees(const MeshReport& r, const Values& admesh)
{
	EXPECT_EQ(r.faces + r.repeatedIndexFaces, admesh.at("faces"));
	EXPECT_EQ(r.repeatedIndexFaces, admesh.at("degenerate"));
	// It pairs the sides of an edge as they come, and so sees open ones only where their number is odd.
	if (r.nonManifoldEdges == 0) {
		EXPECT_EQ(r.borderEdges,
		          admesh.at("disconnected_1") + 2 * admesh.at("disconnected_2") + 3 * admesh.at("disconnected_3"));
	}
	if (!IsClosed(r) || !IsManifold(r)) return;  // what follows is said of the mesh after its repair
	EXPECT_EQ(r.flippedEdges == 0, admesh.at("reversed") == 0);
	EXPECT_EQ(admesh.at("backwards"), 0);
	EXPECT_EQ(admesh.at("edges_fixed") + admesh.at("added"), 0);
	EXPECT_EQ(admesh.at("removed"), r.repeatedIndexFaces);
	EXPECT_EQ(r.components, admesh.at("parts"));
	if (IsOriented(r)) {
		EXPECT_NEAR(r.volume, admesh.at("volume"),
		            1e-5 * std::abs(r.volume) + 1e-6);  // it sums in float, prints 6 digits
	}
}

TEST(KnownFiles, OurReport)
{
	for (const Case& c : Cases()) {
		SCOPED_TRACE(c.name);
		const IndexedMesh mesh = Read(StlFile(c.name, c.faces).path());
		const MeshReport r = MakeReport(mesh);
		EXPECT_EQ(r.borderEdges, c.expected.borderEdges);
		EXPECT_EQ(r.flippedEdges, c.expected.flippedEdges);
		EXPECT_EQ(r.repeatedIndexFaces, c.expected.repeatedIndexFaces);
		EXPECT_EQ(r.collinearFaces, c.expected.collinearFaces);
		EXPECT_EQ(r.duplicateFaces, c.expected.duplicateFaces);
		EXPECT_EQ(r.components, c.expected.components);
		EXPECT_EQ(r.nonManifoldEdges, c.expected.nonManifoldEdges);
		EXPECT_EQ(r.nonManifoldVertices, c.expected.nonManifoldVertices);
		EXPECT_EQ(r.unbalancedEdges, c.expected.unbalancedEdges);
		EXPECT_EQ(int(FindCrossings(mesh).size()), c.crossingPairs);
	}
}

TEST(KnownFiles, CgalAgrees)
{
	if (!fs::exists(kCgal)) GTEST_SKIP() << "not built: " << kCgal << " (needs CGAL)";
	for (const Case& c : Cases()) {
		SCOPED_TRACE(c.name);
		const StlFile stl(c.name, c.faces);
		const auto cgal = AskCgal(stl.path());
		ASSERT_TRUE(cgal.has_value());
		ExpectCgalAgrees(Read(stl.path()), *cgal);
		EXPECT_EQ(cgal->at("crossing_pairs"), c.crossingPairs);
	}
	EXPECT_FALSE(AskCgal("no_such_file.stl").has_value());
}

bool HasAdmesh() { return std::system("command -v admesh >/dev/null 2>&1") == 0; }

TEST(KnownFiles, AdmeshAgrees)
{
	if (!HasAdmesh()) GTEST_SKIP() << "admesh is not installed";
	for (const Case& c : Cases()) {
		SCOPED_TRACE(c.name);
		const StlFile stl(c.name, c.faces);
		const auto admesh = AskAdmesh(stl.path());
		ASSERT_TRUE(admesh.has_value());
		ExpectAdmeshAgrees(MakeReport(Read(stl.path())), *admesh);
	}
	EXPECT_FALSE(AskAdmesh("no_such_file.stl").has_value());
}

std::vector<fs::path> RealFiles()
{
	std::vector<fs::path> files;
	if (fs::is_directory(kMeshes))
		for (const auto& entry : fs::directory_iterator(kMeshes))
			if (entry.path().extension() != ".tsv") files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	return files;
}

TEST(RealFiles, CgalAgrees)
{
	const auto files = RealFiles();
	if (files.empty() || !fs::exists(kCgal)) GTEST_SKIP() << "no meshes in " << kMeshes << ", or not built: " << kCgal;
	for (const fs::path& path : files) {
		SCOPED_TRACE(path.filename());
		auto cgal = AskCgal(path);
		ASSERT_TRUE(cgal.has_value());
		const IndexedMesh mesh = Read(path);
		// CGAL's volume is made of cones from the origin, 4e6 away: it is right to 1e-5 only.
		if (path.filename() == "prusa-fs-lever-utm-derived.obj") {
			const double volume = MakeReport(mesh).volume;
			EXPECT_NEAR(volume, cgal->at("volume"), 1e-4 * volume);
			cgal->at("volume") = volume;
		}
		ExpectCgalAgrees(mesh, *cgal);
	}
}

// Written anew as STL: admesh reads nothing else, and no file of several solids, as one of these is.
TEST(RealFiles, AdmeshAgrees)
{
	const auto files = RealFiles();
	if (files.empty() || !HasAdmesh()) GTEST_SKIP() << "no meshes in " << kMeshes << ", or no admesh";
	for (const fs::path& path : files) {
		SCOPED_TRACE(path.filename());
		const oracle::MeshFile file = oracle::ReadMeshFile(path.string());
		std::vector<Corners> faces;
		for (const auto& f : file.faces) {
			faces.emplace_back();
			for (size_t i = 0; i < 3; ++i) {
				const auto& p = file.points[static_cast<size_t>(f[i])];
				faces.back()[i] = Point3d(p[0], p[1], p[2]);
			}
		}
		const StlFile stl(path.stem(), faces);
		const auto admesh = AskAdmesh(stl.path());
		const MeshReport r = MakeReport(Read(stl.path()));
		ASSERT_TRUE(admesh.has_value());
		ExpectAdmeshAgrees(r, *admesh);
	}
}

}  // namespace
