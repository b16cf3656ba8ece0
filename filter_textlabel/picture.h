#pragma once
// Pictures of a labelled part, made in memory: no OpenGL, no window, no display.
//
// A small software renderer for `--picture` and for the README: depth buffer with supersampling, normals smoothed up to a crease
// angle, a key light that casts shadows, fill light, ambient occlusion and drawn crease lines. The same input gives the same
// bytes on every run. Only writing knows Qt (QImage, which needs no application object).

#include <array>
#include <cstdint>
#include <string>
#include <vector>
#include <vcg/space/point3.h>

namespace textlabel {

using PictureColor = std::array<std::uint8_t, 3>;  ///< sRGB

/// What is shown: a triangle mesh, equal points need not be merged. Faces with a non-finite corner are left out.
struct PictureMesh {
	std::vector<vcg::Point3d> positions;        ///< #V by 3, mesh units
	std::vector<std::array<int, 3>> triangles;  ///< #F by 3, indices of positions, counter-clockwise from outside
	std::vector<PictureColor> colors;           ///< #F, or empty: then the options colour part and label
	std::vector<std::uint8_t> isLabel;          ///< #F, 1 = face of the label, or empty
};

/// Where it is seen from.
struct PictureView {
	vcg::Point3d direction{0, 0, 1};  ///< towards the viewer, any length
	vcg::Point3d up{0, 1, 0};         ///< upwards in the picture, not parallel to direction
	vcg::Point3d focus{0, 0, 0};      ///< the point in the picture's centre, mesh units
	double extent = 1;                ///< what the picture's height shows at the focus, mesh units
	double distance = 0;              ///< from the camera to the focus, mesh units; 0 = parallel projection
};

/// Which edges of the mesh are drawn as lines.
enum class PictureEdges { None, Creases, All };

struct PictureOptions {
	int width = 1600;  ///< pixels
	int height = 900;  ///< pixels
	int samples = 3;   ///< supersampling: samples by samples points in each pixel
	PictureEdges edges = PictureEdges::Creases;
	bool shaded = true;       ///< false: plain colours without light, for tests and masks
	bool shadows = true;      ///< the key light casts shadows
	double creaseAngle = 32;  ///< degrees; faces that meet at less are shaded as one smooth surface
	double margin = 0.06;     ///< free border around what FitView fits, in picture heights
	PictureColor part{176, 188, 200};
	PictureColor label{240, 108, 32};
	PictureColor backgroundTop{252, 252, 253};
	PictureColor backgroundBottom{214, 220, 227};
};

/// Pixels, row by row from the top left, three bytes (red, green, blue) each.
struct Picture {
	int width = 0;
	int height = 0;
	std::vector<std::uint8_t> rgb;  ///< width * height * 3 bytes
	PictureColor at(int x, int y) const;
};

/// Draw the mesh as seen from the view.
/// @pre  view: direction and up finite and not parallel, extent > 0; options: width, height, samples > 0
/// @throws std::invalid_argument when the precondition or the sizes of the mesh's arrays are wrong
Picture RenderPicture(const PictureMesh& mesh, const PictureView& view, const PictureOptions& options = {});

/// The view from the given direction that shows the whole mesh, or only its label faces, as large as the picture allows.
/// @param[in] onlyLabel  fit the label's faces; the whole mesh when it has none
PictureView FitView(const PictureMesh& mesh, const vcg::Point3d& direction, const vcg::Point3d& up,
                    const PictureOptions& options = {}, bool onlyLabel = false);

/// The default picture: the whole part from a three-quarter view in which the label is upright and unhidden, beside two close-ups
/// of the label, shaded and with its triangles. Without label faces the whole part alone.
/// @param[in] direction  towards the viewer of the label, mesh coordinates
/// @param[in] up         upwards in the label
Picture RenderLabelPicture(const PictureMesh& mesh, const vcg::Point3d& direction, const vcg::Point3d& up,
                           const PictureOptions& options = {});

/// Write a PNG (or what the file name's ending says, as far as Qt knows it). The file appears as a whole or not at all.
/// @return false when the file cannot be written
bool WritePicture(const Picture& picture, const std::string& path);

/// The format that a file name's ending says, or "" when that is none.
std::string PictureFormat(const std::string& path);

}  // namespace textlabel
