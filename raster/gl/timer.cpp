#include "raster/gl/timer.h"

#include <chrono>

#include "raster/gl/api.h"

namespace umbrameter::gl {

void wait_for_device() { glFinish(); }

void run_timed(PassTime* time, const std::function<void()>& work) {
  if (time == nullptr) return work();
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t ticks = std::clock();
  work();
  glFinish();
  time->wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  time->processor += static_cast<double>(std::clock() - ticks) / CLOCKS_PER_SEC;
}

}  // namespace umbrameter::gl
