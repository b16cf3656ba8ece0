#pragma once
// Random labels round an axis, for the fuzzer: on parts that are turned about it, good ones, which must work, and spoiled ones; and
// with an axis anywhere on the meshes of random_label.h. The outcome of the latter two is a valid label or a refusal.

#include "random_label.h"

namespace vcg::textlabel::test {

namespace detail {

/// Turned about the z axis.
struct TurnedPart {
	Soup mesh;
	double radius = 0, high = 0;  ///< where a label may go: on this cylinder, up to this height and down as far
	int around = 0;               ///< facets
};

inline TurnedPart MakeTurnedPart(Random& random)
{
	const auto kind = Diagonals(random.below(4));
	TurnedPart t;
	t.around = random.integer(3, 64);
	const int rows = random.integer(1, 8);
	switch (random.below(4)) {
	case 0:
		t.mesh = MakeSphere(t.around, 2 * rows + 4, kind, random);
		t.radius = 1;
		t.high = 0.5;
		break;
	case 1:  // its hole, from within: a label there is read from the axis
		t.mesh = MakeTorus(t.around, 4 * random.integer(1, 6), 0.4, kind, random);
		t.radius = -0.6;
		t.high = 0.15;
		break;
	case 2: {
		const double taper = random.real(0, 0.6);
		t.mesh = MakeLathe(t.around, rows + 2, kind, random, [=](int r) {
			const double z = std::clamp(r - 1, 0, rows) / double(rows) - 0.5;
			return vcg::Point2d(1 - taper * z, 2 * z);
		});
		t.radius = 1;
		t.high = 0.8;
		break;
	}
	default:
		t.mesh = MakeCylinder(t.around, rows, 1, 2, random);
		t.radius = 1;
		t.high = 0.8;
	}
	return t;
}

/// A label of any length that there is room for, read round the axis or, now and then, along it or aslant.
inline LabelCase MakeLabelOnTurnedPart(Random& random)
{
	LabelCase c;
	c.family = "wrapped";
	c.isFloat = random.chance(0.75);
	const TurnedPart part = MakeTurnedPart(random);
	c.mesh = part.mesh;
	const bool isSpoiled = random.chance(0.4);
	if (isSpoiled) Spoil(c.mesh, random);
	if (c.mesh.faces.empty()) return c;
	vcg::Matrix44d turn = LabelFrame::Identity();
	if (random.chance(0.4)) turn.SetRotateRad(random.real(0, 6), random.direction());
	const double scale = random.pick({1.0, 1.0, 10.0, 1e3, 1e-3}), angle = random.real(0, 2 * M_PI),
				 distance = std::abs(part.radius);
	const vcg::Point3d offset =
		random.chance(0.7) ? vcg::Point3d(0, 0, 0) : random.direction() * random.pick({1.0, 10.0});
	const auto place = [&](const vcg::Point3d& p, double w) { return (Transform(turn, p, 0) + offset * w) * scale; };
	for (vcg::Point3d& p : c.mesh.vertices) p = place(p, 1);
	Store(c);

	const vcg::Point3d radial(std::cos(angle), std::sin(angle), 0), axis(0, 0, 1),
		towards = part.radius > 0 ? radial : -radial;
	const vcg::Point3d up = random.chance(0.7)   ? axis * random.pick({1.0, -1.0})
	                        : random.chance(0.5) ? axis ^ radial
	                                             : axis + (axis ^ radial) * random.real(-2, 2);
	c.frame = FrameFromDirection(place(radial * distance, 1), Transform(turn, towards, 0), Transform(turn, up, 0));
	c.frame.wrapAxis = Transform(turn, axis, 0);
	c.frame.wrapRadius = part.radius * scale * (random.chance(0.8) ? 1 : random.pick({0.5, 0.9, 1.1, 2.0, 10.0}));
	const bool isTrue = c.frame.wrapRadius == part.radius * scale,
			   isRound = std::abs(c.frame.v * c.frame.wrapAxis) > 0.999;

	c.outline = MakeOutline(random);
	const double height = part.high * random.pick({0.9, 0.5, 0.2}), room = 2 * M_PI * distance,
				 length = random.chance(0.5) ? height : std::min(0.45 * room, height * random.real(1, 8));
	for (Contour& contour : c.outline.contours)
		for (vcg::Point2d& p : contour.points) p = vcg::Point2d(p[0] * length, p[1] * height) * scale;
	if (random.chance(0.3)) {  // anchored elsewhere
		const double shift = random.real(-1, 1) * length * scale;
		for (Contour& contour : c.outline.contours)
			for (vcg::Point2d& p : contour.points) p[0] += shift;
	}
	if (random.chance(0.7)) Aim(c, height * scale, random);
	c.height = scale * random.pick({0.0, 0.05, -0.05, 0.02, -0.02, random.real(-0.3, 0.3)});
	c.along = ExtrudeAlong(random.below(3));
	// three facets: the one over the cut, and half of one at each end
	const bool fits = 2 * length < room * (1 - 3.0 / part.around) && std::abs(c.height) <= 0.05 * scale;
	c.mustWork = !isSpoiled && isTrue && isRound && fits && part.around >= 12 &&
	             c.along != ExtrudeAlong::SurfaceNormal && AreStrokesCarried(c);
	return c;
}

}  // namespace detail

/// Round an axis.
inline LabelCase MakeWrappedLabel(Random& random)
{
	if (random.chance(0.6)) return detail::MakeLabelOnTurnedPart(random);
	LabelCase c = random.chance(0.5) ? MakeSpoiledLabel(random) : MakeHostileLabel(random);
	c.family = "wrapped";
	c.frame.perspective = false;
	const double turn = random.pick({0.0, 0.0, M_PI / 2, random.real(0, 6)});
	c.frame.wrapAxis = c.frame.v * std::cos(turn) + c.frame.u * std::sin(turn);
	double size = 0;
	for (const Contour& contour : c.outline.contours)
		for (const vcg::Point2d& p : contour.points) size = std::max(size, p.Norm());
	c.frame.wrapRadius = size * random.logReal(0.2, 100) * random.pick({1.0, 1.0, -1.0});
	return c;
}

}  // namespace vcg::textlabel::test
