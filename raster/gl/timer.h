// Time that a pass takes, for benchmarks. It waits for the device before and after, so that no pass is charged with
// the queued work of another.
#pragma once

#include <functional>

namespace umbrameter::gl {

struct PassTime {
  double wall = 0;       ///< seconds
  double processor = 0;  ///< seconds, all threads of the process: what a software rasteriser works
};

/// Returns when the device has done all that was queued.
void wait_for_device();

/// Runs the work. If `time` is given, adds the time from an idle device until all of it is done.
void run_timed(PassTime* time, const std::function<void()>& work);

}  // namespace umbrameter::gl
