// Fuzz target: any bytes as an SVG file, from the file to the checked outline.
//
//   tests/fuzz.sh drawing -max_total_time=600 -max_len=4000 -rss_limit_mb=4096
//
// Small drawings make good seeds, as icons are: build/fuzz/corpus-drawing/NAME.svg.

#include <cstdio>
#include <string>
#include "memory_file.h"
#include "text_outline.h"
#include "text_support.h"

using namespace textlabel;

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
	if (size == 0) return 0;
	const MemoryFile file(data, size);
	TextOptions options;
	options.drawing = file.path();
	options.tolerance = 0.02;  // coarse is quick
	try {
		const std::string flaw = text_support::FlawOf(MakeTextOutline("", options).outline);
		if (!flaw.empty()) {
			std::fprintf(stderr, "%s\n", flaw.c_str());
			std::abort();
		}
	} catch (const TextError& e) {
		if (Sentence(e).empty()) std::abort();
	}
	return 0;
}
