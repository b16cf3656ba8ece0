// label_fuzz: labels by the thousand, each judged; the long run of the fuzzer.
//
// usage: label_fuzz [--labels N] [--seed S] [--jobs J] [--seconds LIMIT] [--keep FOLDER]
//                   [--family clean|spoiled|hostile|wrapped]
//        label_fuzz --show SEED        print the case of a seed and its verdict
//        label_fuzz [--reduce] FILE... judge cases in text form; reduce them to FILE.small
//
// Case i of a run is made from seed S + i alone. Cases run in processes of their own, so that a crash or a hang is
// a finding and not the end. Findings are written to FOLDER as cases in text form.
// Exit: 0; 1 when there is a finding; 2 wrong usage.

#include "fuzz_label_judge.h"
#include "fuzz_label_reduce.h"
#include "random_wrapped_label.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <signal.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace vcg::textlabel;
using namespace vcg::textlabel::test;

namespace {

struct Arguments {
	long labels = 10000, seed = 1, jobs = 1, seconds = 20, show = -1;
	std::string keep, family;
	bool reduce = false;
	std::vector<std::string> files;
};

LabelCase CaseOf(const Arguments& a, long seed)
{
	Random random{std::uint64_t(seed)};
	if (a.family == "clean") return MakeCleanLabel(random);
	if (a.family == "spoiled") return MakeSpoiledLabel(random);
	if (a.family == "wrapped") return MakeWrappedLabel(random);
	return a.family == "hostile" ? MakeHostileLabel(random) : MakeLabelCase(random);
}

constexpr int mostOutcomes = 64, nameLength = 120;

/// What the processes share.
struct Board {
	struct Outcome {
		char name[nameLength];
		long count;
		long firstSeed;
	};
	struct Worker {
		long seed;  ///< being judged
		long next;  ///< first seed not yet begun
		Outcome outcomes[mostOutcomes];
		double slowest;
		long slowestSeed;
	};
	Worker workers[64];
};

double Now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

void Count(Board::Worker& w, const std::string& name, long seed)
{
	for (Board::Outcome& o : w.outcomes) {
		if (o.count == 0) {
			std::snprintf(o.name, nameLength, "%s", name.c_str());
			o.firstSeed = seed;
		}
		if (name.substr(0, nameLength - 1) != o.name) continue;
		++o.count;
		return;
	}
}

const char* CodeName(ErrorCode code)
{
	constexpr const char* names[] = {
		"EmptyLabel", "BadContour", "BadFrame",   "BadHeight",   "EmptyMesh",  "TooLarge",     "OffSurface",
		"FacesAway",  "Border",     "Silhouette", "NonManifold", "Occluded",   "BehindCamera", "TooLong",
		"Grazing",    "Squeezed",   "TooFine",    "HitsSurface", "HitsItself", "Cancelled",    "OutOfMemory"};
	static_assert(std::size(names) == size_t(ErrorCode::OutOfMemory) + 1);
	return names[int(code)];
}

std::string OutcomeName(const LabelCase& c, const Verdict& v)
{
	const std::string family = c.family + std::string(c.family.size() < 8 ? 8 - c.family.size() : 0, ' ');
	const std::string refusal = v.refused ? std::string(CodeName(v.code)) + ": " + v.message : "";
	if (!v.good()) return family + "FAULT " + v.faultClass() + (v.refused ? " " + refusal : "");
	return family + (v.refused       ? "refused " + refusal
	                 : c.height == 0 ? "valid flat"
	                 : c.height > 0  ? "valid raised"
	                                 : "valid sunk");
}

void Keep(const Arguments& a, long seed, const std::string& fault)
{
	std::printf("seed %ld: %s\n", seed, fault.c_str());
	std::fflush(stdout);
	if (a.keep.empty()) return;
	LabelCase c = CaseOf(a, seed);
	c.comment = "seed " + std::to_string(seed) + "\n" + fault + "\n";
	std::ofstream out(a.keep + "/" + std::to_string(seed) + ".label");
	Write(out, c);
}

/// Let the process be killed when it takes more than so many seconds of processor time from now on.
void LimitTime(long seconds)
{
	const itimerval limit = {{0, 0}, {seconds, 0}};
	setitimer(ITIMER_PROF, &limit, nullptr);
}

void Work(const Arguments& a, Board::Worker& w, long stride, long end)
{
	for (; w.next < end;) {
		w.seed = w.next;
		w.next += stride;
		const double started = Now();
		LimitTime(a.seconds);
		const LabelCase c = CaseOf(a, w.seed);
		const Verdict v = Judge(c);
		Count(w, OutcomeName(c, v), w.seed);
		if (!v.good()) Keep(a, w.seed, v.fault);
		const double took = Now() - started;
		if (took > w.slowest) w.slowest = took, w.slowestSeed = w.seed;
	}
}

/// @return 1 when there are faults
int PrintTable(const Arguments& a, const Board& board, double seconds)
{
	std::map<std::string, std::pair<long, long>> table;
	long faults = 0, total = 0;
	double slowest = 0;
	long slowestSeed = 0;
	for (long j = 0; j < a.jobs; ++j) {
		const Board::Worker& w = board.workers[j];
		for (const Board::Outcome& o : w.outcomes) {
			if (o.count == 0) continue;
			auto& row = table.emplace(o.name, std::make_pair(0L, o.firstSeed)).first->second;
			row.first += o.count;
			row.second = std::min(row.second, o.firstSeed);
			total += o.count;
			if (std::string(o.name).find("FAULT") != std::string::npos) faults += o.count;
		}
		if (w.slowest > slowest) slowest = w.slowest, slowestSeed = w.slowestSeed;
	}
	std::printf("\n%10s  %-10s  outcome\n", "count", "first seed");
	for (const auto& [name, row] : table) std::printf("%10ld  %-10ld  %s\n", row.first, row.second, name.c_str());
	std::printf("%10ld  labels in %.1f s, %.0f a second; slowest %.2f s (seed %ld); %ld faults\n", total, seconds,
	            double(total) / (seconds), slowest, slowestSeed, faults);
	return faults > 0;
}

int Run(const Arguments& a)
{
	Board* board =
		static_cast<Board*>(mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
	const double begin = Now();
	std::vector<pid_t> process(size_t(a.jobs), 0);
	std::vector<char> done(size_t(a.jobs), 0);
	const auto start = [&](long j) {
		std::fflush(stdout);
		process[size_t(j)] = fork();
		if (process[size_t(j)] != 0) return;
		Work(a, board->workers[j], a.jobs, a.seed + a.labels);
		std::fflush(stdout);
		_exit(0);
	};
	for (long j = 0; j < a.jobs; ++j) {
		board->workers[j].next = a.seed + j;
		start(j);
	}
	for (long left = a.jobs; left > 0;) {
		usleep(20000);
		for (long j = 0; j < a.jobs; ++j) {
			Board::Worker& w = board->workers[j];
			if (done[size_t(j)]) continue;
			int status = 0;
			if (waitpid(process[size_t(j)], &status, WNOHANG) == 0) continue;
			if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
				done[size_t(j)] = 1;
				--left;
				continue;
			}
			const bool hangs = WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF;
			const std::string fault = hangs ? "hang: stopped" : "crash: signal or exit " + std::to_string(status);
			Count(w, "FAULT " + fault, w.seed);
			Keep(a, w.seed, fault);
			start(j);
		}
	}
	return PrintTable(a, *board, Now() - begin);
}

int Show(const LabelCase& c, const std::string& name)
{
	const Verdict v = Judge(c);
	std::printf(
		"%s: %s%s%s (vertices %zu, faces %zu, contours %zu, height %g, along %s, value %g, limit %g, attempts %d)\n",
		name.c_str(), OutcomeName(c, v).c_str(), v.good() ? "" : "; ", v.fault.c_str(), c.mesh.vertices.size(),
		c.mesh.faces.size(), c.outline.contours.size(), c.height, test::Name(c.along), v.value, v.limit,
		v.result.attempts);
	return !v.good();
}

/// The fault of a case, found in a process of its own; a crash and a hang have names as well.
std::string FaultOf(const Arguments& a, const LabelCase& c)
{
	int ends[2];
	if (pipe(ends) != 0) throw std::runtime_error("pipe");
	const pid_t child = fork();
	if (child == 0) {
		LimitTime(a.seconds);
		const Verdict v = Judge(c);
		const std::string fault = v.good() ? "" : v.faultClass() + (v.refused ? " " + v.message : "");
		_exit(write(ends[1], fault.data(), fault.size()) == ssize_t(fault.size()) ? 0 : 1);
	}
	close(ends[1]);
	char text[256];
	const ssize_t length = read(ends[0], text, sizeof(text));
	close(ends[0]);
	int status = 0;
	waitpid(child, &status, 0);
	return WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
	                           : std::string(text, size_t(std::max<ssize_t>(length, 0)));
}

void ReduceFile(const Arguments& a, const LabelCase& c, const std::string& file)
{
	const std::string fault = FaultOf(a, c);
	if (fault.empty()) return;
	std::ofstream out(file + ".small");
	Write(out, Reduce(
				   c, [&](const LabelCase& k) { return FaultOf(a, k) == fault; }, c.mustWork));
}

}  // namespace

int main(int count, char** values)
{
	Arguments a;
	for (int i = 1; i < count; ++i) {
		const std::string name = values[i];
		const auto number = [&] { return i + 1 < count ? std::atol(values[++i]) : 0; };
		if (name == "--labels") a.labels = number();
		else if (name == "--seed") a.seed = number();
		else if (name == "--jobs") a.jobs = std::clamp(number(), 1L, 64L);
		else if (name == "--seconds") a.seconds = number();
		else if (name == "--keep") a.keep = i + 1 < count ? values[++i] : "";
		else if (name == "--family") a.family = i + 1 < count ? values[++i] : "";
		else if (name == "--show") a.show = number();
		else if (name == "--reduce") a.reduce = true;
		else if (name.rfind("-", 0) != 0 && std::ifstream(name)) a.files.push_back(name);
		else {
			std::cerr << "label_fuzz: no such option or file '" << name << "'; its source begins with the usage.\n";
			return 2;
		}
	}
	if (a.show >= 0) {
		Write(std::cout, CaseOf(a, a.show));
		std::cout << "# ";
		std::cout.flush();
		return Show(CaseOf(a, a.show), "seed " + std::to_string(a.show));
	}
	int faults = 0;
	for (const std::string& file : a.files) {
		std::ifstream in(file);
		const LabelCase c = ReadLabelCase(in);
		if (a.reduce) ReduceFile(a, c, file);
		else faults += Show(c, file);
	}
	return a.files.empty() ? Run(a) : faults > 0;
}
