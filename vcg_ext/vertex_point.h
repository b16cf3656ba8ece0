#pragma once
// The place of a vertex in doubles, whatever the mesh keeps it in.

#include <cmath>
#include <vcg/space/point3.h>

namespace vcg::textlabel {

inline bool IsFinite(const vcg::Point3d& p)
{
	return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

template <class VertexType>
vcg::Point3d PointOf(const VertexType& vertex)
{
	const auto& p = vertex.cP();
	return {double(p[0]), double(p[1]), double(p[2])};
}

}  // namespace vcg::textlabel
