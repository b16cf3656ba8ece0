#pragma once
// The font that ships with the build, so that a label can be cut where no font is installed.
//
// CMake makes the array from the file that its variable TEXTLABEL_FONT names (cmake/embed_font.cmake).

#include <cstddef>

namespace textlabel {

extern const unsigned char embeddedFont[];  ///< a whole font file
extern const std::size_t embeddedFontSize;  ///< its bytes

}  // namespace textlabel
