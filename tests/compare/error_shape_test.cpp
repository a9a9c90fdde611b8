#include "compare/error_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "flat_ground.h"

namespace umbrameter {
namespace {

const dvec3 zenith(0, 1, 0);

// Twenty pixels of 0.1 m in a row, blocked from the tenth on: the edge is at 9.5 px.
struct Row {
  FlatGround ground;
  Image<float> truth;
  WrongTaps wrong;
  explicit Row(const dvec3& to_light = zenith, double texel = 0.2)
      : ground(20, 1, 0.1, to_light, texel), truth(blocked_from(ground, 10)), wrong{Image<uvec4>(20, 1, uvec4(0)), 4} {}
  ShapeInput input() const { return {ground.gbuffer, truth, ground.counted, ground.light, ground.layout}; }
};

TEST(ErrorShape, Distances_are_in_pixels_texels_and_metres) {
  Row row;
  row.wrong.weights[3] = uvec4(4, 0, 0, 0);  // 6.5 px, 0.65 m, 3.25 texels of 0.2 m from the edge
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  EXPECT_EQ(shape.edges, 1u);
  EXPECT_DOUBLE_EQ(shape.all.weight, 1.0);
  ASSERT_TRUE(shape.all.pixels && shape.all.texels && shape.all.metres);
  EXPECT_NEAR(shape.all.pixels->median, 6.5, 1e-5);
  EXPECT_NEAR(shape.all.metres->median, 0.65, 1e-5);
  EXPECT_NEAR(shape.all.texels->median, 3.25, 1e-5);
  EXPECT_NEAR(shape.parts[0].texels->largest, 3.25, 1e-5);
  EXPECT_FALSE(shape.parts[1].texels);
}

// Light along (1, 1, 0)/√2 sees a length along x shortened by cos 45°.
TEST(ErrorShape, Texels_count_across_the_lights_way) {
  Row row(dvec3(1, 1, 0));
  row.wrong.weights[3] = uvec4(4, 0, 0, 0);
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  EXPECT_NEAR(shape.all.texels->median, 3.25 * std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(shape.all.metres->median, 0.65, 1e-5);
}

TEST(ErrorShape, Quantiles_and_shares_go_by_weight) {
  Row row;
  row.wrong.weights[9] = uvec4(0, 4, 0, 0);   // 0.25 texels
  row.wrong.weights[8] = uvec4(0, 2, 0, 0);   // 0.75 texels
  row.wrong.weights[12] = uvec4(0, 0, 3, 0);  // 1.25 texels
  row.wrong.weights[19] = uvec4(0, 0, 0, 1);  // 4.75 texels
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  EXPECT_DOUBLE_EQ(shape.all.weight, 2.5);
  EXPECT_DOUBLE_EQ(shape.all.within[1], 0.4);
  EXPECT_DOUBLE_EQ(shape.all.within[one_texel], 0.6);
  EXPECT_DOUBLE_EQ(shape.all.within[two_texels], 0.9);
  EXPECT_DOUBLE_EQ(shape.all.within.back(), 1.0);
  EXPECT_NEAR(shape.all.texels->median, 0.75, 1e-5);
  EXPECT_NEAR(shape.all.texels->upper, 4.75, 1e-5);
  EXPECT_DOUBLE_EQ(shape.parts[1].within[one_texel], 1.0);
  EXPECT_DOUBLE_EQ(shape.parts[2].within[one_texel], 0.0);
  EXPECT_DOUBLE_EQ(shape.parts[2].within[two_texels], 1.0);
}

TEST(ErrorShape, At_an_edge_is_two_texels_from_it_or_a_pixel_beside_it) {
  for (const double texel : {0.2, 0.01}) {  // 0.5 and 10 texels a pixel
    Row row(zenith, texel);
    row.wrong.weights[9] = uvec4(4, 0, 0, 0);   // 0.5 px from the edge
    row.wrong.weights[7] = uvec4(0, 4, 0, 0);   // 2.5 px
    row.wrong.weights[17] = uvec4(0, 0, 4, 0);  // 7.5 px
    const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
    EXPECT_DOUBLE_EQ(shape.parts[0].at_edge, 1.0);
    EXPECT_DOUBLE_EQ(shape.parts[1].at_edge, texel == 0.2 ? 1.0 : 0.0);
    EXPECT_DOUBLE_EQ(shape.parts[2].at_edge, 0.0);
    EXPECT_DOUBLE_EQ(shape.all.at_edge, texel == 0.2 ? 2.0 / 3.0 : 1.0 / 3.0);
  }
}

TEST(ErrorShape, The_parts_weigh_what_the_whole_does) {
  Row row;
  for (std::size_t i = 0; i < 20; ++i) row.wrong.weights[i] = uvec4(i % 2, i % 3 == 0, 0, i % 5 == 0);
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  double sum = 0.0;
  for (const EdgeDistances& part : shape.parts) sum += part.weight;
  EXPECT_DOUBLE_EQ(sum, shape.all.weight);
  double last = 0.0;
  for (const double share : shape.all.within) {
    EXPECT_GE(share, last);
    last = share;
  }
}

TEST(ErrorShape, Pixels_that_are_not_counted_do_not_weigh) {
  Row row;
  row.wrong.weights[3] = uvec4(4, 0, 0, 0);
  row.ground.counted.exclusion[3] = PixelExclusion::outside_map;
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  EXPECT_EQ(shape.all.weight, 0.0);
  EXPECT_EQ(shape.components->count, 0u);
}

TEST(ErrorShape, Without_error_there_is_no_distance) {
  const Row row;
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  EXPECT_EQ(shape.edges, 1u);
  EXPECT_FALSE(shape.all.pixels);
  EXPECT_EQ(shape.components->count, 0u);
}

TEST(ErrorShape, Without_an_edge_the_error_is_near_none) {
  Row row;
  row.wrong.weights[3] = uvec4(4, 0, 0, 0);
  for (const float everywhere : {0.0f, 1.0f}) {
    row.truth = Image<float>(20, 1, everywhere);
    const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
    EXPECT_EQ(shape.edges, 0u);
    EXPECT_DOUBLE_EQ(shape.all.weight, 1.0);
    EXPECT_FALSE(shape.all.texels);
    EXPECT_EQ(shape.all.within.back(), 0.0);
    EXPECT_EQ(shape.components->count, 1u);
  }
}

TEST(ErrorShape, Pieces_are_counted_in_all_and_by_class) {
  Row row;
  for (const std::size_t i : {2u, 3u}) row.wrong.weights[i] = uvec4(4, 0, 0, 0);
  for (const std::size_t i : {4u, 5u, 6u}) row.wrong.weights[i] = uvec4(0, 4, 0, 0);
  row.wrong.weights[15] = uvec4(0, 0, 1, 0);
  const ErrorShape shape = analyze_error_shape(row.input(), row.wrong);
  EXPECT_EQ(shape.components->count, 2u);
  EXPECT_EQ(shape.components->largest_area, 5u);
  EXPECT_DOUBLE_EQ(shape.components->largest_share, 20.0 / 21.0);
  EXPECT_DOUBLE_EQ(shape.components->largest_x, 4.0);
  EXPECT_EQ(shape.class_components[0].largest_area, 2u);
  EXPECT_EQ(shape.class_components[1].largest_area, 3u);
  EXPECT_EQ(shape.class_components[2].count, 1u);
  EXPECT_EQ(shape.class_components[3].count, 0u);
}

// Noise of V is in the error and in its weight, so that their product alone would have a bias.
TEST(ErrorShape, The_share_outside_the_penumbra_is_right_with_few_rays) {
  constexpr int rays = 16;
  constexpr double visibility = 0.25;  // the weight of the penumbra is 4 · ¼ · ¾
  Row row;
  const Image<float> raster(row.truth.width, row.truth.height, 1.0f);
  Image<float> variance = row.truth;
  std::mt19937 random(1);
  std::binomial_distribution<int> lit(rays, visibility);
  constexpr int draws = 1000;
  double mean = 0.0;
  for (int draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < row.truth.size(); ++i) {
      row.truth[i] = static_cast<float>(lit(random)) / rays;
      variance[i] = row.truth[i] * (1.0f - row.truth[i]) / (rays - 1);
    }
    ShapeInput input = row.input();
    input.truth_variance = &variance;
    mean += *analyze_error_shape(input, raster).outside_penumbra / draws;
  }
  EXPECT_NEAR(mean, 0.25, 0.01);
}

TEST(ErrorShape, A_share_is_split_by_sign_and_by_the_penumbra) {
  Row row;
  for (std::size_t i = 0; i < 20; ++i)
    row.truth[i] = i < 8 ? 1.0f : i < 12 ? 0.875f - 0.25f * static_cast<float>(i - 8) : 0.0f;
  Image<float> raster = row.truth;
  raster[2] = 0.75f;  // 0.25 too dark in the light, 7.5 px from where the truth passes ½
  raster[9] = 0.5f;   // 0.125 too dark within the penumbra, ½ px
  raster[10] = 1.0f;  // 0.625 too bright within it, ½ px
  const ErrorShape shape = analyze_error_shape(row.input(), raster);
  ASSERT_EQ(shape.parts.size(), 2u);
  EXPECT_DOUBLE_EQ(shape.all.weight, 1.0);
  EXPECT_DOUBLE_EQ(shape.parts[0].weight, 0.375);
  EXPECT_DOUBLE_EQ(shape.parts[1].weight, 0.625);
  // Weights 1 − 4V(1 − V): 1 in the light, 1/16 where V is ⅝ and ⅜.
  EXPECT_DOUBLE_EQ(*shape.outside_penumbra, 0.25 + (0.125 + 0.625) / 16.0);
  EXPECT_NEAR(shape.parts[0].pixels->median, 7.5, 1e-5);
  EXPECT_NEAR(shape.parts[1].pixels->largest, 0.5, 1e-5);
  EXPECT_FALSE(shape.components);
}

// Noise lets the sampled truth of a wide penumbra cross ½ in several places.
TEST(ErrorShape, Edges_of_a_sampled_truth_are_those_of_its_hard_shadow) {
  Row row;
  const Image<float> hard = row.truth;
  for (std::size_t i = 6; i < 14; ++i) row.truth[i] = i % 2 == 0 ? 0.45f : 0.55f;
  Image<float> raster = row.truth;
  raster[3] = 0.0f;
  ShapeInput input = row.input();
  EXPECT_EQ(analyze_error_shape(input, raster).edges, 9u);
  input.hard_truth = &hard;
  const ErrorShape shape = analyze_error_shape(input, raster);
  EXPECT_EQ(shape.edges, 1u);
  EXPECT_NEAR(shape.all.pixels->median, 6.5, 1e-5);
}

}  // namespace
}  // namespace umbrameter
