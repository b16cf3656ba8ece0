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
int BarePass(const CMeshO& m, const vcg::textlabel::LabelSpace& space, const vcg::textlabel::PlaneBox& box,
             unsigned char* code);

}  // namespace bench
