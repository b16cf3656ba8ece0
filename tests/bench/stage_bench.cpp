// textlabel_bench: the operation split into its stages, by Google Benchmark.
//
// On closed cushions of 10k, 100k, 1M and 10M triangles, uniformly fine (a few hundred to some hundred thousand triangles under the
// label), with a short and a long text. A stage's name is stage/text/triangles:
//   outline    text to contours
//   sheet      the linear pass, and how the candidates hang together
//   seeds      where contours start
//   march      contours laid on the surface
//   cut        the march again, then the contour walk and the tessellation
//   layer      whether the candidates lie once over the label
//   clearance  what is in front and behind
//   raise      tops and walls
//   check      the proof on rounded coordinates
//   commit     written into the mesh
//   label      all of it (LabelMesh)
//   wrapped    all of the same label, wrapped round an axis in the part
//   pass       the limit: one bare linear pass over vertices and faces
//
//   textlabel_bench --benchmark_filter='.*/short/1000000$'

#include "stages.h"

#include <benchmark/benchmark.h>
#include <functional>
#include <memory>

namespace bench {
namespace {

const std::string& TextOf(bool isLong)
{
	static const std::string shortText = "A43", longText = "SN-0123456789 gqy%&@";
	return isLong ? longText : shortText;
}

Outline OutlineOf(bool isLong) { return textlabel::MakeTextOutline(TextOf(isLong), TextSize(TextOf(isLong))).outline; }

/// The stages of a part and a text; only the last is kept, parts are large.
Stages& StagesOf(int triangles, bool isLong)
{
	static std::pair<int, bool> key;
	static IndexedMesh part;
	static std::unique_ptr<Stages> stages;
	if (!stages || key != std::make_pair(triangles, isLong)) {
		stages = nullptr;
		part = MakeCushion(triangles);
		stages = std::make_unique<Stages>(part, OutlineOf(isLong));
		key = {triangles, isLong};
	}
	return *stages;
}

using Stage = std::function<void(Stages&)>;

void RunStage(benchmark::State& state, int triangles, bool isLong, const Stage& stage, bool changesMesh)
{
	Stages& stages = StagesOf(triangles, isLong);
	for (auto _ : state) {
		stage(stages);
		if (!changesMesh) continue;
		state.PauseTiming();
		stages.restore();
		state.ResumeTiming();
	}
	state.counters["candidates"] = double(stages.candidates());
	state.counters["crossings"] = double(stages.crossings());
	state.counters["faces"] = double(stages.faces());
}

template <class Result>
Stage Kept(Result (Stages::*stage)() const)
{
	return [stage](Stages& s) { benchmark::DoNotOptimize((s.*stage)()); };
}

void Register()
{
	const std::vector<std::pair<std::string, Stage>> reading = {
		{"pass", [](Stages& s) { benchmark::DoNotOptimize(s.pass()); }},
		{"sheet", Kept(&Stages::sheet)},
		{"seeds", Kept(&Stages::seeds)},
		{"march", Kept(&Stages::march)},
		{"cut", Kept(&Stages::cut)},
		{"layer", Kept(&Stages::layer)},
		{"clearance", Kept(&Stages::clearance)},
		{"raise", Kept(&Stages::raise)},
		{"check", Kept(&Stages::check)}};
	const std::vector<std::pair<std::string, Stage>> writing = {
		{"commit", [](Stages& s) { benchmark::DoNotOptimize(s.commit()); }},
		{"label", [](Stages& s) { benchmark::DoNotOptimize(s.label()); }},
		{"wrapped", [](Stages& s) { benchmark::DoNotOptimize(s.wrapped()); }}};
	for (const bool isLong : {false, true}) {
		const std::string text = isLong ? "/long" : "/short";
		benchmark::RegisterBenchmark(("outline" + text).c_str(), [isLong](benchmark::State& state) {
			for (auto _ : state) benchmark::DoNotOptimize(OutlineOf(isLong));
		})->Unit(benchmark::kMillisecond);
		for (const int triangles : {10000, 100000, 1000000, 10000000}) {
			const auto add = [&](const std::string& name, const Stage& stage, bool changesMesh) {
				const std::string full = name + text + "/" + std::to_string(triangles);
				benchmark::RegisterBenchmark(full.c_str(), [=](benchmark::State& state) {
					RunStage(state, triangles, isLong, stage, changesMesh);
				})->Unit(benchmark::kMillisecond);
			};
			for (const auto& [name, stage] : reading) add(name, stage, false);
			for (const auto& [name, stage] : writing) add(name, stage, true);
		}
	}
}

}  // namespace
}  // namespace bench

int main(int count, char** words)
{
	bench::Register();
	benchmark::Initialize(&count, words);
	if (benchmark::ReportUnrecognizedArguments(count, words)) return 2;
	benchmark::RunSpecifiedBenchmarks();
	return 0;
}
