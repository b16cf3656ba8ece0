#include "font_face.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <functional>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_BBOX_H
#include FT_MULTIPLE_MASTERS_H
#include FT_OUTLINE_H
#include <hb-ft.h>
#include <hb-ot.h>
#include "embedded_font.h"
#include "font_outline.h"
#include "text_utf8.h"

namespace textlabel {
namespace {

/// Capital height of a font that has no capitals and does not say, and line height of one that does not say (em).
constexpr double kUsualCapitalHeight = 0.7, kUsualLineHeight = 1.2;
/// Width of a blank in a font that has none (em).
constexpr double kUsualSpace = 0.25;
constexpr double kFixedOne = 65536;  ///< 1 in FreeType's 16.16 numbers

std::string FreeTypeMessage(FT_Error error)
{
	const char* text = FT_Error_String(error);  // null in builds without the texts
	return text != nullptr ? text : "FreeType error " + std::to_string(error);
}

std::string Number(double value)
{
	char text[32];  // the shortest that reads as this double; not as the locale writes it
	return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Are all points of a contour on one line?
bool IsFlat(const CurveContour& contour)
{
	constexpr double kRounding = 1e-9;  // em
	vcg::Point2d far(0, 0);             // from the start
	std::vector<vcg::Point2d> points;
	for (const CurvePiece& piece : contour) {
		for (std::size_t i = 0; i <= static_cast<std::size_t>(piece.degree); ++i) {
			points.push_back(piece.p[i] - contour[0].start());
			if (points.back().SquaredNorm() > far.SquaredNorm()) far = points.back();
		}
	}
	const double bound = kRounding * far.Norm();
	return std::all_of(points.begin(), points.end(), [&](const auto& p) { return std::abs(far ^ p) <= bound; });
}

std::string TagText(FT_ULong tag)
{
	std::string text;
	for (int shift = 24; shift >= 0; shift -= 8) text.push_back(static_cast<char>(tag >> shift & 0xFF));
	return text;
}

using Axes = std::unique_ptr<FT_MM_Var, std::function<void(FT_MM_Var*)>>;

/// The design axes of a face; null when it has none.
Axes AxesOf(FT_Library library, FT_Face face)
{
	FT_MM_Var* axes = nullptr;
	if (!FT_HAS_MULTIPLE_MASTERS(face) || FT_Get_MM_Var(face, &axes) != 0) return nullptr;
	return Axes(axes, [library](FT_MM_Var* a) { FT_Done_MM_Var(library, a); });
}

std::string AxisList(const FT_MM_Var& variable)
{
	std::string text;
	for (FT_UInt i = 0; i < variable.num_axis; ++i) {
		const FT_Var_Axis& axis = variable.axis[i];
		text += (i ? ", " : "") + TagText(axis.tag) + " " + Number(static_cast<double>(axis.minimum) / kFixedOne) +
		        ".." + Number(static_cast<double>(axis.maximum) / kFixedOne);
	}
	return text;
}

/// How large a compressed font (WOFF, WOFF2) says that it is when it is unpacked; 0 for others.
std::size_t UnpackedSize(const FT_Byte* bytes, std::size_t size)
{
	constexpr std::size_t place = 16;  // big-endian, in both headers
	const bool isPacked =
		size >= place + 4 && (std::memcmp(bytes, "wOFF", 4) == 0 || std::memcmp(bytes, "wOF2", 4) == 0);
	std::size_t unpacked = 0;
	for (std::size_t i = 0; isPacked && i < 4; ++i) unpacked = unpacked << 8 | bytes[place + i];
	return unpacked;
}

/// A name as a report can hold it: old fonts have theirs in the encodings of their time.
std::string ReadableName(std::string name)
{
	try {
		DecodeUtf8(name);
	} catch (const TextError&) {
		for (char& c : name)
			if (static_cast<unsigned char>(c) >= 0x80) c = '?';
	}
	return name;
}

}  // namespace

std::shared_ptr<FT_LibraryRec_> OpenFontLibrary()
{
	FT_Library library = nullptr;
	if (FT_Init_FreeType(&library) != 0) throw std::bad_alloc();
	return {library, [](FT_Library l) { FT_Done_FreeType(l); }};
}

FontFace::FontFace(std::shared_ptr<FT_LibraryRec_> library, FontSource source)
	: m_source(std::move(source)), m_library(std::move(library))
{
	open();
	setAxes();
	makeShaper();
	checkMap();
	measure();
}

TextError FontFace::failure(TextErrorCode code, std::string detail) const
{
	return TextError(code, std::move(detail)).ofFont(m_source.name);
}

void FontFace::open()
{
	const FT_Byte* bytes = embeddedFont;
	std::size_t size = embeddedFontSize;
	if (m_source.bytes) {
		bytes = reinterpret_cast<const FT_Byte*>(m_source.bytes->data());
		size = m_source.bytes->size();
	}
	if (UnpackedSize(bytes, size) > kLargestFont) throw failure(TextErrorCode::NotAFont, "it is too large");
	constexpr int kMostFaces = 0xFFFF;
	if (m_source.face < 0 || m_source.face > kMostFaces)
		throw failure(TextErrorCode::BadFace, {}).measured(m_source.face, 0);
	FT_Face face = nullptr;
	const FT_Long index = m_source.face | static_cast<FT_Long>(m_source.instance) << 16;
	FT_Error error = FT_New_Memory_Face(m_library.get(), bytes, static_cast<FT_Long>(size), index, &face);
	if (error != 0 && m_source.face > 0) {
		if (FT_New_Memory_Face(m_library.get(), bytes, static_cast<FT_Long>(size), -1, &face) == 0) {
			const double faces = static_cast<double>(face->num_faces);
			FT_Done_Face(face);
			if (m_source.face >= faces) throw failure(TextErrorCode::BadFace, {}).measured(m_source.face, faces);
		}
	}
	if (error != 0) throw failure(TextErrorCode::NotAFont, FreeTypeMessage(error));
	m_face = {face, [](FT_Face f) { FT_Done_Face(f); }};
	if (!FT_IS_SCALABLE(face)) throw failure(TextErrorCode::NoOutlines, {});
	// Pixels as large as font units: then a 26.6 coordinate has 64 parts of a font unit, for variable fonts.
	error = FT_Set_Pixel_Sizes(face, face->units_per_EM, face->units_per_EM);
	if (error != 0) throw failure(TextErrorCode::NotAFont, FreeTypeMessage(error));
	const std::string style = face->style_name ? std::string(" ") + face->style_name : std::string();
	m_description = ReadableName((face->family_name ? face->family_name : "unnamed") + style);
	if (m_source.bytes) m_description += " (" + m_source.name + ", face " + std::to_string(m_source.face);
	for (const AxisSetting& axis : m_source.axes)
		m_description += (m_source.bytes ? ", " : " ") + axis.tag + "=" + Number(axis.value);
	if (m_source.bytes) m_description += ")";
}

void FontFace::setAxes()
{
	if (m_source.axes.empty()) return;
	const std::string first = m_source.axes.front().tag + "=" + Number(m_source.axes.front().value);
	const Axes variable = AxesOf(m_library.get(), m_face.get());
	if (!variable) throw failure(TextErrorCode::BadAxis, first);
	std::vector<FT_Fixed> place(variable->num_axis);
	if (FT_Get_Var_Design_Coordinates(m_face.get(), variable->num_axis, place.data()) != 0)
		throw failure(TextErrorCode::BadAxis, first);
	for (const AxisSetting& setting : m_source.axes) {
		const FT_Var_Axis *begin = variable->axis, *end = begin + variable->num_axis;
		const FT_Var_Axis* axis =
			std::find_if(begin, end, [&setting](const FT_Var_Axis& a) { return TagText(a.tag) == setting.tag; });
		const double value = setting.value * kFixedOne;
		if (axis == end ||
		    !(value >= static_cast<double>(axis->minimum) && value <= static_cast<double>(axis->maximum)))
			throw failure(TextErrorCode::BadAxis, setting.tag + "=" + Number(setting.value))
				.insteadOf(AxisList(*variable));
		place[static_cast<std::size_t>(axis - begin)] = std::lround(value);
	}
	if (FT_Set_Var_Design_Coordinates(m_face.get(), variable->num_axis, place.data()) != 0)
		throw failure(TextErrorCode::BadAxis, first).insteadOf(AxisList(*variable));
}

void FontFace::makeShaper()
{
	// HarfBuzz reads an OpenType font's tables by itself, through FreeType, which unpacks WOFF. Other kinds (Type 1)
	// have none: FreeType then answers HarfBuzz's questions, in 64 parts of a font unit.
	constexpr double kParts = 64;
	FT_Face face = m_face.get();
	m_shaperUnits = face->units_per_EM;
	if (!FT_IS_SFNT(face)) {
		m_shaper.reset(hb_ft_font_create_referenced(face));
		hb_ft_font_set_load_flags(m_shaper.get(), FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP);
		m_shaperUnits *= kParts;
		return;
	}
	hb_face_t* tables = hb_ft_face_create_referenced(face);
	m_shaper.reset(hb_font_create(tables));
	hb_face_destroy(tables);
	hb_font_set_scale(m_shaper.get(), face->units_per_EM, face->units_per_EM);
	const Axes variable = AxesOf(m_library.get(), face);
	if (!variable) return;
	std::vector<FT_Fixed> place(variable->num_axis);
	std::vector<float> floats;
	if (FT_Get_Var_Design_Coordinates(face, variable->num_axis, place.data()) == 0) {
		for (const FT_Fixed f : place) floats.push_back(static_cast<float>(static_cast<double>(f) / kFixedOne));
		hb_font_set_var_coords_design(m_shaper.get(), floats.data(), static_cast<unsigned>(floats.size()));
	}
}

void FontFace::checkMap() const
{
	if (!FT_IS_SFNT(m_face.get())) {
		if (m_face->charmap == nullptr) throw failure(TextErrorCode::NoUnicodeMap, {});
		return;
	}
	hb_set_t* characters = hb_set_create();
	hb_face_collect_unicodes(hb_font_get_face(m_shaper.get()), characters);
	const bool none = hb_set_is_empty(characters);
	hb_set_destroy(characters);
	if (none) throw failure(TextErrorCode::NoUnicodeMap, {});
}

void FontFace::measure()
{
	hb_codepoint_t index = 0;
	for (const char32_t capital : {U'H', U'I', U'E', U'X'}) {
		if (m_capitalHeight > 0 || !hb_font_get_nominal_glyph(m_shaper.get(), capital, &index)) continue;
		const vcg::Box2d box = BoxOf(glyph(index));
		if (!box.IsNull()) m_capitalHeight = box.max[1];
	}
	hb_position_t capital = 0;
	if (!(m_capitalHeight > 0) && hb_ot_metrics_get_position(m_shaper.get(), HB_OT_METRICS_TAG_CAP_HEIGHT, &capital))
		m_capitalHeight = capital / m_shaperUnits;
	if (!(m_capitalHeight > 0)) m_capitalHeight = kUsualCapitalHeight;
	hb_font_extents_t line{};
	if (hb_font_get_h_extents(m_shaper.get(), &line))
		m_lineHeight = (static_cast<double>(line.ascender) - line.descender + line.line_gap) / m_shaperUnits;
	if (!(m_lineHeight > 0)) m_lineHeight = kUsualLineHeight;
	if (hb_font_get_nominal_glyph(m_shaper.get(), U' ', &index))
		m_spaceAdvance = hb_font_get_glyph_h_advance(m_shaper.get(), index) / m_shaperUnits;
	if (!(m_spaceAdvance > 0)) m_spaceAdvance = kUsualSpace;
}

bool FontFace::has(char32_t c) const
{
	hb_codepoint_t index = 0;
	return hb_font_get_nominal_glyph(m_shaper.get(), c, &index) && index != 0;
}

std::vector<CurveContour> FontFace::glyph(unsigned index) const
{
	const FT_Error error =
		FT_Load_Glyph(m_face.get(), index, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP | FT_LOAD_NO_AUTOHINT);
	const std::string which = "glyph " + std::to_string(index) + ": ";
	if (error != 0) throw failure(TextErrorCode::NotAFont, which + FreeTypeMessage(error));
	if (m_face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return {};
	auto curves = CurvesOf(m_face->glyph->outline, m_face->units_per_EM);
	if (!curves) throw failure(TextErrorCode::NotAFont, which + "invalid outline");
	return *std::move(curves);
}

bool FontFace::isPicture(unsigned index) const
{
	hb_face_t* tables = hb_font_get_face(m_shaper.get());
	const bool hasPictures = FT_HAS_COLOR(m_face.get()) || FT_HAS_FIXED_SIZES(m_face.get()) ||
	                         hb_ot_color_has_layers(tables) || hb_ot_color_has_svg(tables) ||
	                         hb_ot_color_has_png(tables);
	return hasPictures && !hasInk(index);
}

bool FontFace::hasInk(unsigned index) const
{
	const auto [it, isNew] = m_hasInk.try_emplace(index, false);
	if (isNew) {
		const std::vector<CurveContour> curves = glyph(index);
		it->second = !std::all_of(curves.begin(), curves.end(), IsFlat);
	}
	return it->second;
}

bool FontFace::nominalHasInk(char32_t c) const
{
	hb_codepoint_t index = 0;
	return hb_font_get_nominal_glyph(m_shaper.get(), c, &index) && hasInk(index);
}

}  // namespace textlabel
