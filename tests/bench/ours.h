#pragma once
// Ours in the side-by-side: the label on MeshLab's own mesh, and the limits of anything that looks at the mesh once.

#include "vcg_ext/contour.h"
#include "vcg_ext/label_frame.h"
#include "vcg_ext/validate.h"

#include <memory>

namespace bench {

using vcg::textlabel::IndexedMesh;
using vcg::textlabel::LabelFrame;
using vcg::textlabel::Outline;

class Ours {
public:
	Ours(const IndexedMesh& part, const Outline& outline, const LabelFrame& frame, double height);
	~Ours();

	/// Label the part on vectors that have room for what is new, as those of a part that was labelled before. @return seconds
	double label(IndexedMesh* result);
	/// Label the part on vectors without room, which then grow. @return seconds
	double labelWithoutRoom();
	/// One bare linear pass: project every vertex, test every triangle's box against the label's. @return seconds
	double pass();
	/// Copy the arrays of vertices and faces, byte by byte. @return seconds
	double copy();
	/// Bytes of those arrays.
	double bytes() const;
	/// Triangles whose box meets the label's, as the bare pass counts them.
	int underBox() const { return underBox_; }

private:
	struct Mesh;
	void restore(bool room);

	const IndexedMesh& part_;
	const Outline& outline_;
	const LabelFrame frame_;
	const double height_;
	std::unique_ptr<Mesh> mesh_;
	int newVertices_ = 0, newFaces_ = 0, underBox_ = 0;
};

}  // namespace bench
