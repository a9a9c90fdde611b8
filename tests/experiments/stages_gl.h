// Stages of the scene contact-box on the default driver, and values to vary; a test without a driver is skipped.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/error.h"
#include "experiments/stages/stages.h"
#include "scenes/builtin.h"

namespace umbrameter {

// Another value that the parameter accepts, as text; for a choice, all of them.
inline std::vector<std::string> values_of(const Parameter& parameter) {
  const FieldDescription& limits = parameter.description;
  if (const auto* choice = std::get_if<ChoiceRef>(&parameter.field)) return choice->names;
  if (std::holds_alternative<bool*>(parameter.field)) return {"false", "true"};
  if (std::holds_alternative<Size*>(parameter.field)) return {"64x36", "48x36"};
  if (const auto* const* length = std::get_if<Length*>(&parameter.field)) {
    Length other = **length;
    other.number = 1.5 * other.number + 0.01;
    return {to_string(**length), to_string(other)};
  }
  if (const auto* const* integer = std::get_if<int*>(&parameter.field)) {
    const int step = limits.power_of_two ? **integer : 2;
    const bool has_room = **integer + step <= limits.max;
    return {std::to_string(**integer), std::to_string(has_room ? **integer + step : **integer - step)};
  }
  if (const auto* const* real = std::get_if<double*>(&parameter.field)) {
    const double step = std::min(0.5, 0.25 * (limits.max - limits.min));
    const double other = **real + step <= limits.max ? **real + step : **real - step;
    return {to_string(Value(**real)), to_string(Value(other))};
  }
  return {};
}

class ContactBoxGl : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_shared<gl::Context>(gl::Context::make());
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }

  std::unique_ptr<Stages> make_stages() const {
    StageOptions options;
    options.context = context_;
    Scene scene = load_scene("contact-box");
    if (has_point_light_) {
      const Bounds bounds = bounds_of(scene);
      Light& light = scene.lights.front();
      light.world_from_light[3] = dvec4(bounds.center() - bounds.radius() * light.axis(), 1.0);
      light.shape = PointLight{};
    }
    return std::make_unique<Stages>(std::move(scene), options, Console{.quiet = true});
  }

  static Experiment base(const std::vector<std::string>& settings) {
    Experiment experiment;
    experiment.view.size = {64, 36};
    experiment.truth.spp = 8;
    experiment.truth.ao_distance = 0.3;
    experiment.ao.sampling.radius = 0.3;
    experiment.ao.bias.depth = 0.01;
    experiment.ao.sampling.samples = 8;
    experiment.shadow.map.resolution = 64;
    const Parameters parameters = describe(experiment);
    for (const std::string& setting : settings) {
      const std::size_t equals = setting.find('=');
      require(parameters, setting.substr(0, equals)).set_text(setting.substr(equals + 1));
    }
    return experiment;
  }

  bool has_point_light_ = false;

 private:
  std::shared_ptr<gl::Context> context_;
};

}  // namespace umbrameter
