#pragma once
// What the tests of refusals share: label a mesh that must refuse it, and stay as it was.

#include "vcg_ext/text_label.h"

#include <gtest/gtest.h>

#include "label_check.h"
#include "test_mesh.h"

namespace refusal_case {

using namespace label_check;
using test_mesh::FloatMesh;
using test_mesh::Shape;

inline Shape Plate() { return test_mesh::Slab(30, 20, 4, 15, 10); }

/// Label the mesh, which must be refused and stay as it was.
inline Error RefusedMesh(FloatMesh& m, const Outline& outline, const LabelFrame& frame, const LabelOptions& options)
{
	const std::string bytes = test_mesh::Bytes(m);
	const auto* vertices = m.vert.data();
	const auto* faces = m.face.data();
	Error error(ErrorCode::OutOfMemory, "the label was not refused");
	Refusal(m, outline, frame, options, &error);
	EXPECT_TRUE(test_mesh::Bytes(m) == bytes) << "the mesh was changed";
	EXPECT_EQ(m.vert.data(), vertices);
	EXPECT_EQ(m.face.data(), faces);
	return error;
}

inline Error Refused(const Shape& shape, const Outline& outline, const LabelFrame& frame = {}, double height = 1,
                     ExtrudeAlong along = ExtrudeAlong::Viewpoint)
{
	FloatMesh m;
	test_mesh::Fill(m, shape);
	LabelOptions options;
	options.height = height;
	options.along = along;
	return RefusedMesh(m, outline, frame, options);
}

#define EXPECT_CODE(error, expected) EXPECT_EQ(int((error).code), int(ErrorCode::expected)) << (error).what()

/// The place is within `distance` of p.
inline void ExpectPlace(const Error& e, const Point3d& p, double distance)
{
	ASSERT_TRUE(e.hasPlace) << e.what();
	EXPECT_LE((e.place - p).Norm(), distance) << e.place[0] << ' ' << e.place[1] << ' ' << e.place[2];
}

}  // namespace refusal_case
