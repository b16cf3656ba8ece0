// A translation unit of its own, so that every program times the same machine code.

#include "bench_mesh.h"

namespace bench {

int BarePass(const CMeshO& m, const vcg::textlabel::LabelSpace& space, const vcg::textlabel::PlaneBox& box,
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
