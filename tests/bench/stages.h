#pragma once
// The operation split into its stages, in the order in which LabelPlanner and LabelMesh call them; each runs on what the one before
// has left, as often as one likes.

#include "bench_mesh.h"
#include "bench_part.h"
#include "bench_text.h"
#include "vcg_ext/text_label.h"

namespace bench {

using vcg::textlabel::Outline;

/// A part, a label, and what each stage makes of them.
class Stages {
public:
	/// @param[in] part  kept by reference
	Stages(const IndexedMesh& part, Outline outline, double height = 1)
		: part_(part), outline_(std::move(outline)), height_(height), space_(FrameOnCushion())
	{
		for (const auto& c : outline_.contours)
			for (const auto& p : c.points) box_.add(p);
		restore();
		sheet_ = sheet();
		snap_ = 4 * vcg::textlabel::Precision{true}.ulp(sheet_.largestCoordinate);  // as LabelPlanner
		seeds_ = seeds();
		layer_ = layer();
		cut_ = cut();
		patch_ = raise();
		position_ = rounded();
	}

	/// As deep as a label of this height reaches, but for a margin.
	vcg::textlabel::Sheet sheet() const { return vcg::textlabel::CollectSheet(mesh_, space_, box_, height_); }
	std::vector<int> seeds() const { return vcg::textlabel::FindSeeds(space_, sheet_, outline_, snap_); }
	/// @return points of the contours on the surface
	size_t march() const
	{
		vcg::textlabel::LabelPaths paths(space_, sheet_, snap_);
		paths.lay(outline_, seeds_);
		return paths.pieces.size();
	}
	/// The march is a part of it.
	vcg::textlabel::CutLabel cut() const
	{
		return vcg::textlabel::LabelCutter(space_, sheet_, snap_).cut(outline_, seeds_);
	}
	vcg::textlabel::SheetLayer layer() const { return vcg::textlabel::FindLayer(sheet_, outline_, seeds_); }
	/// As deep as LabelPlanner looks below letters that are raised.
	double clearance() const
	{
		return vcg::textlabel::MeasureClearance(space_, sheet_, cut_, snap_, layer_, 2 * snap_).behind;
	}
	vcg::textlabel::LabelPatch raise() const
	{
		return vcg::textlabel::RaiseLabel(space_, sheet_, cut_, height_, vcg::textlabel::ExtrudeAlong::Viewpoint);
	}
	bool check() const
	{
		const auto position = rounded();
		const auto suspects =
			vcg::textlabel::FindSuspects(space_, sheet_, layer_, patch_, position, true, height_, snap_);
		const auto verdict = vcg::textlabel::CheckPatch(space_, sheet_, patch_, position, suspects);
		return verdict.fault == vcg::textlabel::PatchFault::Sound;
	}
	/// Changes the mesh; restore() undoes it.
	size_t commit() { return vcg::textlabel::CommitPatch(mesh_, space_, sheet_, patch_).faces.size(); }
	/// All stages; changes the mesh.
	int label() { return labelIn(FrameOnCushion()); }
	/// The same label, wrapped round an axis in the cushion.
	int wrapped()
	{
		LabelFrame frame = FrameOnCushion();
		frame.wrapRadius = 60;  // the cushion is 100 units long: no face under the text is steep seen from the axis
		frame.wrapAxis = frame.v;
		return labelIn(frame);
	}
	void restore()
	{
		if (mesh_.vert.empty()) {
			constexpr size_t room = 400000;  // more than any label here needs
			ReserveMesh(mesh_, part_.positions.size() + room, part_.faces.size() + room);
		}
		FillMesh(mesh_, part_);
	}
	int pass()
	{
		codes_.resize(part_.positions.size());
		return BarePass(mesh_, space_, box_, codes_.data());
	}

	/// Sizes for the records: candidates, points of the contours on the surface, faces that replace them.
	size_t candidates() const { return sheet_.triangles.size(); }
	size_t crossings() const { return cut_.pieces.size(); }
	size_t faces() const { return patch_.faces.size(); }

private:
	int labelIn(const LabelFrame& frame)
	{
		vcg::textlabel::LabelOptions options;
		options.height = height_;
		return vcg::textlabel::LabelMesh(mesh_, outline_, frame, options).newFaces;
	}
	std::vector<vcg::Point3d> rounded() const
	{
		return vcg::textlabel::RoundedPositions(sheet_, patch_, vcg::textlabel::RoundToFloat);
	}

	const IndexedMesh& part_;
	const Outline outline_;
	const double height_;
	const vcg::textlabel::LabelSpace space_;
	vcg::textlabel::PlaneBox box_;
	double snap_ = 0;
	CMeshO mesh_;
	std::vector<unsigned char> codes_;
	vcg::textlabel::Sheet sheet_;
	std::vector<int> seeds_;
	vcg::textlabel::SheetLayer layer_;
	vcg::textlabel::CutLabel cut_;
	vcg::textlabel::LabelPatch patch_;
	std::vector<vcg::Point3d> position_;
};

}  // namespace bench
