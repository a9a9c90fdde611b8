// Loops over threads whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace umbrameter {

/// Caps the threads of every parallel loop while it lives. 0 leaves the number of cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(ThreadLimit&&) noexcept;
  ThreadLimit& operator=(ThreadLimit&&) noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A half-open rectangle of pixels.
struct Tile {
  int x_begin = 0;
  int y_begin = 0;
  int x_end = 0;
  int y_end = 0;
};

/// Share of the work done, 0 to 1. Called from any thread, one call at a time.
using Progress = std::function<void(double)>;

/// Calls body(i) for every i below count, in any order.
/// Throws what the body throws, and Error when the user interrupts.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Calls body(tile) for tiles of at most tile_size² pixels that cover width × height.
/// Throws what the body throws, and Error when the user interrupts.
void parallel_tiles(int width, int height, int tile_size, const std::function<void(const Tile&)>& body,
                    const Progress& progress = {});

}  // namespace umbrameter
