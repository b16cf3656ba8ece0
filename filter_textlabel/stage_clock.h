#pragma once
// How long the stages of a run take.

#include <array>
#include <chrono>
#include <utility>
#include <vector>

namespace textlabel {

/// Wall-clock times of stages that follow one another. To end one needs no memory and can't fail.
class StageClock {
public:
	/// End the stage that runs; its time goes to `name`. What ends after the last that there is room for goes to that one.
	void end(const char* name)
	{
		const auto now = Clock::now();
		if (count_ < stages_.size()) stages_[count_++].first = name;
		stages_[count_ - 1].second += milliseconds(now - last_);
		last_ = now;
	}
	/// The stages in order, then "total".
	std::vector<std::pair<const char*, double>> stages() const
	{
		std::vector<Stage> all(stages_.begin(), stages_.begin() + std::ptrdiff_t(count_));
		all.emplace_back("total", milliseconds(last_ - start_));
		return all;
	}

private:
	using Clock = std::chrono::steady_clock;
	using Stage = std::pair<const char*, double>;
	static double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

	Clock::time_point start_ = Clock::now(), last_ = start_;
	std::array<Stage, 8> stages_{};
	size_t count_ = 0;
};

}  // namespace textlabel
