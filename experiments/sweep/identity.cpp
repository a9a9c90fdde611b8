#include "experiments/sweep/identity.h"

#include <fmt/format.h>

#include "experiments/stages/reference_key.h"

namespace umbrameter {

/// Of the sources that decide what is measured; cmake/Algorithms.cmake writes it.
extern const char* const algorithms_hash;

namespace {

// How far a light reaches decides which pixels are counted, and how its map is fitted.
std::string bounds_text(const Light& light) {
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    return fmt::format(" ({}, {}, {})", spot->range, spot->inner_cone_angle, spot->outer_cone_angle);
  }
  const auto* point = std::get_if<PointLight>(&light.shape);
  return point != nullptr ? fmt::format(" ({})", point->range) : "";
}

}  // namespace

Identity measuring_identity(Stages& stages) {
  if (stages.has_engine()) return {{"engine", stages.renderer()}, {"algorithms", algorithms_hash}};
  const GlDevice& device = stages.context().device();
  return {{"device", device.software ? "Mesa's software driver" : device.renderer}, {"algorithms", algorithms_hash}};
}

Identity identity_of_sweep(Stages& stages, Experiment experiment, SweptQuantity quantity) {
  Identity identity = {{"scene", experiment.scene}};
  experiment.run.for_engines.clear();  // it adds to the answer, and changes no row
  for (const Parameter& parameter : describe(experiment)) {
    identity.emplace_back(parameter.key, to_string(parameter.value()));
  }
  identity.emplace_back("measured", std::string(quantity_name(quantity)));
  identity.emplace_back("content of the scene", scene_content(stages.scene()));
  std::string lights;
  for (std::uint32_t i = 0; i < stages.scene().lights.size(); ++i) {
    const Light light = stages.light(experiment, i);
    lights += light_content(light) + bounds_text(light) + " ";
  }
  identity.emplace_back("content of the lights", lights);
  identity.emplace_back("content of the view", surfel_content(stages.surfels(experiment)->gbuffer));
  std::string cameras;
  for (const Camera& camera : stages.scene().cameras) cameras += camera_content(camera) + " ";
  identity.emplace_back("content of the cameras", cameras);
  const Identity measuring = measuring_identity(stages);
  identity.insert(identity.end(), measuring.begin(), measuring.end());
  return identity;
}

std::string maker_of(Stages& stages) {
  return fmt::format("{}, {} {}", tracer_identity(), stages.has_engine() ? "engine" : "OpenGL", stages.renderer());
}

std::string makers_text(const std::string& what, const std::vector<std::string>& makers) {
  if (makers.size() < 2) return {};
  return fmt::format("{} were measured by different programs or machines, whose last digits may differ: {}", what,
                     fmt::join(makers, "; "));
}

}  // namespace umbrameter
