#include "techniques/shadow/histogram.h"

#include <gtest/gtest.h>

#include "tests/support/reference/taps.h"

namespace umbrameter {
namespace {

TEST(ShadowLookup, A_flip_is_rounded_after_the_product_as_shaders_round_it) {
  // (1 + 2⁻²³)² = 1 + 2⁻²² + 2⁻⁴⁶, which a float rounds to 1 + 2⁻²². A contracted difference would be −2⁻⁴⁶.
  const float root = 1.0f + 0x1p-23f;
  EXPECT_EQ(flip_bias(1.0f + 0x1p-22f, root, root), 0.0f);
}

TEST(ShadowLookup, A_texel_s_row_counts_from_the_bottom_and_an_image_s_from_the_top) {
  MapLayout layout;
  layout.resolution = 4;
  EXPECT_EQ(texel_index(layout, {0, 3}), 0u);
  EXPECT_EQ(texel_index(layout, {3, 3}), 3u);
  EXPECT_EQ(texel_index(layout, {1, 0}), 13u);
}

}  // namespace
}  // namespace umbrameter
