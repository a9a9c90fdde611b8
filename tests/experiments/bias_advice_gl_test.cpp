// The bias that compare recommends, against brute force over finer biases than it measures, and where it recommends
// none.
#include <gtest/gtest.h>

#include <memory>

#include "core/error.h"
#include "experiments/measure/bias_advice.h"
#include "experiments/measure/measure_biases.h"
#include "present/bias_advice_report.h"
#include "scenes/builtin.h"
#include "scenes/builtin/shapes.h"

namespace umbrameter {
namespace {

using Settings = std::vector<std::pair<const char*, Value>>;

class BiasAdviceGl : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_shared<gl::Context>(gl::Context::make());
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    reset();
  }

  void reset() {
    experiment_ = {};
    experiment_.view.size = {96, 54};
    experiment_.shadow.map.resolution = 256;
  }

  BiasAdvice advise(Scene scene, const std::string& light, const Settings& settings = {}) {
    StageOptions options;
    options.context = context_;
    stages_ = std::make_unique<Stages>(std::move(scene), options, Console{.quiet = true});
    const Parameters parameters = describe(experiment_);
    for (const auto& [key, value] : settings) require(parameters, key).set(value);
    light_ = stages_->lights(light).front();
    return advise_bias(*stages_, experiment_, light_);
  }

  // On an even axis, in texels.
  double least_by_brute_force(double first, double last, int count) {
    std::vector<double> biases;
    for (int i = 0; i < count; ++i) biases.push_back(first + (last - first) * i / (count - 1));
    double least = 1.0;
    const auto measured = measure_biases(*stages_, experiment_, light_, biases, {experiment_.shadow.bias.slope});
    for (const VisibilityStatistics& each : measured.front()) least = std::min(least, each.mae);
    return least;
  }

  std::shared_ptr<gl::Context> context_;
  std::unique_ptr<Stages> stages_;
  Experiment experiment_;
  std::uint32_t light_ = 0;
};

TEST_F(BiasAdviceGl, Has_at_most_5_percent_or_three_pixels_more_error_than_any_bias_on_either_side) {
  const std::vector<std::tuple<const char*, const char*, Settings>> cases = {
      {"two-occluders", "sun", {{"shadow.polygon-offset-factor", 4.0}, {"shadow.polygon-offset-units", 64.0}}},
      {"two-occluders", "spot", {{"shadow.slope-bias", 3.0}}},
      {"contact-box", "sun-low", {{"shadow.slope-bias", 2.0}}},
      {"contact-box", "sun", {{"shadow.normal-offset", 2.0}}},
      {"corner", "lamp", {}},
      {"long-posts", "sun", {{"shadow.filter", std::string("box")}}},
  };
  for (const auto& [name, light, settings] : cases) {
    reset();
    const BiasAdvice advice = advise(load_scene(name), light, settings);
    const double least = std::min(least_by_brute_force(-20.0, 20.0, 8001), least_by_brute_force(-200.0, 200.0, 4001));
    const double three_pixels = 3.0 / static_cast<double>(advice.evidence.pixels);
    const double limit = std::max(1.05 * least, least + three_pixels);
    EXPECT_LE(advice.plateau.recommended.mae, limit) << name << " " << light;
    EXPECT_LE(advice.plateau.first.constant, advice.plateau.recommended.constant);
    EXPECT_GE(advice.plateau.last.constant, advice.plateau.recommended.constant);
  }
}

TEST_F(BiasAdviceGl, Is_negative_where_a_polygon_offset_is_too_large) {
  const BiasAdvice advice = advise(load_scene("two-occluders"), "sun",
                                   {{"shadow.polygon-offset-factor", 4.0}, {"shadow.polygon-offset-units", 64.0}});
  EXPECT_LT(advice.plateau.least.constant, 0.0);
  EXPECT_LT(advice.plateau.recommended.constant, 0.0);
  EXPECT_FALSE(advice.withheld);
  EXPECT_TRUE(advice_text(advice).starts_with("use bias −")) << advice_text(advice);
}

TEST_F(BiasAdviceGl, A_second_run_with_the_recommended_bias_keeps_it) {
  const BiasAdvice first = advise(load_scene("contact-box"), "sun", {{"shadow.slope-bias", -1.0}});
  ASSERT_FALSE(first.withheld);
  EXPECT_FALSE(keeps_bias(first)) << advice_text(first);
  experiment_.shadow.bias.constant.number = first.plateau.recommended.constant;
  const BiasAdvice second = advise_bias(*stages_, experiment_, light_);
  EXPECT_TRUE(keeps_bias(second)) << advice_text(second);
  EXPECT_EQ(second.used.mae, first.plateau.recommended.mae);
  EXPECT_EQ(advice_text(second).substr(0, 5), "keep ");
}

// A body on four legs as one object, with and without a floor; a sun.
Scene animal(bool with_floor) {
  builtin::Shape shape = builtin::box({-0.5, 0.4, -0.15}, {0.5, 0.7, 0.15});
  for (const double x : {-0.45, 0.35}) {
    for (const double z : {-0.15, 0.05}) builtin::append(shape, builtin::box({x, 0.0, z}, {x + 0.1, 0.4, z + 0.1}));
  }
  Scene scene;
  scene.materials.resize(1);
  const auto add = [&](const char* name, const builtin::Shape& part) {
    const auto number = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(to_mesh(name, part, 0));
    scene.objects.push_back({name});
    scene.instances.push_back({number, number, dmat4(1.0)});
  };
  add("animal", shape);
  if (with_floor) add("floor", builtin::box({-2.0, -0.1, -2.0}, {2.0, 0.0, 2.0}));
  Camera camera;
  camera.world_from_camera[3] = dvec4(0.3, 0.5, 2.0, 1.0);
  scene.cameras.push_back(camera);
  Light sun;
  const dvec3 towards = glm::normalize(dvec3(0.6, 0.7, 1.0));
  const dvec3 side = glm::normalize(glm::cross(dvec3(0, 1, 0), towards));
  sun.world_from_light =
      dmat4(dvec4(side, 0), dvec4(glm::cross(towards, side), 0), dvec4(towards, 0), dvec4(0, 0, 0, 1));
  sun.shape = DirectionalLight{};
  scene.lights.push_back(sun);
  return scene;
}

// A map of two coarse paraboloids has acne up to hundreds of texels. The run's own bias must not decide where it ends.
TEST_F(BiasAdviceGl, The_least_bias_with_little_acne_does_not_depend_on_that_of_the_run) {
  const auto little_acne = [&](double bias) {
    reset();
    experiment_.shadow.map.resolution = 1024;
    experiment_.view.size = {320, 180};
    experiment_.shadow.bias.constant = {bias, LengthUnit::texels};
    return advise(load_scene("courtyard"), "lantern", {{"shadow.point-map", std::string("paraboloid")}})
        .line.little_acne;
  };
  const std::optional<BiasCell> usual = little_acne(1.5);
  ASSERT_TRUE(usual);
  EXPECT_GT(usual->constant, 100.0) << "beyond the first search";
  EXPECT_EQ(little_acne(1000.0)->constant, usual->constant);
}

TEST_F(BiasAdviceGl, An_object_without_a_floor_has_none) {
  experiment_.view.size = {240, 135};
  const BiasAdvice alone = advise(animal(false), "");
  ASSERT_TRUE(alone.withheld) << advice_text(alone);
  EXPECT_TRUE(alone.withheld == NoBias::no_receiver || alone.withheld == NoBias::nothing_blocked);
  EXPECT_NE(advice_text(alone).find("no bias recommended"), std::string::npos);
  EXPECT_NE(advice_text(alone).find("--scene.ground adds a floor"), std::string::npos) << advice_text(alone);
  const BiasAdvice on_floor = advise(animal(true), "");
  EXPECT_FALSE(on_floor.withheld) << advice_text(on_floor);
}

TEST_F(BiasAdviceGl, A_plane_without_shadows_has_none) {
  const BiasAdvice advice = advise(load_scene("tilted-plane"), "sun-60");
  EXPECT_EQ(advice.withheld, NoBias::nothing_blocked);
  EXPECT_NE(advice_text(advice).find("no counted pixel is in shadow"), std::string::npos) << advice_text(advice);
}

TEST_F(BiasAdviceGl, A_view_without_light_has_none) {
  // Between a floor and a wider slab above it, under a steep sun.
  Scene scene = animal(true);
  scene.meshes[0] = to_mesh("slab", builtin::box({-6.0, 1.0, -6.0}, {6.0, 1.1, 6.0}), 0);
  scene.cameras[0].world_from_camera[3] = dvec4(0.0, 0.5, 1.0, 1.0);
  const BiasAdvice advice = advise(std::move(scene), "");
  EXPECT_EQ(advice.withheld, NoBias::nothing_lit);
  EXPECT_NE(advice_text(advice).find("no counted pixel is lit"), std::string::npos) << advice_text(advice);
}

TEST_F(BiasAdviceGl, Few_pixels_are_counted_aloud) {
  experiment_.view.size = {9, 5};
  const BiasAdvice advice = advise(load_scene("contact-box"), "sun");
  EXPECT_EQ(advice.withheld, NoBias::few_pixels);
  EXPECT_NE(advice_text(advice).find("only " + std::to_string(advice.evidence.pixels) + " counted pixels"),
            std::string::npos)
      << advice_text(advice);
}

}  // namespace
}  // namespace umbrameter
