#include "font_lookup.h"

#include <algorithm>
#include <fontconfig/fontconfig.h>
#include <memory>
#include <optional>
#include <sstream>
#include "text_error.h"

namespace textlabel {
namespace {

using Pattern = std::unique_ptr<FcPattern, void (*)(FcPattern*)>;
using CharSet = std::unique_ptr<FcCharSet, void (*)(FcCharSet*)>;
using FontSet = std::unique_ptr<FcFontSet, void (*)(FcFontSet*)>;

constexpr int kFaceBits = 16;  ///< FC_INDEX: the face below, the named instance above

const FcChar8* Bytes(const std::string& s) { return reinterpret_cast<const FcChar8*>(s.c_str()); }

std::string Text(const FcPattern* pattern, const char* object, int n = 0)
{
	FcChar8* value = nullptr;
	if (FcPatternGetString(pattern, object, n, &value) != FcResultMatch) return {};
	return reinterpret_cast<const char*>(value);
}

bool IsTrue(const FcPattern* pattern, const char* object)
{
	FcBool value = FcFalse;
	return FcPatternGetBool(pattern, object, 0, &value) == FcResultMatch && value == FcTrue;
}

/// Is one of the values of a property this name? Case and blanks do not count, as everywhere in Fontconfig.
bool Names(const FcPattern* pattern, const char* object, const std::string& name)
{
	const auto plain = [](const std::string& s) {
		std::string result;
		for (const char c : s) {
			if (c != ' ') result.push_back(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
		}
		return result;
	};
	FcChar8* ignored = nullptr;
	for (int n = 0; FcPatternGetString(pattern, object, n, &ignored) == FcResultMatch; ++n) {
		if (plain(Text(pattern, object, n)) == plain(name)) return true;
	}
	return false;
}

bool IsGeneric(std::string family)
{
	for (char& c : family) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
	static const char* const kGeneric[] = {"sans-serif", "sans",    "serif",   "monospace",
	                                       "mono",       "cursive", "fantasy", "system-ui"};
	return std::find(std::begin(kGeneric), std::end(kGeneric), family) != std::end(kGeneric);
}

/// A word of a style that Fontconfig knows as a value of weight, slant or width.
struct StyleValue {
	std::string object;
	int value;
};

std::optional<StyleValue> ParseStyleWord(std::string word)
{
	word.erase(std::remove(word.begin(), word.end(), '-'), word.end());
	const FcConstant* constant = FcNameGetConstant(Bytes(word));
	if (constant == nullptr) return std::nullopt;
	for (const char* object : {FC_WEIGHT, FC_SLANT, FC_WIDTH}) {
		if (std::string(constant->object) == object) return StyleValue{object, constant->value};
	}
	return std::nullopt;
}

/// @return nothing when a word is unknown: then the style is a name, to be found as it is
std::optional<std::vector<StyleValue>> ParseStyle(const std::string& style)
{
	std::vector<StyleValue> values;
	std::istringstream words(style);
	for (std::string word; words >> word;) {
		const auto value = ParseStyleWord(word);
		if (!value) return std::nullopt;
		values.push_back(*value);
	}
	return values;
}

Pattern PatternFor(const FontRequest& request)
{
	Pattern pattern(FcPatternCreate(), FcPatternDestroy);
	if (!request.family.empty()) FcPatternAddString(pattern.get(), FC_FAMILY, Bytes(request.family));
	if (const auto values = ParseStyle(request.style)) {
		for (const StyleValue& v : *values) FcPatternAddInteger(pattern.get(), v.object.c_str(), v.value);
	} else FcPatternAddString(pattern.get(), FC_STYLE, Bytes(request.style));
	FcPatternAddBool(pattern.get(), FC_OUTLINE, FcTrue);
	// any language: Fontconfig would add those of the user's locale
	FcPatternAddString(pattern.get(), FC_LANG, Bytes("und"));
	// a family may be installed both as a variable font and as one file for each weight
	if (!request.axes.empty()) FcPatternAddBool(pattern.get(), FC_VARIABLE, FcTrue);
	return pattern;
}

void Complete(FcPattern* pattern)
{
	FcConfigSubstitute(nullptr, pattern, FcMatchPattern);
	FcDefaultSubstitute(pattern);
}

/// Does the font found have this weight, slant or width? A variable font has a range of it.
bool HasValue(const FcPattern* font, const StyleValue& asked)
{
	FcRange* range = nullptr;
	double low = 0, high = 0;
	if (FcPatternGetRange(font, asked.object.c_str(), 0, &range) == FcResultMatch &&
	    FcRangeGetDouble(range, &low, &high) && low < high)
		return asked.value >= low && asked.value <= high;
	double value = 0;
	if (FcPatternGetDouble(font, asked.object.c_str(), 0, &value) != FcResultMatch) value = 0;
	// Regular and Book, Italic and Oblique are what one foundry calls what the other calls the other.
	if (asked.object == FC_WEIGHT && asked.value <= FC_WEIGHT_MEDIUM && asked.value >= FC_WEIGHT_BOOK)
		return value >= FC_WEIGHT_BOOK && value <= FC_WEIGHT_MEDIUM;
	if (asked.object == FC_SLANT && asked.value != FC_SLANT_ROMAN) return value > FC_SLANT_ROMAN;
	return value == asked.value;
}

bool HasStyle(const FcPattern* font, const FontRequest& request)
{
	if (request.style.empty() || Names(font, FC_STYLE, request.style)) return true;
	const auto values = ParseStyle(request.style);
	return values &&
	       std::all_of(values->begin(), values->end(), [font](const StyleValue& v) { return HasValue(font, v); });
}

/// Fontconfig's rules call a font bold or oblique that whoever draws it is to make so.
bool IsSynthetic(const FcPattern* font)
{
	FcBool emboldened = FcFalse;
	FcPatternGetBool(font, FC_EMBOLDEN, 0, &emboldened);
	FcMatrix* matrix = nullptr;  // a bitmap font has one, too, for its scale
	return emboldened || (FcPatternGetMatrix(font, FC_MATRIX, 0, &matrix) == FcResultMatch && matrix->xy != 0);
}

bool IsAsked(const FcPattern* font, const FontRequest& request)
{
	const bool named = IsGeneric(request.family) || Names(font, FC_FAMILY, request.family);
	return named && !IsSynthetic(font) && HasStyle(font, request);
}

std::string DisplayName(const FcPattern* font) { return Text(font, FC_FAMILY) + ":" + Text(font, FC_STYLE); }

FontSource SourceOf(const FcPattern* font, const std::vector<AxisSetting>& axes)
{
	FontSource source;
	source.name = Text(font, FC_FILE);
	source.bytes = ReadFontFile(source.name);
	int index = 0;
	FcPatternGetInteger(font, FC_INDEX, 0, &index);
	source.face = index & ((1 << kFaceBits) - 1);
	source.instance = index >> kFaceBits;
	constexpr int kAnyInstance = 0x8000;  // a variable font as such: the variations below say which place
	if (source.instance == kAnyInstance) source.instance = 0;
	source.axes = ParseAxes(Text(font, FC_FONT_VARIATIONS));
	for (const AxisSetting& axis : axes) {
		const auto same = [&axis](const AxisSetting& a) { return a.tag == axis.tag; };
		source.axes.erase(std::remove_if(source.axes.begin(), source.axes.end(), same), source.axes.end());
		source.axes.push_back(axis);
	}
	return source;
}

/// A font that is asked for by the name that it has by itself: "DejaVu Sans Bold", "DejaVuSans-Bold".
/// @return null when there is none; of several, as of two versions, the first file
Pattern FindByFullName(const FontRequest& request)
{
	Pattern first(nullptr, FcPatternDestroy);
	if (!request.style.empty()) return first;
	const auto place = [](const FcPattern* font) {
		int index = 0;
		FcPatternGetInteger(font, FC_INDEX, 0, &index);
		return std::make_pair(Text(font, FC_FILE), index);
	};
	for (const char* object : {FC_FULLNAME, FC_POSTSCRIPT_NAME}) {
		const Pattern pattern(FcPatternCreate(), FcPatternDestroy);
		FcPatternAddString(pattern.get(), object, Bytes(request.family));
		FcPatternAddBool(pattern.get(), FC_OUTLINE, FcTrue);
		const std::unique_ptr<FcObjectSet, void (*)(FcObjectSet*)> objects(
			FcObjectSetBuild(FC_FILE, FC_INDEX, FC_FULLNAME, FC_POSTSCRIPT_NAME, nullptr), FcObjectSetDestroy);
		const FontSet fonts(FcFontList(nullptr, pattern.get(), objects.get()), FcFontSetDestroy);
		for (int i = 0; fonts && i < fonts->nfont; ++i) {
			FcPattern* const font = fonts->fonts[i];
			if (!Names(font, object, request.family) || (first && place(first.get()) <= place(font))) continue;
			FcPatternReference(font);
			first.reset(font);
		}
		if (first) return first;
	}
	return first;
}

FontSource FindFamily(const FontRequest& request)
{
	const Pattern pattern = PatternFor(request);
	Complete(pattern.get());
	FcResult result = FcResultNoMatch;
	const Pattern font(FcFontMatch(nullptr, pattern.get(), &result), FcPatternDestroy);
	if (!font || Text(font.get(), FC_FILE).empty()) throw TextError(TextErrorCode::FontNotFound).ofFont(request.text);
	if (IsAsked(font.get(), request)) return SourceOf(font.get(), request.axes);
	if (const Pattern named = FindByFullName(request)) return SourceOf(named.get(), request.axes);
	throw TextError(TextErrorCode::FontSubstituted).ofFont(request.text).insteadOf(DisplayName(font.get()));
}

/// What such a character means is for each font to say: that of another font would be another sign.
bool IsPrivateUse(char32_t c) { return (c >= 0xE000 && c <= 0xF8FF) || c >= 0xF0000; }

bool HasAll(const FcPattern* font, const std::u32string& characters)
{
	FcCharSet* set = nullptr;
	if (FcPatternGetCharSet(font, FC_CHARSET, 0, &set) != FcResultMatch) return false;
	return std::all_of(characters.begin(), characters.end(), [set](char32_t c) { return FcCharSetHasChar(set, c); });
}

}  // namespace

FontSource FindFont(const FontRequest& request)
{
	if (!request.family.empty()) return FindFamily(request);
	FontSource source;
	source.axes = request.axes;
	if (request.file.empty()) return source;
	source.name = request.file;
	source.bytes = ReadFontFile(request.file);
	source.face = request.face;
	return source;
}

bool FindFallback(const std::u32string& characters, const FontRequest& request,
                  const std::function<bool(FontSource)>& take)
{
	if (std::any_of(characters.begin(), characters.end(), IsPrivateUse)) return false;
	const Pattern pattern = PatternFor(request);
	const bool isBuiltIn = request.family.empty() && request.file.empty();
	if (isBuiltIn) FcPatternAddInteger(pattern.get(), FC_WEIGHT, FC_WEIGHT_BOLD);
	const CharSet set(FcCharSetCreate(), FcCharSetDestroy);
	for (const char32_t c : characters) FcCharSetAddChar(set.get(), c);
	FcPatternAddCharSet(pattern.get(), FC_CHARSET, set.get());
	Complete(pattern.get());
	FcResult result = FcResultNoMatch;
	const FontSet fonts(FcFontSort(nullptr, pattern.get(), FcFalse, nullptr, &result), FcFontSetDestroy);
	for (int i = 0; fonts && i < fonts->nfont; ++i) {
		FcPattern* candidate = fonts->fonts[i];
		if (!IsTrue(candidate, FC_OUTLINE) || IsTrue(candidate, FC_COLOR) || !HasAll(candidate, characters)) continue;
		const Pattern font(FcFontRenderPrepare(nullptr, pattern.get(), candidate), FcPatternDestroy);
		try {
			if (take(SourceOf(font.get(), {}))) return true;
		} catch (const TextError&) {  // a broken file is no reason not to take the next
		}
	}
	return false;
}

}  // namespace textlabel
