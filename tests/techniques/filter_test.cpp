#include "techniques/shadow/filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "tests/support/reference/taps.h"

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

// Share of the first texels of a Gaussian, exp(−x²/2σ²) at the texels' centres with σ = (size + 1)/6.
double gaussian_left_of(int size, int at) {
  double left = 0.0;
  double all = 0.0;
  for (int i = 0; i < size; ++i) {
    const double x = (i + 0.5 - 0.5 * size) * 6.0 / (size + 1);
    const double weight = std::exp(-0.5 * x * x);
    all += weight;
    if (i < at) left += weight;
  }
  return left / all;
}

TEST(ShadowFilter, A_gaussian_of_five_has_a_deviation_of_one_texel) {
  // exp(−x²/2) at 0, 1 and 2: 1, 0.606531, 0.135335; their sum 2.483732. Of 32768 the first is 1785.49, the first two
  // are 9787.47.
  EXPECT_EQ(filter_of(ShadowFilter::gaussian, 5).kernel, (Weights{1785, 8002, 13194, 8002, 1785}));
}

TEST(ShadowFilter, A_gaussian_of_any_size_is_symmetric_and_off_by_half_a_unit_at_an_edge) {
  for (const FilterTaps taps : {FilterTaps::nearest, FilterTaps::linear}) {
    const std::uint32_t unit = taps == FilterTaps::nearest ? 1u << 15 : 1u << 23;
    for (int size = 1; size <= FilterKernel::largest_size; ++size) {
      const FilterKernel filter = filter_of(ShadowFilter::gaussian, size, taps);
      const Weights& weights = filter.kernel;
      EXPECT_EQ(weights, Weights(weights.rbegin(), weights.rend())) << size;
      std::uint32_t sum = 0;
      for (int i = 0; i < size; ++i) {
        EXPECT_NEAR(sum, unit * gaussian_left_of(size, i), 0.5001) << size << " " << i;
        sum += weights[static_cast<std::size_t>(i)];
      }
      EXPECT_EQ(sum, unit) << size;
      EXPECT_EQ(filter.weight_sum(), 1'073'741'824u) << size;  // 32768²
      EXPECT_GT(weights.front(), 0u) << size;
    }
  }
}

// A texel of linear taps weighs w_i (1 − f) + w_{i−1} f: the weight left of it is G_i (1 − f) + G_{i−1} f, where G are
// the sums of the Gaussian's weights. Half a unit of 2⁻¹⁵, and that of the kernel, 2⁻²³.
TEST(ShadowFilter, Linear_taps_of_a_gaussian_are_off_by_half_a_unit_wherever_the_receiver_is) {
  for (int size = 1; size <= FilterKernel::largest_size; ++size) {
    const FilterKernel filter = filter_of(ShadowFilter::gaussian, size, FilterTaps::linear);
    for (std::uint32_t part = 0; part <= FilterKernel::texel_parts; ++part) {
      const double f = part / 256.0;
      const AxisWeights weights = axis_weights(filter, part);
      std::uint32_t left = 0;
      for (int i = 0; i <= size; ++i) {
        const double exact = gaussian_left_of(size, i) * (1.0 - f) + gaussian_left_of(size, i - 1) * f;
        EXPECT_NEAR(left, 32768.0 * exact, 0.5 + 0.5 / 256 + 1e-6) << size << " " << part << " " << i;
        left += weights[static_cast<std::size_t>(i)];
      }
      EXPECT_EQ(left, 32768u) << size << " " << part;
    }
  }
}

TEST(ShadowFilter, Linear_taps_of_a_gaussian_weigh_what_the_documentation_says) {
  // docs/techniques/comparing-filters.md, n = 5, f = 1/4: the sums of exp(−x²/2) are 0, 0.0544887, 0.2986900,
  // 0.7013100, 0.9455113 and 1, times 2^23 and rounded: 0, 457084, 2505594, 5883014, 7931524 and 8388608.
  const AxisWeights weights = axis_weights(filter_of(ShadowFilter::gaussian, 5, FilterTaps::linear), 64);
  EXPECT_EQ(Weights(weights.begin(), weights.begin() + 6), (Weights{1339, 6448, 11895, 9300, 3340, 446}));
}

TEST(ShadowFilter, Exact_kernels_of_linear_taps_are_not_rounded) {
  const AxisWeights weights = axis_weights(filter_of(ShadowFilter::tent, 3, FilterTaps::linear), 64);
  // 1 2 1 at a quarter of a texel: 1 · 192; 2 · 192 + 1 · 64; 1 · 192 + 2 · 64; 1 · 64
  EXPECT_EQ(Weights(weights.begin(), weights.begin() + 4), (Weights{192, 448, 320, 64}));
}

TEST(ShadowFilter, Even_kernels_are_symmetric_about_a_texel_corner) {
  EXPECT_EQ(filter_of(ShadowFilter::box, 4).kernel, (Weights{1, 1, 1, 1}));
  EXPECT_EQ(filter_of(ShadowFilter::tent, 4).kernel, (Weights{1, 2, 2, 1}));
  // Deviation 5/6 texel: exp(−x²/2) at 0.6 and 1.8: 0.835270, 0.197899; their sum twice is 2.066338. 0.095773 of 32768
  // is 3138.3.
  EXPECT_EQ(filter_of(ShadowFilter::gaussian, 4).kernel, (Weights{3138, 13246, 13246, 3138}));
}

TEST(ShadowFilter, Optimized_kernels_have_three_five_or_seven_texels) {
  const FilterKernel kernel = filter_of(ShadowFilter::optimized, 7);
  EXPECT_EQ(kernel.kernel, (Weights{1, 5, 12, 16, 12, 5, 1}));
  EXPECT_TRUE(kernel.linear_taps);
  EXPECT_THROW(filter_of(ShadowFilter::optimized, 4), Error);
  EXPECT_THROW(filter_of(ShadowFilter::area_tent, 8), Error);
}

TEST(ShadowFilter, An_area_tent_weighs_a_texel_by_the_area_above_it) {
  // A tent of width 3 and area 1: ∫ from 0 to x is x²/(2·1.5²) in its left half. 1 texel: 2/9, 1.5 texels: 1/2.
  EXPECT_EQ(area_tent_part(3, 0), 0u);
  EXPECT_EQ(area_tent_part(3, 256), 228u);  // 1024 · 2/9 = 227.6
  EXPECT_EQ(area_tent_part(3, 384), 512u);
  EXPECT_EQ(area_tent_part(3, 512), 796u);
  EXPECT_EQ(area_tent_part(3, 768), 1024u);
  for (std::uint32_t size = 1; size <= 7; ++size) {
    EXPECT_EQ(area_tent_part(size, size * 256), FilterKernel::area_sum) << size;
    for (std::uint32_t x = 0; x <= size * 256; ++x) {
      const double half = 0.5 * size;
      const double at = x / 256.0;
      const double left = at <= half ? at * at / (2 * half * half) : 1 - (size - at) * (size - at) / (2 * half * half);
      EXPECT_NEAR(area_tent_part(size, x), 1024 * left, 0.5001) << size << " " << x;
    }
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
