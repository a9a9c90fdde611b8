#include "core/content_hash.h"

#include <gtest/gtest.h>

#include "core/math.h"

namespace umbrameter {
namespace {

// XXH3_128bits of no bytes with seed 0, as `xxh128sum` prints it for an empty file.
TEST(ContentHash, Of_nothing_it_is_the_published_value) {
  EXPECT_EQ(ContentHash().hex(), "99aa06d3014798d86001c324468d497f");
}

TEST(ContentHash, Pieces_do_not_matter_but_order_and_every_bit_do) {
  const std::vector<std::uint8_t> bytes = {1, 2, 3, 4};
  const auto all = std::as_bytes(std::span(bytes));
  const std::string whole = ContentHash().add_bytes(all).hex();
  EXPECT_EQ(ContentHash().add_bytes(all.first(1)).add_bytes(all.subspan(1)).hex(), whole);
  EXPECT_NE(ContentHash().add_bytes(all.subspan(1)).add_bytes(all.first(1)).hex(), whole);
  EXPECT_NE(ContentHash().add(0.0).hex(), ContentHash().add(-0.0).hex());
}

TEST(ContentHash, Lengths_count_so_that_neighbours_cannot_trade_content) {
  EXPECT_NE(ContentHash().add("ab").add("c").hex(), ContentHash().add("a").add("bc").hex());
  const std::vector<vec3> one(1, vec3(1));
  const std::vector<vec3> two(2, vec3(1));
  EXPECT_NE(ContentHash().add(one).add(two).hex(), ContentHash().add(two).add(one).hex());
}

}  // namespace
}  // namespace umbrameter
