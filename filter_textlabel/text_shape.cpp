#include "text_shape.h"

#include <algorithm>
#include <fribidi.h>
#include <hb-ot.h>
#include <new>
#include <set>
#include "font_lookup.h"
#include "text_utf8.h"

namespace textlabel {
namespace {

using Buffer = std::unique_ptr<hb_buffer_t, void (*)(hb_buffer_t*)>;

bool IsInherent(hb_script_t s) { return s == HB_SCRIPT_COMMON || s == HB_SCRIPT_INHERITED || s == HB_SCRIPT_UNKNOWN; }

/// Script of each character; those without one of their own go with what is before them, or else with what follows.
std::vector<hb_script_t> ScriptsOf(const std::u32string& text)
{
	std::vector<hb_script_t> scripts;
	hb_script_t current = HB_SCRIPT_COMMON;
	for (const char32_t c : text) {
		const hb_script_t own = hb_unicode_script(hb_unicode_funcs_get_default(), c);
		if (!IsInherent(own) && IsInherent(current)) std::fill(scripts.begin(), scripts.end(), own);
		if (!IsInherent(own)) current = own;
		scripts.push_back(current);
	}
	return scripts;
}

/// Bidirectional levels of a paragraph.
struct Levels {
	std::vector<FriBidiLevel> of;
	bool rightToLeft = false;
};

Levels LevelsOf(const std::u32string& text)
{
	const std::vector<FriBidiChar> characters(text.begin(), text.end());
	const auto n = static_cast<FriBidiStrIndex>(text.size());
	std::vector<FriBidiCharType> types(text.size());
	std::vector<FriBidiBracketType> brackets(text.size());
	fribidi_get_bidi_types(characters.data(), n, types.data());
	fribidi_get_bracket_types(characters.data(), n, types.data(), brackets.data());
	Levels levels;
	levels.of.resize(text.size());
	FriBidiParType base = FRIBIDI_PAR_ON;  // the first strong character decides
	if (fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), n, &base, levels.of.data()) == 0)
		throw std::bad_alloc();
	levels.rightToLeft = FRIBIDI_IS_RTL(base);
	return levels;
}

class Shaper {
public:
	Shaper(const std::u32string& text, FontStack& fonts, const ShapeOptions& options)
		: m_fonts(fonts), m_options(options)
	{
		m_line.text = text;
	}

	ShapedLine shaped()
	{
		if (m_line.text.empty()) return std::move(m_line);
		for (ShapedItem& item : items()) {
			if (!item.isTab) shape(item);
			const std::vector<ShapedItem> pieces = withFallback(std::move(item));
			m_line.items.insert(m_line.items.end(), pieces.begin(), pieces.end());
		}
		for (const ShapedItem& item : m_line.items) listWhatIsMissing(item);
		return std::move(m_line);
	}

private:
	std::vector<ShapedItem> items()
	{
		const std::u32string& text = m_line.text;
		const Levels levels = LevelsOf(text);
		const std::vector<hb_script_t> scripts = ScriptsOf(text);
		m_line.rightToLeft = levels.rightToLeft;
		std::vector<ShapedItem> items;
		for (int i = 0; i < static_cast<int>(text.size()); ++i) {
			const auto k = static_cast<std::size_t>(i);
			ShapedItem item;
			item.begin = i, item.end = i + 1;
			item.isTab = text[k] == '\t';
			item.level = item.isTab ? levels.rightToLeft : levels.of[k];
			item.script = scripts[k];
			ShapedItem* last = items.empty() ? nullptr : &items.back();
			const bool joins =
				last && !item.isTab && !last->isTab && last->level == item.level && last->script == item.script;
			if (joins) last->end = i + 1;
			else items.push_back(std::move(item));
		}
		return items;
	}

	void shape(ShapedItem& item)
	{
		const FontFace& font = m_fonts[item.font];
		const Buffer buffer(hb_buffer_create(), hb_buffer_destroy);
		const std::vector<uint32_t> text(m_line.text.begin(), m_line.text.end());
		hb_buffer_add_utf32(buffer.get(), text.data(), static_cast<int>(text.size()), static_cast<unsigned>(item.begin),
		                    item.end - item.begin);
		hb_buffer_set_direction(buffer.get(), item.level % 2 ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
		hb_buffer_set_script(buffer.get(), item.script);
		// never the user's locale: the same input gives the same label everywhere
		const std::string language = m_options.language.empty() ? "und" : m_options.language;
		hb_buffer_set_language(buffer.get(), hb_language_from_string(language.c_str(), -1));
		hb_shape(font.shaper(), buffer.get(), m_options.features.data(),
		         static_cast<unsigned>(m_options.features.size()));
		if (!hb_buffer_allocation_successful(buffer.get())) throw std::bad_alloc();
		unsigned count = 0;
		const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
		CheckGlyphCount(m_glyphs += count);
		const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer.get(), &count);
		const double em = font.shaperUnits();
		item.glyphs.clear();
		for (unsigned i = 0; i < count; ++i)
			item.glyphs.push_back({infos[i].codepoint, static_cast<int>(infos[i].cluster), positions[i].x_advance / em,
			                       positions[i].x_offset / em, positions[i].y_offset / em});
	}

	/// First characters of the item's clusters, ascending, and the item's end.
	static std::vector<int> clustersOf(const ShapedItem& item)
	{
		std::vector<int> starts{item.end};
		for (const ShapedGlyph& g : item.glyphs) starts.push_back(g.cluster);
		std::sort(starts.begin(), starts.end());
		starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
		return starts;
	}

	/// Clusters that the item's font has no glyph for.
	static std::set<int> lackingIn(const ShapedItem& item)
	{
		std::set<int> clusters;
		for (const ShapedGlyph& g : item.glyphs) {
			if (g.glyph == 0) clusters.insert(g.cluster);
		}
		return clusters;
	}

	std::u32string inked(int begin, int end) const
	{
		std::u32string characters;
		for (int i = begin; i < end; ++i) {
			const char32_t c = m_line.text[static_cast<std::size_t>(i)];
			if (!IsBlank(c)) characters.push_back(c);
		}
		return characters;
	}

	/// The item as it is, or cut where its font lacks characters that another one has.
	std::vector<ShapedItem> withFallback(ShapedItem item)
	{
		if (item.isTab || !m_fonts.mayFallBack()) return {std::move(item)};
		const std::vector<int> starts = clustersOf(item);
		const std::set<int> lacking = lackingIn(item);
		ShapedItem unshaped = item;
		unshaped.glyphs.clear();  // a text may change its font at each letter
		std::vector<ShapedItem> pieces;
		for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
			const std::u32string characters = inked(starts[k], starts[k + 1]);
			int font = item.font;
			if (lacking.count(starts[k]) && !characters.empty()) font = std::max(font, m_fonts.fallbackFor(characters));
			if (pieces.empty() || pieces.back().font != font) {
				pieces.push_back(unshaped);
				pieces.back().begin = starts[k];
				pieces.back().font = font;
			}
			pieces.back().end = starts[k + 1];
		}
		if (pieces.size() == 1 && pieces[0].font == item.font) return {std::move(item)};
		for (ShapedItem& piece : pieces) shape(piece);
		return pieces;
	}

	void listWhatIsMissing(const ShapedItem& item)
	{
		if (item.isTab) return;
		const std::vector<int> starts = clustersOf(item);
		const FontFace& font = m_fonts[item.font];
		const auto endOf = [&starts](int cluster) { return *std::upper_bound(starts.begin(), starts.end(), cluster); };
		for (const int cluster : lackingIn(item)) {
			for (const char32_t c : inkedOrAll(cluster, endOf(cluster))) {
				if (!font.has(c)) m_line.missing.push_back(c);
			}
		}
		for (const ShapedGlyph& g : item.glyphs) {
			const std::u32string characters = inked(g.cluster, endOf(g.cluster));
			if (!characters.empty() && font.isPicture(g.glyph)) m_line.withoutOutline += characters;
		}
		for (const int cluster : emptyIn(item)) {
			const std::u32string characters = inked(cluster, endOf(cluster));
			const auto mayBeEmpty = [&font](char32_t c) { return IsMark(c) || font.nominalHasInk(c); };
			// a font may draw a sign with its neighbour's glyph and leave its own empty, as those for programmers do
			if (std::none_of(characters.begin(), characters.end(), mayBeEmpty)) m_line.withoutOutline += characters;
		}
	}

	/// Clusters whose glyphs, none of which lacks, leave no ink.
	std::set<int> emptyIn(const ShapedItem& item) const
	{
		std::set<int> empty, others;
		for (const ShapedGlyph& g : item.glyphs)
			(g.glyph != 0 && !m_fonts[item.font].hasInk(g.glyph) ? empty : others).insert(g.cluster);
		for (const int cluster : others) empty.erase(cluster);
		return empty;
	}

	/// What to name when a cluster has no glyph: a control character has no ink and yet no glyph either.
	std::u32string inkedOrAll(int begin, int end) const
	{
		const std::u32string characters = inked(begin, end);
		if (!characters.empty()) return characters;
		return m_line.text.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
	}

	FontStack& m_fonts;
	const ShapeOptions& m_options;
	ShapedLine m_line;
	std::size_t m_glyphs = 0;  ///< shaped so far
};

}  // namespace

FontStack::FontStack(const std::string& font, bool fallback)
	: m_library(OpenFontLibrary()), m_request(ParseFontRequest(font)), m_fallback(fallback)
{
	m_fonts.push_back(std::make_unique<FontFace>(m_library, FindFont(m_request)));
}

int FontStack::fallbackFor(const std::u32string& characters)
{
	const auto hasAll = [&characters](const FontFace& font) {
		return std::all_of(characters.begin(), characters.end(), [&font](char32_t c) { return font.has(c); });
	};
	for (int i = 1; i < size(); ++i) {
		if (hasAll((*this)[i])) return i;
	}
	if (m_hopeless.count(characters)) return -1;
	const bool isFound = FindFallback(characters, m_request, [&](FontSource source) {
		auto face = std::make_unique<FontFace>(m_library, std::move(source));
		if (!hasAll(*face)) return false;
		m_fonts.push_back(std::move(face));
		return true;
	});
	if (isFound) return size() - 1;
	m_hopeless.insert(characters);
	return -1;
}

void CheckGlyphCount(std::size_t glyphs)
{
	if (glyphs > kMostGlyphs) throw TextError(TextErrorCode::Unsound, "the font makes too many glyphs of it");
}

std::vector<hb_feature_t> ParseFeatures(const std::string& text)
{
	std::vector<hb_feature_t> features;
	for (std::size_t at = 0; at < text.size();) {
		const std::size_t end = std::min(text.find(',', at), text.size());
		hb_feature_t feature{};
		if (!hb_feature_from_string(text.data() + at, static_cast<int>(end - at), &feature))
			throw TextError(TextErrorCode::BadFeature, text.substr(at, end - at));
		features.push_back(feature);
		at = end + 1;
	}
	return features;
}

ShapedLine ShapeLine(const std::u32string& text, FontStack& fonts, const ShapeOptions& options)
{
	return Shaper(text, fonts, options).shaped();
}

}  // namespace textlabel
