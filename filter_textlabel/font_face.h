#pragma once
// A font that is open: FreeType draws its glyphs, HarfBuzz shapes with it.

#include <hb.h>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>
#include "font_source.h"
#include "outline_curve.h"
#include "text_error.h"

struct FT_LibraryRec_;
struct FT_FaceRec_;

namespace textlabel {

/// A FreeType of one's own: its objects must not be shared between threads.
std::shared_ptr<FT_LibraryRec_> OpenFontLibrary();

/// One face of a font at one place of its design axes. Lengths are in em.
class FontFace {
public:
	/// @throws TextError{NotAFont, BadFace, BadAxis, NoUnicodeMap, NoOutlines}
	FontFace(std::shared_ptr<FT_LibraryRec_> library, FontSource source);

	const std::string& name() const { return m_source.name; }         ///< for messages
	const std::string& description() const { return m_description; }  ///< "DejaVu Sans Bold (file, face 0, wght=650)"
	double capitalHeight() const { return m_capitalHeight; }
	double lineHeight() const { return m_lineHeight; }
	double spaceAdvance() const { return m_spaceAdvance; }
	hb_font_t* shaper() const { return m_shaper.get(); }
	double shaperUnits() const { return m_shaperUnits; }  ///< HarfBuzz's units for one em
	bool has(char32_t c) const;

	/// The outline of a glyph, by the non-zero rule; empty for a blank.
	/// @throws TextError{NotAFont} when FreeType cannot load it
	std::vector<CurveContour> glyph(unsigned index) const;

	/// Does the font show a glyph as a bitmap or as colour layers and not by an outline of its own?
	bool isPicture(unsigned index) const;
	/// Has the outline of a glyph a contour that is more than a point or a straight line there and back?
	bool hasInk(unsigned index) const;
	/// Has the glyph that stands for the character by itself?
	bool nominalHasInk(char32_t c) const;

private:
	using FacePointer = std::shared_ptr<FT_FaceRec_>;

	void open();
	void checkMap() const;
	void setAxes();
	void makeShaper();
	void measure();
	TextError failure(TextErrorCode code, std::string detail) const;

	FontSource m_source;
	std::shared_ptr<FT_LibraryRec_> m_library;  // outlives the face
	FacePointer m_face;
	std::unique_ptr<hb_font_t, void (*)(hb_font_t*)> m_shaper{nullptr, hb_font_destroy};
	std::string m_description;
	mutable std::unordered_map<unsigned, bool> m_hasInk;  ///< of the glyphs asked for
	double m_shaperUnits = 1, m_capitalHeight = 0, m_lineHeight = 0, m_spaceAdvance = 0;
};

}  // namespace textlabel
