#include "code_symbol.h"

#include <algorithm>
#include <memory>
#include <new>
#include <zint.h>
#include "text_error.h"
#include "text_utf8.h"

namespace textlabel {
namespace {

/// Bars are this high, times the width of the symbol: more than the 15 percent that the standards ask for.
constexpr double kBarHeight = 0.25;
/// Levels of QR codes: with M 15 percent of the symbol may be lost, with L 7. Zint gives more where there is room.
constexpr int kQrLevelM = 2, kQrLevelL = 1;
/// More than any symbol holds.
constexpr std::size_t kMostBytes = 10000;

struct Symbology {
	const char* name;
	int zint;
	int mode;
	bool isBars;
};

const Symbology& Of(CodeKind kind)
{
	static const Symbology kTable[] = {{"None", 0, 0, false},
	                                   {"Data Matrix", BARCODE_DATAMATRIX, UNICODE_MODE, false},
	                                   {"GS1 Data Matrix", BARCODE_DATAMATRIX, GS1_MODE, false},
	                                   {"QR Code", BARCODE_QRCODE, UNICODE_MODE, false},
	                                   {"Micro QR Code", BARCODE_MICROQR, UNICODE_MODE, false},
	                                   {"Aztec Code", BARCODE_AZTEC, UNICODE_MODE, false},
	                                   {"Code 128", BARCODE_CODE128, UNICODE_MODE, true}};
	return kTable[static_cast<int>(kind)];
}

/// What Zint says, without its number: "Error 518: Input too long".
std::string Words(const char* message)
{
	const std::string text = message;
	const std::size_t colon = text.find(": ");
	return text.compare(0, 6, "Error ") == 0 && colon != std::string::npos ? text.substr(colon + 2) : text;
}

/// The lines of a text, each ended by a newline but the last.
std::string WithoutEscapes(const std::string& utf8)
{
	const std::vector<std::u32string> lines = SplitLines(DecodeUtf8(utf8));
	std::u32string text = lines[0];
	for (std::size_t i = 1; i < lines.size(); ++i) text += U'\n' + lines[i];
	if (std::all_of(text.begin(), text.end(), IsBlank)) throw TextError(TextErrorCode::EmptyText);
	return EncodeUtf8(text);
}

using Zint = std::unique_ptr<zint_symbol, void (*)(zint_symbol*)>;

Zint NewZint(CodeKind kind)
{
	Zint zint(ZBarcode_Create(), ZBarcode_Delete);
	if (!zint) throw std::bad_alloc();
	zint->symbology = Of(kind).zint;
	zint->input_mode = Of(kind).mode;
	if (Of(kind).zint == BARCODE_DATAMATRIX) zint->option_3 = DM_SQUARE;
	if (kind == CodeKind::QrCode) zint->option_1 = kQrLevelM;
	return zint;
}

/// @return Zint's status: ZINT_ERROR and above is a failure
int Encode(zint_symbol& zint, const std::string& text)
{
	const auto* const bytes = reinterpret_cast<const unsigned char*>(text.data());
	return ZBarcode_Encode(&zint, bytes, static_cast<int>(text.size()));
}

}  // namespace

const char* CodeName(CodeKind kind) { return Of(kind).name; }

CodeSymbol EncodeText(const std::string& utf8, CodeKind kind)
{
	const auto refused = [kind](const std::string& why) {
		TextError error(TextErrorCode::BadCode, why);
		error.substitute = CodeName(kind);
		return error;
	};
	if (utf8.size() > kMostBytes) throw refused("the text is too long");
	const std::string text = WithoutEscapes(utf8);
	Zint zint = NewZint(kind);
	int status = Encode(*zint, text);
	if (status == ZINT_ERROR_TOO_LONG && kind == CodeKind::QrCode) {
		zint = NewZint(kind);
		zint->option_1 = kQrLevelL;
		status = Encode(*zint, text);
	}
	if (status == ZINT_ERROR_MEMORY) throw std::bad_alloc();
	if (status >= ZINT_ERROR) throw refused(Words(zint->errtxt));
	CodeSymbol symbol;
	symbol.columns = zint->width;
	symbol.rows = zint->rows;
	if (Of(kind).isBars) symbol.rowHeight = kBarHeight * symbol.columns;
	for (int row = 0; row < symbol.rows; ++row) {
		for (int column = 0; column < symbol.columns; ++column)
			symbol.dark.push_back((zint->encoded_data[row][column / 8] >> (column % 8)) & 1);
	}
	return symbol;
}

}  // namespace textlabel
