#pragma once
// Which font: what the user wrote, taken apart, and the bytes that it stands for.

#include <memory>
#include <string>
#include <vector>

namespace textlabel {

/// The value of a design axis of a variable font.
struct AxisSetting {
	std::string tag;  ///< four characters: "wght"
	double value = 0;
};

/// A font as asked for. Neither file nor family: the built-in font.
struct FontRequest {
	std::string text;  ///< as written
	std::string file, family;
	std::string style;  ///< "Bold Oblique", for a family
	int face = 0;       ///< for a file
	std::vector<AxisSetting> axes;
};

/// A font's bytes, and what of them to use.
struct FontSource {
	std::string name;                          ///< file, or family and style; empty = the built-in font
	std::shared_ptr<const std::string> bytes;  ///< null: those of the built-in font
	int face = 0;
	int instance = 0;  ///< named instance of a variable font, counted from 1; 0 = none
	std::vector<AxisSetting> axes;
};

/// Largest font file that is read, bytes.
constexpr std::size_t kLargestFont = std::size_t(1) << 28;

/// Take apart what TextOptions::font documents. What names an existing file, or holds a slash, is a file.
/// @throws TextError{BadAxis} for a setting that is not axis=number; TextError{BadFace} for a face that is no number; TextError{FontNotFound}
///         when it names nothing
FontRequest ParseFontRequest(const std::string& text);

/// Settings as "wght=650,opsz=32".
std::vector<AxisSetting> ParseAxes(const std::string& text);

/// @throws TextError{FontNotFound, NotAFont}
std::shared_ptr<const std::string> ReadFontFile(const std::string& file);

}  // namespace textlabel
