#pragma once
// A linear pass over a large array on all cores. What the chunks find is put together in their order, so that the result does not
// depend on how many there are.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace vcg::textlabel {

/// How many chunks a pass over `count` elements is worth: one thread's start costs as much as reading some ten thousand.
inline size_t ChunkCount(size_t count)
{
	constexpr size_t least = 50000, most = 16;
	const size_t cores = std::max(1u, std::thread::hardware_concurrency());
	return std::clamp<size_t>(count / least, 1, std::min(cores, most));
}

/// Call work(chunk, first, last) for each of `chunks` ranges of 0 .. count-1, at the same time where threads can be had.
/// @throws what the first chunk that failed has thrown, after all have ended
template <class Work>
void EachChunk(size_t count, size_t chunks, const Work& work)
{
	std::vector<std::exception_ptr> failed(chunks);
	const auto run = [&](size_t chunk) {
		try {
			work(chunk, count * chunk / chunks, count * (chunk + 1) / chunks);
		} catch (...) {
			failed[chunk] = std::current_exception();
		}
	};
	std::vector<std::thread> threads;
	threads.reserve(chunks);
	size_t started = 1;  // chunk 0 is for this thread
	try {
		for (; started < chunks; ++started) threads.emplace_back(run, started);
	} catch (const std::system_error&) {
		// no more threads: the rest is done here
	}
	run(0);
	for (size_t chunk = started; chunk < chunks; ++chunk) run(chunk);
	for (std::thread& t : threads) t.join();
	for (const std::exception_ptr& e : failed)
		if (e) std::rethrow_exception(e);
}

}  // namespace vcg::textlabel
