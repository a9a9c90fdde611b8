// The time that each stage takes, without that of the stages that it runs itself. Off unless someone reads it: it waits
// for the device after each stage, so that no stage is charged with the queued work of another.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "experiments/settings/sweep_costs.h"
#include "experiments/stages/work_clock.h"

namespace umbrameter {

class StageClock {
 public:
  /// Measures from now on; `wait` returns when the device is idle.
  void begin(WorkClock clock, std::function<void()> wait);
  /// The times since begin(); the clock is off again.
  GroupTime end();

  /// Charges the time until it ends to a stage.
  class Running {
   public:
    Running(StageClock& clock, Stage stage);
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

   private:
    StageClock* clock_;
  };

 private:
  void charge();

  WorkClock seconds_ = clock_seconds;
  std::function<void()> wait_;
  GroupTime times_;
  std::vector<std::size_t> running_;  // the innermost stage last
  double last_ = 0.0;
};

}  // namespace umbrameter
