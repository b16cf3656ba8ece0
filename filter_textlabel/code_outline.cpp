#include "code_outline.h"

#include <cmath>
#include "outline_unite.h"
#include "text_layout.h"

namespace textlabel {
namespace {

/// What is left of a light or a dark module can still be told from nothing.
constexpr double kMostEmbolden = 0.4;  // of a module
/// There are no curves: this makes the bridges' width, kFinest of it.
constexpr double kModuleOverTolerance = 8;

/// The dark modules, those side by side in a row as one ring.
/// @param[in] side  -1 mirrors
/// @param[in] anchor  from the symbol's lower left corner
std::vector<Ring> RingsOf(const CodeSymbol& symbol, double module, double side, const vcg::Point2d& anchor)
{
	const auto x = [&](int column) { return side * (column * module - anchor[0]); };
	const auto y = [&](int row) { return (symbol.rows - row) * symbol.rowHeight * module - anchor[1]; };
	std::vector<Ring> rings;
	for (int row = 0; row < symbol.rows; ++row) {
		for (int begin = 0, end = 0; begin < symbol.columns; begin = end + 1) {
			for (end = begin; end < symbol.columns && symbol.isDark(row, end);) ++end;
			if (end == begin) continue;
			const double left = x(begin), right = x(end), low = y(row + 1), high = y(row);
			rings.push_back({{left, low}, {right, low}, {right, high}, {left, high}});
		}
	}
	return rings;
}

}  // namespace

TextOutline SetAsCode(const std::string& utf8, const TextOptions& options)
{
	const CodeSymbol symbol = EncodeText(utf8, options.code);
	const double overhang = 2 * options.embolden;
	if (options.fitWidth > 0 && !(options.fitWidth > overhang))
		throw TextError(TextErrorCode::BadSize, "fitWidth").measured(options.fitWidth, overhang);
	TextOutline text;
	text.module =
		options.fitWidth > 0 ? (options.fitWidth - overhang) / symbol.columns : options.size / symbol.height();
	text.capitalHeight = text.module * symbol.height();
	const double most = kMostEmbolden * text.module;
	if (std::abs(options.embolden) > most)
		throw TextError(TextErrorCode::BadEmbolden, "two fifths of a module").measured(options.embolden, most);
	text.tolerance = text.module / kModuleOverTolerance;
	const vcg::Box2d box({0, 0}, {text.module * symbol.columns, text.capitalHeight});
	const vcg::Point2d anchor = AnchorOf(box, options.align, options.anchor);
	const std::vector<Ring> rings = RingsOf(symbol, text.module, options.mirrored ? -1 : 1, anchor);
	text.outline = UniteLetters({{0, rings}}, {text.tolerance, options.embolden}).outline;
	return text;
}

}  // namespace textlabel
