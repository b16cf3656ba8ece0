#pragma once
// Layout: where each glyph of the shaped lines goes.

#include <vector>
#include <vcg/space/box2.h>
#include "outline_curve.h"
#include "text_outline.h"
#include "text_shape.h"

namespace textlabel {

/// A glyph with its rigid place in the label plane, for letters that have their form (FormOf).
struct PlacedGlyph {
	int font = 0;
	unsigned glyph = 0;
	int letter = 0;
	bool isJoined = false;  ///< of a script whose letters hang together
	Affine place;           ///< a turn and a shift
};

/// All that Layout needs to know of TextOptions; lengths in the label's units.
struct LayoutOptions {
	double em = 1;  ///< size of the em square
	Align align = Align::Center;
	double lineSpacing = 1;    ///< times the main font's line height
	double letterSpacing = 0;  ///< added to each advance
	double slant = 0;          ///< radians
	double arcRadius = 0;      ///< 0 = straight
};

/// The map from the em square to an upright letter at the origin: size and slant, the same for all letters.
Affine FormOf(const LayoutOptions& options);

/// Set the lines: the first baseline on v = 0, u = 0 at the left end, the middle or the right end of each line. On an
/// arc, the point of it that is on top (or, hanging, at the bottom) is at (0, 0).
/// @throws TextError{BadArc}
std::vector<PlacedGlyph> Layout(const std::vector<ShapedLine>& lines, const FontStack& fonts,
                                const LayoutOptions& options);

/// What of a box of ink comes to (0, 0).
vcg::Point2d AnchorOf(const vcg::Box2d& ink, Align align, Anchor anchor);

/// The letters of the lines: clusters of characters that are shaped as one, in the order of the text, as UTF-8.
std::vector<std::string> LettersOf(const std::vector<ShapedLine>& lines);

}  // namespace textlabel
