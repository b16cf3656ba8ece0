#pragma once
// A part in numbers, and as bare arrays.

#include "label_report.h"
#include "placement.h"
#include "vcg_ext/parallel_chunks.h"
#include "vcg_ext/validate.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vcg/complex/complex.h>
#include <vector>

namespace textlabel {

/// Bounding boxes of the finite vertices, null when there is none.
struct PartBoxes {
	vcg::Box3d mesh, world;  ///< in mesh and in world coordinates
};

namespace detail {

/// A box that is grown without branches.
struct GrowingBox {
	static constexpr double kEnd = std::numeric_limits<double>::infinity();
	double low[3] = {kEnd, kEnd, kEnd}, high[3] = {-kEnd, -kEnd, -kEnd};

	void add(const vcg::Point3d& p)
	{
		for (int i = 0; i < 3; ++i) {
			low[i] = std::min(low[i], p[i]);
			high[i] = std::max(high[i], p[i]);
		}
	}
	void addTo(vcg::Box3d& box) const
	{
		if (low[0] > high[0]) return;
		box.Add({low[0], low[1], low[2]});
		box.Add({high[0], high[1], high[2]});
	}
};

}  // namespace detail

/// One pass over the vertices.
template <class MeshType>
PartBoxes BoxesOf(const MeshType& m, const vcg::Matrix44d& toWorld)
{
	using vcg::textlabel::EachChunk, vcg::textlabel::IsFinite;
	const bool isMoved = toWorld != vcg::textlabel::LabelFrame::Identity();
	const size_t chunks = vcg::textlabel::ChunkCount(m.vert.size());
	std::array<std::array<detail::GrowingBox, 2>, vcg::textlabel::kMostChunks> found;
	EachChunk(m.vert.size(), chunks, [&](size_t chunk, size_t first, size_t last) {
		detail::GrowingBox mesh, world;
		for (size_t i = first; i < last; ++i) {
			const vcg::Point3d p = vcg::textlabel::PointOf(m.vert[i]);
			if (m.vert[i].IsD() || !IsFinite(p)) continue;
			mesh.add(p);
			if (!isMoved) continue;
			const vcg::Point3d q = toWorld * p;
			if (IsFinite(q)) world.add(q);
		}
		found[chunk] = {mesh, isMoved ? world : mesh};
	});
	PartBoxes boxes;
	for (size_t chunk = 0; chunk < chunks; ++chunk) {
		found[chunk][0].addTo(boxes.mesh);
		found[chunk][1].addTo(boxes.world);
	}
	return boxes;
}

/// What one pass over the faces finds.
struct FaceSums {
	double volume = 0;  ///< enclosed, mesh units cubed; of an open part, of the cone to the point given
	bool anySelected = false;
};

/// One pass over the faces, in blocks of a fixed size: the number of cores changes no digit of the sum.
/// @param[in] from  mesh coordinates; near the part, so that one far from the origin keeps its digits
template <class MeshType>
FaceSums SumFaces(const MeshType& m, const vcg::Point3d& from)
{
	constexpr size_t block = 4096;
	std::vector<FaceSums> sums((m.face.size() + block - 1) / block);
	const auto sumBlock = [&](size_t first, size_t last) {
		FaceSums sum;
		for (size_t f = first; f < last; ++f) {
			if (m.face[f].IsD()) continue;
			vcg::Point3d p[3];
			for (int k = 0; k < 3; ++k) p[k] = vcg::textlabel::PointOf(*m.face[f].cV(k)) - from;
			const double six = p[0] * (p[1] ^ p[2]);
			if (std::isfinite(six)) sum.volume += six / 6;
			sum.anySelected = sum.anySelected || m.face[f].IsS();
		}
		return sum;
	};
	vcg::textlabel::EachChunk(sums.size(), vcg::textlabel::ChunkCount(m.face.size()),
	                          [&](size_t, size_t first, size_t last) {
								  for (size_t b = first; b < last; ++b)
									  sums[b] = sumBlock(b * block, std::min((b + 1) * block, m.face.size()));
							  });
	FaceSums total;
	for (const FaceSums& sum : sums) {
		total.volume += sum.volume;
		total.anySelected = total.anySelected || sum.anySelected;
	}
	return total;
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
/// Deleted faces are left out, so the triangles have numbers of their own.
template <class MeshType>
PartGeometry GeometryOf(const MeshType& m, const vcg::Matrix44d& toWorld)
{
	PartGeometry part;
	part.positions.reserve(m.vert.size());
	for (size_t i = 0; i < m.vert.size(); ++i) part.positions.push_back(toWorld * vcg::textlabel::PointOf(m.vert[i]));
	const bool mirrors = toWorld.Determinant() < 0;
	for (const auto& f : m.face) {
		if (f.IsD()) continue;
		const auto vertex = [&](int k) { return int(f.cV(k) - m.vert.data()); };
		part.triangles.push_back({vertex(0), vertex(mirrors ? 2 : 1), vertex(mirrors ? 1 : 2)});
	}
	return part;
}

/// The colours of the triangles of GeometryOf. Labels have a few; a painted surface has many, and these part nothing.
/// @return #triangles: a number for each colour; empty when there is only one, or when there are many
template <class MeshType>
std::vector<std::uint32_t> PaintOf(const MeshType& m)
{
	constexpr size_t most = 16;
	std::vector<std::uint32_t> paint, colors;
	if (!vcg::tri::HasPerFaceColor(m)) return paint;
	for (const auto& f : m.face) {
		if (f.IsD()) continue;
		const auto& c = f.cC();
		paint.push_back(std::uint32_t(c[0]) << 16 | std::uint32_t(c[1]) << 8 | std::uint32_t(c[2]));
		if (!colors.empty() && colors.back() == paint.back()) continue;
		const auto known = std::find(colors.begin(), colors.end(), paint.back());
		if (known == colors.end()) colors.push_back(paint.back());
		else std::iter_swap(known, colors.end() - 1);  // the next face often has the same
		if (colors.size() > most) return {};
	}
	return colors.size() > 1 ? paint : std::vector<std::uint32_t>();
}

/// Which triangles of GeometryOf are among some faces of the mesh.
/// @return #triangles, 1 or 0
template <class MeshType>
std::vector<std::uint8_t> MarkTriangles(const MeshType& m, std::initializer_list<const std::vector<int>*> lists)
{
	std::vector<std::uint8_t> isListed(m.face.size(), 0), marked;
	for (const auto* faces : lists)
		for (const int f : *faces) isListed[size_t(f)] = 1;
	for (size_t f = 0; f < m.face.size(); ++f)
		if (!m.face[f].IsD()) marked.push_back(isListed[f]);
	return marked;
}

}  // namespace textlabel
