#include "compare/bias_units.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrameter {
namespace {

TEST(BiasUnits, A_bias_is_the_same_length_in_every_unit) {
  // 4 cm with texels of 2.5 cm over a depth range of 20 m: 1.6 texels, 0.002 of the range.
  for (const Length& bias : {Length{0.04}, Length{1.6, LengthUnit::texels}}) {
    const BiasInUnits all = in_units(bias, 0.025, 20.0);
    EXPECT_DOUBLE_EQ(all.metres, 0.04);
    EXPECT_DOUBLE_EQ(all.texels, 1.6);
    EXPECT_DOUBLE_EQ(all.depth, 0.002);
  }
}

TEST(BiasUnits, What_is_not_known_is_not_a_number) {
  EXPECT_TRUE(std::isnan(in_units(Length{0.04}, 0.0, 20.0).texels));
  EXPECT_EQ(in_units(Length{0.04}, 0.0, 20.0).metres, 0.04);
  EXPECT_TRUE(std::isnan(in_units({1.5, LengthUnit::texels}, 0.0, 20.0).metres));
  EXPECT_TRUE(std::isnan(in_units(Length{0.04}, 0.025, 0.0).depth));
}

}  // namespace
}  // namespace umbrameter
