// Parts of the AO methods against numerical integration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "techniques/ao/noise.h"
#include "techniques/ao/technique.h"

namespace umbrameter {
namespace {

TEST(AoNoise, Each_pixel_of_a_stratified_tile_has_another_part_of_the_range) {
  for (const int size : {1, 4, 8}) {
    const std::vector<vec4> tile = stratified_tile({.size = size}, 7);
    const auto count = static_cast<std::size_t>(size * size);
    ASSERT_EQ(tile.size(), count);
    for (const int axis : {0, 1}) {
      std::vector<int> seen(count, 0);
      for (const vec4& pair : tile) ++seen.at(static_cast<std::size_t>(pair[axis] * static_cast<float>(count)));
      EXPECT_EQ(seen, std::vector<int>(count, 1)) << size;
    }
    EXPECT_NE(tile, stratified_tile({.size = size}, 8));
  }
}

TEST(Gtao, The_inner_integral_is_that_of_the_cosine_to_the_normal) {
  shared::GtaoMethod method;
  for (const double n : {-1.4, -0.7, 0.0, 0.3, 1.2}) {
    for (const double low : {-3.0, -1.2, -0.4, -0.01}) {
      for (const double high : {0.02, 0.5, 1.5, 3.0}) {
        // The midpoint rule; horizons below the normal's hemisphere do not count.
        constexpr int parts = 20000;
        double expected = 0.0;
        for (int i = 0; i < parts; ++i) {
          const double theta = low + (high - low) * (i + 0.5) / parts;
          expected += std::max(0.0, std::cos(theta - n)) * std::abs(std::sin(theta)) * (high - low) / parts;
        }
        EXPECT_NEAR(method.slice_visibility(static_cast<float>(n), static_cast<float>(low), static_cast<float>(high)),
                    expected, 3e-6)
            << n << " " << low << " " << high;
      }
    }
  }
}

TEST(Gtao, The_inner_integral_of_directions_is_that_of_the_cosine_to_the_normal) {
  shared::BitmaskMethod method;
  for (const double n : {-1.4, -0.7, 0.0, 0.3, 1.2}) {
    for (const double angle : {-1.5, -0.4, 0.02, 0.9, 1.5}) {
      constexpr int parts = 20000;
      dvec2 expected(0);
      for (int i = 0; i < parts; ++i) {
        const double theta = angle * (i + 0.5) / parts;
        expected += std::cos(theta - n) * std::abs(std::sin(theta)) * dvec2(std::cos(theta), std::sin(theta)) * angle;
      }
      const vec2 sum = method.directions_up_to(static_cast<float>(n), static_cast<float>(angle));
      EXPECT_NEAR(sum.x, expected.x / parts, 2e-6) << n << " " << angle;
      EXPECT_NEAR(sum.y, expected.y / parts, 2e-6) << n << " " << angle;
    }
  }
}

TEST(Gtao, An_open_hemisphere_is_1_for_every_direction_of_view) {
  shared::GtaoMethod method;
  for (const float tilt : {0.0f, 0.5f, 1.0f, 1.5f}) {
    const vec3 normal(std::sin(tilt), 0.0f, std::cos(tilt));
    double sum = 0.0;
    constexpr int slices = 20000;
    for (int i = 0; i < slices; ++i) {
      const float azimuth = static_cast<float>(pi * (i + 0.5) / slices);
      const float along = std::cos(azimuth) * normal.x;
      const float length = std::hypot(along, normal.z);
      const float n = std::atan2(along, normal.z);
      sum += static_cast<double>(length * method.slice_visibility(n, -3.1f, 3.1f)) / slices;
    }
    EXPECT_NEAR(sum, 1.0, 1e-4) << tilt;
  }
}

TEST(DepthPyramid, Each_texel_is_one_of_four_on_a_rotated_grid) {
  shared::AlchemyMethod method;
  method.size = {5, 4};
  method.depth = Image<float>(5, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) method.depth.at(x, 3 - y) = static_cast<float>(10 * y + x);
  }
  EXPECT_EQ(method.depth_at_level({4, 3}, 0), 34.0f);
  // Level 1 has 2×2 texels. Texel (x, y) holds (2x + (y & 1 ^ 1), 2y + (x & 1 ^ 1)) of level 0 (McGuire et al. 2012).
  EXPECT_EQ(method.depth_at_level({0, 0}, 1), 11.0f);
  EXPECT_EQ(method.depth_at_level({1, 0}, 1), 3.0f);
  EXPECT_EQ(method.depth_at_level({0, 1}, 1), 30.0f);
  EXPECT_EQ(method.depth_at_level({1, 1}, 1), 22.0f);
  // Level 2 has one texel: it holds (1, 1) of level 1.
  EXPECT_EQ(method.depth_at_level({0, 0}, 2), 22.0f);
}

TEST(DepthPyramid, The_level_is_the_floor_of_the_logarithm_of_the_distance_less_the_offset) {
  shared::AlchemyMethod method;
  method.size = {1280, 720};
  Alchemy technique;
  technique.params.mip_chain = true;
  const shared::AlchemyMethod::AlchemySettings settings = settings_of(technique);
  // The paper's offset is 3, so that the first level serves from 2^4 pixels on; there are five.
  const std::vector<std::pair<float, int>> cases = {{1.0f, 0},   {15.99f, 0}, {16.0f, 1},  {31.99f, 1}, {32.0f, 2},
                                                    {255.0f, 4}, {256.0f, 5}, {512.0f, 5}, {1e30f, 5}};
  for (const auto& [pixels, level] : cases) EXPECT_EQ(method.mip_level(pixels, settings), level) << pixels;
  technique.params.mip_chain = false;
  EXPECT_EQ(method.mip_level(512.0f, settings_of(technique)), 0);
  // An image of 7×3 pixels has the levels 3×1 and 1×1.
  method.size = {7, 3};
  EXPECT_EQ(method.mip_level(512.0f, settings), 2);
}

TEST(Bitmask, Sectors_have_equal_shares_of_the_slice_in_either_weight) {
  shared::BitmaskMethod method;
  for (const float n : {-1.4f, -0.5f, 0.0f, 0.3f, 1.2f}) {
    for (const float angle : {-2.0f, -1.2f, -0.3f, 0.0f, 0.1f, 0.9f, 1.7f}) {
      // The midpoint rule, over the normal's hemisphere in the slice.
      constexpr int parts = 20000;
      double below = 0.0;
      double all = 0.0;
      for (int i = 0; i < parts; ++i) {
        const double theta = static_cast<double>(n) + pi * ((i + 0.5) / parts - 0.5);
        const double weight = std::cos(theta - static_cast<double>(n)) * std::abs(std::sin(theta));
        all += weight;
        if (theta < static_cast<double>(angle)) below += weight;
      }
      EXPECT_NEAR(method.sector_position(n, angle, 1), below / all, 2e-4) << n << " " << angle;
      const double even = (static_cast<double>(angle) - static_cast<double>(n)) / pi + 0.5;
      EXPECT_NEAR(method.sector_position(n, angle, 0), std::clamp(even, 0.0, 1.0), 1e-6) << n << " " << angle;
    }
  }
}

TEST(Bitmask, The_angle_of_a_share_of_the_slice_has_that_share_below_it) {
  shared::BitmaskMethod method;
  for (const float n : {-1.2f, 0.0f, 0.6f}) {
    for (const int is_cosine : {0, 1}) {
      for (const float position : {0.0f, 0.03125f, 0.5f, 0.9f, 1.0f}) {
        EXPECT_NEAR(method.sector_position(n, method.sector_angle(n, position, is_cosine), is_cosine), position, 1e-5);
      }
    }
  }
}

TEST(Bitmask, A_surface_covers_the_sectors_it_reaches_or_those_whose_centre_it_covers) {
  shared::BitmaskMethod method;
  EXPECT_EQ(method.covered_sectors(0.0f, 1.0f, 0), 0xffffffffu);
  EXPECT_EQ(method.covered_sectors(0.0f, 1.0f, 1), 0xffffffffu);
  EXPECT_EQ(method.covered_sectors(1.0f, 1.0f, 0), 0u);
  EXPECT_EQ(method.covered_sectors(1.0f, 1.0f, 1), 0u);
  // From 0.4 to 1.4 sectors: the centre of the first at 0.5, not that of the second at 1.5.
  EXPECT_EQ(method.covered_sectors(0.4f / 32, 1.4f / 32, 0), 1u);
  EXPECT_EQ(method.covered_sectors(0.4f / 32, 1.6f / 32, 0), 3u);
  EXPECT_EQ(method.covered_sectors(0.6f / 32, 1.4f / 32, 0), 0u);
  // Rounded up: as many sectors as the surface is wide, from the one in which it begins.
  EXPECT_EQ(method.covered_sectors(0.4f / 32, 0.5f / 32, 1), 1u);
  EXPECT_EQ(method.covered_sectors(0.4f / 32, 1.5f / 32, 1), 3u);
  EXPECT_EQ(method.covered_sectors(31.5f / 32, 1.0f, 1), 0x80000000u);
}

}  // namespace
}  // namespace umbrameter
