// truth.shadow: what the reference of a shadow is, and which statistics it has.
#include <gtest/gtest.h>

#include <cmath>

#include "compare/shadow_edges.h"
#include "experiments/measure/measure_image.h"
#include "experiments/measure/shadow_shape.h"
#include "experiments/sweep/sweep_table.h"
#include "tests/experiments/two_occluders_gl.h"

namespace umbrameter {
namespace {

class ShadowReferenceGl : public TwoOccludersGl {
 protected:
  void SetUp() override {
    TwoOccludersGl::SetUp();
    experiment_.view.size = {96, 54};
    experiment_.truth.spp = 64;
  }
};

TEST_F(ShadowReferenceGl, Over_the_pixel_is_sampled_and_has_no_causes) {
  const ShadowMeasurement point = measure_shadow(*stages_, experiment_, 0, {});
  ASSERT_TRUE(by_cause(point) != nullptr);
  experiment_.truth.shadow = ShadowReference::pixel;
  const ShadowMeasurement pixel = measure_shadow(*stages_, experiment_, 0, {});
  EXPECT_TRUE(pixel.is_sampled);
  ASSERT_TRUE(std::holds_alternative<SoftVisibilityStatistics>(*pixel.statistics));
  EXPECT_GT(std::get<SoftVisibilityStatistics>(*pixel.statistics).penumbra.value, 0.0) << "edges are partly lit";
  double difference = 0.0;
  double counted = 0.0;
  for (std::size_t i = 0; i < pixel.truth->visibility.size(); ++i) {
    if (pixel.counted.exclusion[i] != PixelExclusion::none) continue;
    EXPECT_GE(pixel.truth->visibility[i], 0.0f);
    EXPECT_LE(pixel.truth->visibility[i], 1.0f);
    difference += std::abs(static_cast<double>(pixel.truth->visibility[i] - point.truth->visibility[i]));
    ++counted;
  }
  EXPECT_GT(difference, 0.0);
  EXPECT_LT(difference / counted, 0.05) << "away from edges both are the same";
}

TEST_F(ShadowReferenceGl, At_a_point_no_light_has_extent) {
  const ShadowMeasurement without = measure_shadow(*stages_, experiment_, 0, {});
  experiment_.light.angle = 3.0;
  experiment_.light.radius = 0.2;
  EXPECT_TRUE(stages_->is_sampled(experiment_, 0));
  experiment_.truth.shadow = ShadowReference::point;
  const ShadowMeasurement point = measure_shadow(*stages_, experiment_, 0, {});
  const auto* of_point = by_cause(point);
  const auto* of_none = by_cause(without);
  ASSERT_TRUE(of_point != nullptr && of_none != nullptr);
  EXPECT_EQ(point.truth->visibility.pixels, without.truth->visibility.pixels);
  EXPECT_EQ(of_point->acne, of_none->acne);
}

// An edge of a sampled reference would be where it passes ½, which the noise of few rays makes ragged.
TEST_F(ShadowReferenceGl, Edges_are_those_of_the_hard_shadow_at_any_number_of_rays) {
  struct Edges {
    std::uint64_t of_shape = 0;
    std::vector<std::uint8_t> of_samples{};  // of each pixel, in the sampled reference
    double near_edges = 0.0;
  };
  const auto edges_of = [&](int spp) {
    experiment_.truth.spp = spp;
    ShadowMeasurement measured = measure_shadow(*stages_, experiment_, 0, {});
    EXPECT_EQ(measured.is_sampled, experiment_.truth.shadow != ShadowReference::point);
    const auto surfels = stages_->surfels(experiment_);
    const std::vector<std::uint32_t> lights = {0};
    return Edges{measure_shape(*stages_, measured).error.edges,
                 find_shadow_edges(measured.truth->visibility, surfels->gbuffer, measured.counted).bits.pixels,
                 measure_image(*stages_, stages_->in_metres(experiment_), lights, {}).statistics->near_edges};
  };
  experiment_.truth.shadow = ShadowReference::point;
  const Edges hard = edges_of(16);
  ASSERT_GT(hard.of_shape, 50u);
  ASSERT_GT(hard.near_edges, 0.0);
  for (const ShadowReference reference : {ShadowReference::pixel, ShadowReference::light}) {
    experiment_.truth.shadow = reference;
    if (reference == ShadowReference::light) experiment_.light.angle = 16.0;
    const Edges few = edges_of(16);
    const Edges many = edges_of(1024);
    EXPECT_FALSE(few.of_samples == many.of_samples) << "else this test shows nothing";
    EXPECT_EQ(few.of_shape, many.of_shape);
    EXPECT_EQ(few.near_edges, many.near_edges);
    // An area light also counts pixels that face a part of it without its centre.
    if (reference != ShadowReference::pixel) continue;
    EXPECT_EQ(many.of_shape, hard.of_shape);
    EXPECT_EQ(many.near_edges, hard.near_edges);
  }
}

TEST_F(ShadowReferenceGl, The_hard_shadow_of_an_area_light_is_traced_once_and_for_edges_alone) {
  experiment_.light.angle = 4.0;
  const auto rays_for = [&](const auto& work) {
    const std::uint64_t before = stages_->costs().shadow.rays;
    work();
    return stages_->costs().shadow.rays - before;
  };
  for (const int spp : {16, 32}) {
    experiment_.truth.spp = spp;
    std::optional<ShadowMeasurement> shadow;
    const std::uint64_t sampled = rays_for([&] { shadow = measure_shadow(*stages_, experiment_, 0, {}); });
    EXPECT_EQ(sampled, stages_->truth(experiment_, 0)->statistics.rays) << "statistics need no edges";
    const std::uint64_t hard = rays_for([&] { measure_shape(*stages_, *shadow); });
    EXPECT_EQ(hard > 0, spp == 16) << "it does not depend on the number of rays";
    EXPECT_LE(hard, std::uint64_t{96 * 54}) << "one ray a pixel";
  }
}

TEST_F(ShadowReferenceGl, Is_an_axis_of_a_sweep_of_shadows) {
  const Table table = sweep_table(*stages_, experiment_, {"truth.shadow=point,pixel"});
  ASSERT_EQ(table.rows.size(), 2u);
  const std::size_t penumbra = column_index(table, "penumbra");
  EXPECT_EQ(to_number(table.rows[0][penumbra]), 0.0);
  EXPECT_GT(to_number(table.rows[1][penumbra]), 0.0);
}

}  // namespace
}  // namespace umbrameter
