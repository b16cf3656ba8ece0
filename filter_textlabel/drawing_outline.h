#pragma once
// A drawing as an outline: what it paints, flattened and united.
//
// Shapes are painted one over the other, as in a picture: ink adds to what is there, white takes away from it. A drawing in white alone
// is meant for a dark ground: its white is the ink.

#include "text_outline.h"

namespace textlabel {

/// Default height of a drawing / tolerance: its details are finer than those of a letter.
constexpr double kDrawingTolerance = 4000;

/// Cut options.drawing, without its widths and box.
/// @throws TextError{DrawingUnreadable, DrawingUnsupported, DrawingEmpty, DrawingAndCode, BadSize, BadEmbolden, BadTolerance,
///         LetterVanished, LetterBroken, Unsound}
TextOutline SetAsDrawing(const TextOptions& options);

}  // namespace textlabel
