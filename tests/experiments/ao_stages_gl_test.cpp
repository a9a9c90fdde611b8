// Ambient-occlusion error by stage, of every technique on built-in scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "experiments/measure/measure.h"
#include "experiments/measure/measure_ao_stages.h"
#include "scenes/builtin.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/shapes.h"

namespace umbrameter {
namespace {

struct Measured {
  AoMeasurement ao;
  AoStages stages;
};

class AoStagesGl : public test::GlFixture {
 protected:
  static Experiment experiment(AoTechniques::Choice technique, const std::string& camera) {
    Experiment experiment;
    experiment.view.size = {160, 90};
    experiment.view.camera = camera;
    experiment.ao.technique = technique;
    experiment.truth.spp = 16;
    return experiment;
  }
  static Measured measure(Stages& stages, const Experiment& relative) {
    const Experiment experiment = stages.in_metres(relative);
    AoMeasurement ao = measure_ao(stages, experiment, {});
    AoStages measured = measure_ao_stages(stages, experiment, *ao.truth, *ao.raster, Console{});
    return {std::move(ao), std::move(measured)};
  }
  static const AoStageError& of(const Measured& measured, AoStage stage) {
    return measured.stages.statistics.stages[static_cast<std::size_t>(stage)];
  }
};

TEST_F(AoStagesGl, The_signed_stages_of_every_technique_add_up_to_its_error) {
  Stages stages(load_scene("corner"), {}, Console{});
  for (const AoTechniques::Choice technique :
       {AoTechniques::choice<Ssao>, AoTechniques::choice<Gtao>, AoTechniques::choice<Hbao>,
        AoTechniques::choice<Alchemy>, AoTechniques::choice<Crytek>}) {
    const Measured measured = measure(stages, experiment(technique, "overview"));
    double sum = 0.0;
    for (const AoStageError& stage : measured.stages.statistics.stages) sum += stage.mean.value;
    // The error that a run reports without stages.
    EXPECT_NEAR(sum, measured.ao.statistics->error.mean_error.value, 1e-6) << static_cast<int>(technique);
    EXPECT_NEAR(measured.stages.statistics.total.rmse.value, measured.ao.statistics->error.rmse.value, 1e-9);
    // No occluder of the surfels in this view is outside it.
    EXPECT_NEAR(of(measured, AoStage::off_screen).mean.value, 0.0, 1e-3) << static_cast<int>(technique);
  }
}

TEST_F(AoStagesGl, Further_bounces_with_the_albedo_of_each_surface_are_part_of_the_model) {
  Stages stages(load_scene("corner"), {}, Console{});
  Experiment plain = experiment(AoTechniques::choice<Hbao>, "overview");
  plain.ao.blur.kind = AoBlur::none;
  const Measured before = measure(stages, plain);
  Experiment bounces = plain;
  bounces.ao.tone = {.multi_bounce = true, .albedo_source = AoAlbedo::surface};
  const Measured after = measure(stages, bounces);
  const auto surfels = stages.surfels(plain);
  const GBuffer& gbuffer = surfels->gbuffer;
  float largest = 0.0f;
  for (std::size_t i = 0; i < gbuffer.albedo.size(); ++i) {
    const double luminance = glm::dot(dvec3(0.2126, 0.7152, 0.0722), dvec3(gbuffer.albedo[i]));
    const double albedo = luminance * (1.0 - static_cast<double>(gbuffer.metallic[i]));
    const float raw = (*before.ao.raster)[i];
    EXPECT_NEAR((*after.ao.raster)[i], with_bounces(raw, albedo), 1e-5f);
    largest = std::max(largest, (*after.ao.raster)[i] - raw);
  }
  EXPECT_GT(largest, 0.05f);
  EXPECT_GT(of(after, AoStage::model).mean.value, of(before, AoStage::model).mean.value);
  double sum = 0.0;
  for (const AoStageError& stage : after.stages.statistics.stages) sum += stage.mean.value;
  EXPECT_NEAR(sum, after.ao.statistics->error.mean_error.value, 1e-6);
}

TEST_F(AoStagesGl, Seen_from_above_a_trench_is_as_solid_as_the_depth_buffer_assumes) {
  Stages stages(load_scene("trench"), {}, Console{});
  Experiment above = experiment(AoTechniques::choice<Ssao>, "above");
  above.view.size = {320, 180};  // a pixel is half as wide as the narrowest slot
  above.truth.spp = 8;
  above.ao.ssao.range_check = false;  // it fades the walls of deep slots, whose tops are far from their floors in depth
  const Measured measured = measure(stages, above);
  // The walls are seen edge-on, by no pixel: without them the slots are much brighter, and solid blocks mend all of it.
  const Estimate& hidden = of(measured, AoStage::hidden).mean;
  const Estimate& thin = of(measured, AoStage::thin).mean;
  EXPECT_GT(hidden.lower, 0.05);
  const double interval = 0.5 * (hidden.upper - hidden.lower + thin.upper - thin.lower);
  EXPECT_NEAR(hidden.value + thin.value, 0.0, interval + 0.001);
  // The points that the range check would fade are the only ones of which method and integral differ much.
  EXPECT_NEAR(of(measured, AoStage::approximation).mean.value, 0.0, 0.02);
}

TEST_F(AoStagesGl, With_many_samples_HBAO_and_GTAO_without_falloff_come_to_their_own_integrals) {
  Stages stages(load_scene("trench"), {}, Console{});
  const Measured hbao = measure(stages, experiment(AoTechniques::choice<Hbao>, "above"));
  EXPECT_NEAR(of(hbao, AoStage::approximation).mean.value, 0.0, 0.02);
  Experiment plain = experiment(AoTechniques::choice<Gtao>, "above");
  plain.ao.gtao.falloff_range = 0.0;
  plain.ao.gtao.power = 1.0;
  const double without_falloff = of(measure(stages, plain), AoStage::approximation).mean.value;
  EXPECT_NEAR(without_falloff, 0.0, 0.02);
  // With a falloff GTAO mixes cosines of horizons. Occlusion is their square: a weight acts squared, and too little.
  plain.ao.gtao.falloff_range = 0.615;
  EXPECT_GT(of(measure(stages, plain), AoStage::approximation).mean.value, without_falloff + 0.01);
}

TEST_F(AoStagesGl, A_plateau_out_of_reach_of_bitmask_and_ray_marching_is_hidden_and_neither_thin_nor_approximated) {
  // From above: the side of the plateau is edge-on. 1.15 m beside it, its top is farther away than the bitmask's radius
  // of 1.5 m, √(1.15² + 1²) = 1.524 m, and deeper above each ray of 1.5 m than ray marching's thickness of 0.03 m.
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000}));
  shapes::add_mesh(scene, shapes::box({1.15f, -0.1f, -40}, {40, 1, 40}));
  Camera camera;
  camera.world_from_camera = dmat4(dvec4(1, 0, 0, 0), dvec4(0, 0, -1, 0), dvec4(0, 1, 0, 0), dvec4(0, 5, 0, 1));
  camera.projection = OrthographicProjection{2.55, 1.55, 0.01, 100.0};  // pixels of 10 cm
  scene.cameras = {camera};
  Stages stages(scene, {}, Console{});
  for (const AoTechniques::Choice technique : {AoTechniques::choice<Bitmask>, AoTechniques::choice<Marched>}) {
    Experiment beside = experiment(technique, "");
    beside.view.size = {51, 31};
    beside.ao.sampling.radius = 1.5;
    beside.ao.bitmask.weight = BitmaskWeight::cosine;
    beside.ao.bitmask.rounding = BitmaskRounding::nearest;
    beside.ao.marched.thickness = 0.02;
    const Measured measured = measure(stages, beside);
    const auto change_at = [&](AoStage stage) {
      const Image<float> change = stage_difference(measured.stages.images, stage);
      double mean = 0.0;
      for (int y = 0; y < 31; ++y) mean += static_cast<double>(change.at(25, y)) / 31.0;  // x = 0
      return mean;
    };
    EXPECT_GT(change_at(AoStage::hidden), 0.02) << static_cast<int>(technique);
    EXPECT_EQ(change_at(AoStage::thin), 0.0) << static_cast<int>(technique);
    EXPECT_NEAR(change_at(AoStage::approximation), 0.0, 1e-6) << static_cast<int>(technique);
  }
}

TEST_F(AoStagesGl, With_many_samples_bitmask_and_ray_marching_come_to_their_own_integrals) {
  Stages stages(load_scene("trench"), {}, Console{});
  Experiment bitmask = experiment(AoTechniques::choice<Bitmask>, "above");
  bitmask.ao.bitmask.weight = BitmaskWeight::cosine;
  bitmask.ao.bitmask.rounding = BitmaskRounding::nearest;
  for (Experiment each : {bitmask, experiment(AoTechniques::choice<Marched>, "above")}) {
    each.view.size = {96, 54};
    const Measured measured = measure(stages, each);
    EXPECT_NEAR(of(measured, AoStage::approximation).mean.value, 0.0, 0.02);
  }
}

TEST_F(AoStagesGl, Bias_and_range_check_of_full_sphere_SSAO_brighten_an_open_plane) {
  // Points less than the bias b behind the plane along the view axis count as open. For an angle θ between normal and
  // axis they fill a slab of thickness c = b cos θ / R of the unit ball: the result is ½ + (3c − c³)/4.
  Scene scene = shapes::empty_scene();
  shapes::add_mesh(scene, shapes::quad({-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000}));
  const auto mean_at = [&](double angle, bool range_check) {
    Camera camera;
    const dvec3 z(0, std::cos(angle), std::sin(angle));
    camera.world_from_camera =
        dmat4(dvec4(1, 0, 0, 0), dvec4(glm::cross(z, dvec3(1, 0, 0)), 0), dvec4(z, 0), dvec4(10.0 * z, 1));
    camera.projection = OrthographicProjection{1.0, 1.0, 0.01, 100.0};
    scene.cameras = {camera};
    Stages stages(scene, {}, Console{});
    Experiment plane = experiment(AoTechniques::choice<Crytek>, "");
    plane.ao.sampling.radius = 0.2;
    plane.ao.bias.depth = 0.01;
    plane.ao.ssao.range_check = range_check;
    const Measured measured = measure(stages, plane);
    EXPECT_NEAR(of(measured, AoStage::model).mean.value, -0.5, 1e-6);
    // Away from the image's border, beyond which points are compared with the depths at the border.
    const auto approximation = static_cast<std::size_t>(AoStage::approximation) + 1;
    const Image<float>& drawn = measured.stages.images.accessibility[approximation];
    double mean = 0.0;
    for (int y = 25; y < 65; ++y) {
      for (int x = 60; x < 100; ++x) mean += static_cast<double>(drawn.at(x, y)) / 1600.0;
    }
    return mean;
  };
  for (const double angle : {0.0, pi / 3.0}) {
    const double c = 0.05 * std::cos(angle);
    EXPECT_NEAR(mean_at(angle, false), 0.5 + (3.0 * c - c * c * c) / 4.0, 1.5e-3) << angle;
  }
  // At 60° the plane that the ball covers spans depths of ±1.7 radii, and beyond one radius the range check fades.
  EXPECT_GT(mean_at(pi / 3.0, true), mean_at(pi / 3.0, false) + 0.01);
}

}  // namespace
}  // namespace umbrameter
