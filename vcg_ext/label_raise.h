#pragma once
// The raise: inside regions leave the surface, walls join them to it.
//
// Source: Slabaugh et al., section 3.2, last paragraph: "we duplicate each point on each letter contour, and apply a small offset
// either towards or away from the center of projection C". One copy stays on the surface, one goes with the inside; vertices of the
// mesh that lie within a letter move with it. Towards the viewpoint the top can't fold: the order along each ray is kept.

#include "label_cut.h"

namespace vcg::textlabel {

enum class ExtrudeAlong {
	Viewpoint,  ///< along each ray, towards or away from C (the paper); along -w in parallel projection, from the axis if wrapped
	LabelNormal,   ///< along the label's w; if wrapped, as Viewpoint
	SurfaceNormal  ///< along the surface's normal, smoothed over the letter
};

enum class FaceKind : signed char { Outside, Top, Wall };

/// A vertex that the label makes.
struct PatchVertex {
	vcg::Point3d mesh;  ///< mesh coordinates, not yet rounded
	Mixture mixture;    ///< of whose attributes it has its own
	int ground = -1;  ///< the vertex over which it is raised, numbered as in PatchFace; -1 when it lies in the surface
};

/// A face that the label makes or changes.
struct PatchFace {
	IndexTriangle vertex;  ///< < #sheet vertices: that vertex; else sheet.vertices.size() + i: LabelPatch::vertices[i]
	int parent;            ///< sheet triangle whose attributes it takes (its birth face)
	FaceKind kind;
};

/// What a label changes in a mesh: replace the sheet triangles in `removed` by `faces`, and move some vertices.
struct LabelPatch {
	std::vector<PatchVertex> vertices;                ///< new
	std::vector<std::pair<int, vcg::Point3d>> moved;  ///< sheet vertices within letters, and where to
	std::vector<PatchFace>
		faces;  ///< nearly each removed triangle is the parent of one that is no wall; at least as many as these
	std::vector<int> removed;  ///< sheet triangles, ascending
	bool isFlat = true;        ///< nothing is raised: tops are pieces of the surface
};

/// Raise the inside of a cut label.
/// @param[in] height  world units; > 0 towards the viewer, < 0 away, 0 leaves all in the surface
/// @return a patch whose border is that of the triangles it replaces
/// @throws Error{NonManifold} where two sheets touch in a vertex that a letter moves; Error{BehindCamera} when it would rise to the centre
///         of projection; PlacementConflict where the cut is not what a walk makes
LabelPatch RaiseLabel(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double height,
                      ExtrudeAlong along);

// ---------------------------------------------------------------------------------------------------------------------------

namespace detail {

/// Inside triangles of a cut, those cut up and those wholly within alike, as points of the cut.
inline std::vector<IndexTriangle> InsideTriangles(const Sheet& sheet, const CutLabel& cut)
{
	std::vector<IndexTriangle> inside;
	for (const CutTriangle& t : cut.triangles)
		if (t.side == Side::Inside) inside.push_back(t.point);
	for (const int t : cut.within) inside.push_back(sheet.triangles[size_t(t)].vertex);
	return inside;
}

/// Unit normals of the letters' surface in label space, averaged over neighbours so that facets don't show; zero elsewhere.
inline std::vector<vcg::Point3d> SmoothNormals(const Sheet& sheet, const CutLabel& cut,
                                               const std::vector<IndexTriangle>& inside)
{
	constexpr int rounds = 4;  // a noisy scan's normals settle; a flat face's do not change
	std::vector<int> faces = cut.touched;
	faces.insert(faces.end(), cut.within.begin(), cut.within.end());
	std::vector<vcg::Point3d> corner(sheet.vertices.size(), vcg::Point3d(0, 0, 0)), sum;
	for (const int f : faces) {
		const IndexTriangle& t = sheet.triangles[size_t(f)].vertex;
		const vcg::Point3d& a = sheet.vertices[size_t(t[0])].label;
		const vcg::Point3d n = (sheet.vertices[size_t(t[1])].label - a) ^ (sheet.vertices[size_t(t[2])].label - a);
		for (const int v : t) corner[size_t(v)] += n;
	}
	for (int round = 0; round <= rounds; ++round) {
		for (vcg::Point3d& n : corner)
			if (n.SquaredNorm() > 0) n /= n.Norm();
		if (round == rounds) break;
		sum = corner;
		for (const int f : faces) {
			const IndexTriangle& t = sheet.triangles[size_t(f)].vertex;
			const vcg::Point3d all = corner[size_t(t[0])] + corner[size_t(t[1])] + corner[size_t(t[2])];
			for (const int v : t) sum[size_t(v)] += all;
		}
		corner.swap(sum);
	}
	// between the corners the normal turns steadily: two points side by side have nearly the same
	std::vector<vcg::Point3d> normal(size_t(cut.points.count(sheet)), vcg::Point3d(0, 0, 0));
	for (const IndexTriangle& t : inside)
		for (const int v : t) {
			const Mixture m = cut.points.mixtureOf(sheet, v);
			vcg::Point3d n(0, 0, 0);
			for (size_t k = 0; k < 3; ++k) n += corner[size_t(m.parent[k])] * m.weight[k];
			if (n.SquaredNorm() > 0) normal[size_t(v)] = n / n.Norm();
		}
	return normal;
}

/// A vector of label space at a point of the sheet, in mesh coordinates. Where the label is wrapped it turns with the point, steadily
/// over each triangle as its corners do: what is raised of a triangle stays plane, and its pieces stay in their order.
inline vcg::Point3d Across(const LabelSpace& space, const Sheet& sheet, const Mixture& at, const vcg::Point3d& label)
{
	const auto corner = [&](size_t k) { return sheet.vertices[size_t(at.parent[k])].mesh; };
	if (!space.wraps()) return space.vectorToMesh(corner(0), label);
	vcg::Point3d sum(0, 0, 0);
	for (size_t k = 0; k < 3; ++k) sum += space.vectorToMesh(corner(k), label) * at.weight[k];
	return sum;
}

/// A vertex that moves with a letter must belong to it alone: where two sheets touch in a vertex, both would move.
inline void RequireOwnVertices(const Sheet& sheet, const LabelPatch& patch)
{
	std::vector<char> shared(sheet.vertices.size(), 0);
	for (const PatchFace& f : patch.faces)
		for (const int v : f.vertex)
			if (f.kind == FaceKind::Outside && v < int(shared.size())) shared[size_t(v)] = 1;
	std::vector<int> ofOthers = sheet.besideNoPoint;  // mesh indices
	for (const StraddlingTriangle& s : sheet.straddling)
		ofOthers.insert(ofOthers.end(), s.vertex.begin(), s.vertex.end());
	std::sort(ofOthers.begin(), ofOthers.end());
	std::vector<char> isRemoved(sheet.triangles.size(), 0);
	for (const int t : patch.removed) isRemoved[size_t(t)] = 1;
	for (const auto& [v, to] : patch.moved) {
		bool own = !shared[size_t(v)] &&
		           !std::binary_search(ofOthers.begin(), ofOthers.end(), sheet.vertices[size_t(v)].index);
		for (int i = sheet.vertexStart[size_t(v)]; i < sheet.vertexStart[size_t(v) + 1]; ++i)
			own = own && isRemoved[size_t(sheet.vertexFan[size_t(i)])];
		if (!own)
			throw Error(ErrorCode::NonManifold, "two sheets touch in a vertex").atPlace(sheet.vertices[size_t(v)].mesh);
	}
}

}  // namespace detail

inline LabelPatch RaiseLabel(const LabelSpace& space, const Sheet& sheet, const CutLabel& cut, double height,
                             ExtrudeAlong along)
{
	LabelPatch patch;
	const int old = int(sheet.vertices.size());
	const size_t walls = height == 0 ? 0 : cut.pieces.size();  // twice as many faces
	patch.vertices.reserve(cut.points.added.size() + walls);
	patch.faces.reserve(cut.triangles.size() + cut.within.size() + sheet.flipped.size() + 2 * walls);
	for (const CutPoint& p : cut.points.added) patch.vertices.push_back({p.mesh, p.mixture, -1});
	std::vector<int> top(size_t(cut.points.count(sheet)));
	for (size_t i = 0; i < top.size(); ++i) top[i] = int(i);
	patch.isFlat = height == 0;

	const std::vector<IndexTriangle> inside = detail::InsideTriangles(sheet, cut);
	if (height != 0) {
		std::vector<vcg::Point3d> normal;
		if (along == ExtrudeAlong::SurfaceNormal) normal = detail::SmoothNormals(sheet, cut, inside);
		const auto raised = [&](int i) {
			const SheetPoint& p = cut.points.at(sheet, i);
			const vcg::Point3d direction = along == ExtrudeAlong::Viewpoint     ? space.towardsViewer(p.label)
			                               : along == ExtrudeAlong::LabelNormal ? vcg::Point3d(0, 0, 1)
			                                                                    : normal[size_t(i)];
			bool isInFront = space.isInFront(p.label + direction * height);
			for (const int v :
			     cut.points.mixtureOf(sheet, i).parent)  // wrapped, a whole triangle goes with its corners
				if (space.wraps()) isInFront &= space.isInFront(sheet.vertices[size_t(v)].label + direction * height);
			if (!isInFront)
				throw Error(ErrorCode::BehindCamera, "the label would rise to the centre of projection")
					.atPlace(p.mesh)
					.measured(height, 0);
			return p.mesh + detail::Across(space, sheet, cut.points.mixtureOf(sheet, i), direction * height);
		};
		for (const ContourPiece& piece : cut.pieces) {  // each contour point is the start of one piece
			top[size_t(piece.from)] = old + int(patch.vertices.size());
			patch.vertices.push_back({raised(piece.from), cut.points.mixtureOf(sheet, piece.from), piece.from});
		}
		std::vector<char> seen(size_t(old), 0);
		for (const IndexTriangle& t : inside)
			for (const int v : t)
				if (v < old && top[size_t(v)] == v) seen[size_t(v)] = 1;
		for (int v = 0; v < old; ++v)
			if (seen[size_t(v)]) patch.moved.emplace_back(v, raised(v));
	}
	const auto topOf = [&](const IndexTriangle& t) {
		return IndexTriangle{top[size_t(t[0])], top[size_t(t[1])], top[size_t(t[2])]};
	};
	std::vector<int> pieceFrom(height == 0 ? 0 : top.size(), -1), parentBeside(cut.pieces.size(), -1);
	for (size_t i = 0; i < cut.pieces.size() && height != 0; ++i) pieceFrom[size_t(cut.pieces[i].from)] = int(i);
	const auto findPieces = [&](const IndexTriangle& t, int parent) {  // which inside triangle borders a contour piece
		for (size_t k = 0; k < 3 && height != 0; ++k) {
			const int piece = pieceFrom[size_t(t[k])];
			if (piece >= 0 && cut.pieces[size_t(piece)].to == t[(k + 1) % 3]) parentBeside[size_t(piece)] = parent;
		}
	};
	for (const CutTriangle& t : cut.triangles) {
		if (t.side == Side::Outside) {
			patch.faces.push_back({t.point, t.parent, FaceKind::Outside});
			continue;
		}
		patch.faces.push_back({topOf(t.point), t.parent, FaceKind::Top});
		findPieces(t.point, t.parent);
	}
	for (const int t : cut.within) {
		const auto& v = sheet.triangles[size_t(t)].vertex;
		patch.faces.push_back({topOf(v), t, FaceKind::Top});
		findPieces(v, t);
	}
	patch.removed.reserve(cut.touched.size() + cut.within.size() + sheet.flipped.size());
	std::merge(cut.touched.begin(), cut.touched.end(), cut.within.begin(), cut.within.end(),
	           std::back_inserter(patch.removed));
	for (const int t : sheet.flipped)
		if (!std::binary_search(patch.removed.begin(), patch.removed.end(), t)) {
			patch.faces.push_back({sheet.triangles[size_t(t)].vertex, t, FaceKind::Outside});
			patch.removed.insert(std::lower_bound(patch.removed.begin(), patch.removed.end(), t), t);
		}
	if (height == 0) return patch;
	detail::RequireOwnVertices(sheet, patch);
	for (size_t i = 0; i < cut.pieces.size(); ++i) {
		if (parentBeside[i] < 0)
			throw PlacementConflict{"a contour piece borders no letter",
			                        cut.points.at(sheet, cut.pieces[i].from).plane};
		const int parent = parentBeside[i], a = cut.pieces[i].from, b = cut.pieces[i].to;
		const int ta = top[size_t(a)], tb = top[size_t(b)];
		patch.faces.push_back({{a, b, tb}, parent, FaceKind::Wall});
		patch.faces.push_back({{a, tb, ta}, parent, FaceKind::Wall});
	}
	return patch;
}

}  // namespace vcg::textlabel
