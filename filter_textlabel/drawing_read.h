#pragma once
// From an SVG file to the shapes that it paints.
//
// Read are paths, basic shapes, groups, nested drawings, use, symbol, switch, clip paths and all that gives them a style
// (drawing_style.h). What cannot be cut as it looks, text, pictures, masks, dashes and markers, is refused, not left out in silence; so is what
// would be elsewhere without it, as the origin of a transformation. What is not painted, drawing programs keep for themselves, or has no
// sharp border, as a shadow, is passed over.

#include <string>
#include "drawing_shape.h"

namespace textlabel {

/// Largest drawing that is read, bytes.
constexpr std::size_t kLargestDrawing = std::size_t(1) << 24;

/// Read an SVG document.
/// @return finite shapes; none when it paints nothing
/// @throws TextError{DrawingUnreadable, DrawingUnsupported}, without the file's name
Drawing ReadSvg(const std::string& bytes);

/// Read an SVG file.
/// @throws TextError{DrawingUnreadable, DrawingUnsupported}
Drawing ReadDrawing(const std::string& file);

}  // namespace textlabel
