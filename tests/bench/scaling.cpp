// label_scaling: how the time of a label grows, with exponents fitted by least squares on the logarithms.
//
//   label_scaling [--runs 9] [away|finer|letters]...
//
//   away     the part grows beside the label: the same triangles under it, the same label, another shell of up to 10M triangles
//   finer    the mesh gets finer, also under the label
//   letters  from 1 to 200 letters on the same part
//
// Times are of LabelMesh, medians, in milliseconds, on vectors that have room.

#include "stages.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>

namespace bench {
namespace {

/// Median seconds of `runs` runs.
double Median(int runs, const std::function<void()>& timed, const std::function<void()>& after)
{
	std::vector<double> seconds;
	for (int i = 0; i < runs; ++i) {
		const auto start = std::chrono::steady_clock::now();
		timed();
		seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
		after();
	}
	std::sort(seconds.begin(), seconds.end());
	return seconds[seconds.size() / 2];
}

struct Cost {
	double label = 0, pass = 0;  ///< milliseconds
	double crossings = 0, faces = 0;

	double local() const { return label - pass; }
};

Cost Measure(const IndexedMesh& part, const Outline& outline, int runs)
{
	Stages stages(part, outline);
	Cost cost;
	stages.label();
	stages.restore();
	cost.label = 1000 * Median(
							runs, [&] { stages.label(); }, [&] { stages.restore(); });
	cost.pass = 1000 * Median(
						   runs, [&] { stages.pass(); }, [] {});
	cost.crossings = double(stages.crossings());
	cost.faces = double(stages.faces());
	return cost;
}

/// Slope of y over x on logarithms, least squares.
double Exponent(const std::vector<double>& x, const std::vector<double>& y)
{
	const double n = double(x.size());
	double sx = 0, sy = 0, sxx = 0, sxy = 0;
	for (size_t i = 0; i < x.size(); ++i) {
		const double a = std::log(x[i]), b = std::log(y[i]);
		sx += a;
		sy += b;
		sxx += a * a;
		sxy += a * b;
	}
	return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Outline OutlineOf(const std::string& text, double size)
{
	textlabel::TextOptions options = TextSize("");
	options.size = size;
	return textlabel::MakeTextOutline(text, options).outline;
}

void Away(int runs)
{
	constexpr double apart = 200, labelled = 10000;  // units; triangles
	std::printf("| triangles | label | bare pass | more than on %.0f, in passes |\n|--:|--:|--:|--:|\n", labelled);
	const IndexedMesh under = MakeCushion(labelled);
	double first = 0;
	for (const double triangles : {1e4, 1e5, 1e6, 1e7}) {
		const IndexedMesh part = triangles > labelled ? Beside(under, MakeCushion(triangles - labelled), apart) : under;
		const Cost cost = Measure(part, OutlineOf("A43", 10), runs);
		if (first == 0) first = cost.label;
		std::printf("| %zu | %.3f | %.3f | %.2f |\n", part.faces.size(), cost.label, cost.pass,
		            (cost.label - first) / cost.pass);
	}
}

void Finer(int runs)
{
	std::vector<double> crossings, faces, local;
	std::printf(
		"| triangles | crossings | new faces | label | bare pass | label without it |\n|--:|--:|--:|--:|--:|--:|\n");
	for (const double triangles : {1e4, 3e4, 1e5, 3e5, 1e6, 3e6}) {
		const IndexedMesh part = MakeCushion(triangles);
		const Cost cost = Measure(part, OutlineOf("A43", 10), runs);
		std::printf("| %zu | %.0f | %.0f | %.3f | %.3f | %.3f |\n", part.faces.size(), cost.crossings, cost.faces,
		            cost.label, cost.pass, cost.local());
		crossings.push_back(cost.crossings);
		faces.push_back(cost.faces);
		local.push_back(cost.local());
	}
	std::vector<double> logged;
	for (const double n : crossings) logged.push_back(n * std::log(n));
	std::printf(
		"\nTime without the pass grows as crossings^%.2f (n log n over this range: ^%.2f), as new faces^%.2f.\n",
		Exponent(crossings, local), Exponent(crossings, logged), Exponent(faces, local));
}

void Letters(int runs)
{
	constexpr int most = 200, perLine = 20;
	constexpr double size = 2;  // units
	const std::string alphabet = "ABCDEFGHJKLMNPQRSTUVWXYZ0123456789";
	const IndexedMesh part = MakeCushion(100000);
	std::vector<double> letters, local;
	std::printf("| letters | crossings | label | bare pass | label without it |\n|--:|--:|--:|--:|--:|\n");
	for (const int count : {1, 2, 5, 10, 20, 50, 100, most}) {
		std::string text;
		for (int i = 0; i < count; ++i) {
			if (i > 0 && i % perLine == 0) text += '\n';
			text += alphabet[size_t(i) % alphabet.size()];
		}
		const Cost cost = Measure(part, OutlineOf(text, size), runs);
		std::printf("| %d | %.0f | %.3f | %.3f | %.3f |\n", count, cost.crossings, cost.label, cost.pass, cost.local());
		letters.push_back(count);
		local.push_back(cost.local());
	}
	std::printf("\nTime without the pass grows as letters^%.2f, from 20 letters on as letters^%.2f.\n",
	            Exponent(letters, local),
	            Exponent({letters.begin() + 4, letters.end()}, {local.begin() + 4, local.end()}));
}

}  // namespace
}  // namespace bench

int main(int count, char** words)
{
	int runs = 9;
	std::vector<std::string> what;
	for (int i = 1; i < count; ++i) {
		const std::string word = words[i];
		if (word == "--runs" && i + 1 < count) runs = std::max(1, std::atoi(words[++i]));
		else what.push_back(word);
	}
	if (what.empty()) what = {"away", "finer", "letters"};
	for (const std::string& word : what) {
		if (word == "away") bench::Away(runs);
		else if (word == "finer") bench::Finer(runs);
		else if (word == "letters") bench::Letters(runs);
		else return std::fprintf(stderr, "label_scaling: see the head of scaling.cpp\n"), 2;
		std::printf("\n");
	}
}
