#pragma once
// Automatic placement: where would a person put the label?
//
// The part is looked at from the normals of its largest flat regions (and, when none of them holds the text, from all
// around). Each look is a small depth image, so what is hidden from that side never counts; the largest window of the
// text's shape in which the image is flat, without steps and holes, is a place. Each place is then measured once more on
// the triangles themselves.
// Source: Slabaugh et al., section 5 (future work): "automatically positions the label on the surface".

#include <array>
#include <cstdint>
#include <functional>
#include <vector>
#include <vcg/space/point3.h>

namespace textlabel {

/// The part and the text to be placed on it. All lengths are in mesh units; the query only refers to the mesh.
struct PlaceQuery {
	const std::vector<vcg::Point3d>& positions;        ///< #V by 3; vertices that are not finite are skipped
	const std::vector<std::array<int, 3>>& triangles;  ///< #F by 3, counter-clockwise seen from outside
	double labelWidth = 0;                             ///< of the text's bounding box at capital height 1
	double labelHeight = 0;
	double size = -1;                       ///< wanted capital height, or -1: choose one that fits
	double depth = 0;                       ///< signed: > 0 raised, < 0 sunk (needs a wall of that thickness)
	vcg::Point3d up{0, 0, 0};               ///< wanted up of the text, or zero: choose
	std::vector<std::uint32_t> paint = {};  ///< #F: colours whose borders the text should not run across; or empty
};

/// Where the centre of the text's bounding box goes, and what the label will find there.
struct Place {
	vcg::Point3d position;   ///< on the surface
	vcg::Point3d direction;  ///< unit, towards the viewer; the label is projected in parallel against it
	vcg::Point3d up;         ///< unit, perpendicular to direction; the text reads along up x direction
	double size = 0;         ///< capital height to use: the wanted one, or the chosen one
	bool flat = false;       ///< the surface under the text is a plane
	double stretch = 1;      ///< largest surface length over label length under the text; 1 on a plane
	double wall = 0;         ///< thickness behind the text along -direction; infinite when nothing is there
};

/// Offer places for a text one by one, best first, until `accept` takes one (the library may refuse a place for reasons that
/// an image does not show). Flat places come before curved ones, and those with a wall thick enough for query.depth first; places
/// across the border of two colours come last.
/// @return true when one was accepted; false without any offer when the mesh has no finite triangle, the label no extent,
///         or the wanted size fits nowhere
/// @post every place faces the viewer, is the first surface seen there, and has no step, hole or silhouette under the text
/// Deterministic; time linear in the number of triangles, and none is spent on places that nobody asks for.
bool OfferPlaces(const PlaceQuery& query, const std::function<bool(const Place&)>& accept);

}  // namespace textlabel
