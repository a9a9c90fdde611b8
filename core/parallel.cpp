#include "core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <mutex>

#include "core/interrupt.h"

namespace umbrameter {

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
  oneapi::tbb::parallel_for(Range(0, count), [&](const Range& range) {
    throw_if_interrupted();
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

void parallel_tiles(int width, int height, int tile_size, const std::function<void(const Tile&)>& body,
                    const Progress& progress) {
  const int columns = (width + tile_size - 1) / tile_size;
  const int rows = (height + tile_size - 1) / tile_size;
  const auto count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  std::mutex mutex;
  std::size_t done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    throw_if_interrupted();
    const int x = static_cast<int>(i % static_cast<std::size_t>(columns)) * tile_size;
    const int y = static_cast<int>(i / static_cast<std::size_t>(columns)) * tile_size;
    body({x, y, std::min(x + tile_size, width), std::min(y + tile_size, height)});
    if (progress) {
      const std::lock_guard lock(mutex);
      progress(static_cast<double>(++done) / static_cast<double>(count));
    }
  });
}

}  // namespace umbrameter
