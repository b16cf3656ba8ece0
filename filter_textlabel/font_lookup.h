#pragma once
// From a font's name to its file, by Fontconfig.

#include <optional>
#include <string>
#include "font_source.h"

namespace textlabel {

/// The bytes that a request stands for.
/// A family must be installed under that name, in that style: Fontconfig's substitutes are not taken. Only the generic
/// families (sans-serif, serif, monospace...) stand for whatever Fontconfig puts there.
/// @throws TextError{FontNotFound, FontSubstituted, NotAFont, BadAxis}
FontSource FindFont(const FontRequest& request);

/// An installed outline font that has all the characters, as close as Fontconfig can to what was asked for.
std::optional<FontSource> FindFallback(const std::u32string& characters, const FontRequest& request);

}  // namespace textlabel
