#pragma once
// MeshLab's camera as text: what "Copy camera settings to clipboard" gives, read and written.
//
// The text is an XML document with an element
//   <VCGCamera TranslationVector="x y z 1" RotationMatrix="16 numbers, by rows" FocalMm="..." ViewportPx="..." .../>
// where TranslationVector is minus the viewpoint and the rows of the matrix are the camera's axes in world coordinates:
// right, up, and backwards (from the scene towards the viewer). CameraType 0 is perspective, every other parallel.
// Source: VCGlib, wrap/qt/shot_qt.h and vcg/math/shot.h.

#include <array>
#include <string>
#include <vcg/space/point3.h>

namespace textlabel {

/// A view of the scene; world coordinates.
struct Camera {
	vcg::Point3d viewpoint{0, 0, 0};
	vcg::Point3d right{1, 0, 0};      ///< unit
	vcg::Point3d up{0, 1, 0};         ///< unit
	vcg::Point3d backwards{0, 0, 1};  ///< unit, right x up: from the scene towards the viewer
	bool perspective = true;
	double focalMm = 1;  ///< for writing only, like all that follows: these may be missing
	std::array<double, 2> pixelSizeMm{1, 1};
	std::array<int, 2> viewportPx{1, 1};
	std::array<double, 2> centerPx{0, 0};
};

/// Read a camera. Accepts the document as copied, or any XML that holds a VCGCamera element (a project, a view file), with
/// plain or binary (base64) numbers.
/// @throws RequestError{CameraNotXml, CameraMissing, CameraIncomplete, CameraNotRotation}
/// @post right, up and backwards are orthonormal to double precision
Camera ReadCamera(const std::string& xml);

/// The document that MeshLab's "Paste shot" takes; numbers are exact.
std::string WriteCamera(const Camera& camera);

/// Axes made orthonormal and right-handed, keeping backwards.
/// @throws RequestError{CameraNotRotation} when they are not finite, or further from that than six-digit numbers may be
void Orthonormalize(Camera& camera);

}  // namespace textlabel
