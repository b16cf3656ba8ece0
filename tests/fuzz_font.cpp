// Fuzz target: any bytes as a font file, from opening it to the checked outline of a text. Also any bytes as the text.
//
//   tests/fuzz.sh font -max_total_time=600 -max_len=20000 -rss_limit_mb=4096
//
// Small fonts make good seeds: hb-subset --unicodes=41,34,33 --output-file=build/fuzz/corpus-font/seed FONT, with a
// byte of your choice put in front (it selects the text and the options).

#include <cstdio>
#include <cstdlib>
#include <string>
#include "memory_file.h"
#include "text_outline.h"
#include "text_support.h"

using namespace textlabel;

namespace {

const char* const kTexts[] = {"A43", "fi\\nÅ é 1/2", "سلام 12", "नमस्ते", "x\tA\u0301", "文字"};

void Set(const std::string& text, const TextOptions& options)
{
	try {
		const std::string flaw = text_support::FlawOf(MakeTextOutline(text, options).outline);
		if (!flaw.empty()) {
			std::fprintf(stderr, "%s\n", flaw.c_str());
			std::abort();
		}
	} catch (const TextError& e) {
		if (Sentence(e).empty()) std::abort();
	}
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
	if (size < 2) return 0;
	const unsigned char choice = data[0];
	constexpr unsigned kTextCount = sizeof kTexts / sizeof *kTexts;
	TextOptions options;
	if (choice == 0) {
		Set(std::string(reinterpret_cast<const char*>(data + 1), size - 1), options);
		return 0;
	}
	const MemoryFile file(data + 1, size - 1);
	options.font = file.path() + (choice & 0x80 ? ":wght=650" : "");
	if (choice & 0x40) options.embolden = 0.3;
	if (choice & 0x20) options.tolerance = 0.5;
	Set(kTexts[choice % kTextCount], options);
	return 0;
}
