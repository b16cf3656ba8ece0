// Automatic placement on real parts: rays are cast at every triangle, all over the text's box.

#include "filter_textlabel/auto_placement.h"
#include "oracle_mesh_file.h"
#include "placement_parts.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>

namespace textlabel::test {
namespace {

std::filesystem::path Folder()
{
	if (const char* given = std::getenv("TEXTLABEL_REAL_MESHES")) return given;
	return std::filesystem::path(__FILE__).parent_path() / "../../shared/meshes";
}

Triangles Load(const std::filesystem::path& file)
{
	const oracle::MeshFile mesh = oracle::ReadMeshFile(file.string());
	Triangles part;
	for (const auto& p : mesh.points) part.positions.emplace_back(p[0], p[1], p[2]);
	part.triangles = mesh.faces;
	return part;
}

struct Hit {
	double height = -std::numeric_limits<double>::infinity();  // above the plane of the place
	bool isFront = false;
};

/// The first triangle that the viewer sees at a point; Moeller and Trumbore's test on every triangle.
Hit FirstHit(const Triangles& part, const Point3d& at, const Point3d& towards)
{
	Hit first;
	for (const std::array<int, 3>& t : part.triangles) {
		const Point3d& a = part.positions[size_t(t[0])];
		const Point3d e1 = part.positions[size_t(t[1])] - a, e2 = part.positions[size_t(t[2])] - a;
		const Point3d across = towards ^ e2;
		const double facing = e1 * across;
		if (facing == 0) continue;
		const Point3d from = at - a, turned = from ^ e1;
		const double u = from * across / facing, v = towards * turned / facing, height = e2 * turned / facing;
		if (u < 0 || v < 0 || u + v > 1 || height <= first.height) continue;
		first = {height, facing < 0};  // towards x e2 turns with the triangle, seen from below
	}
	return first;
}

class RealPart : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(RealPart, EveryPlaceShowsASmoothFront)
{
	const Triangles part = Load(GetParam());
	PlaceQuery query{part.positions, part.triangles};
	query.labelWidth = 2.3;
	query.labelHeight = 1;
	const std::vector<Place> places = FirstPlaces(query);
	ASSERT_FALSE(places.empty());
	for (const Place& place : places) {
		SCOPED_TRACE(testing::Message() << "place " << &place - places.data());
		const Point3d right = place.up ^ place.direction;
		const double farthest = place.size * std::hypot(query.labelWidth, query.labelHeight) / 2;
		const double relief = place.flat ? 0.01 * place.size : farthest * std::sqrt(place.stretch * place.stretch - 1);
		for (int i = -6; i <= 6; ++i)
			for (int j = -3; j <= 3; ++j) {
				const Point3d p = place.position + right * (place.size * query.labelWidth * i / 12.0) +
				                  place.up * (place.size * query.labelHeight * j / 6.0);
				const Hit hit = FirstHit(part, p, place.direction);
				ASSERT_TRUE(hit.isFront) << "at " << i << ", " << j;
				EXPECT_LE(std::abs(hit.height), 1.1 * relief + 1e-9 * farthest) << "at " << i << ", " << j;
			}
	}
}

std::vector<std::filesystem::path> Files()
{
	std::vector<std::filesystem::path> files;
	std::error_code none;
	for (const auto& entry : std::filesystem::directory_iterator(Folder(), none))
		if (entry.path().extension() == ".stl") files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	return files;
}

std::string NameOf(const testing::TestParamInfo<std::filesystem::path>& info)
{
	std::string name = info.param.stem().string();
	for (char& c : name)
		if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
	return name;
}

INSTANTIATE_TEST_SUITE_P(AutoPlacement, RealPart, testing::ValuesIn(Files()), NameOf);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RealPart);

TEST(RealParts, AreThere)
{
	if (Files().empty()) GTEST_SKIP() << "no real parts in " << Folder();
}

}  // namespace
}  // namespace textlabel::test
