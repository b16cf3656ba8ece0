#pragma once
// Judge of a label: runs a case and checks every promise of vcg_ext/text_label.h by other means than the library's.
//
// A mesh is judged as an STL file would hold it: coordinates rounded to float32 (unless the result says that only
// float64 carries the letters), equal points merged. What the input had wrong is not held against the result.

#include "fuzz_label_topology.h"
#include "label_case.h"
#include "vcg_ext/crossing_search.h"

#include <vcg/complex/complex.h>

#include <map>
#include <set>
#include <string>
#include <tuple>

namespace vcg::textlabel::test {

/// What became of a case. An empty fault: a valid label, or a refusal that left the mesh as it was.
struct Verdict {
	std::string fault;  ///< what is wrong, in words that name the class first: "crossing: ..."
	bool refused = false;
	ErrorCode code{};     ///< when refused
	std::string message;  ///< when refused
	double value = 0, limit = 0;
	LabelResult result;

	bool good() const { return fault.empty(); }
	std::string faultClass() const { return fault.substr(0, fault.find(':')); }
};

/// Run a case and judge it.
Verdict Judge(const LabelCase& c);

// ---------------------------------------------------------------------------------------------------------------------

namespace detail {

class FloatVertex;
class FloatFace;
struct FloatTypes : vcg::UsedTypes<vcg::Use<FloatVertex>::AsVertexType, vcg::Use<FloatFace>::AsFaceType> {};
class FloatVertex : public vcg::Vertex<FloatTypes, vcg::vertex::Coord3f, vcg::vertex::BitFlags> {};
class FloatFace : public vcg::Face<FloatTypes, vcg::face::VertexRef, vcg::face::BitFlags> {};
class FloatMesh : public vcg::tri::TriMesh<std::vector<FloatVertex>, std::vector<FloatFace>> {};
class DoubleVertex;
class DoubleFace;
struct DoubleTypes : vcg::UsedTypes<vcg::Use<DoubleVertex>::AsVertexType, vcg::Use<DoubleFace>::AsFaceType> {};
class DoubleVertex : public vcg::Vertex<DoubleTypes, vcg::vertex::Coord3d, vcg::vertex::BitFlags> {};
class DoubleFace : public vcg::Face<DoubleTypes, vcg::face::VertexRef, vcg::face::BitFlags> {};
class DoubleMesh : public vcg::tri::TriMesh<std::vector<DoubleVertex>, std::vector<DoubleFace>> {};

template <class MeshType>
void Fill(MeshType& m, const Soup& s)
{
	using Scalar = typename MeshType::ScalarType;
	vcg::tri::Allocator<MeshType>::AddVertices(m, s.vertices.size());
	for (size_t i = 0; i < s.vertices.size(); ++i)
		m.vert[i].P() = {Scalar(s.vertices[i][0]), Scalar(s.vertices[i][1]), Scalar(s.vertices[i][2])};
	if (!s.faces.empty()) vcg::tri::Allocator<MeshType>::AddFaces(m, s.faces.size());
	for (size_t i = 0; i < s.faces.size(); ++i)
		for (int k = 0; k < 3; ++k) m.face[i].V(k) = &m.vert[size_t(s.faces[i][size_t(k)])];
}

template <class MeshType>
Soup SoupOf(const MeshType& m)
{
	Soup s;
	for (const auto& v : m.vert) s.vertices.push_back({double(v.cP()[0]), double(v.cP()[1]), double(v.cP()[2])});
	for (const auto& f : m.face)
		s.faces.push_back({int(f.cV(0) - m.vert.data()), int(f.cV(1) - m.vert.data()), int(f.cV(2) - m.vert.data())});
	return s;
}

inline bool AreSamePoint(const vcg::Point3d& a, const vcg::Point3d& b)
{
	return std::memcmp(&a[0], &b[0], 3 * sizeof(double)) == 0;
}

inline bool AreSame(const Soup& a, const Soup& b)
{
	return a.faces == b.faces && a.vertices.size() == b.vertices.size() &&
	       std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin(), AreSamePoint);
}

/// A mesh as a file holds it.
inline Soup Welded(const Soup& s, bool asFloat)
{
	Soup w;
	std::map<std::tuple<double, double, double>, int> at;
	std::vector<int> to;
	for (vcg::Point3d p : s.vertices) {
		if (asFloat)
			for (int i = 0; i < 3; ++i) p[i] = ToFloat32(p[i]);
		if (!IsFinite(p)) {
			to.push_back(w.add(p));
			continue;
		}
		const auto found = at.emplace(std::make_tuple(p[0] + 0.0, p[1] + 0.0, p[2] + 0.0), int(w.vertices.size()));
		if (found.second) w.add(p);
		to.push_back(found.first->second);
	}
	for (const auto& f : s.faces) w.faces.push_back({to[size_t(f[0])], to[size_t(f[1])], to[size_t(f[2])]});
	return w;
}

inline bool IsSubset(const std::set<std::pair<Place, Place>>& a, const std::set<std::pair<Place, Place>>& b)
{
	return std::includes(b.begin(), b.end(), a.begin(), a.end());
}

template <class... Values>
std::string Text(const Values&... values)
{
	std::ostringstream out;
	out.precision(9);
	(out << ... << values);
	return out.str();
}

/// A label's outcome together with the mesh before and after.
struct Outcome {
	const LabelCase& c;
	const Soup& before;
	const Soup& after;
	const LabelResult& r;
	std::vector<char> touched;  ///< #faces after: made or changed by the label

	double diagonal() const
	{
		PlaneBox xy, z;
		for (const vcg::Point3d& p : before.vertices)
			if (IsFinite(p)) xy.add({p[0], p[1]}), z.add({p[2], 0});
		return std::sqrt(xy.width() * xy.width() + xy.height() * xy.height() + z.width() * z.width());
	}
};

inline std::string CheckIndices(Outcome& o)
{
	const LabelResult& r = o.r;
	o.touched.assign(o.after.faces.size(), 0);
	for (const auto* list : {&r.topFaces, &r.wallFaces, &r.outsideFaces})
		for (const int f : *list) {
			if (f < 0 || f >= int(o.after.faces.size())) return "index: a face of the result is not in the mesh";
			if (std::exchange(o.touched[size_t(f)], 1)) return "index: a face is named twice in the result";
		}
	if (r.firstNewVertex != int(o.before.vertices.size()) ||
	    r.newVertices != int(o.after.vertices.size() - o.before.vertices.size()))
		return "index: new vertices are not where the result says";
	if (r.newFaces != int(o.after.faces.size() - o.before.faces.size())) return "index: newFaces is wrong";
	int slots = 0;
	for (size_t f = 0; f < o.after.faces.size(); ++f) {
		if (f >= o.before.faces.size()) {
			if (!o.touched[f]) return "index: a new face is not in the result";
			continue;
		}
		slots += o.touched[f];
		if (!o.touched[f] && o.before.faces[f] != o.after.faces[f])
			return "untouched: a face that is not in the result has changed";
	}
	if (slots != r.touchedFaces) return Text("index: touchedFaces is ", r.touchedFaces, ", not ", slots);
	if ((o.c.height == 0) != r.wallFaces.empty()) return "index: walls and height disagree";
	return {};
}

/// Old vertices stay, except for those strictly inside a raised letter: all faces around them are tops.
inline std::string CheckVertices(const Outcome& o)
{
	std::vector<char> isTop(o.after.faces.size(), 0), other(o.after.vertices.size(), 0),
		used(o.after.vertices.size(), 0);
	for (const int f : o.r.topFaces) isTop[size_t(f)] = 1;
	for (size_t f = 0; f < o.after.faces.size(); ++f)
		for (const int v : o.after.faces[f]) {
			used[size_t(v)] = 1;
			if (!isTop[f]) other[size_t(v)] = 1;
		}
	for (size_t v = 0; v < o.after.vertices.size(); ++v) {
		if (v >= o.before.vertices.size()) {
			if (!IsFinite(o.after.vertices[v])) return "vertex: a new one is not finite";
			if (!used[v]) return "vertex: a new one has no face";
			continue;
		}
		if (AreSamePoint(o.before.vertices[v], o.after.vertices[v])) continue;
		if (o.c.height == 0) return "vertex: an old one moved in a flat label";
		if (other[v]) return "vertex: an old one moved that is not inside a letter";
	}
	return {};
}

inline std::string CompareTopology(const Outcome& o, const Topology& a, const Topology& b)
{
	if (a.border != b.border) return Text("border: ", a.border.size(), " edges before, ", b.border.size(), " after");
	if (!IsSubset(b.nonManifold, a.nonManifold))
		return Text("non-manifold: ", a.nonManifold.size(), " edges before, ", b.nonManifold.size(), " after");
	if (!std::includes(a.forks.begin(), a.forks.end(), b.forks.begin(), b.forks.end()))
		return Text("fork: ", a.forks.size(), " vertices of several fans before, ", b.forks.size(), " after");
	if (a.components != b.components) return Text("components: ", a.components, " before, ", b.components, " after");
	if (a.euler != b.euler) return Text("euler: ", a.euler, " before, ", b.euler, " after");
	int fresh = 0;
	for (const int f : b.degenerate) fresh += o.touched[size_t(f)];
	if (fresh > 0 && a.degenerate.empty()) return Text("degenerate: ", fresh, " of the label's faces");
	return {};
}

/// Whether welding alone makes an edge non-manifold at a face that the label changed: two sheets that lie in one
/// place. No label on one of them can look like a label on both.
inline bool WeldsSheets(const Outcome& o, const Soup& before, const Topology& welded)
{
	for (size_t f = 0; f < before.faces.size(); ++f)
		for (size_t k = 0; k < 3 && o.touched[f]; ++k) {
			const Place a = PlaceOf(before.vertices[size_t(before.faces[f][k])]),
						b = PlaceOf(before.vertices[size_t(before.faces[f][(k + 1) % 3])]);
			if (welded.nonManifold.count({std::min(a, b), std::max(a, b)})) return true;
		}
	return false;
}

inline std::string CheckTopology(const Outcome& o, const Soup& before, const Soup& after)
{
	std::string fault = CompareTopology(o, TopologyOf(o.before), TopologyOf(o.after));
	if (!fault.empty()) return fault + ", by indices";
	const Topology welded = TopologyOf(before);
	return WeldsSheets(o, before, welded) ? std::string() : CompareTopology(o, welded, TopologyOf(after));
}

inline std::string CheckCrossings(const Outcome& o, const Soup& before, const Soup& after)
{
	const auto pairsOf = [&](const Soup& s, bool touchedIsFirst) {
		std::vector<Corners> mine, others;
		for (int f = 0; f < int(s.faces.size()); ++f)
			(!touchedIsFirst || (f < int(o.touched.size()) && o.touched[size_t(f)]) ? mine : others)
				.push_back(CornersIn(s, f));
		return FindCrossings(mine, others);
	};
	const std::vector<FacePair> now = pairsOf(after, true);
	if (now.empty()) return {};
	const std::vector<FacePair> then = pairsOf(before, true);  // faces that the label changed, against all
	if (then.empty()) return Text("crossing: ", now.size(), " pairs, none before");
	// pieces of a face that crossed before may cross; anything made by raising may not
	if (o.c.height == 0) return {};
	std::vector<Corners> raised, others;
	std::vector<char> isRaised(after.faces.size(), 0);
	for (const auto* list : {&o.r.topFaces, &o.r.wallFaces})
		for (const int f : *list) isRaised[size_t(f)] = 1;
	for (int f = 0; f < int(after.faces.size()); ++f)
		(isRaised[size_t(f)] ? raised : others).push_back(CornersIn(after, f));
	const size_t bad = FindCrossings(raised, others).size();
	return bad == 0 ? std::string() : Text("crossing: ", bad, " pairs with raised faces");
}

struct Measure {
	double volume = 0, area = 0;
};

inline Measure MeasureFaces(const Soup& s, const vcg::Point3d& origin, const std::function<bool(size_t)>& counts)
{
	Measure m;
	for (size_t f = 0; f < s.faces.size(); ++f) {
		if (!counts(f)) continue;
		const Corners c = CornersIn(s, int(f));
		m.volume += (c[0] - origin) * ((c[1] - origin) ^ (c[2] - origin)) / 6;
		m.area += ((c[1] - c[0]) ^ (c[2] - c[0])).Norm() / 2;
	}
	return m;
}

/// Volume and area by formulas of their own.
inline std::string CheckMeasures(const Outcome& o)
{
	const LabelResult& r = o.r;
	if (r.topFaces.empty()) return "measure: no letter";
	const vcg::Point3d origin = o.after.vertices[size_t(o.after.faces[size_t(r.topFaces[0])][0])];
	const auto touched = [&](size_t f) { return o.touched[f] != 0; };
	const Measure before = MeasureFaces(o.before, origin, touched), after = MeasureFaces(o.after, origin, touched);
	double perimeter = 0, matrix[9];
	for (const Contour& c : o.c.outline.contours)
		for (size_t i = 0; i < c.points.size(); ++i)
			perimeter += (c.points[i] - c.points[(i + 1) % c.points.size()]).Norm();
	const double area = Area(o.c.outline);
	for (int i = 0; i < 9; ++i) matrix[i] = o.c.frame.toWorld.ElementAt(i / 3, i % 3);
	const vcg::Point3d a(matrix[0], matrix[3], matrix[6]), b(matrix[1], matrix[4], matrix[7]),
		c(matrix[2], matrix[5], matrix[8]);
	const double det = std::abs((a ^ b) * c);

	if (!(std::abs(r.labelArea - area) <= 1e-9 * area + 1.01 * r.resolution * perimeter))
		return Text("area: the letters have ", r.labelArea, " instead of ", area);
	if (!(r.surfaceArea >= 0.0)) return "area: surfaceArea is not a number";
	if (!(r.stretch >= 1 && r.stretch <= o.c.maxStretch)) return Text("measure: stretch ", r.stretch);
	// a few dozen steps of the coarsest coordinates that a file can hold here
	constexpr double mostSteps = 32;
	double largest = 0, scale = 0;
	for (const vcg::Point3d& p : o.before.vertices)
		for (int i = 0; i < 3; ++i)
			if (std::isfinite(p[i])) largest = std::max(largest, std::abs(p[i]));
	for (const double x : matrix) scale += x * x;
	const double step = largest * double(std::numeric_limits<float>::epsilon()) * std::sqrt(scale);
	if (!(r.resolution >= 0 && r.resolution <= mostSteps * step)) return Text("measure: resolution ", r.resolution);
	if (o.c.height == 0) {
		const double allowed =
			1e-6 * before.area + 100 * r.resolution * r.stretch * perimeter / std::pow(det, 2.0 / 3) * 4;
		if (!(std::abs(after.area - before.area) <= allowed))
			return Text("area: flat label, surface ", before.area, " before, ", after.area, " after, allowed ",
			            allowed);
	}
	// rounding moves each point by half an ulp: the volume by that times the area of what moved
	const double ulp = r.resolution / 4 / std::cbrt(det);
	const double rounding = 4 * ulp * (before.area + after.area);
	const double change = after.volume - before.volume;
	if (!(std::abs(change - r.addedVolume) <= rounding + 1e-9 * std::abs(r.addedVolume)))
		return Text("volume: changed by ", change, ", the result says ", r.addedVolume, ", rounding ", rounding);
	if (o.c.height == 0) return {};
	const bool upwards = o.c.along == ExtrudeAlong::Viewpoint || o.c.along == ExtrudeAlong::LabelNormal;
	if (!o.c.frame.perspective && o.c.frame.wrapRadius == 0 &&
	    upwards) {  // a prism over any surface: base times height
		const double expected = r.labelArea * o.c.height / det, allowed = rounding + 1e-6 * std::abs(expected);
		if (!(std::abs(change - expected) <= allowed))
			return Text("volume: changed by ", change, " instead of ", expected, ", allowed ", allowed);
	}
	if (upwards && std::abs(change) > rounding && (change > 0) != (o.c.height > 0))
		return Text("volume: wrong sign, ", change);
	return {};
}

inline std::string CheckResult(const LabelCase& c, const Soup& before, const Soup& after, const LabelResult& r)
{
	Outcome o{c, before, after, r, {}};
	std::string fault = CheckIndices(o);
	if (fault.empty()) fault = CheckVertices(o);
	if (!fault.empty()) return fault;
	const Soup weldedBefore = Welded(before, r.survivesFloat32), weldedAfter = Welded(after, r.survivesFloat32);
	fault = CheckTopology(o, weldedBefore, weldedAfter);
	if (fault.empty()) fault = CheckCrossings(o, weldedBefore, weldedAfter);
	if (fault.empty()) fault = CheckMeasures(o);
	return fault;
}

/// Label a mesh; what is thrown becomes part of the verdict.
template <class MeshType>
void RunLabel(MeshType& m, const LabelCase& c, Verdict& verdict)
{
	LabelOptions options;
	options.height = c.height;
	options.along = c.along;
	options.maxStretch = c.maxStretch;
	try {
		verdict.result = LabelMesh(m, c.outline, c.frame, options);
	} catch (const Error& e) {
		verdict.refused = true;
		verdict.code = e.code;
		verdict.message = e.message;
		verdict.value = e.value;
		verdict.limit = e.limit;
	} catch (const PlacementConflict& e) {
		verdict.fault = Text("exception: PlacementConflict ", e.why);
	} catch (const std::exception& e) {
		verdict.fault = Text("exception: ", e.what());
	}
}

template <class MeshType>
Verdict JudgeOn(const LabelCase& c)
{
	Verdict verdict;
	MeshType first, second;
	Fill(first, c.mesh);
	Fill(second, c.mesh);
	const Soup before = SoupOf(first);
	RunLabel(first, c, verdict);
	if (!verdict.good()) return verdict;
	const Soup after = SoupOf(first);
	if (first.vn != int(first.vert.size()) || first.fn != int(first.face.size()))
		verdict.fault = "index: vn or fn is wrong";
	if (verdict.refused) {
		if (!AreSame(before, after)) verdict.fault = "refused: but the mesh has changed";
		if (verdict.good() && c.mustWork)
			verdict.fault = Text("refusal: of what should work, code ", int(verdict.code), ", ", verdict.message);
		return verdict;
	}
	if (verdict.good()) verdict.fault = CheckResult(c, before, after, verdict.result);
	if (!verdict.good()) return verdict;
	constexpr int oneIn = 4;  // it costs as much as the label
	if (after.faces.size() % oneIn != 0) return verdict;
	Verdict again;
	RunLabel(second, c, again);
	if (again.refused || !AreSame(after, SoupOf(second))) verdict.fault = "determinism: another mesh the second time";
	return verdict;
}

}  // namespace detail

inline Verdict Judge(const LabelCase& c)
{
	return c.isFloat ? detail::JudgeOn<detail::FloatMesh>(c) : detail::JudgeOn<detail::DoubleMesh>(c);
}

}  // namespace vcg::textlabel::test
