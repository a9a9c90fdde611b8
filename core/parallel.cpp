#include "core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include "core/interrupt.h"

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace umbrameter {
namespace {

// TBB comes without instrumentation: ThreadSanitizer has to be told that a loop's bodies come after what was before the
// loop, and before what follows it. Elsewhere nothing.
class VisibleOrder {
 public:
#if defined(__SANITIZE_THREAD__)
  VisibleOrder() { __tsan_release(&begin_); }
  void enter() { __tsan_acquire(&begin_); }
  void leave() { __tsan_release(&end_); }
  void join() { __tsan_acquire(&end_); }

 private:
  char begin_ = 0;
  char end_ = 0;
#else
  void enter() {}
  void leave() {}
  void join() {}
#endif
};

}  // namespace

struct ThreadLimit::State {
  oneapi::tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) {
    state_ = std::make_unique<State>(State{oneapi::tbb::global_control(
        oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads))});
  }
}
ThreadLimit::~ThreadLimit() = default;
ThreadLimit::ThreadLimit(ThreadLimit&&) noexcept = default;
ThreadLimit& ThreadLimit::operator=(ThreadLimit&&) noexcept = default;

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  using Range = oneapi::tbb::blocked_range<std::size_t>;
  VisibleOrder order;
  oneapi::tbb::parallel_for(Range(0, count), [&](const Range& range) {
    order.enter();
    throw_if_interrupted();
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
    order.leave();
  });
  order.join();
}

void parallel_tiles(int width, int height, int tile_size, const std::function<void(const Tile&)>& body,
                    const Progress& progress) {
  const int columns = (width + tile_size - 1) / tile_size;
  const int rows = (height + tile_size - 1) / tile_size;
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::mutex mutex;
  std::size_t done = 0;
  VisibleOrder order;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    order.enter();
    throw_if_interrupted();
    const int x = static_cast<int>(i % static_cast<std::size_t>(columns)) * tile_size;
    const int y = static_cast<int>(i / static_cast<std::size_t>(columns)) * tile_size;
    body({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
    if (progress) {
      const std::lock_guard lock(mutex);
      progress(static_cast<double>(++done) / static_cast<double>(count));
    }
    order.leave();
  });
  order.join();
}

}  // namespace umbrameter
