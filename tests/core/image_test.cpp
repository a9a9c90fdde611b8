#include "core/image.h"

#include <gtest/gtest.h>

#include "core/bounds.h"
#include "core/gbuffer.h"
#include "core/random.h"

namespace umbrameter {
namespace {

TEST(Image, Rows_follow_one_another_from_the_top) {
  Image<int> image(3, 2, 7);
  image.at(2, 0) = 1;
  image.at(0, 1) = 2;
  EXPECT_EQ(image.pixels, (std::vector<int>{7, 7, 1, 2, 7, 7}));
  EXPECT_TRUE(Image<int>().empty());
}

TEST(GBuffer, Starts_as_background) {
  const GBuffer gbuffer(2, 2);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_FALSE(gbuffer.is_surface(i));
}

TEST(Bounds, Hold_what_was_included_and_nothing_before) {
  Bounds bounds;
  EXPECT_TRUE(bounds.empty());
  EXPECT_EQ(bounds.radius(), 0.0);
  bounds.include(dvec3(1, 2, 3));
  bounds.include(dvec3(-1, 2, 5));
  EXPECT_FALSE(bounds.empty());
  EXPECT_EQ(bounds.center(), dvec3(0, 2, 4));
  EXPECT_EQ(bounds.corner(1), dvec3(1, 2, 3));
  EXPECT_EQ(bounds.corner(4), dvec3(-1, 2, 5));
  EXPECT_DOUBLE_EQ(bounds.radius(), 1.4142135623730951);  // half of the diagonal of 2 × 0 × 2
}

TEST(Random, Is_a_function_of_its_arguments_in_their_order) {
  EXPECT_EQ(hash(1u, 2u, 3u), hash(1u, 2u, 3u));
  EXPECT_NE(hash(1u, 2u, 3u), hash(3u, 2u, 1u));
  EXPECT_NE(hash(0u, 0u), hash(0u, 1u));
}

TEST(Random, Unit_floats_stay_below_one_and_average_one_half) {
  EXPECT_LT(to_unit_float(0xffffffffu), 1.0f);
  EXPECT_EQ(to_unit_float(0u), 0.0f);
  double sum = 0.0;
  constexpr int count = 100000;
  for (std::uint32_t i = 0; i < count; ++i) sum += to_unit_float(hash(i));
  // Five standard errors of the mean of uniform numbers: 5 · √(1/12) / √100000 = 0.0046.
  EXPECT_NEAR(sum / count, 0.5, 0.0046);
}

}  // namespace
}  // namespace umbrameter
