#pragma once
// Meshes for tests: types from the barest to one with every attribute, and shapes that are made, not read.

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <vcg/complex/complex.h>
#include <vector>

namespace test_mesh {

// ---- types ----

class FloatVertex;
class FloatFace;
struct FloatTypes : vcg::UsedTypes<vcg::Use<FloatVertex>::AsVertexType, vcg::Use<FloatFace>::AsFaceType> {};
class FloatVertex : public vcg::Vertex<FloatTypes, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::BitFlags> {
};
class FloatFace : public vcg::Face<FloatTypes, vcg::face::VertexRef, vcg::face::Normal3f, vcg::face::BitFlags> {};
class FloatMesh : public vcg::tri::TriMesh<std::vector<FloatVertex>, std::vector<FloatFace>> {};

class DoubleVertex;
class DoubleFace;
struct DoubleTypes : vcg::UsedTypes<vcg::Use<DoubleVertex>::AsVertexType, vcg::Use<DoubleFace>::AsFaceType> {};
class DoubleVertex
	: public vcg::Vertex<DoubleTypes, vcg::vertex::Coord3d, vcg::vertex::Normal3d, vcg::vertex::BitFlags> {};
class DoubleFace : public vcg::Face<DoubleTypes, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::BitFlags> {};
class DoubleMesh : public vcg::tri::TriMesh<std::vector<DoubleVertex>, std::vector<DoubleFace>> {};

/// Everything that a label has to carry along.
class RichVertex;
class RichFace;
struct RichTypes : vcg::UsedTypes<vcg::Use<RichVertex>::AsVertexType, vcg::Use<RichFace>::AsFaceType> {};
class RichVertex : public vcg::Vertex<RichTypes, vcg::vertex::Coord3f, vcg::vertex::Normal3f, vcg::vertex::BitFlags,
                                      vcg::vertex::Color4b, vcg::vertex::Qualityf, vcg::vertex::TexCoord2f> {};
class RichFace : public vcg::Face<RichTypes, vcg::face::VertexRef, vcg::face::Normal3f, vcg::face::BitFlags,
                                  vcg::face::Color4b, vcg::face::Qualityf, vcg::face::WedgeTexCoord2f> {};
class RichMesh : public vcg::tri::TriMesh<std::vector<RichVertex>, std::vector<RichFace>> {};

// ---- shapes ----

/// Points and faces, counter-clockwise seen from outside.
struct Shape {
	std::vector<vcg::Point3d> points;
	std::vector<std::array<int, 3>> faces;

	int add(const vcg::Point3d& p)
	{
		points.push_back(p);
		return int(points.size()) - 1;
	}
	/// A quadrangle a b c d as two triangles that share the diagonal a c.
	void quad(int a, int b, int c, int d)
	{
		faces.push_back({a, b, c});
		faces.push_back({a, c, d});
	}
	/// The same shape with every point moved.
	Shape moved(const std::function<vcg::Point3d(const vcg::Point3d&)>& f) const
	{
		Shape s = *this;
		for (vcg::Point3d& p : s.points) p = f(p);
		return s;
	}
	Shape joined(const Shape& other) const
	{
		Shape s = *this;
		const int offset = int(points.size());
		s.points.insert(s.points.end(), other.points.begin(), other.points.end());
		for (const auto& f : other.faces) s.faces.push_back({f[0] + offset, f[1] + offset, f[2] + offset});
		return s;
	}
};

/// Give a mesh the points and faces of a shape; flags are clear, normals right.
template <class MeshType>
void Fill(MeshType& m, const Shape& s)
{
	using Scalar = typename MeshType::ScalarType;
	m.Clear();
	vcg::tri::Allocator<MeshType>::AddVertices(m, s.points.size());
	vcg::tri::Allocator<MeshType>::AddFaces(m, s.faces.size());
	for (size_t i = 0; i < s.points.size(); ++i)
		m.vert[i].P() = {Scalar(s.points[i][0]), Scalar(s.points[i][1]), Scalar(s.points[i][2])};
	for (size_t i = 0; i < s.faces.size(); ++i)
		for (int k = 0; k < 3; ++k) m.face[i].V(k) = &m.vert[size_t(s.faces[i][size_t(k)])];
	for (auto& v : m.vert) v.N() = {0, 0, 0};  // of no face: not computed below
	vcg::tri::UpdateNormal<MeshType>::PerVertexNormalizedPerFaceNormalized(m);
}

template <class MeshType>
Shape ToShape(const MeshType& m)
{
	Shape s;
	for (const auto& v : m.vert) s.points.emplace_back(double(v.cP()[0]), double(v.cP()[1]), double(v.cP()[2]));
	for (const auto& f : m.face) {
		if (f.IsD()) continue;
		std::array<int, 3> corner;
		for (int k = 0; k < 3; ++k) corner[size_t(k)] = int(f.cV(k) - m.vert.data());
		s.faces.push_back(corner);
	}
	return s;
}

/// A sheet over a grid: nx by ny quads, place(i, j) for 0 <= i <= nx, 0 <= j <= ny; faces up where i x j is up.
inline Shape Sheet(int nx, int ny, const std::function<vcg::Point3d(int, int)>& place)
{
	Shape s;
	for (int j = 0; j <= ny; ++j)
		for (int i = 0; i <= nx; ++i) s.add(place(i, j));
	const auto at = [nx](int i, int j) { return j * (nx + 1) + i; };
	for (int j = 0; j < ny; ++j)
		for (int i = 0; i < nx; ++i) s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
	return s;
}

/// Close a sheet to a solid by a copy of it, moved by `down` and turned round, and walls along the border.
inline Shape Thickened(const Shape& sheet, int nx, int ny, const vcg::Point3d& down)
{
	Shape s = sheet;
	const int n = int(sheet.points.size());
	for (const vcg::Point3d& p : sheet.points) s.add(p + down);
	for (const auto& f : sheet.faces) s.faces.push_back({f[0] + n, f[2] + n, f[1] + n});
	std::vector<int> border;  // counter-clockwise seen from above
	for (int i = 0; i < nx; ++i) border.push_back(i);
	for (int j = 0; j < ny; ++j) border.push_back(j * (nx + 1) + nx);
	for (int i = nx; i > 0; --i) border.push_back(ny * (nx + 1) + i);
	for (int j = ny; j > 0; --j) border.push_back(j * (nx + 1));
	for (size_t i = 0; i < border.size(); ++i) {
		const int a = border[i], b = border[(i + 1) % border.size()];
		s.quad(a + n, b + n, b, a);
	}
	return s;
}

/// A slab with a gridded top: w x h x d, its top at z = 0, centred on the origin.
inline Shape Slab(double w, double h, double d, int nx, int ny)
{
	const Shape top = Sheet(
		nx, ny, [&](int i, int j) { return vcg::Point3d(w * (double(i) / nx - 0.5), h * (double(j) / ny - 0.5), 0); });
	return Thickened(top, nx, ny, {0, 0, -d});
}

/// A box of twelve triangles, its top at z = 0.
inline Shape Box(double w, double h, double d) { return Slab(w, h, d, 1, 1); }

/// A prism along z whose top, at z = 0, is a fan around one vertex in the middle: of valence `sides`.
inline Shape Fan(int sides, double radius, double d)
{
	Shape s;
	const int top = s.add({0, 0, 0}), bottom = s.add({0, 0, -d});
	for (int i = 0; i < sides; ++i) {
		const double angle = 2 * M_PI * i / sides;
		s.add({radius * std::cos(angle), radius * std::sin(angle), 0});
		s.add({radius * std::cos(angle), radius * std::sin(angle), -d});
	}
	for (int i = 0; i < sides; ++i) {
		const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % sides);
		s.faces.push_back({top, a, b});
		s.faces.push_back({bottom, b + 1, a + 1});
		s.quad(a + 1, b + 1, b, a);
	}
	return s;
}

/// A sphere about the origin, of `slices` meridians and `stacks` parallels.
inline Shape Sphere(double radius, int slices, int stacks)
{
	Shape s;
	const int north = s.add({0, 0, radius});
	for (int j = 1; j < stacks; ++j)
		for (int i = 0; i < slices; ++i) {
			const double a = 2 * M_PI * i / slices, b = M_PI * j / stacks;
			s.add(vcg::Point3d(std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), std::cos(b)) * radius);
		}
	const int south = s.add({0, 0, -radius});
	const auto at = [&](int i, int j) { return 1 + (j - 1) * slices + i % slices; };
	for (int i = 0; i < slices; ++i) {
		s.faces.push_back({north, at(i, 1), at(i + 1, 1)});
		s.faces.push_back({south, at(i + 1, stacks - 1), at(i, stacks - 1)});
		for (int j = 1; j + 1 < stacks; ++j) s.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
	}
	return s;
}

/// Around y: the radius at each height, in steps of one; open at both ends.
inline Shape Turned(const std::vector<double>& radii, int sides, double step = 1)
{
	const int rows = int(radii.size()) - 1;
	Shape s = Sheet(sides, rows, [&](int i, int j) {
		const double a = 2 * M_PI * i / sides, r = radii[size_t(j)];
		return vcg::Point3d(r * std::sin(a), step * (j - rows / 2.0), r * std::cos(a));
	});
	for (auto& f : s.faces)  // the last column is the first
		for (int& v : f) v -= v % (sides + 1) == sides ? sides : 0;
	return s;
}

/// A cylinder along y, closed by fans; `rings` quads along it.
inline Shape Cylinder(double radius, double length, int sides, int rings)
{
	Shape s;
	for (int j = 0; j <= rings; ++j)
		for (int i = 0; i < sides; ++i) {
			const double a = 2 * M_PI * i / sides;
			s.add({radius * std::sin(a), length * (double(j) / rings - 0.5), radius * std::cos(a)});
		}
	const int low = s.add({0, -length / 2, 0}), high = s.add({0, length / 2, 0});
	const auto at = [&](int i, int j) { return j * sides + i % sides; };
	for (int i = 0; i < sides; ++i) {
		for (int j = 0; j < rings; ++j) s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
		s.faces.push_back({low, at(i + 1, 0), at(i, 0)});
		s.faces.push_back({high, at(i, rings), at(i + 1, rings)});
	}
	return s;
}

/// A spiral staircase without steps: a sheet that turns `turns` times about z and rises by `pitch` each time, seen from above.
inline Shape Helicoid(double inner, double outer, double pitch, double turns, int segments, int across)
{
	return Sheet(across, segments, [&](int i, int j) {
		const double r = inner + (outer - inner) * i / across, a = 2 * M_PI * turns * j / segments;
		return vcg::Point3d(r * std::cos(a), r * std::sin(a), pitch * turns * j / segments);
	});
}

/// A block with the inside of a half tube of radius 5 along y in its top: along its normals everything meets in the axis, z = 5.
inline Shape Groove()
{
	constexpr int around = 40, along = 10;
	const Shape top = Sheet(around, along, [](int i, int j) {
		const double a = M_PI * (double(i) / around) - M_PI;
		return vcg::Point3d(5 * std::cos(a), 3.0 * (j - 5), 5 * std::sin(a) + 5);
	});
	return Thickened(top, around, along, {0, 0, -10});
}

// ---- comparing ----

/// All that a mesh stores, byte by byte: positions, indices, flags, attributes. Not the addresses.
template <class MeshType>
std::string Bytes(const MeshType& m)
{
	std::string out;
	const auto add = [&out](const auto& x) { out.append(reinterpret_cast<const char*>(&x), sizeof x); };
	const auto addTexture = [&add](const auto& t) {  // one by one: there is padding between them
		add(t.u());
		add(t.v());
		add(t.n());
	};
	add(m.vn);
	add(m.fn);
	for (const auto& v : m.vert) {
		for (int i = 0; i < 3; ++i) {
			add(v.cP()[i]);
			add(v.cN()[i]);
		}
		add(v.cFlags());
		if (MeshType::VertexType::HasColor()) add(v.cC());
		if (MeshType::VertexType::HasQuality()) add(v.cQ());
		if (MeshType::VertexType::HasTexCoord()) addTexture(v.cT());
	}
	for (const auto& f : m.face) {
		for (int k = 0; k < 3; ++k) {
			add(f.cV(k) - m.vert.data());
			add(f.cN()[k]);
			if (MeshType::FaceType::HasWedgeTexCoord()) addTexture(f.cWT(k));
		}
		add(f.cFlags());
		if (MeshType::FaceType::HasColor()) add(f.cC());
		if (MeshType::FaceType::HasQuality()) add(f.cQ());
	}
	return out;
}

}  // namespace test_mesh
