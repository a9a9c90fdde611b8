// The AO methods: an open plane, a wall of known occlusion, and the shader against the processor.
#include <algorithm>
#include <cmath>

#include "ao_fixture.h"

namespace umbrameter {
namespace {

using namespace testing_scenes;

TEST_F(AoMethodsGl, An_open_plane_is_open_for_GTAO_but_at_grazing_angles) {
  AoParams params = method(AoTechniques::choice<Gtao>);
  params.blur.kind = AoBlur::box;
  // At 60 and 85 degrees a sample's pixel lies beside the slice, and the plane is higher there than in the slice.
  for (const auto spacing : {AoSliceSpacing::angle, AoSliceSpacing::image}) {
    params.slices.spacing = spacing;
    // Even in the image, slices are not even about the direction to the viewer at the edge.
    const double at_edge = spacing == AoSliceSpacing::image ? 0.01 : 0.005;
    expect_open_plane(params, {{10, at_edge}, {30, 0.005}, {60, 0.02}, {85, 0.06}});
  }
}

TEST_F(AoMethodsGl, GTAO_meets_the_closed_form_beside_a_step) {
  AoParams params = method(AoTechniques::choice<Gtao>);
  params.sampling.radius = 4.0;
  params.gtao = {1.0, 1e-3, 2.0, 0.0, 1.0};
  params.slices.slices = 8;
  params.slices.steps = 48;
  // ½(1 − d/√(d² + h²)), weighted by the cosine.
  EXPECT_NEAR(beside_step(params, 1.0), 0.853553, 0.01);
  EXPECT_NEAR(beside_step(params, 0.25), 0.621268, 0.01);
}

TEST_F(AoMethodsGl, GTAO_is_that_of_the_processor) {
  AoParams params = method(AoTechniques::choice<Gtao>);
  params.gtao.thin_compensation = 0.7;
  for (const auto spacing : {AoSliceSpacing::angle, AoSliceSpacing::image}) {
    params.slices.spacing = spacing;
    expect_as_on_cpu(params, shared::GtaoMethod{}, settings_of(std::get<Gtao>(make_technique(params))));
  }
}

TEST_F(AoMethodsGl, An_open_plane_is_open_for_HBAO_and_Alchemy_AO_and_half_open_for_full_sphere_SSAO) {
  AoParams params = method(AoTechniques::choice<Hbao>);
  params.blur.kind = AoBlur::box;
  expect_open_plane(params, {{10, 0.005}, {30, 0.005}, {60, 0.015}, {85, 0.05}});
  params.technique = AoTechniques::choice<Alchemy>;
  for (const auto estimator : {AlchemyEstimator::alchemy, AlchemyEstimator::sao}) {
    params.alchemy.estimator = estimator;
    expect_open_plane(params, {{10, 1e-3}, {30, 1e-3}, {60, 1e-3}, {85, 1e-3}});
  }
  params.technique = AoTechniques::choice<Crytek>;
  params.bias.depth = 0.0;
  // Near the horizon, half of the points lie before the background.
  expect_open_plane(params, {{10, 0.03}, {30, 0.03}, {60, 0.05}, {85, 0.5}}, 0.5);
}

TEST_F(AoMethodsGl, HBAO_meets_its_integral_beside_a_step) {
  AoParams params = method(AoTechniques::choice<Hbao>);
  params.sampling.radius = 3.0;
  params.hbao = {16, 96, 0.0, 1.0, true};
  for (const double distance : {0.5, 1.0}) {
    // The sine of the step's edge in each direction, times 1 - (r/R)².
    const double occlusion = mean_over_disk(1.0, [&](double, double azimuth) {
      if (std::cos(azimuth) <= 0.0) return 0.0;
      const double square = 1.0 + std::pow(distance / std::cos(azimuth), 2);
      return std::max(0.0, 1.0 - square / 9.0) / std::sqrt(square);
    });
    EXPECT_NEAR(beside_step(params, distance), 1.0 - occlusion, 0.015);
  }
}

TEST_F(AoMethodsGl, Alchemy_AO_meets_its_integral_beside_a_step) {
  AoParams params = method(AoTechniques::choice<Alchemy>);
  params.sampling.radius = 2.0;
  params.sampling.samples = 512;
  params.alchemy.turns = 89;
  params.alchemy.bias = 0.0;
  params.alchemy.intensity = 0.5;
  for (const auto estimator : {AlchemyEstimator::alchemy, AlchemyEstimator::sao}) {
    params.alchemy.estimator = estimator;
    for (const double distance : {0.5, 1.0}) {
      const double occlusion = mean_over_disk(2.0, [&](double across, double azimuth) {
        const double square = across * across + 1.0;
        if (across * std::cos(azimuth) <= distance || square >= 4.0) return 0.0;
        // The height is 1 and the radius is 2.
        return estimator == AlchemyEstimator::sao ? 5.0 * 2.0 * std::pow(1.0 - square / 4.0, 3) / square
                                                  : 2.0 * 2.0 / square;
      });
      EXPECT_NEAR(beside_step(params, distance), 1.0 - 0.5 * occlusion, 0.015);
    }
  }
}

TEST_F(AoMethodsGl, A_mip_chain_of_depth_changes_far_samples_only) {
  AoParams params = method(AoTechniques::choice<Alchemy>);
  params.sampling.radius = 0.2;  // at most 12 pixels wide
  const auto draw = [&](bool mip_chain) {
    params.alchemy.mip_chain = mip_chain;
    Scene scene;
    add_mesh(scene, ground(20));
    add_mesh(scene, box({-1, 0, -1}, {1, 1, 1}));
    return see(scene, perspective_view(160, 120, {2, 3, 4}, {0, 0.5, 0}), params).ao;
  };
  const Image<float> plain = draw(false);
  EXPECT_EQ(draw(true), plain);
  params.sampling.radius = 1.0;
  EXPECT_NE(draw(true), draw(false));
}

TEST_F(AoMethodsGl, Full_sphere_SSAO_is_the_share_of_the_ball_above_the_step) {
  AoParams params = method(AoTechniques::choice<Crytek>);
  params.sampling.radius = 2.0;
  params.sampling.samples = 512;
  params.bias.depth = 0.0;
  params.ssao.range_check = false;
  for (const double distance : {0.5, 1.0}) {
    // In the half-ball above the floor: the discs of the ball at the height y, cut at the step.
    double hidden = 0.0;
    constexpr int parts = 10000;
    for (int i = 0; i < parts; ++i) {
      const double y = (i + 0.5) / parts;  // up to the height 1
      const double r = std::sqrt(4.0 - y * y);
      if (r > distance) hidden += r * r * std::acos(distance / r) - distance * std::sqrt(r * r - distance * distance);
    }
    EXPECT_NEAR(beside_step(params, distance), 0.5 - hidden / parts / (4.0 / 3.0 * pi * 8.0), 0.015);
  }
}

TEST_F(AoMethodsGl, HBAO_Alchemy_AO_and_full_sphere_SSAO_are_those_of_the_processor) {
  AoParams params = method(AoTechniques::choice<Hbao>);
  expect_as_on_cpu(params, shared::HbaoMethod{}, settings_of(std::get<Hbao>(make_technique(params))));
  params.technique = AoTechniques::choice<Alchemy>;
  for (const auto estimator : {AlchemyEstimator::alchemy, AlchemyEstimator::sao}) {
    params.alchemy.estimator = estimator;
    expect_as_on_cpu(params, shared::AlchemyMethod{}, settings_of(std::get<Alchemy>(make_technique(params))));
  }
  // At 48×32 pixels, with a radius of up to 15 pixels: with an offset of 0 samples read levels 0 to 3.
  params.alchemy.mip_chain = true;
  params.alchemy.mip_offset = 0;
  expect_as_on_cpu(params, shared::AlchemyMethod{}, settings_of(std::get<Alchemy>(make_technique(params))));
  params.technique = AoTechniques::choice<Crytek>;
  expect_as_on_cpu(params, shared::CrytekMethod{}, settings_of(std::get<Crytek>(make_technique(params))));
}

}  // namespace
}  // namespace umbrameter
