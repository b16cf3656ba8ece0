#pragma once
// From the rings of single letters to the outline of the whole text.
//
// Fonts draw letters of overlapping, touching, doubled or self-crossing contours. Clipper unites them on an integer
// grid by the non-zero rule: each letter by itself first, since fonts differ in which way round they draw, then all
// together. They are thinned after that, so that no gap opens where they overlap. What is left too close to each other (a pinch, a gap or a neck below `finest`) is bridged by a bead
// (outline_bead.h).

#include <string>
#include <vector>
#include "outline_flatten.h"
#include "vcg_ext/contour.h"

namespace textlabel {

/// What one letter is made of.
struct LetterRings {
	int letter = 0;           ///< index of the letter
	std::vector<Ring> rings;  ///< any orientation, crossing or not; non-zero rule
	bool isJoined = false;    ///< hangs together with its neighbours: where thinning parts them, they are spoilt
};

struct UniteOptions {
	double tolerance =
		0;  ///< chord error that the rings were flattened with, > 0; also of the joins that embolden makes
	double embolden = 0;  ///< move the outline outwards by so much
};

/// What is narrower than this times the tolerance cannot be told from a touch: gaps are closed, necks widened to it,
/// specks left out.
constexpr double kFinest = 1.0 / 8;

struct United {
	vcg::textlabel::Outline outline;  ///< as TextOutline::outline promises
	std::vector<int> vanished;        ///< letters that had an area, of which nothing is left
	std::vector<int> broken;  ///< letters that thinning took apart, or that lost a piece; joined ones that it parted
};

/// Unite letters into one outline.
/// @throws TextError{BadTolerance} when the tolerance is too fine for the grid over so large a text: `limit` would do
/// @throws TextError{Unsound} when a letter crosses itself too often to be one
United UniteLetters(const std::vector<LetterRings>& letters, const UniteOptions& options);

}  // namespace textlabel
