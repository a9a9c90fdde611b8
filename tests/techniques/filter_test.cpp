#include "techniques/shadow/filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace umbrameter {
namespace {

using Weights = std::vector<std::uint32_t>;

FilterKernel filter_of(ShadowFilter filter, int size, FilterTaps taps = FilterTaps::nearest) {
  PcfParams params;
  params.filter = filter;
  params.size = size;
  params.taps = taps;
  return make_filter(params);
}

TEST(ShadowFilter, Kernels_weigh_what_their_names_say) {
  EXPECT_EQ(filter_of(ShadowFilter::nearest, 5).kernel, (Weights{1}));
  EXPECT_EQ(filter_of(ShadowFilter::bilinear, 5).kernel, (Weights{1}));
  EXPECT_EQ(filter_of(ShadowFilter::box, 3).kernel, (Weights{1, 1, 1}));
  EXPECT_EQ(filter_of(ShadowFilter::tent, 1).kernel, (Weights{1}));
  EXPECT_EQ(filter_of(ShadowFilter::tent, 5).kernel, (Weights{1, 2, 3, 2, 1}));
}

TEST(ShadowFilter, A_gaussian_of_five_has_a_deviation_of_one_texel) {
  // exp(−x²/2) at 0, 1 and 2: 1, 0.606531, 0.135335; their sum 2.483732. Of 128 these are 51.535, 31.258 and 6.975.
  EXPECT_EQ(filter_of(ShadowFilter::gaussian, 5).kernel, (Weights{7, 31, 52, 31, 7}));
}

TEST(ShadowFilter, What_rounding_leaves_over_goes_to_the_middle_of_a_gaussian) {
  for (int size = 1; size <= FilterKernel::largest_size; size += 2) {
    std::uint32_t sum = 0;
    for (const std::uint32_t weight : filter_of(ShadowFilter::gaussian, size).kernel) sum += weight;
    EXPECT_EQ(sum, 128u) << size;
  }
}

TEST(ShadowFilter, Linear_taps_read_one_texel_more_and_weigh_a_texel_s_parts) {
  const FilterKernel bilinear = filter_of(ShadowFilter::bilinear, 1);
  EXPECT_EQ(bilinear.tap_count(), 4);
  EXPECT_EQ(bilinear.weight_sum(), 65'536u);  // 256²
  const FilterKernel largest = filter_of(ShadowFilter::tent, 29, FilterTaps::linear);
  EXPECT_EQ(largest.tap_count(), 900);
  EXPECT_EQ(largest.weight_sum(), 3'317'760'000u);  // (15² · 256)²
  EXPECT_EQ(largest_weight_sum(29), 3'317'760'000u);
}

TEST(ShadowFilter, Points_of_a_disk_lie_in_it_and_apart) {
  PcfParams params;
  params.filter = ShadowFilter::poisson;
  for (const int count : {1, 16, 64}) {
    params.samples = count;
    const FilterKernel disk = make_filter(params);
    ASSERT_EQ(disk.points.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(disk.weight_sum(), static_cast<std::uint32_t>(count));
    // Disks of this radius about all points but one cover half of the unit disk at most: 32 candidates or more that all
    // fall there are less likely than 2⁻³².
    const double apart = std::sqrt(0.5 / std::max(count - 1, 1));
    for (std::size_t i = 0; i < disk.points.size(); ++i) {
      EXPECT_LE(glm::length(disk.points[i]), 1.0f);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GE(glm::distance(disk.points[i], disk.points[j]), apart) << i;
    }
    for (const vec2& turn : disk.rotations) EXPECT_NEAR(glm::length(turn), 1.0f, 1e-6f);
  }
}

TEST(ShadowFilter, A_vogel_disk_puts_one_point_in_each_ring_of_equal_area) {
  PcfParams params;
  params.filter = ShadowFilter::vogel;
  for (const int count : {1, 7, 64}) {
    params.samples = count;
    const FilterKernel disk = make_filter(params);
    ASSERT_EQ(disk.tap_count(), count);
    EXPECT_EQ(disk.weight_sum(), static_cast<std::uint32_t>(count));
    for (int i = 0; i < count; ++i) {
      const vec2 p = disk.points[static_cast<std::size_t>(i)];
      // Ring i of n lies between radii √(i/n) and √((i + 1)/n).
      const double ring = count * static_cast<double>(p.x * p.x + p.y * p.y);
      EXPECT_NEAR(ring, i + 0.5, 1e-4);
    }
  }
}

}  // namespace
}  // namespace umbrameter
