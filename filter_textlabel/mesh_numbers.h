#pragma once
// A part in numbers, and as bare arrays.

#include "label_report.h"
#include "placement.h"
#include "vcg_ext/validate.h"

#include <vcg/complex/complex.h>

namespace textlabel {

template <class MeshType>
vcg::Point3d PointOf(const MeshType& m, size_t vertex)
{
	const auto& p = m.vert[vertex].cP();
	return {double(p[0]), double(p[1]), double(p[2])};
}

/// Bounding box of the finite vertices, in world coordinates; null when there is none.
template <class MeshType>
vcg::Box3d WorldBox(const MeshType& m, const vcg::Matrix44d& toWorld)
{
	vcg::Box3d box;
	for (size_t i = 0; i < m.vert.size(); ++i) {
		const vcg::Point3d p = toWorld * PointOf(m, i);
		if (!m.vert[i].IsD() && vcg::textlabel::IsFinite(p)) box.Add(p);
	}
	return box;
}

/// Vertices, triangles and volume. The volume is taken from the centre of the box, so that a part far from the origin keeps its
/// digits.
template <class MeshType>
MeshNumbers NumbersOf(const MeshType& m)
{
	MeshNumbers numbers;
	numbers.vertices = m.VN();
	numbers.triangles = m.FN();
	const vcg::Box3d box = WorldBox(m, vcg::textlabel::LabelFrame::Identity());
	if (box.IsNull()) return numbers;
	const vcg::Point3d center = box.Center();
	for (const auto& f : m.face) {
		if (f.IsD()) continue;
		vcg::Point3d p[3];
		for (int k = 0; k < 3; ++k) p[k] = PointOf(m, size_t(f.cV(k) - m.vert.data())) - center;
		const double six = p[0] * (p[1] ^ p[2]);
		if (std::isfinite(six)) numbers.volume += six / 6;
	}
	return numbers;
}

/// Borders, components and handles too; this takes many times as long as all the rest of a label.
template <class MeshType>
void CountTopology(const MeshType& m, MeshNumbers& numbers)
{
	const vcg::textlabel::MeshReport counted = vcg::textlabel::MakeReport(m);
	numbers.hasTopology = true;
	numbers.borderEdges = counted.borderEdges;
	numbers.nonManifoldEdges = counted.nonManifoldEdges;
	numbers.components = counted.components;
	numbers.genus = counted.genus;
}

/// The part as arrays, in world coordinates; a mirroring matrix is undone, so that triangles stay counter-clockwise from outside.
template <class MeshType>
PartGeometry GeometryOf(const MeshType& m, const vcg::Matrix44d& toWorld)
{
	PartGeometry part;
	part.positions.reserve(m.vert.size());
	for (size_t i = 0; i < m.vert.size(); ++i) part.positions.push_back(toWorld * PointOf(m, i));
	const bool mirrors = toWorld.Determinant() < 0;
	for (const auto& f : m.face) {
		if (f.IsD()) continue;
		const auto vertex = [&](int k) { return int(f.cV(k) - m.vert.data()); };
		part.triangles.push_back({vertex(0), vertex(mirrors ? 2 : 1), vertex(mirrors ? 1 : 2)});
	}
	return part;
}

}  // namespace textlabel
