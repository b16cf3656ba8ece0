#pragma once
// MeshLab's mesh for the benchmarks, and the least that a label has to do with all of it.

#include "vcg_ext/sheet.h"
#include "vcg_ext/validate.h"

#include "meshlab_api.h"

namespace bench {

using vcg::textlabel::IndexedMesh;

/// Room in an empty mesh.
inline void ReserveMesh(CMeshO& m, size_t vertices, size_t faces)
{
	m.vert.reserve(vertices);
	m.face.reserve(faces);
}

/// Make a mesh, or make it again after a label: a label changes positions, corners and sizes only.
inline void FillMesh(CMeshO& m, const IndexedMesh& part)
{
	m.vert.resize(part.positions.size());
	m.face.resize(part.faces.size());
	m.vn = int(m.vert.size());
	m.fn = int(m.face.size());
	for (size_t v = 0; v < part.positions.size(); ++v) m.vert[v].P() = CMeshO::CoordType::Construct(part.positions[v]);
	for (size_t f = 0; f < part.faces.size(); ++f)
		for (int k = 0; k < 3; ++k) m.face[f].V(k) = &m.vert[size_t(part.faces[f][size_t(k)])];
}

/// Project every vertex in parallel projection and tell on which sides of a box it is; count the triangles that are not all
/// on one side, which are those whose own boxes meet it.
/// @param[out] code  #V
inline int BarePass(const CMeshO& m, const vcg::textlabel::LabelSpace& space, const vcg::textlabel::PlaneBox& box,
                    unsigned char* code)
{
	const vcg::Point3d origin = space.toLabel({0, 0, 0}), x = space.toLabel({1, 0, 0}) - origin,
					   y = space.toLabel({0, 1, 0}) - origin, z = space.toLabel({0, 0, 1}) - origin;
	const auto row = [&](int i) { return vcg::Point3f(float(x[i]), float(y[i]), float(z[i])); };
	const vcg::Point3f u = row(0), v = row(1);
	const float left = float(box.low[0] - origin[0]), right = float(box.high[0] - origin[0]),
				below = float(box.low[1] - origin[1]), above = float(box.high[1] - origin[1]);
	const auto* vertex = m.vert.data();
	for (size_t i = 0, n = m.vert.size(); i < n; ++i) {
		const auto& p = vertex[i].cP();
		const vcg::Point3f q = vcg::Point3f::Construct(p);
		const float s = u * q, t = v * q;
		code[i] = static_cast<unsigned char>((s < left) | (s > right) << 1 | (t < below) << 2 | (t > above) << 3);
	}
	int meet = 0;
	for (const auto& f : m.face)
		meet += (code[f.cV(0) - vertex] & code[f.cV(1) - vertex] & code[f.cV(2) - vertex]) == 0;
	return meet;
}

}  // namespace bench
