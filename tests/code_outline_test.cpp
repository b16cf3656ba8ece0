// Codes as outlines: their modules counted, measured and placed. That a reader reads them is tested on pictures of labelled parts
// (python_codes_test.py).

#include "code_symbol.h"
#include "text_outline.h"

#include <gtest/gtest.h>
#include "text_support.h"

using namespace textlabel;

namespace {

constexpr CodeKind kKinds[] = {CodeKind::DataMatrix,  CodeKind::Gs1DataMatrix, CodeKind::QrCode,
                               CodeKind::MicroQrCode, CodeKind::Aztec,         CodeKind::Code128};

const char* SampleFor(CodeKind kind)
{
	return kind == CodeKind::Gs1DataMatrix ? "[01]09506000134352[21]0042" : "PN-0042";
}

TextOutline Made(CodeKind kind, const std::string& text, const std::function<void(TextOptions&)>& set = {})
{
	TextOptions options;
	options.code = kind;
	if (set) set(options);
	return MakeTextOutline(text, options);
}

TextError ErrorOf(CodeKind kind, const std::string& text, const std::function<void(TextOptions&)>& set = {})
{
	try {
		Made(kind, text, set);
	} catch (const TextError& error) {
		return error;
	}
	ADD_FAILURE() << "no error";
	return TextError(TextErrorCode::Unsound);
}

double AreaOf(const vcg::textlabel::Outline& outline)
{
	double area = 0;
	for (const auto& contour : outline.contours) area += vcg::textlabel::TwiceSignedArea(contour.points) / 2;
	return area;
}

int CountDark(const CodeSymbol& symbol)
{
	return static_cast<int>(std::count(symbol.dark.begin(), symbol.dark.end(), 1));
}

TEST(CodeSymbol, HasTheSizesOfItsStandard)
{
	const auto sizeOf = [](const std::string& text, CodeKind kind) {
		const CodeSymbol symbol = EncodeText(text, kind);
		EXPECT_EQ(symbol.dark.size(), static_cast<std::size_t>(symbol.rows * symbol.columns));
		return std::make_pair(symbol.rows, symbol.columns);
	};
	EXPECT_EQ(sizeOf("123456", CodeKind::DataMatrix), std::make_pair(10, 10));
	EXPECT_EQ(sizeOf("A1B2C3D4E5F6", CodeKind::DataMatrix), std::make_pair(16, 16))
		<< "square, though a rectangle would do";
	EXPECT_EQ(sizeOf("PN-0042", CodeKind::QrCode), std::make_pair(21, 21));
	EXPECT_EQ(sizeOf("12345", CodeKind::MicroQrCode), std::make_pair(11, 11));
	EXPECT_EQ(sizeOf("PN", CodeKind::Aztec), std::make_pair(15, 15));
	EXPECT_EQ(sizeOf("PN", CodeKind::Code128), std::make_pair(1, 11 * (1 + 2 + 1) + 13)) << "start, text, check, stop";
	EXPECT_EQ(sizeOf(std::string(2900, 'x'), CodeKind::QrCode), std::make_pair(177, 177)) << "too long for level M";
}

TEST(CodeSymbol, StartsAtTheUpperLeft)
{
	const CodeSymbol matrix = EncodeText("PN-0042", CodeKind::DataMatrix), qr = EncodeText("PN-0042", CodeKind::QrCode);
	for (int i = 0; i < matrix.rows; ++i) {
		EXPECT_TRUE(matrix.isDark(i, 0) && matrix.isDark(matrix.rows - 1, i)) << "solid on the left and below";
		EXPECT_EQ(matrix.isDark(0, i), i % 2 == 0) << "dashed above";
	}
	for (int i = 0; i < 7; ++i)
		EXPECT_TRUE(qr.isDark(i, 0) && qr.isDark(0, i) && qr.isDark(20 - i, 0) && qr.isDark(0, 20 - i));
	int dark = 0;
	for (int i = 14; i < 21; ++i) dark += qr.isDark(20, i) + qr.isDark(i, 20);
	EXPECT_LT(dark, 14) << "no finder pattern at the lower right";
}

TEST(CodeSymbol, EscapesAreWhatTheyStandFor)
{
	for (const CodeKind kind : {CodeKind::DataMatrix, CodeKind::QrCode}) {
		EXPECT_EQ(EncodeText("A\\nB", kind).dark, EncodeText("A\nB", kind).dark);
		EXPECT_NE(EncodeText("A\\\\nB", kind).dark, EncodeText("A\nB", kind).dark);
	}
}

TEST(CodeSymbol, SaysWhatCannotBeEncoded)
{
	const auto refused = [](const std::string& text, CodeKind kind) { return ErrorOf(kind, text); };
	for (const auto& [text, kind] : {std::pair{std::string(40, 'x'), CodeKind::MicroQrCode},
	                                 {std::string(3000, 'x'), CodeKind::QrCode},
	                                 {std::string(20000, 'x'), CodeKind::QrCode},
	                                 {std::string("漢字"), CodeKind::Code128},
	                                 {std::string("PN-0042"), CodeKind::Gs1DataMatrix}}) {
		const TextError error = refused(text, kind);
		EXPECT_EQ(error.code, TextErrorCode::BadCode);
		EXPECT_NE(Sentence(error).find(CodeName(kind)), std::string::npos) << Sentence(error);
		EXPECT_EQ(Sentence(error).find("Error"), std::string::npos) << Sentence(error);
	}
	EXPECT_EQ(refused(" \n ", CodeKind::QrCode).code, TextErrorCode::EmptyText);
	EXPECT_EQ(refused("\xff", CodeKind::QrCode).code, TextErrorCode::BadUtf8);
}

TEST(CodeOutline, IsSoundAndCoversItsDarkModules)
{
	for (const CodeKind kind : kKinds) {
		const CodeSymbol symbol = EncodeText(SampleFor(kind), kind);
		for (const bool mirrored : {false, true}) {
			const TextOutline code =
				Made(kind, SampleFor(kind), [&](TextOptions& o) { o.size = 22, o.mirrored = mirrored; });
			EXPECT_EQ(text_support::FlawOf(code.outline), "") << CodeName(kind);
			EXPECT_DOUBLE_EQ(code.module * symbol.height(), 22) << CodeName(kind);
			const double expected = CountDark(symbol) * code.module * code.module * symbol.rowHeight;
			EXPECT_NEAR(AreaOf(code.outline), expected, 2e-3 * expected) << CodeName(kind) << ": bridges are thin";
			EXPECT_TRUE(code.letters.empty() && code.fonts.empty());
		}
	}
}

/// How much of each module is covered, told by its middle.
bool CoversTheDarkModules(const TextOutline& code, const CodeSymbol& symbol, double side)
{
	for (int row = 0; row < symbol.rows; ++row)
		for (int column = 0; column < symbol.columns; ++column) {
			const vcg::Point2d p(side * (column + 0.5 - symbol.columns / 2.0) * code.module,
			                     (symbol.rows / 2.0 - row - 0.5) * symbol.rowHeight * code.module);
			bool inside = false;
			for (const auto& contour : code.outline.contours) inside ^= text_support::IsInside(p, contour.points);
			if (inside != symbol.isDark(row, column)) return false;
		}
	return true;
}

TEST(CodeOutline, HasEachModuleAtItsPlace)
{
	for (const CodeKind kind : kKinds) {
		const CodeSymbol symbol = EncodeText(SampleFor(kind), kind);
		for (const double embolden : {0.0, 0.1, -0.1})
			for (const bool mirrored : {false, true}) {
				const auto set = [&](TextOptions& o) {
					o.size = kind == CodeKind::Code128 ? 40 : 20, o.embolden = embolden, o.mirrored = mirrored;
				};
				EXPECT_TRUE(CoversTheDarkModules(Made(kind, SampleFor(kind), set), symbol, mirrored ? -1 : 1))
					<< CodeName(kind) << " " << embolden << mirrored;
			}
	}
}

TEST(CodeOutline, IsAnchoredAndFitted)
{
	const auto boxOf = [](Align align, Anchor anchor) {
		const TextOutline code =
			Made(CodeKind::QrCode, "PN-0042", [&](TextOptions& o) { o.size = 21, o.align = align, o.anchor = anchor; });
		return std::array<double, 4>{code.boxMin[0], code.boxMin[1], code.boxMax[0], code.boxMax[1]};
	};
	using Box = std::array<double, 4>;
	const auto isNear = [](const Box& a, const Box& b) {
		for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(a[i], b[i], 1e-6);
	};
	isNear(boxOf(Align::Center, Anchor::Middle), Box{-10.5, -10.5, 10.5, 10.5});
	isNear(boxOf(Align::Left, Anchor::Baseline), Box{0, 0, 21, 21});
	isNear(boxOf(Align::Right, Anchor::Top), Box{-21, -21, 0, 0});
	for (const double embolden : {0.0, 0.2, -0.2}) {
		const TextOutline fit = Made(CodeKind::DataMatrix, "123456",
		                             [&](TextOptions& o) { o.size = 3, o.fitWidth = 30, o.embolden = embolden; });
		EXPECT_NEAR(fit.boxMax[0] - fit.boxMin[0], 30, 1e-6);
		EXPECT_NEAR(fit.module, (30 - 2 * embolden) / 10, 1e-9);
	}
}

TEST(CodeOutline, IsCheckedByItsModules)
{
	const auto set = [](double minStroke, double minGap, double embolden, double size = 10) {
		return
			[=](TextOptions& o) { o.size = size, o.minStroke = minStroke, o.minGap = minGap, o.embolden = embolden; };
	};
	const TextOutline code = Made(CodeKind::DataMatrix, "123456", set(1, 1, 0));
	EXPECT_EQ(code.thinnestStroke.width, 1);
	EXPECT_EQ(code.narrowestGap.width, 1);
	EXPECT_EQ(code.thinnestStroke.letter, -1);
	EXPECT_NO_THROW(Made(CodeKind::DataMatrix, "123456", set(1.4, 0.6, 0.2)));
	const TextError thin = ErrorOf(CodeKind::DataMatrix, "123456", set(1.5, 0, 0)),
					tight = ErrorOf(CodeKind::DataMatrix, "123456", set(0, 1, 0.25));
	EXPECT_EQ(thin.code, TextErrorCode::TooThin);
	EXPECT_NEAR(thin.size, 15, 1e-9);
	EXPECT_NO_THROW(Made(CodeKind::DataMatrix, "123456", set(1.5, 0, 0, thin.size * (1 + 1e-9))));
	EXPECT_NE(Sentence(thin).find("dark modules"), std::string::npos) << Sentence(thin);
	EXPECT_NE(Sentence(tight).find("light modules"), std::string::npos) << Sentence(tight);
	for (const double embolden : {0.41, -0.41}) {
		const TextError fat = ErrorOf(CodeKind::DataMatrix, "123456", set(0, 0, embolden));
		EXPECT_EQ(fat.code, TextErrorCode::BadEmbolden);
		EXPECT_NEAR(fat.limit, 0.4, 1e-12);
	}
	EXPECT_EQ(ErrorOf(CodeKind::DataMatrix, "123456", set(0, 0, 0, -1)).code, TextErrorCode::BadSize);
	EXPECT_EQ(ErrorOf(CodeKind::DataMatrix, "1", [](TextOptions& o) { o.fitWidth = 1, o.embolden = 1; }).code,
	          TextErrorCode::BadSize);
}

}  // namespace
