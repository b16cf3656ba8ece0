#pragma once
// Machine-readable codes, by Zint: a text in, the modules of a symbol out.

#include <string>
#include <vector>

namespace textlabel {

/// How a text is marked: in letters, or as a code that a camera reads.
enum class CodeKind { None, DataMatrix, Gs1DataMatrix, QrCode, MicroQrCode, Aztec, Code128 };

/// Its name, as its standard writes it.
const char* CodeName(CodeKind kind);

/// A symbol without its quiet zone. A module is its unit of length: the side of a square, or the width of the thinnest bar.
struct CodeSymbol {
	int columns = 0, rows = 0;
	double rowHeight = 1;    ///< modules: 1, but for bars
	std::vector<char> dark;  ///< rows * columns, from the top row down, each from left to right

	bool isDark(int row, int column) const
	{
		return dark[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
		            static_cast<std::size_t>(column)] != 0;
	}
	double height() const { return rows * rowHeight; }
};

/// Encode a text in the smallest symbol that holds it. That of a GS1 Data Matrix has its identifiers in brackets:
/// [01]09506000134352[21]0042
/// @param[in] utf8  the text, with its escapes (text_outline.h)
/// @param[in] kind  not None
/// @throws TextError{BadCode} when the code has no room for it, or no such characters; TextError{BadUtf8, EmptyText}
CodeSymbol EncodeText(const std::string& utf8, CodeKind kind);

}  // namespace textlabel
