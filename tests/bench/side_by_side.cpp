// Ours beside what a user would use instead: on the same part, with the same outline, in one run, in turn.
//
// usage: side_by_side [--sizes 10k,100k,1M,5M] [--turns 7] [--text TEXT]... [--style emboss|engrave] [--shuffled]
//                     [--peer-seconds 40] [--python PYTHON] [--folder FOLDER] [--output TABLE.md]
//
// Times are of the operation only, meshes in memory, medians: ours on MeshLab's mesh (float coordinates); the peers' boolean of
// part and prism from arrays to arrays, which is what a program pays that has a mesh of its own, and the boolean alone on what the
// peer calls a mesh. Not timed: making outline and prism, copying a mesh before a run, cropping and pasting back, judging. The
// peers' prism has flat ends, one below the label's lowest point and one above its highest, as a slicer embosses; ours has a top
// that follows the surface. All take turns, --turns of them, so that a noisy machine hits all alike; in a turn, what is short runs
// again and again for 20 ms, so that it is not timed on the caches of another. A peer that takes long has fewer turns
// (--peer-seconds for each row).
//
// Each result is judged in the same way: rounded to float32, equal points merged, then closed, manifold, oriented, no face without
// area, components and genus as before, and, up to 110,000 triangles, no two faces that cross (CGAL).
// Exit: 0; 1 when a result of ours is not valid; 2 wrong usage; 77 when no peer is there.

#include "bench_part.h"
#include "bench_solid.h"
#include "bench_text.h"
#include "ours.h"
#include "peer.h"
#include "side_by_side_table.h"

#include <cstdlib>
#include <functional>
#include <iostream>

namespace bench {
namespace {

struct Options {
	std::vector<int> sizes = {10000, 100000, 1000000, 5000000};
	std::vector<std::string> texts;
	int turns = 7;
	double peerSeconds = 40;
	bool engrave = false, shuffled = false;
	std::string python = "python3", folder = "/tmp", output;
};

/// What is timed, and for how long it may be.
struct Entrant {
	std::function<double()> run;
	Series* series;
	double budget = std::numeric_limits<double>::infinity();  ///< seconds
	int turns = 0;                                            ///< that it has had

	bool isRefused() const { return !series->seconds.empty() && series->seconds.back() < 0; }
	bool isDone(int most) const { return isRefused() || turns >= most || (turns > 0 && series->sum() >= budget); }
	void takeTurn()
	{
		constexpr double least = 0.02;  // seconds
		for (double sum = 0; sum < least && !isRefused(); sum += series->seconds.back())
			series->seconds.push_back(run());
		++turns;
	}
};

int ToNumber(const std::string& text)
{
	const double factor = text.back() == 'M' ? 1e6 : text.back() == 'k' ? 1e3 : 1;
	return int(std::atof(text.c_str()) * factor);
}

class SideBySide {
public:
	SideBySide(const Options& options, std::vector<std::unique_ptr<Peer>>& peers) : options_(options), peers_(peers) {}

	Row run(int triangles, const std::string& text)
	{
		constexpr double height = 1, margin = 0.5;  // units
		const auto outline = textlabel::MakeTextOutline(text, TextSize(text)).outline;
		const LabelFrame frame = FrameOnCushion();
		const LabelSpace space(frame);
		IndexedMesh part = MakeCushion(triangles);
		if (options_.shuffled) part = Shuffled(part);
		const Crop crop(space, part, BoxOf(outline));
		const double low = crop.lowest() - margin, high = crop.highest() + margin, floor = low - 4 * margin;
		const IndexedMesh cropped = crop.solid(space, floor);
		const IndexedMesh prism = options_.engrave ? MakePrism(space, outline, low - height, high)
		                                           : MakePrism(space, outline, low, high + height);
		Row row;
		row.triangles = int(part.faces.size());
		row.text = text;
		row.underBox = crop.triangles();
		Ours ours(part, outline, frame, options_.engrave ? -height : height);
		entrants_ = {{[&] { return ours.label(nullptr); }, &row.ours},
		             {[&] { return ours.labelWithoutRoom(); }, &row.oursFirst},
		             {[&] { return ours.pass(); }, &row.pass},
		             {[&] { return ours.copy(); }, &row.copy}};
		row.peers.resize(peers_.size() / 2);
		for (size_t i = 0; i < row.peers.size(); ++i) addPeer(i, part, cropped, prism, row.peers[i]);
		judge(ours, part, cropped, row);
		race();
		return row;
	}

private:
	Operation operation() const { return options_.engrave ? Operation::Difference : Operation::Union; }

	void addPeer(size_t i, const IndexedMesh& part, const IndexedMesh& cropped, const IndexedMesh& prism,
	             PeerTimes& times)
	{
		Peer &whole = *peers_[2 * i], &local = *peers_[2 * i + 1];
		whole.load(part, prism);
		local.load(cropped, prism);
		const Operation what = operation();
		const double budget = options_.peerSeconds;
		times.name = whole.about();
		entrants_.push_back({[&whole, what] { return whole.run(what); }, &times.whole, budget});
		entrants_.push_back({[&whole, what] { return whole.runAlone(what, nullptr); }, &times.wholeAlone, budget});
		entrants_.push_back({[&local, what] { return local.run(what); }, &times.cropped, budget});
		entrants_.push_back({[&local, what] { return local.runAlone(what, nullptr); }, &times.croppedAlone, budget});
	}

	/// One run of each that is not timed, for its result; it also warms up.
	void judge(Ours& ours, const IndexedMesh& original, const IndexedMesh& cropped, Row& row)
	{
		const Judge whole(original), local(cropped);
		IndexedMesh result;
		ours.label(&result);
		row.valid = whole.verdict(result);
		for (size_t i = 0; i < row.peers.size(); ++i) {
			PeerTimes& times = row.peers[i];
			Peer &all = *peers_[2 * i], &part = *peers_[2 * i + 1];
			times.wholeAlone.valid = all.runAlone(operation(), &result) < 0 ? "refused" : whole.verdict(result);
			times.croppedAlone.valid = part.runAlone(operation(), &result) < 0 ? "refused" : local.verdict(result);
		}
	}

	void race()
	{
		for (bool any = true; any;) {
			any = false;
			for (Entrant& e : entrants_) {
				if (e.isDone(options_.turns)) continue;
				any = true;
				e.takeTurn();
			}
		}
	}

	const Options& options_;
	std::vector<std::unique_ptr<Peer>>& peers_;  ///< each twice: for the whole part, for the cropped one
	std::vector<Entrant> entrants_;
};

bool Read(int count, char** words, Options& options)
{
	for (int i = 1; i < count; ++i) {
		const std::string name = words[i];
		if (name == "--shuffled") {
			options.shuffled = true;
			continue;
		}
		if (++i == count) return false;
		const std::string value = words[i];
		if (name == "--sizes") {
			options.sizes.clear();
			std::istringstream in(value);
			for (std::string size; std::getline(in, size, ',');) options.sizes.push_back(ToNumber(size));
		} else if (name == "--turns") options.turns = std::atoi(value.c_str());
		else if (name == "--text") options.texts.push_back(value);
		else if (name == "--style") options.engrave = value == "engrave";
		else if (name == "--peer-seconds") options.peerSeconds = std::atof(value.c_str());
		else if (name == "--python") options.python = value;
		else if (name == "--folder") options.folder = value;
		else if (name == "--output") options.output = value;
		else return false;
	}
	if (options.texts.empty()) options.texts = {"A43", "SN-0123456789 gqy%&@"};
	return options.turns > 0;
}

int Run(const Options& options)
{
	std::vector<std::unique_ptr<Peer>> peers;
	const auto add = [&](const std::function<std::unique_ptr<Peer>()>& make) {
		auto whole = make(), cropped = make();
		if (!whole) return;
		peers.push_back(std::move(whole));
		peers.push_back(std::move(cropped));
	};
	add([&] { return MakeManifold(options.python, options.folder); });
	add([] { return MakeCgal(); });
	if (peers.empty()) return std::cerr << "side_by_side: neither manifold3d nor CGAL is there\n", 77;

	std::vector<Row> rows;
	SideBySide race(options, peers);
	for (const std::string& text : options.texts)
		for (const int size : options.sizes) {
			rows.push_back(race.run(size, text));
			std::cerr << ToText(rows.back());
		}
	const std::string table = ToMarkdown(rows);
	std::cout << table;
	if (!options.output.empty()) std::ofstream(options.output) << table;
	for (const Row& row : rows)
		if (row.valid != "yes") return 1;
	return 0;
}

}  // namespace
}  // namespace bench

int main(int count, char** words)
{
	bench::Options options;
	if (!bench::Read(count, words, options)) return std::cerr << "side_by_side: see the head of side_by_side.cpp\n", 2;
	try {
		return bench::Run(options);
	} catch (const std::exception& e) {
		std::cerr << "side_by_side: " << e.what() << '\n';
		return 1;
	}
}
