#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace umbrameter {
namespace {

TEST(Parallel, Every_index_is_visited_once_at_any_number_of_threads) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    std::vector<std::atomic<int>> visits(10007);
    parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const auto& count : visits) ASSERT_EQ(count.load(), 1);
  }
}

TEST(Parallel, Tiles_cover_every_pixel_once_also_when_sizes_do_not_divide) {
  std::vector<std::atomic<int>> visits(37 * 23);
  parallel_tiles(37, 23, 8, [&](const Tile& tile) {
    EXPECT_LE(tile.x_end - tile.x_begin, 8);
    EXPECT_LE(tile.y_end - tile.y_begin, 8);
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
      for (int x = tile.x_begin; x < tile.x_end; ++x) ++visits[static_cast<std::size_t>(y * 37 + x)];
    }
  });
  for (const auto& count : visits) ASSERT_EQ(count.load(), 1);
}

TEST(Parallel, Progress_rises_to_one) {
  double last = 0.0;
  parallel_tiles(
      64, 64, 8, [](const Tile&) {},
      [&](double share) {
        EXPECT_GT(share, last);
        last = share;
      });
  EXPECT_EQ(last, 1.0);
}

TEST(Parallel, What_a_body_throws_reaches_the_caller) {
  EXPECT_THROW(parallel_for(1000,
                            [](std::size_t i) {
                              if (i == 500) throw std::runtime_error("body");
                            }),
               std::runtime_error);
}

TEST(Parallel, Nothing_to_do_is_fine) {
  parallel_for(0, [](std::size_t) { FAIL(); });
  parallel_tiles(0, 0, 8, [](const Tile&) { FAIL(); });
}

}  // namespace
}  // namespace umbrameter
