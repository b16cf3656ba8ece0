// Edges with many vertices on one side, closed by triangles without area (caps), as CAD exports have them: labels go over them as over any
// flat sheet.

#include "vcg_ext/text_label.h"

#include <gtest/gtest.h>
#include <random>

#include "label_check.h"
#include "test_mesh.h"

namespace {

using namespace label_check;
using test_mesh::FloatMesh;
using test_mesh::Shape;

LabelOptions OfHeight(double height)
{
	LabelOptions options;
	options.height = height;
	return options;
}

/// A label on a flat sheet keeps its area and adds what its height says, and the sheet stays one.
LabelResult ExpectLabelled(const Shape& sheet, const Outline& letters, const LabelFrame& frame, double height)
{
	FloatMesh m;
	test_mesh::Fill(m, sheet);
	const LabelResult result = LabelMesh(m, letters, frame, OfHeight(height));
	const double area = Area(letters), tolerance = 1e-4 * area;
	EXPECT_NEAR(result.addedVolume, area * height, tolerance);
	EXPECT_NEAR(result.surfaceArea, area, tolerance);
	const MeshReport report = MakeReport(m, {true, true});
	EXPECT_EQ(report.nonManifoldEdges + report.flippedEdges + report.duplicateFaces, 0);
	EXPECT_EQ(report.genus, 0);
	return result;
}

/// A square sheet of side 36 with a row of triangles without area across its middle.
Shape RowOfCaps(int cells)
{
	const double width = 36.0 / cells;
	Shape s;
	std::vector<int> below, row, above, middle;
	for (int i = 0; i <= cells; ++i) {
		below.push_back(s.add({i * width - 18, -18, 0}));
		row.push_back(s.add({i * width - 18, 0, 0}));
		above.push_back(s.add({i * width - 18, 18, 0}));
		if (i < cells) middle.push_back(s.add({(i + 0.5) * width - 18, 0, 0}));
	}
	for (int c = 0; c < cells; ++c) {
		const size_t i = size_t(c), j = i + 1;
		s.quad(below[i], below[j], row[j], row[i]);
		s.faces.push_back({row[i], row[j], middle[i]});
		s.faces.push_back({row[i], middle[i], above[i]});
		s.faces.push_back({middle[i], row[j], above[j]});
		s.faces.push_back({middle[i], above[j], above[i]});
	}
	return s;
}

// Each looks like a horizon within the letter, and those at its end have neighbours beyond the label's box.
TEST(RowOfCaps, UnderOneLetter)
{
	const Outline bar = label_check::Letters({Rectangle(-16.03, -5.02, 16.01, 6.03)});
	for (const int cells : {8, 16, 28, 36, 48, 64})
		EXPECT_EQ(ExpectLabelled(RowOfCaps(cells), bar, FromAbove(), 0.3).attempts, 1) << cells;
}

// The same row on a second surface below, which no letter touches: it stays as it is.
TEST(RowOfCaps, OnAnotherSurfaceIsLeftAlone)
{
	const Shape upper = RowOfCaps(16);
	const Shape both = upper.joined(upper.moved([](const Point3d& p) { return p - Point3d(0, 0, 5); }));
	for (const double height : {0.3, 0.0, -0.3}) {
		FloatMesh m;
		test_mesh::Fill(m, both);
		LabelOptions options;
		options.height = height;
		LabelMesh(m, label_check::Letters({Rectangle(-16.03, -5.02, 16.01, 6.03)}), FromAbove(), options);
		for (size_t f = upper.faces.size(); f < both.faces.size(); ++f)
			for (int k = 0; k < 3; ++k) EXPECT_EQ(m.face[f].cV(k) - m.vert.data(), both.faces[f][size_t(k)]) << f;
	}
}

/// A sheet of which an edge has many vertices on one side, closed by a fan from its end: each triangle without area lies on the next.
Shape FanOfCaps(int vertices)
{
	Shape s;
	const int a = s.add({-20, 0, 0}), b = s.add({20, 0, 0}), c = s.add({20, -20, 0}), d = s.add({-20, -20, 0}),
			  top = s.add({0, 20, 0}), left = s.add({-20, 20, 0}), right = s.add({20, 20, 0});
	std::vector<int> row{a};
	for (int i = 1; i <= vertices; ++i) row.push_back(s.add({-20 + 40.0 * i / (vertices + 1), 0, 0}));
	row.push_back(b);
	s.faces = {{a, c, b}, {a, d, c}, {a, top, left}, {b, right, top}};
	for (size_t i = 1; i < row.size(); ++i) s.faces.push_back({row[i - 1], row[i], top});
	for (size_t i = 2; i < row.size(); ++i) s.faces.push_back({a, row[i], row[i - 1]});
	return s;
}

const Outline kFanBar = label_check::Letters({Rectangle(-15.01, -4.02, 15.03, 4.01)});

TEST(FanOfCaps, UnderOneLetter)
{
	for (const int vertices : {1, 2, 3, 5, 20, 100})
		for (const double height : {0.5, -0.5, 0.0}) ExpectLabelled(FanOfCaps(vertices), kFanBar, FromAbove(), height);
}

// Turned and rounded, some of its caps show their backs and some face the viewer; not all such rows can be mended.
TEST(FanOfCaps, TurnedUnderOneLetter)
{
	constexpr int count = 200;
	std::mt19937 random(7);
	std::uniform_real_distribution<double> angle(0, M_PI);
	int refused = 0;
	for (int n = 0; n < count; ++n) {
		const double a = angle(random), c = std::cos(a), s = std::sin(a);
		const Shape turned = FanOfCaps(2 + n % 7).moved(
			[&](const Point3d& p) { return Point3d(c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]); });
		try {
			ExpectLabelled(turned, kFanBar, FrameFromDirection({0, 0, 0}, {0, 0, 1}, {-s, c, 0}), 0.5);
		} catch (const Error& error) {
			EXPECT_EQ(int(error.code), int(ErrorCode::Silhouette)) << error.what();
			++refused;
		}
	}
	EXPECT_LT(refused, count / 10);
}

}  // namespace
