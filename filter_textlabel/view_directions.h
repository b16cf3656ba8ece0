#pragma once
// From where to look at a part: along the normals of its largest flat regions, and from all around; and which way is up there.

#include "placement_part.h"
#include "vcg_ext/place_table.h"

#include <algorithm>
#include <cstdint>

namespace textlabel {

struct FlatViewOptions {
	int cellsPerSide = 60;         ///< cells of the cube of directions; one is about 1.5 degrees wide
	double togetherDegrees = 1.5;  ///< normals this near make one direction
	double aroundDegrees = 4;      ///< normals this near may belong to a region that is flat enough
	double apartDegrees = 3;       ///< two directions differ by more than this
	double minShare = 0.002;       ///< of the part's area; less is no region to label
	size_t maxCount = 16;
};

struct UprightOptions {
	double levelDegrees = 15;   ///< nearer to horizontal than this, a face is read like a sheet on the table
	double binDegrees = 1;      ///< of the histogram of border directions
	double minShare = 0.25;     ///< of the border that must agree before it counts (a circle has 1/45)
	double uprightBonus = 0.8;  ///< the world's up wins when it has this share of the strongest direction
	double snapDegrees = 0.5;   ///< a border this near to the world's up is along it
};

namespace detail {

constexpr double degree = 3.14159265358979323846 / 180;

/// Cell of the unit cube's surface, cellsPerSide squared cells on each of the six sides, that a vector points to.
inline size_t DirectionCell(const vcg::Point3d& d, int cellsPerSide)
{
	int axis = 0;
	for (int i = 1; i < 3; ++i)
		if (std::abs(d[i]) > std::abs(d[axis])) axis = i;
	const double size = std::abs(d[axis]);
	const auto cell = [&](double t) {
		return std::min(cellsPerSide - 1, int((std::atan(t / size) / (90 * degree) + 0.5) * cellsPerSide));
	};
	const int side = 2 * axis + (d[axis] < 0 ? 1 : 0);
	const int row = cell(d[(axis + 1) % 3]), column = cell(d[(axis + 2) % 3]);
	return (size_t(side) * size_t(cellsPerSide) + size_t(row)) * size_t(cellsPerSide) + size_t(column);
}

/// Sums of area vectors by direction, largest first; empty cells left out.
inline std::vector<vcg::Point3d> AreaByDirection(const Part& part, int cellsPerSide)
{
	std::vector<vcg::Point3d> cells(6 * size_t(cellsPerSide) * size_t(cellsPerSide), vcg::Point3d(0, 0, 0));
	for (const vcg::Point3d& area : part.areas) cells[DirectionCell(area, cellsPerSide)] += area;
	cells.erase(
		std::remove_if(cells.begin(), cells.end(), [](const vcg::Point3d& a) { return !(a.SquaredNorm() > 0); }),
		cells.end());
	std::stable_sort(cells.begin(), cells.end(),
	                 [](const vcg::Point3d& a, const vcg::Point3d& b) { return a.SquaredNorm() > b.SquaredNorm(); });
	return cells;
}

inline bool AreNear(const vcg::Point3d& a, const vcg::Point3d& b, double cosine)
{
	return a * b >= cosine * a.Norm() * b.Norm();
}

/// One side of a triangle: the same key for the same two end points, whichever triangle it belongs to.
struct Side {
	std::uint64_t key;
	vcg::Point3d vector;
};

/// Borders of the flat regions that face a direction: sides that belong to one of its faces only.
inline std::vector<vcg::Point3d> BordersFacing(const Part& part, const vcg::Point3d& towards, double cosine)
{
	std::vector<Side> sides;
	for (size_t f = 0; f < part.faces.size(); ++f) {
		if (!AreNear(part.areas[f], towards, cosine)) continue;
		for (size_t i = 0; i < 3; ++i) {
			const vcg::Point3d& a = part.points[size_t(part.faces[f][i])];
			const vcg::Point3d& b = part.points[size_t(part.faces[f][(i + 1) % 3])];
			// by coordinates, not by index: a mesh need not be welded
			sides.push_back({vcg::textlabel::HashOfPlace(a) + vcg::textlabel::HashOfPlace(b), b - a});
		}
	}
	std::sort(sides.begin(), sides.end(),
	          [](const Side& a, const Side& b) { return a.key != b.key ? a.key < b.key : a.vector < b.vector; });
	std::vector<vcg::Point3d> borders;
	for (size_t i = 0, next = 0; i < sides.size(); i = next) {
		for (next = i + 1; next < sides.size() && sides[next].key == sides[i].key; ++next) {}
		if (next == i + 1) borders.push_back(sides[i].vector);
	}
	return borders;
}

/// Lengths of the borders by direction modulo a quarter turn, and where in each bin they lie.
struct BorderHistogram {
	std::vector<double> length, moment;  ///< moment: length times the angle from the middle of the bin, degrees
	double total = 0;

	size_t bin(long i) const { return size_t((i + long(length.size())) % long(length.size())); }
	/// Length in the bin and its two neighbours: a direction may lie between two bins.
	double around(long i) const { return length[bin(i - 1)] + length[bin(i)] + length[bin(i + 1)]; }
};

inline BorderHistogram CountBorders(const std::vector<vcg::Point3d>& borders, const ViewAxes& axes, double binDegrees)
{
	const size_t bins = size_t(std::lround(90 / binDegrees));
	BorderHistogram counted{std::vector<double>(bins, 0.0), std::vector<double>(bins, 0.0), 0};
	for (const vcg::Point3d& border : borders) {
		const double x = border * axes.right, y = border * axes.up, size = std::hypot(x, y);
		const double angle = std::remainder(std::atan2(y, x) / degree, 90.0);
		const long i = std::lround(angle / binDegrees);
		counted.length[counted.bin(i)] += size;
		counted.moment[counted.bin(i)] += size * (angle - double(i) * binDegrees);
		counted.total += size;
	}
	return counted;
}

/// Angle from the right axis to the border directions that agree most, between -45 and 45 degrees; 0 when few agree.
inline double AngleToBorders(const std::vector<vcg::Point3d>& borders, const ViewAxes& axes,
                             const UprightOptions& options)
{
	const BorderHistogram counted = CountBorders(borders, axes, options.binDegrees);
	const long half = long(counted.length.size()) / 2;
	long best = 0;
	for (long i = 1; i <= half; ++i)  // the nearest to upright first
		for (long turn : {i, -i})
			if (counted.around(turn) * (best == 0 ? options.uprightBonus : 1) > counted.around(best)) best = turn;
	if (!(counted.total > 0) || counted.around(best) < options.minShare * counted.total) return 0;
	for (long turn : {best - 1, best + 1})
		if (counted.length[counted.bin(turn)] > counted.length[counted.bin(best)]) best = turn;
	const double angle =
		double(best) * options.binDegrees + counted.moment[counted.bin(best)] / counted.length[counted.bin(best)];
	return std::abs(angle) <= options.snapDegrees ? 0 : angle * degree;
}

}  // namespace detail

/// A normal of flat regions, and the area of all faces that may belong to them.
struct FlatView {
	vcg::Point3d towards;
	double area;
};

/// Normals of the largest flat regions, largest first.
inline std::vector<FlatView> FlatViews(const Part& part, const FlatViewOptions& options = {})
{
	const std::vector<vcg::Point3d> cells = detail::AreaByDirection(part, options.cellsPerSide);
	double total = 0;
	for (const vcg::Point3d& area : part.areas) total += area.Norm();
	const double together = std::cos(options.togetherDegrees * detail::degree);
	const double around = std::cos(options.aroundDegrees * detail::degree);
	const double apart = std::cos(options.apartDegrees * detail::degree);
	std::vector<FlatView> views;
	for (const vcg::Point3d& cell : cells) {
		if (views.size() == options.maxCount || cell.Norm() < options.minShare * total) break;
		const auto isKnown = [&](const FlatView& known) { return detail::AreNear(known.towards, cell, apart); };
		if (std::any_of(views.begin(), views.end(), isKnown)) continue;
		FlatView view{vcg::Point3d(0, 0, 0), 0};
		for (const vcg::Point3d& other : cells) {
			if (detail::AreNear(other, cell, together)) view.towards += other;
			if (detail::AreNear(other, cell, around)) view.area += other.Norm();
		}
		view.towards.Normalize();
		views.push_back(view);
	}
	return views;
}

/// From all around: the sides, edges and corners of a cube (26).
inline std::vector<vcg::Point3d> RoundDirections()
{
	std::vector<vcg::Point3d> directions;
	for (int corner = 1; corner <= 3; ++corner)  // number of axes that take part: sides first
		for (int x = -1; x <= 1; ++x)
			for (int y = -1; y <= 1; ++y)
				for (int z = -1; z <= 1; ++z)
					if (std::abs(x) + std::abs(y) + std::abs(z) == corner)
						directions.push_back(vcg::Point3d(x, y, z) / std::sqrt(double(corner)));
	return directions;
}

/// Axes in which a text on a face that looks `towards` reads upright: Z is up, on faces that lie level Y is.
/// @param[in] wanted  up by wish of the caller, or zero; ignored where it is parallel to towards
inline ViewAxes UprightAxes(const vcg::Point3d& towards, const vcg::Point3d& wanted, const UprightOptions& options = {})
{
	const double level = std::sin(options.levelDegrees * detail::degree);
	if ((wanted ^ towards).Norm() > level * wanted.Norm()) return AxesFrom(towards, wanted);
	const vcg::Point3d z(0, 0, 1);
	return AxesFrom(towards, (z ^ towards).Norm() > level ? z : vcg::Point3d(0, 1, 0));
}

/// The same, turned in the plane by at most 45 degrees so that the text runs along the borders of the flat regions there.
inline ViewAxes AlignedAxes(const Part& part, const ViewAxes& upright, double cosine,
                            const UprightOptions& options = {})
{
	const std::vector<vcg::Point3d> borders = detail::BordersFacing(part, upright.towards, cosine);
	const double angle = detail::AngleToBorders(borders, upright, options);
	if (angle == 0) return upright;
	return AxesFrom(upright.towards, upright.up * std::cos(angle) - upright.right * std::sin(angle));
}

}  // namespace textlabel
