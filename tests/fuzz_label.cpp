// Fuzz target: whole labels, every choice of the generators steered by the input's bytes.
//
//   tests/fuzz.sh label -max_total_time=600 -max_len=4000
//
// A failing input prints its case in the text form of tests/corpus/labels/.

#include "fuzz_label_judge.h"
#include "random_label.h"

#include <cstdlib>
#include <iostream>

using namespace vcg::textlabel::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size)
{
	Random random(data, size);
	LabelCase c = MakeLabelCase(random);
	const Verdict v = Judge(c);
	if (v.good() || v.faultClass() == "refusal") return 0;
	c.comment = v.fault;
	Write(std::cerr, c);
	std::abort();
}
