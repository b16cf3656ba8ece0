#pragma once
// A machine-readable code as an outline: its dark modules, united.
//
// Modules that meet in a corner only are joined by a bridge far thinner than a module (outline_bead.h), as the surface has to be one.

#include "text_outline.h"

namespace textlabel {

/// Set a text as options.code, without its widths and box.
/// @throws TextError{BadCode, BadSize, BadEmbolden}, and those of the text
TextOutline SetAsCode(const std::string& utf8, const TextOptions& options);

}  // namespace textlabel
