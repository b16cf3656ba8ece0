#pragma once
// Labels on real parts as a user makes them: a camera that looks at the part from some side, a text, a style, Apply.
//
// The filter runs on the request as MeshLab would give it (filter_textlabel/label_service.h). The text is first asked for at a third
// of the part's silhouette; where that is refused, once more with the size left to the filter. What comes out is judged here.

#include "filter_textlabel/label_service.h"

#include <optional>

#include "real_mesh.h"

namespace view_label {

using namespace real_mesh;
using test_mesh::Shape;
using textlabel::LabelStyle;
using vcg::Point3d;

/// A part, and what was wrong with it before.
struct Part {
	std::string name;
	Shape shape;
	bool isFloat = true;  ///< else in doubles, as PyMeshLab holds it
	MeshReport before;    ///< as a file would hold it
	bool crosses = false;

	explicit Part(const std::filesystem::path& file)
		: name(file.filename().string()), isFloat(FitsFloat32(file)), before()
	{
		shape = Load(file, isFloat);
		before = MakeReport(ToIndexed(shape));
		crosses = !FindCrossings(ToIndexed(shape), {true}).empty();
	}
};

/// Unit vectors towards the viewer: along the axes, and into each octant, no two components equal.
inline std::vector<Point3d> ViewDirections()
{
	std::vector<Point3d> directions;
	for (int axis = 0; axis < 3; ++axis)
		for (const double sign : {1.0, -1.0}) {
			directions.emplace_back(0, 0, 0);
			directions.back()[axis] = sign;
		}
	for (const double x : {0.48, -0.48})
		for (const double y : {0.6, -0.6})
			for (const double z : {0.64, -0.64}) directions.emplace_back(x, y, z);
	return directions;
}

inline const std::vector<std::string>& ViewTexts()
{
	static const std::vector<std::string> texts = {"A43", "SN-0123456789 gqy%&@"};
	return texts;
}

/// Where a user would have the middle of the window: the middle of the part's box, or where nothing is seen there, the face nearest
/// to it that looks to the viewer.
inline Point3d LookAt(const Part& part, const Point3d& middle, const Point3d& towardsViewer)
{
	double nearest = std::numeric_limits<double>::infinity();
	Point3d aim = middle;
	for (const auto& f : part.shape.faces) {
		const Point3d a = part.shape.points[size_t(f[0])] - middle, b = part.shape.points[size_t(f[1])] - middle,
					  c = part.shape.points[size_t(f[2])] - middle;
		const auto side = [&](const Point3d& p, const Point3d& q) { return towardsViewer * (p ^ q); };
		if (!(side(b - a, c - a) > 0)) continue;
		if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) return middle;
		const Point3d center = (a + b + c) / 3;
		const double distance = (center - towardsViewer * (center * towardsViewer)).SquaredNorm();
		if (!(distance < nearest)) continue;
		nearest = distance;
		aim = center + middle;
	}
	return aim;
}

/// A camera with the whole part in sight.
inline textlabel::LabelRequest RequestFrom(const Part& part, const Point3d& towardsViewer)
{
	constexpr double away = 1.5;  // diagonals
	vcg::Box3d box;
	for (const Point3d& p : part.shape.points)
		if (vcg::textlabel::IsFinite(p)) box.Add(p);
	textlabel::LabelRequest request;
	request.placement = textlabel::PlacementKind::Camera;
	request.direction = towardsViewer;
	request.position = LookAt(part, box.Center(), towardsViewer) + towardsViewer * (box.Diag() * away);
	return request;
}

/// Width of the part as the camera of a request sees it.
inline double SilhouetteWidth(const Part& part, const textlabel::LabelRequest& request)
{
	const Point3d right = textlabel::RequestedCamera(request).right;
	double low = std::numeric_limits<double>::infinity(), high = -low;
	for (const Point3d& p : part.shape.points) {
		if (!vcg::textlabel::IsFinite(p)) continue;
		low = std::min(low, p * right);
		high = std::max(high, p * right);
	}
	return high - low;
}

inline const char* NameOf(vcg::textlabel::ErrorCode code)
{
	constexpr const char* names[] = {"empty label",  "bad contour",     "bad frame",      "bad height",   "empty mesh",
	                                 "too large",    "beside the part", "shows its back", "border",       "horizon",
	                                 "not manifold", "hidden",          "behind camera",  "too long",     "too steep",
	                                 "squeezed",     "too fine",        "meets the part", "meets itself", "cancelled",
	                                 "out of memory"};
	static_assert(std::size(names) == size_t(vcg::textlabel::ErrorCode::OutOfMemory) + 1);
	return names[int(code)];
}

inline std::string NameOf(textlabel::RequestProblem problem)
{
	using Problem = textlabel::RequestProblem;
	if (problem == Problem::ViewMissesPart) return "view misses the part";
	if (problem == Problem::ViewFromInside) return "shows its back";
	return "request problem " + std::to_string(int(problem));
}

/// One label: made, with all that is wrong with it, or refused.
struct Labelled {
	bool isMade = false;
	std::string reason;    ///< why it was refused, in few words
	std::string sentence;  ///< and as the user reads it
	Shape shape;           ///< when made
	bool survivesFloat32 = true;
	double capitalHeight = 0, height = 0;
	std::string fault;  ///< what is wrong with the mesh; empty when all is well
};

namespace detail {

inline std::string WorseReport(const MeshReport& before, const MeshReport& after)
{
	const std::vector<std::pair<const char*, int MeshReport::*>> counts = {
		{"repeated index", &MeshReport::repeatedIndexFaces},
		{"collinear", &MeshReport::collinearFaces},
		{"duplicate", &MeshReport::duplicateFaces},
		{"non-manifold edges", &MeshReport::nonManifoldEdges},
		{"non-manifold vertices", &MeshReport::nonManifoldVertices},
		{"flipped edges", &MeshReport::flippedEdges},
		{"unbalanced edges", &MeshReport::unbalancedEdges},
		{"not finite", &MeshReport::notFinite}};
	for (const auto& [name, member] : counts)
		if (after.*member > before.*member) return name;
	if (after.borderEdges != before.borderEdges || after.borderLoops != before.borderLoops) return "border";
	if (after.components != before.components) return "components";
	return after.genus == before.genus ? "" : "genus";
}

inline std::vector<Corners> CornersOf(const IndexedMesh& m, const std::vector<char>& isMine, char mine)
{
	std::vector<Corners> out;
	for (size_t f = 0; f < m.faces.size(); ++f) {
		if (isMine[f] != mine) continue;
		const auto at = [&](size_t k) { return m.positions[size_t(m.faces[f][k])]; };
		out.push_back({at(0), at(1), at(2)});
	}
	return out;
}

/// Crossings of the faces that the label made; of all of these, or where the part crosses itself, of those that were raised.
inline size_t CountCrossings(const Part& part, const Shape& labelled, const LabelResult& result, bool isFlat)
{
	std::vector<char> isMine(labelled.faces.size(), 0);
	for (const auto* list : {&result.topFaces, &result.wallFaces, &result.outsideFaces}) {
		if (part.crosses && (isFlat || list == &result.outsideFaces)) continue;
		for (const int f : *list) isMine[size_t(f)] = 1;
	}
	const IndexedMesh m = PrepareForReport(ToIndexed(labelled), {result.survivesFloat32, false});
	return FindCrossings(CornersOf(m, isMine, 1), CornersOf(m, isMine, 0)).size();
}

/// Whether the enclosed volume has changed as the style says, and by what the library says.
inline std::string VolumeFault(const Part& part, const Shape& labelled, const LabelResult& result, double height)
{
	if (!IsClosed(part.before) || !IsManifold(part.before) || !IsOriented(part.before)) return {};
	const auto volume = [&](const Shape& s) {
		const Point3d o = part.shape.points[0];
		double sum = 0;
		for (const auto& f : s.faces) {
			const auto at = [&](size_t k) { return s.points[size_t(f[k])] - o; };
			sum += at(0) * (at(1) ^ at(2));
		}
		return sum / 6;
	};
	const double old = volume(part.shape), added = volume(labelled) - old;
	const double rounding = 2e-6 * std::abs(old) + 1e-4 * std::abs(result.addedVolume);
	if (std::abs(added - result.addedVolume) > rounding) return "volume is not what the result says";
	return std::abs(added) > rounding && (added > 0) != (height > 0) ? "volume has the wrong sign" : "";
}

template <class MeshType>
Labelled Run(const Part& part, const textlabel::LabelRequest& request)
{
	Labelled out;
	MeshType m;
	test_mesh::Fill(m, part.shape);
	const std::string bytes = test_mesh::Bytes(m);
	textlabel::ErrorContext context;
	const textlabel::ServiceHost host;
	textlabel::LabelJob<MeshType> job(m, LabelFrame::Identity(), host, context);
	try {
		const textlabel::LabelReport report = job.run(request);
		out.isMade = true;
		out.shape = test_mesh::ToShape(m);
		out.survivesFloat32 = job.result().survivesFloat32;
		out.capitalHeight = report.size;
		out.height = report.depth;
		const IndexedMesh asFile = PrepareForReport(ToIndexed(out.shape), {out.survivesFloat32, true});
		out.fault = WorseReport(part.before, MakeReport(asFile));
		if (out.fault.empty() && CountCrossings(part, out.shape, job.result(), report.depth == 0) > 0)
			out.fault = "crossing faces";
		if (out.fault.empty()) out.fault = VolumeFault(part, out.shape, job.result(), report.depth);
		return out;
	} catch (const Error& e) {
		out.reason = NameOf(e.code);
		out.sentence = textlabel::ErrorText(e, context);
	} catch (const textlabel::RequestError& e) {
		out.reason = NameOf(e.problem);
		out.sentence = textlabel::ErrorText(e);
	}
	if (test_mesh::Bytes(m) != bytes) out.fault = "refused, and changed";
	return out;
}

}  // namespace detail

/// Label a part and judge the outcome.
inline Labelled Label(const Part& part, const textlabel::LabelRequest& request)
{
	return part.isFloat ? detail::Run<test_mesh::FloatMesh>(part, request)
	                    : detail::Run<test_mesh::DoubleMesh>(part, request);
}

/// The two ways to ask for a label: at a third of the silhouette, and with the size left to the filter.
inline textlabel::LabelRequest AtAThird(const Part& part, textlabel::LabelRequest request)
{
	request.fitWidth = SilhouetteWidth(part, request) / 3;
	return request;
}

}  // namespace view_label
