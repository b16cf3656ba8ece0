#pragma once
// How long the stages of a run take.

#include <array>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

namespace textlabel {

/// Wall-clock times of stages that follow one another, also by turns. To end one needs no memory and can't fail.
class StageClock {
public:
	/// End the stage that runs; its time is added to `name`.
	/// @pre no more names than there is room for
	void end(const char* name)
	{
		const auto now = Clock::now();
		size_t i = 0;
		while (i < count_ && std::strcmp(stages_[i].first, name) != 0) ++i;
		if (i == count_) stages_[count_++] = {name, 0};
		stages_[i].second += milliseconds(now - last_);
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
