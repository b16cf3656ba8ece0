#pragma once
// What tests of labels have in common: letters drawn by hand, and what must hold of every labelled mesh.

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vcg/space/distance3.h>
#include <vector>

#include "test_mesh.h"
#include "vcg_ext/text_label.h"
#include "vcg_ext/validate.h"

namespace label_check {

using namespace vcg::textlabel;
using vcg::Point2d;
using vcg::Point3d;

// ---- letters ----

/// Outlines from contours drawn by hand: outer ones counter-clockwise, each a part and a letter; holes join the part before.
inline Outline Letters(const std::vector<std::vector<Point2d>>& contours)
{
	Outline o;
	for (const std::vector<Point2d>& points : contours) {
		if (TwiceSignedArea(points) > 0) ++o.partCount;
		o.contours.push_back({points, o.partCount - 1, o.partCount - 1});
	}
	return o;
}

inline std::vector<Point2d> Rectangle(double u0, double v0, double u1, double v1)
{
	return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
}

inline std::vector<Point2d> Hole(std::vector<Point2d> points)
{
	std::reverse(points.begin(), points.end());
	return points;
}

inline std::vector<Point2d> RegularPolygon(double u, double v, double radius, int sides, double turn = 0)
{
	std::vector<Point2d> p;
	for (int i = 0; i < sides; ++i) {
		const double a = turn + 2 * M_PI * i / sides;
		p.emplace_back(u + radius * std::cos(a), v + radius * std::sin(a));
	}
	return p;
}

/// An O (a frame with a hole), an L and an i with its dot, together about 14 wide and 6 high, centred.
inline Outline ThreeLetters()
{
	return Letters({Rectangle(-7, -3, -2, 3),
	                Hole(Rectangle(-6, -2, -3, 2)),
	                {{-1, -3}, {3, -3}, {3, -2}, {0, -2}, {0, 3}, {-1, 3}},
	                Rectangle(4, -3, 5, 1),
	                RegularPolygon(4.5, 2.25, 0.7, 16)});
}

inline Outline Moved(Outline o, double scale, double du, double dv, double turn = 0)
{
	const double c = std::cos(turn) * scale, s = std::sin(turn) * scale;
	for (Contour& contour : o.contours)
		for (Point2d& p : contour.points) p = {c * p[0] - s * p[1] + du, s * p[0] + c * p[1] + dv};
	return o;
}

/// Winding number of the outline around a point of the label plane: 1 in a letter, 0 elsewhere.
inline int Winding(const Outline& o, const Point2d& p)
{
	int winding = 0;
	for (const Contour& c : o.contours)
		for (size_t i = 0, j = c.points.size() - 1; i < c.points.size(); j = i++) {
			const Point2d a = c.points[j] - p, b = c.points[i] - p;
			if (a[1] <= 0 && b[1] > 0 && (a ^ b) > 0) ++winding;
			if (a[1] > 0 && b[1] <= 0 && (a ^ b) < 0) --winding;
		}
	return winding;
}

/// Distance of a point of the label plane from the nearest contour.
inline double ContourDistance(const Outline& o, const Point2d& p)
{
	double least = std::numeric_limits<double>::infinity();
	for (const Contour& c : o.contours)
		for (size_t i = 0, j = c.points.size() - 1; i < c.points.size(); j = i++) {
			const Point2d a = c.points[j], d = c.points[i] - a;
			const double t = std::min(1.0, std::max(0.0, ((p - a) * d) / d.SquaredNorm()));
			least = std::min(least, (a + d * t - p).Norm());
		}
	return least;
}

// ---- frames ----

/// Looking down on z = 0, reading along x.
inline LabelFrame FromAbove() { return {}; }

inline LabelFrame FromAbovePerspective(double height)
{
	LabelFrame f;
	f.perspective = true;
	f.center = {0, 0, height};
	return f;
}

// ---- what must hold ----

/// The step between float32 numbers at the largest coordinate of a mesh.
inline double FloatUlp(const test_mesh::Shape& s)
{
	double largest = 0;
	for (const Point3d& p : s.points)
		for (int i = 0; i < 3; ++i) largest = std::max(largest, std::abs(p[i]));
	const float x = static_cast<float>(largest);
	return double(std::nextafter(x, std::numeric_limits<float>::max())) - double(x);
}

/// As a file of float32 corners would hold it: closed where the input was, manifold, oriented, no degenerate face, the same pieces
/// and handles; and no two faces cross.
template <class MeshType>
void ExpectSameKind(const test_mesh::Shape& before, const MeshType& after)
{
	const auto indexed = [](const test_mesh::Shape& s) {
		IndexedMesh m;
		m.positions = s.points;
		for (const auto& f : s.faces) m.faces.push_back({f[0], f[1], f[2]});
		return PrepareForReport(m, {true, true});
	};
	const IndexedMesh old = indexed(before), now = indexed(test_mesh::ToShape(after));
	const MeshReport a = MakeReport(old), b = MakeReport(now);
	EXPECT_TRUE(IsManifold(b)) << ToText(b);
	EXPECT_TRUE(IsOriented(b)) << ToText(b);
	EXPECT_FALSE(HasDegenerateFaces(b)) << ToText(b);
	EXPECT_EQ(b.borderEdges, a.borderEdges) << ToText(b);
	EXPECT_EQ(b.borderLoops, a.borderLoops);
	EXPECT_EQ(b.components, a.components);
	EXPECT_EQ(b.genus, a.genus);
	EXPECT_EQ(FindCrossings(now).size(), 0u);
}

/// Volume of a closed shape, about the middle of its box so that little is lost far from the origin.
inline double Volume(const test_mesh::Shape& s)
{
	const Point3d o = s.points[0];
	double sum = 0;
	for (const auto& f : s.faces) {
		const auto at = [&](size_t k) { return s.points[size_t(f[k])] - o; };
		sum += at(0) * (at(1) ^ at(2));
	}
	return sum / 6;
}

inline double SurfaceArea(const test_mesh::Shape& s)
{
	double sum = 0;
	for (const auto& f : s.faces) {
		const Point3d& o = s.points[size_t(f[0])];
		sum += ((s.points[size_t(f[1])] - o) ^ (s.points[size_t(f[2])] - o)).Norm();
	}
	return sum / 2;
}

inline double Distance(const Point3d& p, const std::array<Point3d, 3>& t)
{
	double distance = 0;
	Point3d closest;
	vcg::TrianglePointDistance(vcg::Triangle3<double>(t[0], t[1], t[2]), p, distance, closest);
	return distance;
}

/// The candidates of a shape under a box of the label plane.
inline Sheet CandidatesOf(const test_mesh::Shape& shape, const LabelSpace& space, double halfWidth, double halfHeight)
{
	test_mesh::DoubleMesh m;
	test_mesh::Fill(m, shape);
	PlaneBox box;
	box.add({-halfWidth, -halfHeight});
	box.add({halfWidth, halfHeight});
	return CollectSheet(m, space, box);
}

/// A label as far as the cut: what its raising and checking start from.
struct CutExample {
	LabelSpace space;
	Sheet sheet;
	CutLabel cut;

	CutExample(const test_mesh::Shape& shape, const Outline& outline, const LabelFrame& frame, double snap = 1e-6)
		: space(frame), sheet(CandidatesOf(shape, space, 40, 40)),
		  cut(LabelCutter(space, sheet, snap).cut(outline, FindSeeds(space, sheet, outline, snap)))
	{}
};

/// What an Error says, for a message; or that there was none.
template <class MeshType>
std::string Refusal(MeshType& m, const Outline& outline, const LabelFrame& frame, const LabelOptions& options,
                    Error* error)
{
	try {
		LabelMesh(m, outline, frame, options);
	} catch (const Error& e) {
		*error = e;
		return e.message;
	}
	return "no error";
}

}  // namespace label_check
