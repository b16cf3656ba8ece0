#pragma once
// The filter itself: a request and a mesh in, a labelled mesh and a report out; the same for every host.
//
// text -> outline (text_outline.h); place -> frames (placement.h); both -> the library (vcg_ext/text_label.h); then what a host
// expects of a changed mesh. Until the library commits, the mesh is only read; after it, all that the mesh needs is done without
// memory. What is only told (the report) may still run out of it: ErrorContext::isMade knows the difference.

#include "error_text.h"
#include "label_report.h"
#include "mesh_numbers.h"
#include "placement.h"
#include "stage_clock.h"
#include "vcg_ext/text_label.h"

namespace textlabel {

/// What the service asks of its host.
struct ServiceHost {
	std::function<std::optional<Camera>()> currentView;  ///< null, or nothing returned: there is no window
	std::function<bool(int percent)> progress;           ///< null, or return false to cancel
};

/// One run on one mesh.
template <class MeshType>
class LabelJob {
public:
	/// @param[in] toWorld  the layer's matrix
	/// @param[out] context  what a sentence about an error needs; kept up to date while running
	LabelJob(MeshType& m, const vcg::Matrix44d& toWorld, const ServiceHost& host, ErrorContext& context)
		: m_(m), toWorld_(toWorld), host_(host), context_(context)
	{}

	/// Label the mesh; when an exception comes it is as it was, or wholly labelled if context.isMade.
	/// @throws vcg::textlabel::Error, TextError, RequestError, std::bad_alloc
	LabelReport run(const LabelRequest& request);

	/// Where the label is in the mesh, after run().
	const vcg::textlabel::LabelResult& result() const { return result_; }
	const vcg::textlabel::LabelFrame& frame() const { return frame_; }
	const TextOutline& outline() const { return outline_; }

private:
	PartProbe probe() const;
	Camera viewFor(LabelRequest& request) const;
	void label(LabelRequest& request, StageClock& clock);
	void labelOnce(const LabelRequest& request, const Camera& view, StageClock& clock);
	bool labelBolder(const LabelRequest& request, const Camera& view, StageClock& clock);
	void tryAttempt(const LabelRequest& request, const Attempt& attempt, const TextOutline& outline);
	void labelAtDepth(const LabelRequest& request, const TextOutline& outline, double depth);
	void finish(const LabelRequest& request, bool anySelected);
	void updateBox();
	bool markForNormals();
	void updateNormals();
	void countAgain(MeshNumbers& before, MeshNumbers& after) const;
	LabelReport report(const LabelRequest& request) const;

	MeshType& m_;
	const vcg::Matrix44d toWorld_;
	const ServiceHost& host_;
	ErrorContext& context_;
	PartBoxes boxes_;  ///< before the label
	vcg::textlabel::LabelFrame frame_;
	vcg::textlabel::LabelResult result_;
	TextOutline outline_;
	double size_ = 0, height_ = 0;
	double boldSize_ =
		std::numeric_limits<double>::infinity();  ///< at which letters that were too thin would be bold enough
};

// ---------------------------------------------------------------------------------------------------------------------------

template <class MeshType>
PartProbe LabelJob<MeshType>::probe() const
{
	return {boxes_.world, [this](const SightLine& line) { return HitsOnLine(m_, toWorld_, line); },
	        [this] {
				PartGeometry geometry = GeometryOf(m_, toWorld_);
				geometry.paint = PaintOf(m_);
				return geometry;
			},
	        [this](vcg::textlabel::LabelFrame frame, double halfSide) {
				frame.toWorld = toWorld_;
				return CollectSurface(m_, frame, halfSide);
			}};
}

/// The camera for placements that have one. A window's view becomes the request's camera, read back from its text, so that the
/// request can be run again with the same result to the last bit.
template <class MeshType>
Camera LabelJob<MeshType>::viewFor(LabelRequest& request) const
{
	if (request.placement == PlacementKind::CurrentView) {
		const std::optional<Camera> view = host_.currentView ? host_.currentView() : std::nullopt;
		if (!view) throw RequestError(RequestProblem::NoWindow, "placement");
		request.placement = PlacementKind::Camera;
		request.camera = WriteCamera(*view);
	}
	return request.placement == PlacementKind::Camera ? RequestedCamera(request) : Camera();
}

template <class MeshType>
LabelReport LabelJob<MeshType>::run(const LabelRequest& asked)
{
	LabelRequest request = asked;
	StageClock clock;
	boxes_ = BoxesOf(m_, toWorld_);
	vcg::textlabel::RequireCountable(m_.vert.size(), m_.face.size());
	const vcg::textlabel::LayerMatrix layer(toWorld_);  // refuses a bad one, which makes the part look empty
	if (m_.FN() == 0 || boxes_.world.IsNull()) throw RequestError(RequestProblem::EmptyPart);
	CheckRequest(request, boxes_.world);
	constexpr int countedUpTo =
		50000;  // triangles; of larger parts only when the report is asked for: counting takes longer than labelling
	const bool counts = m_.FN() <= countedUpTo || !request.report.empty();
	const FaceSums faces = SumFaces(m_, boxes_.mesh.Center());
	MeshNumbers before;
	before.vertices = m_.VN();
	before.triangles = m_.FN();
	const double worldVolume = std::abs(layer.determinant);
	before.volume = faces.volume * worldVolume;
	if (counts) CountTopology(m_, before);
	clock.end("measure");
	label(request, clock);
	finish(request, faces.anySelected);
	clock.end("finish");
	LabelReport made = report(request);
	made.before = made.after = before;
	made.after.vertices = m_.VN();
	made.after.triangles = m_.FN();
	made.after.volume += result_.addedVolume * worldVolume;
	if (counts) countAgain(made.before, made.after);
	clock.end("measure_again");
	made.milliseconds = clock.stages();
	return made;
}

/// The topology after the label, where there is memory left to count it; else none is told.
template <class MeshType>
void LabelJob<MeshType>::countAgain(MeshNumbers& before, MeshNumbers& after) const
{
	try {
		CountTopology(m_, after);
	} catch (const std::bad_alloc&) {
		before.hasTopology = after.hasTopology = false;
	}
}

template <class MeshType>
void LabelJob<MeshType>::label(LabelRequest& request, StageClock& clock)
{
	const Camera view = viewFor(request);
	try {
		labelOnce(request, view, clock);
	} catch (const vcg::textlabel::Error& error) {
		if (!DependsOnPlace(error.code) || !labelBolder(request, view, clock)) throw;
	} catch (const TextError& error) {
		if (error.code != TextErrorCode::TooThin || !labelBolder(request, view, clock)) throw;
	}
}

/// Where both place and size are left to us, and the best places held only letters that are too thin: one that holds the size at which
/// they are not.
/// @return false, and all as it was, when there is none
template <class MeshType>
bool LabelJob<MeshType>::labelBolder(const LabelRequest& request, const Camera& view, StageClock& clock)
{
	constexpr double more = 1 + 1e-6;  // than just enough
	const bool isChosen = request.placement == PlacementKind::Automatic && request.size == ChosenToFit;
	if (!isChosen || !(boldSize_ * more <= boxes_.world.Diag())) return false;
	LabelRequest sized = request;
	sized.size = boldSize_ * more;
	const ErrorContext context = context_;
	try {
		labelOnce(sized, view, clock);
		return true;
	} catch (const vcg::textlabel::Error& second) {
		if (!DependsOnPlace(second.code)) throw;
	} catch (const TextError&) {  // the first search's error says more
	} catch (const RequestError&) {}
	context_ = context;
	return false;
}

/// The first attempt that the library takes; when it takes none, the error of the first one.
template <class MeshType>
void LabelJob<MeshType>::labelOnce(const LabelRequest& request, const Camera& view, StageClock& clock)
{
	TextSetter text(request);
	std::exception_ptr first;
	ErrorContext firstContext;
	const auto keepFirst = [&] {
		if (first) return;
		first = std::current_exception();
		firstContext = context_;
	};
	const auto refuse = [&] {
		context_ = firstContext;
		std::rethrow_exception(first);
	};
	const auto accept = [&](const Attempt& attempt) {
		clock.end("place");
		try {
			outline_ = text.at(attempt.size);
			tryAttempt(request, attempt, outline_);
			context_.isMade = true;
		} catch (vcg::textlabel::Error& error) {
			if (error.hasPlace) error.place = toWorld_ * error.place;  // where a person sees it
			if (!DependsOnPlace(error.code)) throw;
			keepFirst();
		} catch (const TextError& error) {
			const bool isTooLarge = error.code == TextErrorCode::BadArc;
			if (error.code == TextErrorCode::TooThin && error.fitWidth == 0) boldSize_ = error.size;
			if (!isTooLarge && first) refuse();  // too small for the text, which was not what was wrong
			if (!isTooLarge) throw;
			keepFirst();
		}
		clock.end("label");
		return context_.isMade;
	};
	if (!OfferAttempts(request, view, probe(), text, accept)) refuse();
}

/// A depth that is left to us is a share of the size, half of it for a drawing, whose details are finer, or of a code's module, less where
/// the part is thin.
template <class MeshType>
void LabelJob<MeshType>::tryAttempt(const LabelRequest& request, const Attempt& attempt, const TextOutline& outline)
{
	constexpr double sizeOverDepth = 10, drawingOverDepth = 20, moduleOverDepth = 2, ofWall = 0.4, ofRoom = 0.5;
	frame_ = attempt.frame;
	frame_.toWorld = toWorld_;
	size_ = attempt.size;
	context_.letters = outline.letters;
	context_.isWrapped = frame_.wrapRadius != 0;
	const bool choose = request.depth == ChosenToFit && request.style != LabelStyle::Flat;
	if (!choose) return labelAtDepth(request, outline, request.depth);
	const double ofSize = size_ / (request.drawing.empty() ? sizeOverDepth : drawingOverDepth);
	double depth = outline.module > 0 ? outline.module / moduleOverDepth : ofSize;
	if (request.style == LabelStyle::Engrave && attempt.wall > 0) depth = std::min(depth, attempt.wall * ofWall);
	try {
		labelAtDepth(request, outline, depth);
	} catch (const vcg::textlabel::Error& error) {
		using Code = vcg::textlabel::ErrorCode;
		const bool shallower = error.limit > 0 && error.limit < depth;
		if (!shallower || (error.code != Code::HitsSurface && error.code != Code::HitsItself)) throw;
		labelAtDepth(request, outline, error.limit * ofRoom);
	}
}

template <class MeshType>
void LabelJob<MeshType>::labelAtDepth(const LabelRequest& request, const TextOutline& outline, double depth)
{
	height_ = request.style == LabelStyle::Emboss ? depth : request.style == LabelStyle::Engrave ? -depth : 0;
	context_.depth = height_;
	context_.isAlongView = request.extrudeAlong == ExtrudeDirection::Viewpoint;
	vcg::textlabel::LabelOptions options;
	options.height = height_;
	options.along = vcg::textlabel::ExtrudeAlong(request.extrudeAlong);
	options.maxStretch = request.maxStretch;
	options.minStretch = LeastStretch(request, outline);
	options.fileDigits = context_.fileDigits = int(request.fileDigits);
	options.progress = host_.progress;
	result_ = vcg::textlabel::LabelMesh(m_, outline.outline, frame_, options);
}

/// Selection, colour, box and normals of what has changed.
/// @param[in] anySelected  some faces were selected before
template <class MeshType>
void LabelJob<MeshType>::finish(const LabelRequest& request, bool anySelected)
{
	const bool colors = vcg::tri::HasPerFaceColor(m_) && (request.style == LabelStyle::Flat || request.tint);
	if (anySelected)
		for (auto& f : m_.face) f.ClearS();
	for (const auto* faces : {&result_.topFaces, &result_.wallFaces})
		for (const int f : *faces) {
			m_.face[size_t(f)].SetS();
			if (colors)
				m_.face[size_t(f)].C() = vcg::Color4b(request.color[0], request.color[1], request.color[2], 255);
		}
	updateBox();
	updateNormals();
}

/// The box grows by what is new. It may shrink only where a vertex of its border moved: then all of them are looked at once more.
template <class MeshType>
void LabelJob<MeshType>::updateBox()
{
	const vcg::Box3d &old = boxes_.mesh, &from = result_.movedFrom;
	bool mayShrink = false;
	for (int i = 0; i < 3 && !from.IsNull(); ++i)
		mayShrink = mayShrink || from.min[i] <= old.min[i] || from.max[i] >= old.max[i];
	vcg::Box3d box = mayShrink ? BoxesOf(m_, vcg::textlabel::LabelFrame::Identity()).mesh : old;
	box.Add(result_.newPlaces);
	m_.bbox.Import(box);
}

/// Mark the vertices that need a normal as visited, and of the others all that a pass over the mesh's faces could take for these.
/// @return whether some are old ones on which walls stand
template <class MeshType>
bool LabelJob<MeshType>::markForNormals()
{
	const auto* const firstNew = m_.vert.data() + result_.firstNewVertex;
	const auto eachVertex = [&](const auto& faces, const auto& use) {
		for (const int f : faces)
			for (int k = 0; k < 3; ++k) use(*m_.face[size_t(f)].V(k));
	};
	const auto mark = [&] {
		for (const auto* faces : {&result_.topFaces, &result_.wallFaces, &result_.outsideFaces})
			eachVertex(*faces, [&](auto& v) { &v >= firstNew ? v.SetV() : v.ClearV(); });
		if (height_ != 0)  // the old corners of a letter's top have moved with it
			eachVertex(result_.topFaces, [](auto& v) { v.SetV(); });
	};
	mark();
	bool isOnOld = false;
	eachVertex(result_.wallFaces, [&](const auto& v) { isOnOld = isOnOld || !v.IsV(); });
	if (!isOnOld) return false;
	for (auto& v : m_.vert) v.ClearV();  // a mark may be left from what others did
	mark();
	eachVertex(result_.wallFaces, [](auto& v) { v.SetV(); });
	return true;
}

/// New faces get their normals; so do the vertices that are new, have moved, or have walls standing on them. All faces around the
/// first two are new; those around an old vertex that a contour runs through are found by looking at all.
/// Needs no memory: these are marked as visited.
template <class MeshType>
void LabelJob<MeshType>::updateNormals()
{
	const bool perVertex = vcg::tri::HasPerVertexNormal(m_), perFace = vcg::tri::HasPerFaceNormal(m_);
	const auto eachCorner = [&](const auto& use) {
		for (const auto* faces : {&result_.topFaces, &result_.wallFaces, &result_.outsideFaces})
			for (const int f : *faces)
				for (int k = 0; k < 3; ++k) use(m_.face[size_t(f)], k);
	};
	const bool isOnOld = markForNormals() && perVertex;
	eachCorner([&](auto& f, int k) {
		if (perVertex && f.V(k)->IsV()) f.V(k)->N().SetZero();
		if (perFace && k == 0) f.N() = vcg::TriangleNormal(f).Normalize();
	});
	const auto addNormal = [](auto& f, int k) {  // weighted by the angle, as MeshLab does it
		if (f.V(k)->IsV())
			f.V(k)->N() += vcg::TriangleNormal(f).Normalize() * vcg::Angle(f.P1(k) - f.P(k), f.P2(k) - f.P(k));
	};
	if (isOnOld) {
		for (auto& f : m_.face)
			for (int k = 0; k < 3 && !f.IsD(); ++k) addNormal(f, k);
	} else if (perVertex) {
		eachCorner(addNormal);
	}
	eachCorner([&](auto& f, int k) {
		if (!f.V(k)->IsV()) return;
		f.V(k)->ClearV();
		if (perVertex) f.V(k)->N().Normalize();
	});
}

template <class MeshType>
LabelReport LabelJob<MeshType>::report(const LabelRequest& request) const
{
	LabelReport r;
	r.request = request;
	r.size = size_;
	r.depth = height_;
	for (const std::string& font : outline_.fonts) r.font += (r.font.empty() ? "" : "; ") + font;
	r.module = outline_.module;
	r.thinnestStroke = outline_.thinnestStroke.width;
	r.narrowestGap = outline_.narrowestGap.width;
	r.touchedTriangles = result_.touchedFaces;
	r.labelArea = result_.labelArea;
	r.surfaceArea = result_.surfaceArea;
	r.stretch = result_.stretch;
	r.leastStretch = result_.leastStretch;
	r.resolution = result_.resolution;
	r.coordinateStep = result_.coordinateStep;
	r.survivesFloat32 = result_.survivesFloat32;
	r.view = {frame_.origin, frame_.w, frame_.v, frame_.perspective, frame_.center, frame_.wrapRadius, frame_.wrapAxis};
	return r;
}

}  // namespace textlabel
