#include "experiments/stages/stage_clock.h"

#include <algorithm>
#include <utility>

namespace umbrameter {

void StageClock::begin(std::function<void()> wait) {
  wait_ = std::move(wait);
  times_ = {};
  running_.clear();
  last_ = std::chrono::steady_clock::now();
}

GroupTime StageClock::end() {
  charge();
  wait_ = {};
  return std::exchange(times_, {});
}

// To the innermost stage that runs.
void StageClock::charge() {
  wait_();
  const Time now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  if (running_.empty()) {
    times_.rest += seconds;
  } else {
    double& of_stage = times_.of_stage[running_.back()];
    of_stage = std::max(of_stage, 0.0) + seconds;
  }
}

StageClock::Running::Running(StageClock& clock, Stage stage) : clock_(clock.wait_ ? &clock : nullptr) {
  if (clock_ == nullptr) return;
  clock_->charge();
  clock_->running_.push_back(static_cast<std::size_t>(stage));
}

StageClock::Running::~Running() {
  if (clock_ == nullptr || clock_->running_.empty()) return;
  clock_->charge();
  clock_->running_.pop_back();
}

}  // namespace umbrameter
