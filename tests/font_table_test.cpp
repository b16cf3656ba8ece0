// Every glyph of a dozen font families: is its outline sound at the default tolerance, and, finely flattened, of the
// area that FreeType's rasteriser fills? Prints a table. A sample of the glyphs by default; all of them (5,000 of the
// 65,535 of Noto CJK) when TEXTLABEL_ALL_GLYPHS is set.

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <iomanip>
#include <iostream>
#include <memory>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_MULTIPLE_MASTERS_H
#include "font_face.h"
#include "font_lookup.h"
#include "outline_flatten.h"
#include "outline_unite.h"
#include "text_outline.h"
#include "text_support.h"

using namespace textlabel;

namespace {

constexpr double kFineTolerance = 2e-5;  ///< em, for the area
constexpr double kAreaSlack = 0.005;     ///< relative
constexpr unsigned kMostGlyphs = 20000;
constexpr unsigned kSampleOfCollection = 5000;
#if defined(__SANITIZE_ADDRESS__)
constexpr unsigned kSample = 30;
#else
constexpr unsigned kSample = 250;
#endif

const char* const kFonts[] = {"DejaVu Sans",
                              "DejaVu Serif:Bold",
                              "Liberation Sans",
                              "Liberation Serif:Italic",
                              "Liberation Mono",
                              "Inter",
                              "Inter:wght=650",
                              "Inter:wght=900",
                              "Amiri",
                              "Noto Naskh Arabic",
                              "Noto Sans Devanagari",
                              "Noto Sans Thai",
                              "Noto Sans CJK JP",
                              "Roboto",
                              "osifont",
                              "Routed Gothic",
                              "DSEG7 Classic",
                              "DSEG14 Classic"};

/// A second, independent way from the font to an area: FreeType's own rasteriser.
class Rasteriser {
public:
	explicit Rasteriser(const FontSource& source) : m_library(OpenFontLibrary())
	{
		const auto* bytes = reinterpret_cast<const FT_Byte*>(source.bytes->data());
		FT_New_Memory_Face(m_library.get(), bytes, static_cast<FT_Long>(source.bytes->size()), source.face, &m_face);
		if (source.axes.empty()) return;
		FT_Fixed weight = std::lround(source.axes[0].value * 65536);  // Inter's one axis
		FT_Set_Var_Design_Coordinates(m_face, 1, &weight);
	}
	~Rasteriser() { FT_Done_Face(m_face); }
	Rasteriser(const Rasteriser&) = delete;
	Rasteriser& operator=(const Rasteriser&) = delete;

	/// em²
	double area(unsigned glyph, unsigned pixelsPerEm) const
	{
		FT_Set_Pixel_Sizes(m_face, 0, pixelsPerEm);
		if (FT_Load_Glyph(m_face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP | FT_LOAD_RENDER) != 0) return -1;
		const FT_Bitmap& bitmap = m_face->glyph->bitmap;
		double sum = 0;
		for (unsigned y = 0; y < bitmap.rows; ++y) {
			for (unsigned x = 0; x < bitmap.width; ++x)
				sum += bitmap.buffer[static_cast<int>(y) * bitmap.pitch + static_cast<int>(x)];
		}
		return sum / 255 / pixelsPerEm / pixelsPerEm;
	}

private:
	std::shared_ptr<FT_LibraryRec_> m_library;
	FT_Face m_face = nullptr;
};

struct Row {
	unsigned glyphs = 0, blank = 0, refused = 0, unsound = 0, wrongArea = 0;
	double worstArea = 0;
	std::size_t points = 0;
};

vcg::textlabel::Outline OutlineOf(const std::vector<CurveContour>& curves, double tolerance)
{
	LetterRings letter;
	for (const CurveContour& contour : curves) {
		Ring ring = Flatten(contour, tolerance);
		if (!ring.empty()) letter.rings.push_back(std::move(ring));
	}
	return UniteLetters({letter}, {tolerance, 0}).outline;
}

/// Relative difference of the area from that of the raster, at the first resolution that is fine enough.
double AreaError(double area, unsigned glyph, const Rasteriser& raster)
{
	double error = 0;
	for (const unsigned pixelsPerEm : {512u, 2048u, 8192u}) {
		const double expected = raster.area(glyph, pixelsPerEm);
		error = expected == area ? 0 : std::abs(area - expected) / std::max(std::abs(expected), 1e-12);
		if (error < kAreaSlack / 2) break;
	}
	return error;
}

void Judge(const FontFace& font, unsigned glyph, const Rasteriser& raster, Row& row)
{
	++row.glyphs;
	const std::vector<CurveContour> curves = font.glyph(glyph);
	if (curves.empty()) {
		++row.blank;
		return;
	}
	try {
		const auto coarse = OutlineOf(curves, font.capitalHeight() / kDefaultTolerance),
				   fine = OutlineOf(curves, kFineTolerance);
		for (const auto& contour : coarse.contours) row.points += contour.points.size();
		const std::string flaw = text_support::FlawOf(coarse) + text_support::FlawOf(fine);
		const double error = AreaError(Area(fine), glyph, raster);
		row.unsound += !flaw.empty();
		row.wrongArea += error > kAreaSlack;
		row.worstArea = std::max(row.worstArea, error);
		if (!flaw.empty() || error > kAreaSlack)
			std::cout << "  " << font.description() << " glyph " << glyph << ": " << flaw << " area off by " << error
					  << '\n';
	} catch (const TextError& e) {
		++row.refused;
		std::cout << "  " << font.description() << " glyph " << glyph << ": " << Sentence(e) << '\n';
	}
}

Row TableRow(const FontSource& source, bool all)
{
	const FontFace font(OpenFontLibrary(), source);
	const Rasteriser raster(source);
	const unsigned count = hb_face_get_glyph_count(hb_font_get_face(font.shaper()));
	const unsigned wanted = all ? (count > kMostGlyphs ? kSampleOfCollection : count) : std::min(count, kSample);
	Row row;
	for (unsigned i = 0; i < wanted; ++i)
		Judge(font, static_cast<unsigned>(std::uint64_t(i) * count / wanted), raster, row);
	return row;
}

TEST(FontTable, EveryGlyphIsSoundAndHasTheAreaOfItsRaster)
{
	const bool all = std::getenv("TEXTLABEL_ALL_GLYPHS") != nullptr;
	int fonts = 0;
	std::cout << "font                     glyphs  blank refused unsound wrong area  worst area error  points\n"
			  << std::fixed;
	for (const char* name : kFonts) {
		FontSource source;
		try {
			source = FindFont(ParseFontRequest(name));
		} catch (const TextError& e) {
			std::cout << std::left << std::setw(24) << name << " not installed\n";
			continue;
		}
		++fonts;
		const Row row = TableRow(source, all);
		std::cout << std::left << std::setw(24) << name << std::right << std::setw(7) << row.glyphs << std::setw(7)
				  << row.blank << std::setw(8) << row.refused << std::setw(8) << row.unsound << std::setw(11)
				  << row.wrongArea << std::setw(17) << std::setprecision(3) << 100 * row.worstArea << "%"
				  << std::setw(8) << row.points << std::endl;
		EXPECT_EQ(row.unsound, 0u) << name;
		EXPECT_EQ(row.wrongArea, 0u) << name;
		EXPECT_EQ(row.refused, 0u) << name;
	}
	if (fonts == 0) GTEST_SKIP() << "none of the fonts is installed";
}

}  // namespace
