#pragma once
// From a font's name to its file, by Fontconfig.

#include <functional>
#include <string>
#include "font_source.h"

namespace textlabel {

/// The bytes that a request stands for.
/// A family must be installed under that name, in that style: Fontconfig's substitutes are not taken. Only the generic
/// families (sans-serif, serif, monospace...) stand for whatever Fontconfig puts there.
/// @throws TextError{FontNotFound, FontSubstituted, NotAFont, BadAxis}
FontSource FindFont(const FontRequest& request);

/// Look for an installed outline font that has all the characters, as close as Fontconfig can to what was asked for.
/// @param[in] take  given one font after the other, the closest first, until it returns true. Those that cannot be read,
///                  for which it throws a TextError, are passed over.
/// @return was one taken?
bool FindFallback(const std::u32string& characters, const FontRequest& request,
                  const std::function<bool(FontSource)>& take);

}  // namespace textlabel
