#pragma once
// How long the stages of a run take.

#include <chrono>
#include <utility>
#include <vector>

namespace textlabel {

/// Wall-clock times of stages that follow one another.
class StageClock {
public:
	/// End the stage that runs; its time goes to `name`.
	void end(const char* name)
	{
		const auto now = Clock::now();
		stages_.emplace_back(name, milliseconds(now - last_));
		last_ = now;
	}
	/// The stages in order, then "total".
	std::vector<std::pair<const char*, double>> stages() const
	{
		auto all = stages_;
		all.emplace_back("total", milliseconds(last_ - start_));
		return all;
	}

private:
	using Clock = std::chrono::steady_clock;
	static double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

	Clock::time_point start_ = Clock::now(), last_ = start_;
	std::vector<std::pair<const char*, double>> stages_;
};

}  // namespace textlabel
