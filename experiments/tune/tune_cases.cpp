#include "experiments/tune/tune_cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/stages/reference_key.h"

namespace umbrameter {
namespace {

std::string indices(std::size_t count) {
  std::string list;
  for (std::size_t i = 0; i < count; ++i) list += fmt::format("{}{}", i > 0 ? "," : "", i);
  return list;
}

SweepAxis parse_case_axis(const Stages& stages, const Parameters& parameters, const std::string& key,
                          const std::string& text) {
  const Scene& scene = stages.scene();
  if (text == "all" && key == "view.camera") return parse_axis(parameters, key, indices(scene.cameras.size()));
  if (text == "all" && key == "view.light") return parse_axis(parameters, key, indices(scene.lights.size()));
  return parse_axis(parameters, key, text);
}

// "overview" for "0" and for "OVERVIEW".
std::string camera_name(Stages& stages, const Experiment& experiment) {
  const std::string name = stages.surfels(experiment)->view.camera.name;
  return name.empty() ? experiment.view.camera : name;
}

void add_cases(std::vector<TuneCase>& cases, Stages& stages, const Experiment& experiment, SweptQuantity quantity,
               const std::string& suffix) {
  const std::string view = fmt::format("{}, camera {}", scene_title(experiment), camera_name(stages, experiment));
  if (quantity != SweptQuantity::visibility) {
    cases.push_back({&stages, experiment, quantity, 0, view + suffix});
    return;
  }
  for (const std::uint32_t light : stages.lights(experiment.view.light)) {
    TuneCase tuned{&stages, experiment, quantity, light, {}};
    tuned.experiment.view.light = std::to_string(light);
    tuned.title = fmt::format("{}, {}{}", view, stages.title(light), suffix);
    cases.push_back(std::move(tuned));
  }
}

void go_over(std::vector<TuneCase>& cases, Stages& stages, Experiment experiment, SweptQuantity quantity,
             const std::vector<SweepAxis>& axes, std::size_t depth, const std::string& suffix) {
  if (depth == axes.size()) return add_cases(cases, stages, stages.in_metres(experiment), quantity, suffix);
  const Parameters parameters = describe(experiment);
  const SweepAxis& axis = axes[depth];
  const bool is_named = axis.key == "view.camera" || axis.key == "view.light";
  for (const Value& value : axis.values) {
    set_value(parameters, axis, value);
    const std::string text = is_named ? "" : fmt::format(", {} {}", axis.key, to_string(value));
    go_over(cases, stages, experiment, quantity, axes, depth + 1, suffix + text);
  }
}

}  // namespace

std::vector<TuneCase> cases_of(Stages& stages, const Experiment& experiment, SweptQuantity quantity,
                               const CaseAxes& over) {
  Experiment base = experiment;
  const Parameters parameters = describe(base);
  std::vector<SweepAxis> axes;
  for (const auto& [key, text] : over) axes.push_back(parse_case_axis(stages, parameters, key, text));
  std::vector<TuneCase> cases;
  go_over(cases, stages, experiment, quantity, axes, 0, "");
  return cases;
}

void require_sense(const std::vector<TuneCase>& cases) {
  std::vector<Light> lights;
  for (const TuneCase& each : cases) {
    if (each.quantity == SweptQuantity::visibility) lights.push_back(each.stages->scene().lights[each.light]);
  }
  if (lights.empty()) return;
  for (const TuneCase& each : cases) require_sense(each.experiment, lights);
}

std::string unused_camera(const std::vector<TuneCase>& cases) {
  if (cases.empty()) return {};
  Stages& stages = *cases.front().stages;
  const Scene& scene = stages.scene();
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    Experiment experiment = cases.front().experiment;
    std::vector<std::string> notes;
    const Camera& camera = scene.cameras[i];
    const bool is_used = std::ranges::any_of(cases, [&](const TuneCase& each) {
      const double aspect = static_cast<double>(each.experiment.view.size.width) / each.experiment.view.size.height;
      const Camera used = select_camera(scene, each.experiment.view.camera, aspect, notes);
      return used.name == camera.name && camera_content(used) == camera_content(camera);
    });
    if (!is_used) return std::to_string(i);
  }
  return {};
}

}  // namespace umbrameter
