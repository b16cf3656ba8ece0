#pragma once
// Polygons with more than three corners: VCGlib keeps such a polygon as triangles, and marks their common edges as faux. The triangles
// of a polygon that a label takes are replaced by plain ones; what is left of the polygon stays one, and must not say that it goes on
// where it now ends.

#include "label_raise.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vcg::textlabel {

/// An edge of a face.
struct FaceEdge {
	int face, edge;  ///< index in the mesh; 0..2
};

/// The faux edges at which faces that stay meet faces that a patch removes. Costs a pass over the faces, and only where a polygon is
/// touched.
template <class MeshType>
std::vector<FaceEdge> FauxEdgesAround(const MeshType& m, const Sheet& sheet, const LabelPatch& patch)
{
	const auto endsOf = [&](const typename MeshType::FaceType& f, int k) {
		const auto a = f.cV0(k) - m.vert.data(), b = f.cV1(k) - m.vert.data();
		return std::make_pair(std::min(a, b), std::max(a, b));
	};
	using Ends = decltype(endsOf(m.face[0], 0));
	std::vector<Ends> cut;
	std::vector<int> removed;
	for (const int t : patch.removed) {
		const int face = sheet.triangles[size_t(t)].face;
		removed.push_back(face);
		for (int k = 0; k < 3; ++k)
			if (m.face[size_t(face)].IsF(k)) cut.push_back(endsOf(m.face[size_t(face)], k));
	}
	std::vector<FaceEdge> around;
	if (cut.empty()) return around;
	std::sort(cut.begin(), cut.end());
	std::sort(removed.begin(), removed.end());
	for (size_t f = 0; f < m.face.size(); ++f) {
		const auto& face = m.face[f];
		for (int k = 0; k < 3 && !face.IsD() && face.IsAnyF(); ++k)
			if (face.IsF(k) && std::binary_search(cut.begin(), cut.end(), endsOf(face, k)) &&
			    !std::binary_search(removed.begin(), removed.end(), int(f)))
				around.push_back({int(f), k});
	}
	return around;
}

}  // namespace vcg::textlabel
