#pragma once
// The one error type of the library.
//
// The library speaks in codes and data (which face, which letter, where), never in sentences: the plugin turns a code into
// text with a remedy in one table (filter_textlabel/error_text.h). A wrong input is an Error; a bug of ours is an assert.

#include <exception>
#include <string>
#include <vcg/space/point3.h>

namespace vcg::textlabel {

enum class ErrorCode {
	// the request
	EmptyLabel,  ///< no contour at all: empty text, or only blanks
	BadContour,  ///< a contour that is not simple, not nested or not oriented as promised
	BadFrame,    ///< non-finite or degenerate frame: direction zero, up parallel to it, camera in the label plane
	BadHeight,   ///< not finite, larger than the part, or finer than the coordinates: `value`, `limit`
	// the mesh
	EmptyMesh,  ///< no vertex, no face (a point cloud), or no finite face
	TooLarge,   ///< `value` vertices or faces, `limit` can be numbered
	// the place
	OffSurface,   ///< a letter, or a piece of it, falls beside the surface
	FacesAway,    ///< the first surface seen there shows its back: normals turned round, or the camera inside
	Border,       ///< the label runs over an open border or a hole
	Silhouette,   ///< the label runs over the horizon of the part as seen from the viewpoint
	NonManifold,  ///< an edge of three or more faces, or two faces of opposite orientation, lies under the label
	Occluded,     ///< another surface hides a piece of the label from the viewer
	BehindCamera,  ///< the surface, or the label raised by `value`, reaches behind C; wrapped: to the axis or over the cut
	TooLong,       ///< wrapped, and longer than the way round the axis: `value` with its margins, `limit` the way
	Grazing,       ///< too steep to the view: `value` is the stretch, infinite from behind; `limit` the largest allowed
	Squeezed,  ///< wrapped, where the surface is nearer to the axis: `value` is the stretch, below 1; `limit` the least allowed
	// the result
	TooFine,  ///< finer than the coordinates carry: `value` the finest detail, 0: one with the mesh's own; `limit` needed
	HitsSurface,  ///< the raised or sunk label meets another part of the surface: `limit` is the depth that fits
	HitsItself,   ///< the extrusion folds or meets itself: `limit` is the depth that works
	Cancelled,    ///< the caller's progress function said stop
	OutOfMemory   ///< the mesh is as it was
};

/// What went wrong, where, and by how much.
struct Error : std::exception {
	ErrorCode code;
	int face = -1;    ///< index of a face of the mesh, or -1
	int letter = -1;  ///< index of the letter (Contour::letter), or -1
	bool hasPlace = false;
	vcg::Point3d place{0, 0, 0};  ///< in mesh coordinates, valid when hasPlace
	double value = 0;             ///< measured, see the code
	double limit = 0;             ///< allowed, see the code
	std::string message;          ///< detail for a developer; never needed to understand the code

	explicit Error(ErrorCode c, std::string m = {}) : code(c), message(std::move(m)) {}
	Error& atFace(int f)
	{
		face = f;
		return *this;
	}
	Error& atLetter(int l)
	{
		letter = l;
		return *this;
	}
	Error& atPlace(const vcg::Point3d& p)
	{
		place = p;
		hasPlace = true;
		return *this;
	}
	Error& measured(double v, double l)
	{
		value = v;
		limit = l;
		return *this;
	}
	const char* what() const noexcept override { return message.c_str(); }
};

}  // namespace vcg::textlabel
