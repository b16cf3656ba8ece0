// label_memory: the most memory that a label needs beside the mesh itself, in bytes and in percent of the mesh's arrays.
//
//   label_memory [TRIANGLES]     default 1000000
//
// Two measures: what the program has asked for (operator new, counted), and what the process has got from the system (VmHWM of
// Linux, reset before the label). Two cases: vectors with room for the label, as after a part's first label, and vectors without,
// which then move; there the second measure is the one that matters, since moved pages are given back as they are copied.

#include "stages.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <malloc.h>
#include <new>

namespace {

std::atomic<size_t> liveBytes{0}, peakBytes{0};

void* Allocate(size_t size)
{
	void* p = std::malloc(size == 0 ? 1 : size);
	if (!p) throw std::bad_alloc();
	const size_t live = liveBytes += malloc_usable_size(p);
	for (size_t peak = peakBytes; peak < live && !peakBytes.compare_exchange_weak(peak, live);) {}
	return p;
}

void Free(void* p)
{
	if (p) liveBytes -= malloc_usable_size(p);
	std::free(p);
}

}  // namespace

void* operator new(std::size_t size) { return Allocate(size); }
void* operator new[](std::size_t size) { return Allocate(size); }
void operator delete(void* p) noexcept { Free(p); }
void operator delete[](void* p) noexcept { Free(p); }
void operator delete(void* p, std::size_t) noexcept { Free(p); }
void operator delete[](void* p, std::size_t) noexcept { Free(p); }

namespace bench {
namespace {

/// A line of /proc/self/status, in bytes.
double Status(const std::string& name)
{
	std::ifstream in("/proc/self/status");
	for (std::string word; in >> word;)
		if (word == name + ":") {
			double kilobytes = 0;
			in >> kilobytes;
			return 1024 * kilobytes;
		}
	return 0;
}

void Measure(const char* text, const IndexedMesh& part, bool room)
{
	const Outline outline = textlabel::MakeTextOutline(text, TextSize(text)).outline;
	constexpr size_t extra = 400000;  // more than any label here needs
	CMeshO mesh;
	ReserveMesh(mesh, part.positions.size() + (room ? extra : 0), part.faces.size() + (room ? extra : 0));
	FillMesh(mesh, part);
	const double own = double(mesh.vert.size() * sizeof mesh.vert[0] + mesh.face.size() * sizeof mesh.face[0]);
	vcg::textlabel::LabelOptions options;
	options.height = 1;
	malloc_trim(0);  // freed pages that stay would hide what is asked for next
	std::ofstream("/proc/self/clear_refs") << "5";
	const double resident = Status("VmRSS");
	const size_t live = liveBytes;
	peakBytes = live;
	vcg::textlabel::LabelMesh(mesh, outline, FrameOnCushion(), options);
	const double asked = double(peakBytes - live), got = Status("VmHWM") - resident;
	std::printf("| %s | %s | %.1f MB | %.2f MB | %.1f %% | %.2f MB | %.1f %% |\n", text, room ? "yes" : "no", own / 1e6,
	            asked / 1e6, 100 * asked / own, got / 1e6, 100 * got / own);
}

}  // namespace
}  // namespace bench

int main(int count, char** words)
{
	const bench::IndexedMesh part = bench::MakeCushion(count > 1 ? std::atof(words[1]) : 1e6);
	std::printf("%zu triangles\n\n| label | room | mesh | asked for | of it | from the system | of it |\n"
	            "|---|---|--:|--:|--:|--:|--:|\n",
	            part.faces.size());
	for (const char* text : {"A43", "SN-0123456789 gqy%&@"})
		for (const bool room : {true, false}) bench::Measure(text, part, room);
}
