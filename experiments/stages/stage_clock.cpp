#include "experiments/stages/stage_clock.h"

#include <algorithm>
#include <utility>

namespace umbrameter {

void StageClock::begin(WorkClock clock, std::function<void()> wait) {
  seconds_ = clock;
  wait_ = std::move(wait);
  times_ = {};
  running_.clear();
  last_ = seconds_();
}

GroupTime StageClock::end() {
  charge();
  wait_ = {};
  return std::exchange(times_, {});
}

// To the innermost stage that runs.
void StageClock::charge() {
  wait_();
  const double now = seconds_();
  const double seconds = now - std::exchange(last_, now);
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
