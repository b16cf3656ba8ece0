// The parts in meshes/ are what meshes/parts.tsv says, and fit for printing as they lie in their files.

#include "vcg_ext/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

using namespace vcg::textlabel;
using vcg::Point3d;

namespace {

constexpr double pi = 3.14159265358979323846;
const std::string folder = std::string(TEXTLABEL_SOURCE_DIR) + "/meshes/";

using Row = std::map<std::string, std::string>;

std::vector<std::string> Split(const std::string& line, char separator)
{
	std::vector<std::string> cells;
	std::istringstream in(line);
	for (std::string cell; std::getline(in, cell, separator);) cells.push_back(cell);
	return cells;
}

std::vector<Row> ReadParts()
{
	std::ifstream in(folder + "parts.tsv");
	std::vector<Row> rows;
	std::vector<std::string> names;
	for (std::string line; std::getline(in, line);) {
		if (line.empty() || line[0] == '#') continue;
		const std::vector<std::string> cells = Split(line, '\t');
		if (names.empty()) {
			names = cells;
			continue;
		}
		Row row;
		for (size_t i = 0; i < names.size(); i++) row[names[i]] = cells.at(i);
		rows.push_back(row);
	}
	return rows;
}

Point3d ToPoint(const std::string& text)
{
	const std::vector<std::string> cells = Split(text, ',');
	return {std::stod(cells.at(0)), std::stod(cells.at(1)), std::stod(cells.at(2))};
}

/// A binary STL as it lies in the file, equal points merged.
IndexedMesh ReadStl(const std::string& name)
{
	std::ifstream in(folder + name, std::ios::binary);
	const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
	IndexedMesh mesh;
	for (size_t at = 84 + 12; at + 38 <= bytes.size(); at += 50) {
		Face face;
		for (size_t k = 0; k < 3; k++) {
			float c[3];
			std::memcpy(c, bytes.data() + at + 12 * k, sizeof c);
			face[k] = int(mesh.positions.size());
			mesh.positions.push_back({c[0], c[1], c[2]});
		}
		mesh.faces.push_back(face);
	}
	return PrepareForReport(mesh, {true, true});
}

using Corner = std::array<Point3d, 3>;

Corner Corners3(const IndexedMesh& mesh, const Face& f)
{
	return {mesh.positions[size_t(f[0])], mesh.positions[size_t(f[1])], mesh.positions[size_t(f[2])]};
}

/// Area of the section of a closed mesh by a plane, by Green's theorem over the segments in which it cuts the faces.
/// @param[in] axis  normal of the plane: 0, 1, 2 for x, y, z; no vertex may lie on the plane
double SectionArea(const IndexedMesh& mesh, int axis, double height)
{
	const int u = (axis + 1) % 3, v = (axis + 2) % 3;
	double twice = 0;
	for (const Face& f : mesh.faces) {
		const Corner t = Corners3(mesh, f);
		std::array<double, 2> from{}, to{};
		bool cut = false;
		for (size_t k = 0; k < 3; k++) {
			const Point3d &a = t[k], &b = t[(k + 1) % 3];
			if ((a[axis] < height) == (b[axis] < height)) continue;
			const double s = (height - a[axis]) / (b[axis] - a[axis]);
			const std::array<double, 2> p = {a[u] + s * (b[u] - a[u]), a[v] + s * (b[v] - a[v])};
			(a[axis] < height ? to : from) = p;  // outwards is to the right of the way from one to the other
			cut = true;
		}
		if (cut) twice += from[0] * to[1] - from[1] * to[0];
	}
	return std::abs(twice) / 2;
}

/// The first surface that is seen at a point, looking against `direction`: distance towards the viewer and cosine of the slope.
struct Seen {
	double height = -1e300, cosine = -1;
};

Seen Look(const IndexedMesh& mesh, const Point3d& place, const Point3d& direction)
{
	Seen seen;
	for (const Face& f : mesh.faces) {
		const Corner t = Corners3(mesh, f);
		const Point3d e1 = t[1] - t[0], e2 = t[2] - t[0], n = e1 ^ e2, q = place - t[0];
		const double det = n * direction;
		if (det == 0) continue;
		const double h = -(n * q) / det, b = (q ^ e2) * direction / det, c = (e1 ^ q) * direction / det;
		if (b < 0 || c < 0 || b + c > 1 || h <= seen.height) continue;
		seen = {h, det / n.Norm()};
	}
	return seen;
}

struct Part : testing::TestWithParam<Row> {
	IndexedMesh mesh = ReadStl(GetParam().at("file"));
	double number(const std::string& name) const { return std::stod(GetParam().at(name)); }
};

}  // namespace

TEST_P(Part, IsSoundAndAsDescribed)
{
	const MeshReport report = MakeReport(mesh);
	EXPECT_EQ(report.faces, int(number("triangles"))) << ToText(report);
	EXPECT_TRUE(IsManifold(report) && IsOriented(report) && !HasDegenerateFaces(report)) << ToText(report);
	EXPECT_EQ(report.components, 1);
	EXPECT_EQ(report.borderLoops, int(number("borders")));
	ASSERT_TRUE(report.genus);
	EXPECT_EQ(*report.genus, int(number("genus")));
	EXPECT_EQ(report.unusedVertices, 0);
	if (GetParam().at("volume") != "-") {
		EXPECT_TRUE(IsSound(report)) << ToText(report);
		EXPECT_NEAR(report.volume, number("volume"), 1e-6 * number("volume"));
	}
}

TEST_P(Part, DoesNotCrossItself)
{
	const std::vector<FacePair> pairs = FindCrossings(mesh);
	EXPECT_TRUE(pairs.empty()) << pairs.size() << " pairs, the first: faces " << pairs[0].first << " and "
							   << pairs[0].second;
}

TEST_P(Part, HasNoSlivers)
{
	double largest = 0, thinnest = 1e300;
	for (const Point3d& p : mesh.positions)
		for (int k = 0; k < 3; k++) largest = std::max(largest, std::abs(p[k]));
	for (const Face& f : mesh.faces) {
		const Corner t = Corners3(mesh, f);
		const double longest = std::max({(t[1] - t[0]).Norm(), (t[2] - t[1]).Norm(), (t[0] - t[2]).Norm()});
		thinnest = std::min(thinnest, ((t[1] - t[0]) ^ (t[2] - t[0])).Norm() / longest);
	}
	const double ulp = std::ldexp(1.0, std::ilogb(largest) - 23);
	EXPECT_GT(thinnest, 8 * ulp);
}

TEST_P(Part, HasAboutThePapersTriangles)
{
	if (GetParam().at("paper_before") == "-") return;  // the paper gives no count
	EXPECT_NEAR(double(mesh.faces.size()), number("paper_before"), 0.02 * number("paper_before"));
}

TEST_P(Part, CarriesItsLabel)
{
	const Point3d place = ToPoint(GetParam().at("position")),
				  direction = ToPoint(GetParam().at("direction")).normalized();
	const Point3d right = (ToPoint(GetParam().at("up")) ^ direction).normalized(), up = direction ^ right;
	const double size = number("size");
	EXPECT_NEAR(Look(mesh, place, direction).height, 0, 0.02 * size);
	// A letter is about as wide as 0.95 capital heights; some letters reach 0.3 below the line.
	const double halfWidth = 0.95 * size * double(GetParam().at("text").size()) / 2, halfHeight = 0.65 * size;
	for (int i = -8; i <= 8; i++)
		for (int j = -2; j <= 2; j++) {
			const Point3d p = place + right * (halfWidth * i / 8) + up * (halfHeight * j / 2);
			const Seen seen = Look(mesh, p, direction);
			EXPECT_GT(seen.cosine, std::cos(45 * pi / 180)) << i << ' ' << j;
			EXPECT_LT(std::abs(seen.height), size) << i << ' ' << j;
		}
}

INSTANTIATE_TEST_SUITE_P(Meshes, Part, testing::ValuesIn(ReadParts()),
                         [](const auto& part) { return Split(part.param.at("file"), '.')[0]; });

TEST(Meshes, AreTheFiveOfThePapersFigures)
{
	std::string figures;
	for (const Row& row : ReadParts()) figures += row.at("figure") + ' ';
	EXPECT_EQ(figures, "7 8 9 10 11 ");
}

// Sections whose area a drawing gives; a circle is a regular polygon in an STL.
TEST(Meshes, SectionsHaveTheAreasOfTheirDrawings)
{
	const auto disc = [](double r, int corners) { return corners * r * r * std::sin(2 * pi / corners) / 2; };
	const double plate = 110 * 64 - (4 * 12 * 12 - disc(12, 48)) - 4 * disc(3.3, 36);  // bracket: plate with bolt holes
	EXPECT_NEAR(SectionArea(ReadStl("bracket.stl"), 2, 2.8), plate, 1e-6 * plate);
	const double neck = disc(13, 80) - disc(10.5, 80);  // housing: the filler neck between gussets and collar
	EXPECT_NEAR(SectionArea(ReadStl("housing.stl"), 2, 50.3), neck, 1e-6 * neck);
	const double pipe = disc(17, 72) - disc(12.5, 72);  // valve: the pipes between ball and flanges
	EXPECT_NEAR(SectionArea(ReadStl("valve.stl"), 0, 30.1), pipe, 1e-6 * pipe);
	EXPECT_NEAR(SectionArea(ReadStl("valve.stl"), 0, -30.1), pipe, 1e-6 * pipe);
}
