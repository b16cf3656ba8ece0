#pragma once
// A linear pass over a large array on all cores. What the chunks find is put together in their order, so that the result does not
// depend on how many there are.

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <thread>

namespace vcg::textlabel {

/// The fewest elements that a chunk is worth starting a thread for. Only tests set it smaller, to see many chunks on a small mesh.
inline size_t leastChunk = 150000;

constexpr size_t kMostChunks = 16;

/// How many chunks a pass over `count` elements is worth: one thread's start costs as much as reading some ten thousands,
/// and more where the other cores are busy.
inline size_t ChunkCount(size_t count)
{
	const size_t most = std::min<size_t>(count / leastChunk, kMostChunks);
	if (most <= 1) return 1;  // to count the cores, glibc reads a file
	return std::clamp<size_t>(std::thread::hardware_concurrency(), 1, most);
}

/// Call work(chunk, first, last) for each of `chunks` ranges of 0 .. count-1, at the same time where threads can be had.
/// It fails only where the work does: without memory or threads, all is done by the caller's.
/// @param[in] chunks  1 .. kMostChunks
/// @throws what the first chunk that failed has thrown, after all have ended
template <class Work>
void EachChunk(size_t count, size_t chunks, const Work& work)
{
	std::array<std::exception_ptr, kMostChunks> failed;
	const auto run = [&](size_t chunk) {
		try {
			work(chunk, count * chunk / chunks, count * (chunk + 1) / chunks);
		} catch (...) {
			failed[chunk] = std::current_exception();
		}
	};
	std::array<std::thread, kMostChunks> threads;
	size_t started = 1;  // chunk 0 is for this thread
	try {
		for (; started < chunks; ++started) threads[started] = std::thread(run, started);
	} catch (...) {
		// no more of them: the rest is done here
	}
	run(0);
	for (size_t chunk = started; chunk < chunks; ++chunk) run(chunk);
	for (size_t chunk = 1; chunk < started; ++chunk) threads[chunk].join();
	for (const std::exception_ptr& e : failed)
		if (e) std::rethrow_exception(e);
}

}  // namespace vcg::textlabel
