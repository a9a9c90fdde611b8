#include "compare/visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/settings/sweep.h"
#include "row_check.h"

namespace umbrameter {
namespace {

// Four pixels of eight taps: one of them not counted.
struct FourPixels {
  Image<float> truth{4, 1};
  WrongTaps wrong{Image<uvec4>(4, 1, uvec4(0)), 8};
  CountedPixels counted{Image<PixelExclusion>(4, 1, PixelExclusion::none), {}, 0.5};
  FourPixels() {
    truth.pixels = {1, 1, 0, 1};
    wrong.weights.pixels = {uvec4(0), uvec4(4, 2, 0, 0), uvec4(0, 0, 1, 3), uvec4(8, 0, 0, 0)};
    counted.exclusion.pixels[3] = PixelExclusion::back_facing;
  }
};

// Sums of rounded shares would differ in the last digit, and with it decide which of two biases has the least error.
TEST(Visibility, As_many_wrong_taps_are_the_same_error_whatever_their_causes) {
  const TruthCounts truth{26631, 19000, 0.5};
  const auto error_of = [&](std::array<std::uint64_t, cause_count> wrong) {
    VisibilitySums sums;
    sums.weight_sum = 1;
    sums.wrong = wrong;
    return to_statistics(sums, truth).mae;
  };
  const double error = error_of({599, 0, 0, 0});
  EXPECT_EQ(error, 599.0 / 26631.0);
  for (std::uint64_t acne = 0; acne < 599; ++acne) {
    for (const std::uint64_t leak : {std::uint64_t{0}, std::uint64_t{7}, (599 - acne) / 2}) {
      if (acne + leak > 599) continue;
      EXPECT_EQ(error_of({acne, 0, 599 - acne - leak, leak}), error) << acne << " " << leak;
    }
  }
}

TEST(Visibility, Shares_are_of_the_counted_pixels_only) {
  const FourPixels four;
  const VisibilityStatistics s = analyze_visibility(four.wrong, four.truth, four.counted);
  EXPECT_EQ(s.pixels, 3u);
  EXPECT_DOUBLE_EQ(s.lit, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(s.blocked, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(s.mae, (0.75 + 0.5) / 3.0);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt((0.75 * 0.75 + 0.25) / 3.0));
  EXPECT_DOUBLE_EQ(s.mean_error, (-0.75 + 0.5) / 3.0);
  EXPECT_DOUBLE_EQ(s.false_blocked, 0.75 / 3.0);
  EXPECT_DOUBLE_EQ(s.false_lit, 0.5 / 3.0);
  EXPECT_EQ(s.max_error, 0.75);
  EXPECT_EQ(s.max_x, 1);
  EXPECT_EQ(s.max_y, 0);
}

TEST(Visibility, The_causes_add_up_to_the_mean_absolute_error) {
  const FourPixels four;
  const VisibilityStatistics s = analyze_visibility(four.wrong, four.truth, four.counted);
  EXPECT_DOUBLE_EQ(s.acne, 0.5 / 3.0);
  EXPECT_DOUBLE_EQ(s.false_occlusion, 0.25 / 3.0);
  EXPECT_DOUBLE_EQ(s.peter_panning, 0.125 / 3.0);
  EXPECT_DOUBLE_EQ(s.leak, 0.375 / 3.0);
  EXPECT_DOUBLE_EQ(s.acne + s.false_occlusion + s.peter_panning + s.leak, s.mae);
}

TEST(Visibility, Without_wrong_taps_there_is_no_error) {
  FourPixels four;
  four.wrong.weights = Image<uvec4>(4, 1, uvec4(0));
  const VisibilityStatistics s = analyze_visibility(four.wrong, four.truth, four.counted);
  EXPECT_EQ(s.mae, 0.0);
  EXPECT_EQ(s.rmse, 0.0);
  EXPECT_EQ(s.max_x, -1);
  EXPECT_EQ(signed_error(four.truth, four.truth), Image<float>(4, 1, 0.0f));
}

TEST(Visibility, Nothing_counted_gives_no_numbers_so_that_none_looks_like_a_perfect_score) {
  FourPixels four;
  four.counted = {Image<PixelExclusion>(4, 1, PixelExclusion::background), {}, 0.0};
  const VisibilityStatistics s = analyze_visibility(four.wrong, four.truth, four.counted);
  EXPECT_EQ(s.pixels, 0u);
  const std::vector<Value> row = row_of(s);
  EXPECT_EQ(to_number(row[0]), 0.0);
  for (std::size_t i = 1; i < row.size(); ++i) EXPECT_TRUE(std::isnan(to_number(row[i]))) << i;
}

TEST(Visibility, A_pixel_takes_the_class_of_its_largest_share) {
  const FourPixels four;
  EXPECT_EQ(classify(four.wrong, four.counted).pixels,
            (std::vector<PixelClass>{PixelClass::correct, PixelClass::acne, PixelClass::light_leak,
                                     PixelClass::not_counted}));
}

TEST(Visibility, Every_column_has_a_unit_and_a_value) {
  const std::vector<Column> columns = columns_of(VisibilityStatistics{});
  EXPECT_EQ(columns.size(), row_of(VisibilityStatistics{}).size());
  for (const Column& column : columns) {
    EXPECT_FALSE(column.unit.empty()) << column.name;
    EXPECT_FALSE(column.meaning.empty()) << column.name;
  }
}

TEST(Visibility, Rows_stand_under_their_column) {
  VisibilityStatistics s;
  s.pixels = 1;
  s.lit = 2;
  s.blocked = 3;
  s.mae = 4;
  s.rmse = 5;
  s.acne = 6;
  s.false_occlusion = 7;
  s.peter_panning = 8;
  s.leak = 9;
  s.mean_error = 10;
  s.max_error = 11;
  s.false_blocked = 12;
  s.false_lit = 13;
  s.mean_texel = 14;
  test::expect_row({columns_of(VisibilityStatistics{}), {row_of(s)}}, {{"pixels", 1},
                                                                       {"lit", 2},
                                                                       {"blocked", 3},
                                                                       {"mae", 4},
                                                                       {"rmse", 5},
                                                                       {"acne", 6},
                                                                       {"false_occlusion", 7},
                                                                       {"peter_panning", 8},
                                                                       {"leak", 9},
                                                                       {"mean_error", 10},
                                                                       {"max_error", 11},
                                                                       {"false_blocked", 12},
                                                                       {"false_lit", 13},
                                                                       {"mean_texel", 14}});
}

TEST(Visibility, Pixels_are_counted_by_facing_map_cone_and_range) {
  // A spot 4 m above the origin that shines down with a cone of 45° and a range of 4.5 m.
  Light light;
  light.world_from_light = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0, 4, 0, 1));
  light.shape = SpotLight{4.5, 0.0, pi / 4};
  Bounds bounds;
  bounds.include(dvec3(-10, 0, -10));
  bounds.include(dvec3(10, 4, 10));
  GBuffer gbuffer(6, 1);
  const vec3 positions[] = {{1, 0, 0}, {1, 0, 0}, {3.5f, 0, 3.5f}, {3.9f, 0, 0}, {8, 0, 0}};
  for (std::size_t i = 0; i < 5; ++i) {
    gbuffer.instance[i] = 0;
    gbuffer.position[i] = positions[i];
    gbuffer.geometric_normal[i] = i == 1 ? vec3(0, -1, 0) : vec3(0, 1, 0);
  }
  const CountedPixels counted = count_pixels(gbuffer, light, fit_light(light, bounds, 256));
  EXPECT_EQ(counted.exclusion[0], PixelExclusion::none);
  EXPECT_EQ(counted.exclusion[1], PixelExclusion::back_facing);
  EXPECT_EQ(counted.exclusion[2], PixelExclusion::outside_cone);   // inside the square map, 51° off the axis
  EXPECT_EQ(counted.exclusion[3], PixelExclusion::outside_range);  // 44° off the axis, √(16 + 15.21) = 5.59 m away
  EXPECT_EQ(counted.exclusion[4], PixelExclusion::outside_map);
  EXPECT_EQ(counted.exclusion[5], PixelExclusion::background);
  // One texel spans 2 · tan 45° · 4 m / 256 at the only counted surfel.
  EXPECT_NEAR(counted.mean_texel, 8.0 / 256.0, 1e-9);
  // What a frame does not light even without shadows is left out; what is left out already keeps its reason.
  const CountedPixels lit =
      count_pixels(gbuffer, light, fit_light(light, bounds, 256), Image<std::uint8_t>(6, 1, std::uint8_t{1}));
  EXPECT_EQ(lit.exclusion[0], PixelExclusion::back_facing);
  EXPECT_EQ(lit.exclusion[2], PixelExclusion::outside_cone);
  EXPECT_EQ(lit.exclusion[5], PixelExclusion::background);
  EXPECT_EQ(lit.totals[0], 0u);
}

}  // namespace
}  // namespace umbrameter
