#include "auto_placement.h"

#include "place_candidates.h"
#include <tuple>

namespace textlabel {
namespace {

using vcg::Point3d;

constexpr double closeLookPixels = 160;   // along the longer side of a text that is measured
constexpr double closeSlackDegrees = 10;  // a close look at a curved place may be that much steeper than the first
constexpr double flatRelief = 0.01;       // of the capital height: a flatter surface counts as a plane
constexpr double axisSnap = 1e-4;         // a direction this near to an axis (radians) is along it
constexpr double wallReserve = 1.25;      // a sunk label asks for so many times its depth of wall
constexpr size_t maxPlaces = 8;
constexpr size_t maxMeasured = 24;
constexpr size_t maxSharpened = 64;  // a look at all triangles each

/// Two digits are what a person would have typed.
double RoundedDown(double size)
{
	const double unit = std::pow(10.0, std::floor(std::log10(size)) - 1);
	return std::floor(size / unit) * unit;
}

double SizeIn(const PlaceQuery& query, const Part& part, const Candidate& candidate)
{
	if (query.size > 0) return query.size;
	return RoundedDown(std::min(candidate.capital, taste.maxCapitalShare * part.diagonal));
}

/// A close look at the text's box around a point, with the tight margin.
DepthImage CloseLook(const PlaceQuery& query, const Part& part, const ViewAxes& axes, const Point3d& at, double size)
{
	const Shape shape = detail::TightShape(query);
	PixelGrid grid;
	grid.pixel = size * std::max(shape.width, shape.height) / closeLookPixels;
	grid.width = 2 * detail::Reach(size * shape.width / grid.pixel) + 1;
	grid.height = 2 * detail::Reach(size * shape.height / grid.pixel) + 1;
	grid.left = at * axes.right - grid.pixel * (grid.width / 2);
	grid.bottom = at * axes.up - grid.pixel * (grid.height / 2);
	return Look(part, axes, grid);
}

/// The point that is seen in the middle, from the part's centre.
Point3d MiddlePoint(const DepthImage& image, const Point3d& under)
{
	const double depth = image.depth[image.grid.at(image.grid.width / 2, image.grid.height / 2)];
	return under + image.axes.towards * (depth - under * image.axes.towards);
}

/// Mean normal of what is seen: of whole faces when flat (needles count little), of pixels when curved.
Point3d MeanNormal(const Part& part, const DepthImage& image, bool flat)
{
	std::vector<int> faces = image.face;
	std::sort(faces.begin(), faces.end());
	if (flat) faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
	Point3d sum(0, 0, 0);
	for (int f : faces) {
		if (f < 0) continue;
		const Point3d& area = part.areas[size_t(f)];
		sum += flat ? area : area / area.Norm();
	}
	return sum;
}

Point3d SnappedToAxis(const Point3d& direction)
{
	for (int i = 0; i < 3; ++i) {
		Point3d axis(0, 0, 0);
		axis[i] = direction[i] < 0 ? -1 : 1;
		if ((direction - axis).Norm() <= axisSnap) return axis;
	}
	return direction;
}

/// Axes along a normal; a normal or an up that is an axis but for rounding becomes that axis, to the last bit.
ViewAxes CleanAxes(const Point3d& normal, const Point3d& up)
{
	const ViewAxes axes = AxesFrom(SnappedToAxis(normal / normal.Norm()), up);
	const Point3d cleanUp = SnappedToAxis(axes.up);
	return cleanUp * axes.towards == 0 ? ViewAxes{cleanUp ^ axes.towards, cleanUp, axes.towards} : axes;
}

bool IsAllFree(const FreeArea& area) { return area.isWindowFree(0, 0, area.width() - 1, area.height() - 1); }

double LargestStretch(const Part& part, const DepthImage& image)
{
	double largest = 1;
	for (int f : image.face) {
		const Point3d& area = part.areas[size_t(f)];
		largest = std::max(largest, area.Norm() / (area * image.axes.towards));
	}
	return largest;
}

double Relief(const DepthImage& image)
{
	const auto range = std::minmax_element(image.depth.begin(), image.depth.end());
	return *range.second - *range.first;
}

/// Look at a candidate from its own normal and at its own scale; nothing when the surface is not as smooth as it seemed.
std::optional<Place> Measure(const PlaceQuery& query, const Part& part, const Candidate& candidate)
{
	Place place;
	place.size = SizeIn(query, part, candidate);
	const Point3d under = candidate.axes.right * candidate.right + candidate.axes.up * candidate.up;
	const DepthImage first = CloseLook(query, part, candidate.axes, under, place.size);
	const Point3d normal = MeanNormal(part, first, candidate.level.flat);
	const Point3d at = MiddlePoint(first, under);
	if (!IsFinite(at) || !(normal * candidate.axes.towards > 0)) return std::nullopt;
	const DepthImage image = CloseLook(query, part, CleanAxes(normal, candidate.axes.up), at, place.size);
	const double slack = candidate.level.flat ? 0 : closeSlackDegrees;
	if (!IsAllFree(FindFreeArea(part, image, detail::RuleFor(candidate.level, slack)))) return std::nullopt;
	place.position = MiddlePoint(image, at) + part.center;
	place.direction = image.axes.towards;
	place.up = image.axes.up;
	place.flat = Relief(image) <= flatRelief * place.size;
	place.stretch = place.flat ? 1 : LargestStretch(part, image);
	place.wall = ThinnestWall(part, image, sameSurface * part.diagonal);
	return place;
}

/// Does the middle of the candidate lie under the text of a place that we have?
bool IsTaken(const std::vector<Place>& places, const PlaceQuery& query, const Part& part, const Candidate& candidate)
{
	return std::any_of(places.begin(), places.end(), [&](const Place& place) {
		const Point3d at = place.position - part.center;
		const double right = std::abs(at * candidate.axes.right - candidate.right);
		const double up = std::abs(at * candidate.axes.up - candidate.up);
		return place.direction * candidate.axes.towards > 0.5 && right < place.size * query.labelWidth / 2 &&
		       up < place.size * query.labelHeight / 2;
	});
}

bool IsQueryUsable(const PlaceQuery& query)
{
	const bool hasExtent = query.labelWidth > 0 && query.labelHeight > 0;
	return hasExtent && std::isfinite(query.labelWidth) && std::isfinite(query.labelHeight) &&
	       !std::isnan(query.depth) && std::isfinite(query.size) && IsFinite(query.up);
}

/// Take the best candidate out: good ones first, then by score, then in the order of the search.
Candidate TakeBest(std::vector<Candidate>& candidates, const PlaceQuery& query, const Part& part)
{
	const auto rank = [&](const Candidate& c) { return std::make_tuple(IsGood(query, part, c), c.score()); };
	const auto best = std::max_element(candidates.begin(), candidates.end(),
	                                   [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); });
	const Candidate taken = *best;
	candidates.erase(best);
	return taken;
}

/// Offer the places that one search finds, best first, until one is accepted; those with a thin wall come last.
/// @param[in,out] places  those that were offered before; the new ones are added
bool OfferPlaces(const PlaceQuery& query, const Part& part, const Effort& effort,
                 const std::function<bool(const Place&)>& accept, std::vector<Place>& places)
{
	std::vector<Candidate> candidates = FindCandidates(query, part, effort);
	std::vector<Place> thin;
	for (size_t sharpened = 0, measured = 0, offered = 0;
	     !candidates.empty() && sharpened < maxSharpened && measured < maxMeasured && offered < maxPlaces;) {
		const Candidate candidate = TakeBest(candidates, query, part);
		if (IsTaken(places, query, part, candidate) || IsTaken(thin, query, part, candidate)) continue;
		if (!candidate.sharp) {
			++sharpened;
			if (const std::optional<Candidate> sharp = Sharpened(query, part, candidate)) candidates.push_back(*sharp);
			continue;
		}
		++measured;
		const std::optional<Place> place = Measure(query, part, candidate);
		if (!place) continue;
		++offered;
		const bool isThick = query.depth >= 0 || place->wall >= -query.depth * wallReserve;
		(isThick ? places : thin).push_back(*place);
		if (isThick && accept(*place)) return true;
	}
	places.insert(places.end(), thin.begin(), thin.end());
	return std::any_of(thin.begin(), thin.end(), accept);
}

}  // namespace

bool OfferPlaces(const PlaceQuery& query, const std::function<bool(const Place&)>& accept)
{
	Part part = MakePart(query.positions, query.triangles, query.paint);
	if (!IsQueryUsable(query) || part.faces.empty()) return false;
	std::vector<Place> places;
	const auto offer = [&] {
		return OfferPlaces(query, part, quickEffort, accept, places) ||
		       OfferPlaces(query, part, ThoroughEffort(query, part), accept, places);
	};
	if (offer()) return true;
	if (part.paint.empty()) return false;
	part.paint.clear();
	places.clear();
	return offer();
}

}  // namespace textlabel
