#pragma once
// Random labels on random meshes: the cases of the fuzzer.
//
// Three families. *Clean*: a closed good mesh with the label well within one sheet, of a size that the coordinates
// carry; it must work. *Spoiled*: such a place, and a mesh of slivers, snapped vertices, holes, second sheets.
// *Hostile*: anything anywhere. The outcome of these is a valid label or a refusal. Contour points are aimed at
// vertices, edges and diagonals, because exact coincidences are the rule on real parts.
// A fourth one, of labels that run round an axis, is in random_wrapped_label.h.

#include "label_case.h"
#include "random_outline.h"

namespace vcg::textlabel::test {

namespace detail {

/// A mesh of about unit size, and how big a label it takes.
struct Part {
	Soup mesh;
	std::vector<int> places;  ///< faces around whose centre a label may go
	double room = 0;      ///< half the side of a square that lies well within the sheet around such a place; 0: unknown
	double depth = 0;     ///< how deep a label may go
	bool planar = false;  ///< the sheet is plane there
	bool centred = false;  ///< only one place has that room: `centre`, seen along z
	vcg::Point3d centre{0, 0, 0};
};

inline vcg::Point3d MiddleOf(const Soup& s, int f)
{
	const auto& t = s.faces[size_t(f)];
	return (s.vertices[size_t(t[0])] + s.vertices[size_t(t[1])] + s.vertices[size_t(t[2])]) / 3;
}

/// @param[in] isPlace  (middle, unit normal) of a face
inline std::vector<int> FacesWhere(const Soup& s,
                                   const std::function<bool(const vcg::Point3d&, const vcg::Point3d&)>& isPlace)
{
	std::vector<int> faces;
	for (int f = 0; f < int(s.faces.size()); ++f) {
		const vcg::Point3d n = s.normal(f);
		if (isPlace(MiddleOf(s, f), n / n.Norm())) faces.push_back(f);
	}
	return faces;
}

inline Part PlanePart(Random& random)
{
	Part part;
	const double size = random.pick({1.0, 1.0, 0.1, 0.75});
	const int cells = random.pick({1, 2, 3, 4, 6, 8, 10, 16});
	const double thickness = random.pick({0.5, 1.0, 0.2});
	const auto kind = Diagonals(random.below(4));
	part.mesh = MakeSlab(cells, cells, 2 * size / cells, thickness * size, kind, random, [](int, int) { return 0.0; });
	part.room = 0.95 * size;
	if (cells % 2 == 1) part.room *= (cells - 1.0) / cells;  // not centred
	if (cells == 1) {
		for (vcg::Point3d& p : part.mesh.vertices) p -= vcg::Point3d(size, size, 0);
		part.room = 0.95 * size;
	}
	part.depth = 0.5 * thickness * size;
	part.planar = part.centred = true;
	return part;
}

inline Part ReliefPart(Random& random)
{
	Part part;
	const int cells = random.integer(4, 20);
	const double cell = 2.0 / cells, steep = random.logReal(1e-7, 0.5) * cell,
				 wave = random.chance(0.5) ? random.real(0, 0.2) : 0;
	part.mesh = MakeSlab(cells, cells, cell, 1, Diagonals(random.below(4)), random, [&](int i, int j) {
		return random.real(-steep, steep) + wave * std::sin(i * cell * 3) * std::cos(j * cell * 2);
	});
	part.room = 0.9 * (cells % 2 ? (cells - 1.0) / cells : 1.0);
	part.depth = 0.3;
	part.centred = true;
	return part;
}

inline Part RoundPart(Random& random)
{
	Part part;
	const auto kind = Diagonals(random.below(4));
	switch (random.below(4)) {
	case 0:
		part.mesh = MakeIcosphere(random.integer(1, 3));
		part.room = 0.4;
		part.depth = 0.1;
		break;
	case 1:
		part.mesh = MakeSphere(random.integer(8, 40), random.integer(6, 20), kind, random);
		part.room = 0.4;
		part.depth = 0.1;
		break;
	case 2:
		part.mesh = MakeTorus(random.integer(8, 40), random.integer(8, 24), 0.4, kind, random);
		part.room = 0.12;
		part.depth = 0.04;
		part.places = FacesWhere(part.mesh, [](const vcg::Point3d& middle, const vcg::Point3d& normal) {
			return vcg::Point3d(middle[0], middle[1], 0) * normal > 0.3 * middle.Norm();  // not seen across the hole
		});
		break;
	default: {
		const int around = random.chance(0.1) ? 1000 : random.integer(8, 64);
		part.mesh = MakeCylinder(around, around > 100 ? 1 : random.integer(1, 8), 0.7, 1.6, random);
		part.depth = 0.05;
		if (random.chance(0.5)) {
			part.room = 0.4;
			part.centre = {0, 0, 0.8};
			part.centred = true;
			break;
		}
		part.room = 0.25;
		part.places = FacesWhere(part.mesh, [](const vcg::Point3d& middle, const vcg::Point3d& normal) {
			return std::abs(middle[2]) < 0.4 && std::abs(normal[2]) < 0.1;
		});
		if (part.places.empty()) part.centred = true, part.room = 0.4, part.centre = {0, 0, 0.8};
	}
	}
	return part;
}

inline Part MakePart(Random& random)
{
	Part part = random.chance(0.45) ? PlanePart(random) : random.chance(0.5) ? ReliefPart(random) : RoundPart(random);
	if (part.places.empty()) part.places = FacesWhere(part.mesh, [](const auto&, const auto&) { return true; });
	return part;
}

inline LabelFrame FrameOf(const vcg::Point3d& origin, const vcg::Point3d& towards, Random& random)
{
	const vcg::Point3d axes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1, 0}};
	for (;;) {
		const vcg::Point3d up = random.chance(0.7) ? axes[random.below(4)] : random.direction();
		if ((up ^ towards).Norm() > 0.1 * towards.Norm()) return FrameFromDirection(origin, towards, up);
	}
}

/// A random linear map with a shift, in float-friendly numbers now and then.
inline vcg::Matrix44d RandomMatrix(Random& random, bool gentle)
{
	vcg::Matrix44d m = LabelFrame::Identity();
	for (int i = 0; i < 3; ++i) {
		for (int j = 0; j < 3; ++j) m.ElementAt(i, j) = i == j ? 1 : 0;
		m.ElementAt(i, 3) = random.real(-2, 2);
	}
	const vcg::Point3d axis = random.direction();
	const double angle = random.pick({0.0, M_PI / 2, M_PI / 4, random.real(0, 6)}),
				 size = random.pick({1.0, 1.0, 25.4, 0.001});
	vcg::Matrix44d turn;
	turn.SetRotateRad(angle, axis);
	m = m * turn;
	for (int i = 0; i < 3; ++i) {
		const double stretch = gentle ? 1 : random.pick({1.0, 1.0, 0.5, 1.7});
		const double sign = i == 0 && random.chance(0.4) ? -1 : 1;
		for (int j = 0; j < 3; ++j) m.ElementAt(j, i) *= size * stretch * sign;
	}
	return m;
}

inline vcg::Point3d Transform(const vcg::Matrix44d& m, const vcg::Point3d& p, double w)
{
	vcg::Point3d q;
	for (int i = 0; i < 3; ++i)
		q[i] = m.ElementAt(i, 0) * p[0] + m.ElementAt(i, 1) * p[1] + m.ElementAt(i, 2) * p[2] + m.ElementAt(i, 3) * w;
	return q;
}

/// A surface's normal through a linear map: the cofactors, times the sign that keeps it outward.
inline vcg::Point3d TransformNormal(const vcg::Matrix44d& m, const vcg::Point3d& n)
{
	vcg::Point3d c[3];
	for (int j = 0; j < 3; ++j) c[j] = {m.ElementAt(0, j), m.ElementAt(1, j), m.ElementAt(2, j)};
	const double det = (c[0] ^ c[1]) * c[2];
	const vcg::Point3d q = (c[1] ^ c[2]) * n[0] + (c[2] ^ c[0]) * n[1] + (c[0] ^ c[1]) * n[2];
	return det < 0 ? -q : q;
}

/// Points of the label plane that a contour point could be aimed at: vertices, and points on edges, near the origin.
inline std::vector<vcg::Point2d> Targets(const LabelCase& c, double reach, Random& random)
{
	std::vector<vcg::Point2d> targets;
	const LabelSpace space(c.frame);
	const auto take = [&](const vcg::Point3d& p) {
		const vcg::Point3d q = space.toLabel(p);
		if (!IsFinite(q) || !space.isInFront(q)) return;
		const vcg::Point2d at = space.project(q);
		if (std::abs(at[0]) < reach && std::abs(at[1]) < reach) targets.push_back(at);
	};
	for (const vcg::Point3d& p : c.mesh.vertices) take(p);
	for (int i = 0; i < 30; ++i) {
		const auto& f = c.mesh.faces[size_t(random.below(int(c.mesh.faces.size())))];
		const vcg::Point3d &a = c.mesh.vertices[size_t(f[0])], &b = c.mesh.vertices[size_t(f[1])];
		take(a + (b - a) * random.pick({0.5, 0.25, random.unit()}));
	}
	return targets;
}

/// Move some or all of an outline so that its points meet targets exactly.
inline void Aim(LabelCase& c, double reach, Random& random)
{
	const std::vector<vcg::Point2d> targets = Targets(c, reach, random);
	if (targets.empty()) return;
	const Contour& contour = c.outline.contours[size_t(random.below(int(c.outline.contours.size())))];
	const vcg::Point2d from = contour.points[size_t(random.below(int(contour.points.size())))];
	vcg::Point2d to = targets[0];  // the nearest of a few: a short way keeps the label in its place
	for (int i = 0; i < 6; ++i) {
		const vcg::Point2d& t = targets[size_t(random.below(int(targets.size())))];
		if ((t - from).SquaredNorm() < (to - from).SquaredNorm()) to = t;
	}
	if ((to - from).Norm() > 0.2 * reach) return;
	for (Contour& moved : c.outline.contours)
		for (vcg::Point2d& p : moved.points) p = p == from ? to : p + (to - from);
}

inline void Scale(Outline& o, double s)
{
	for (Contour& c : o.contours)
		for (vcg::Point2d& p : c.points) p *= s;
}

inline void Quantize(Soup& s, double step)
{
	for (vcg::Point3d& p : s.vertices)
		for (int i = 0; i < 3; ++i) p[i] = std::round(p[i] / step) * step;
}

inline void Store(LabelCase& c)
{
	if (!c.isFloat) return;
	for (vcg::Point3d& p : c.mesh.vertices)
		for (int i = 0; i < 3; ++i) p[i] = ToFloat32(p[i]);
}

/// Whether float32 coordinates have steps a few hundred times finer than the strokes.
inline bool AreStrokesCarried(const LabelCase& c)
{
	constexpr double steps = 256;
	double largest = 0, finest = std::numeric_limits<double>::infinity();
	for (const vcg::Point3d& p : c.mesh.vertices)
		largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
	for (const Contour& contour : c.outline.contours) {
		double perimeter = 0;
		for (size_t i = 0, n = contour.points.size(); i < n; ++i)
			perimeter += (contour.points[i] - contour.points[(i + 1) % n]).Norm();
		finest = std::min(finest, std::abs(TwiceSignedArea(contour.points)) / perimeter);
	}
	const auto& m = c.frame.toWorld;
	const double scale = vcg::Point3d(m.ElementAt(0, 0), m.ElementAt(1, 0), m.ElementAt(2, 0)).Norm();
	return finest > steps * scale * largest * double(std::numeric_limits<float>::epsilon());
}

/// Put what a mesh should not have into it.
inline void Spoil(Soup& s, Random& random)
{
	for (int i = random.integer(1, 3); i > 0; --i) switch (random.below(9)) {
		case 0: SplitFaces(s, random.integer(1, 12), random.pick({0.1, 1e-4, 1e-8}), random); break;
		case 1: SplitEdges(s, random.integer(1, 8), random.pick({0.3, 1e-4, 1e-8}), random); break;
		case 2: Quantize(s, random.pick({0.5, 0.25, 0.1, 0.01})); break;
		case 3: RemoveFaces(s, random.integer(1, 3), random); break;
		case 4: {  // a face twice, or turned round
			const auto f = s.faces[size_t(random.below(int(s.faces.size())))];
			s.faces.push_back(random.chance(0.5) ? f : std::array<int, 3>{f[0], f[2], f[1]});
			break;
		}
		case 5: {  // a second sheet close by
			Soup other = s;
			const vcg::Point3d shift = random.direction() * random.pick({0.0, 1e-7, 1e-4, 0.05, 0.5});
			for (vcg::Point3d& p : other.vertices) p += shift;
			Append(s, other);
			break;
		}
		case 6: {  // unwelded
			const size_t f = size_t(random.below(int(s.faces.size()))), k = size_t(random.below(3));
			const vcg::Point3d copy = s.vertices[size_t(s.faces[f][k])];
			s.faces[f][k] = s.add(copy);
			break;
		}
		case 7: {  // a vertex somewhere else
			s.vertices[size_t(random.below(int(s.vertices.size())))] += random.direction() * random.logReal(1e-6, 1);
			break;
		}
		default: {  // a fin: an edge of three faces
			const auto f = s.faces[size_t(random.below(int(s.faces.size())))];
			const int tip = s.add(s.vertices[size_t(f[0])] + random.direction() * 0.3);
			s.faces.push_back({f[0], f[1], tip});
		}
		}
}

}  // namespace detail

/// A label that has to work: a closed clean mesh, the label well within one sheet, numbers that float32 carries.
inline LabelCase MakeCleanLabel(Random& random)
{
	LabelCase c;
	c.family = "clean";
	c.isFloat = random.chance(0.75);
	detail::Part part = detail::MakePart(random);
	const bool turned = random.chance(0.4);
	const double scale = random.pick({1.0, 1.0, 10.0, 1e3, 1e-3, 1e-5, 1e5});
	const vcg::Point3d offset =
		random.chance(0.7) ? vcg::Point3d(0, 0, 0) : random.direction() * random.pick({1.0, 10.0, 100.0});
	vcg::Matrix44d turn = LabelFrame::Identity();
	if (turned) turn.SetRotateRad(random.real(0, 6), random.direction());
	if (part.planar && random.chance(0.3)) detail::Quantize(part.mesh, std::ldexp(1.0, -20));
	c.mesh = part.mesh;
	for (vcg::Point3d& p : c.mesh.vertices) p = (detail::Transform(turn, p, 0) + offset) * scale;
	detail::Store(c);

	const int face = part.places[size_t(random.below(int(part.places.size())))];
	const vcg::Point3d origin = part.centred ? part.centre : detail::MiddleOf(part.mesh, face);
	vcg::Point3d normal = part.centred ? vcg::Point3d(0, 0, 1) : part.mesh.normal(face);
	normal /= normal.Norm();
	normal += random.direction() * random.pick({0.0, 0.0, 0.1, 0.2});
	normal /= normal.Norm();
	const vcg::Point3d worldOrigin = (detail::Transform(turn, origin, 0) + offset) * scale,
					   towards = detail::Transform(turn, normal, 0);
	c.frame = detail::FrameOf(worldOrigin, towards, random);
	double world = scale;
	if (random.chance(0.2)) {
		c.frame.toWorld = detail::RandomMatrix(random, true);
		const auto& m = c.frame.toWorld;
		const double size = vcg::Point3d(m.ElementAt(0, 0), m.ElementAt(1, 0), m.ElementAt(2, 0)).Norm();
		const auto matrix = m;
		c.frame = detail::FrameOf(detail::Transform(matrix, worldOrigin, 1), detail::TransformNormal(matrix, towards),
		                          random);
		c.frame.toWorld = matrix;
		world *= size;
	}
	if (random.chance(0.25)) {
		c.frame.perspective = true;
		c.frame.center = c.frame.origin + c.frame.w * (world * random.pick({4.0, 10.0, 100.0}));
	}
	c.outline = MakeOutline(random);
	const double size = part.room * world * 0.65 * random.pick({1.0, 0.5, 0.25, random.real(0.2, 1)});
	detail::Scale(c.outline, size);
	if (random.chance(0.7)) detail::Aim(c, size, random);
	c.height = part.depth * world * random.pick({0.0, 0.3, -0.3, 0.1, -0.1, random.real(-0.5, 0.5)});
	c.along = part.planar ? ExtrudeAlong(random.below(3)) : ExtrudeAlong(random.below(2));
	c.mustWork = detail::AreStrokesCarried(c);
	return c;
}

namespace detail {

/// A place and a frame anywhere on a mesh, good or not.
inline void PlaceAnywhere(LabelCase& c, const Part& part, double scale, Random& random)
{
	const auto& f = c.mesh.faces[size_t(random.below(int(c.mesh.faces.size())))];
	vcg::Point3d corner[3];
	for (size_t k = 0; k < 3; ++k) corner[k] = c.mesh.vertices[size_t(f[k])];
	const vcg::Point3d origin = random.chance(0.3) ? corner[0] : (corner[0] + corner[1] + corner[2]) / 3;
	vcg::Point3d normal = (corner[1] - corner[0]) ^ (corner[2] - corner[0]);
	const double length = normal.Norm();
	normal = length > 0 && std::isfinite(length) ? normal / length : random.direction();
	normal += random.direction() * random.pick({0.0, 0.0, 0.3, 0.9});
	if (!(normal.Norm() > 0.01)) normal = {0, 0, 1};
	const vcg::Matrix44d matrix = random.chance(0.3) ? RandomMatrix(random, false) : LabelFrame::Identity();
	const vcg::Point3d worldOrigin = IsFinite(origin) ? Transform(matrix, origin, 1) : vcg::Point3d(0, 0, 0);
	c.frame = FrameOf(worldOrigin, TransformNormal(matrix, normal), random);
	c.frame.toWorld = matrix;
	const double world = scale * std::cbrt(std::abs(matrix.Determinant()));
	if (random.chance(0.3)) {
		const double sideways = random.chance(0.3) ? random.real(-1, 1) : 0, distance = random.pick({0.5, 3.0, 100.0});
		c.frame.perspective = true;
		c.frame.center = c.frame.origin + c.frame.w * (world * distance) + c.frame.u * (world * sideways);
	}
	const double size = part.room * world * random.logReal(0.02, 1);
	c.outline = MakeOutline(random);
	Scale(c.outline, size);
	if (random.chance(0.8)) Aim(c, 2 * size, random);
	c.height = world * random.pick({0.0, 0.05, -0.05, 0.001, -0.001, random.real(-0.5, 0.5)});
}

}  // namespace detail

/// A good place on a mesh of slivers, snapped or spoiled: the outcome is a valid label or a refusal.
inline LabelCase MakeSpoiledLabel(Random& random)
{
	LabelCase c = MakeCleanLabel(random);
	c.family = "spoiled";
	c.mustWork = false;
	double size = 0;
	for (const vcg::Point3d& p : c.mesh.vertices) size = std::max(size, (p - c.mesh.vertices[0]).Norm());
	const double unit = size / 3;
	const vcg::Point3d shift = c.mesh.vertices[0];
	for (vcg::Point3d& p : c.mesh.vertices) p = (p - shift) / unit;
	detail::Spoil(c.mesh, random);
	for (vcg::Point3d& p : c.mesh.vertices) p = p * unit + shift;
	detail::Store(c);
	if (random.chance(0.7) && !c.mesh.faces.empty()) detail::Aim(c, size, random);
	if (random.chance(0.1)) c.maxStretch = random.pick({1.01, 2.0, 100.0, 1e6});
	return c;
}

/// Anything anywhere.
inline LabelCase MakeHostileLabel(Random& random)
{
	LabelCase c;
	c.family = "hostile";
	c.isFloat = random.chance(0.75);
	detail::Part part = detail::MakePart(random);
	if (random.chance(0.8)) detail::Spoil(part.mesh, random);
	const double scale = random.pick({1.0, 1.0, 1.0, 1e3, 1e-5, 1e6});
	const double away = random.pick({0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1e3, 1e5, 1e6});
	const vcg::Point3d offset = random.direction() * away;
	vcg::Matrix44d turn = LabelFrame::Identity();
	if (random.chance(0.3)) turn.SetRotateRad(random.real(0, 6), random.direction());
	c.mesh = part.mesh;
	for (vcg::Point3d& p : c.mesh.vertices) p = (detail::Transform(turn, p, 0) + offset) * scale;
	detail::Store(c);
	if (random.chance(0.02)) c.mesh.vertices[size_t(random.below(int(c.mesh.vertices.size())))][0] = std::nan("");
	if (c.mesh.faces.empty()) return c;
	detail::PlaceAnywhere(c, part, scale, random);
	c.along = ExtrudeAlong(random.below(3));
	if (random.chance(0.3)) c.maxStretch = random.pick({1.01, 2.0, 100.0, 1e6});
	return c;
}

inline LabelCase MakeLabelCase(Random& random)
{
	const double family = random.unit();
	return family < 0.5 ? MakeCleanLabel(random) : family < 0.8 ? MakeSpoiledLabel(random) : MakeHostileLabel(random);
}

}  // namespace vcg::textlabel::test
