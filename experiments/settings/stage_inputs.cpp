#include "experiments/settings/stage_inputs.h"

#include <algorithm>
#include <array>

#include "techniques/shadow/technique.h"

namespace umbrameter {
namespace {

constexpr std::string_view scene_key = "view.scene";
constexpr std::string_view light_key = "view.light";

// All of the view except the scene, which is loaded before any stage. The light only matters to another renderer, whose
// frames always have one.
Parameters surfel_parameters(Experiment& experiment) {
  Parameters view = describe(experiment.view);
  std::erase_if(view, [&](const Parameter& each) {
    return each.key == scene_key || (each.key == light_key && renderer_title(experiment).empty());
  });
  return concatenate({view, describe(experiment.frame), {require(describe(experiment.engine), engine_key)}});
}

// The adapter, and the parameters of an engine's shadows or of its ambient occlusion.
Parameters engine_parameters(Experiment& experiment, bool of_ao) {
  Parameters all = describe(experiment.engine);
  std::erase_if(all, [&](const Parameter& each) { return each.key != engine_key && is_engine_ao(each.key) != of_ao; });
  return all;
}

// What decides the size of an engine's texels.
Parameters engine_map_parameters(Experiment& experiment) {
  Parameters all = engine_parameters(experiment, false);
  std::erase_if(all, [](const Parameter& each) { return !is_engine_map_size(each.key); });
  return all;
}

Parameters run_parameter(Experiment& experiment, std::string_view key) {
  return {require(describe(experiment.run), key)};
}

// The parameters of shadows that neither the map nor its filter reads.
Parameters visibility_parameters(Experiment& experiment) {
  Parameters all = describe(experiment.shadow);
  const Parameters earlier =
      concatenate({describe(experiment.shadow.map), describe(experiment.shadow.fit),
                   describe(experiment.shadow.map_depth), filtered_map_parameters(experiment.shadow)});
  std::erase_if(all, [&](const Parameter& parameter) { return find(earlier, parameter.key) != nullptr; });
  return concatenate({all, engine_parameters(experiment, false), run_parameter(experiment, "run.classes")});
}

// All of ambient occlusion but what follows the blur.
Parameters ao_parameters(Experiment& experiment) {
  Parameters all = describe(experiment.ao);
  const Parameters later = describe(experiment.ao.tone);
  std::erase_if(all, [&](const Parameter& parameter) { return find(later, parameter.key) != nullptr; });
  return concatenate({all, engine_parameters(experiment, true), run_parameter(experiment, "run.seed")});
}

// Whether lights have extent for reference and statistics.
Parameters emitter_parameters(Experiment& experiment) {
  return concatenate({describe(experiment.light), {require(describe(experiment.truth), "truth.shadow")}});
}

Parameters ao_sampling_parameters(Experiment& experiment) {
  Parameters all = concatenate({describe(experiment.truth), run_parameter(experiment, "run.seed")});
  std::erase_if(all, [](const Parameter& parameter) { return parameter.key == "truth.shadow"; });
  return all;
}

Parameters sampling_parameters(Experiment& experiment) {
  return concatenate({describe(experiment.truth), run_parameter(experiment, "run.seed")});
}

const std::array<StageInputs, stage_count>& stages() {
  static const std::array<StageInputs, stage_count> all = {{
      {"surfels", surfel_parameters, {}, 10.0},
      {"light", [](Experiment& e) { return Parameters{require(describe(e.view), light_key)}; }, {}, 0.0},
      {"emitter", emitter_parameters, {Stage::light}, 0.0},
      {"layout",
       [](Experiment& e) {
         return concatenate({describe(e.shadow.map),
                             describe(e.shadow.fit),
                             {require(describe(e.shadow.map_depth), "shadow.point-map")},
                             engine_map_parameters(e)});
       },
       {Stage::surfels, Stage::light},
       1.0},
      {"counted pixels",
       [](Experiment&) { return Parameters{}; },
       {Stage::surfels, Stage::emitter, Stage::layout},
       1.0},
      {"shadow map", [](Experiment& e) { return describe(e.shadow.map_depth); }, {Stage::layout}, 10.0},
      {"filtered map", [](Experiment& e) { return filtered_map_parameters(e.shadow); }, {Stage::map}, 3.0},
      {"visibility", visibility_parameters, {Stage::surfels, Stage::filtered_map, Stage::emitter}, 2.0},
      {"reference", [](Experiment&) { return Parameters{}; }, {Stage::surfels, Stage::light}, 100.0},
      {"reference of an area light", sampling_parameters, {Stage::surfels, Stage::emitter}, 1000.0},
      {"reference over the pixel", sampling_parameters, {Stage::surfels, Stage::emitter}, 1000.0},
      {"stored G-buffer", [](Experiment& e) { return gbuffer_parameters(e.shading); }, {Stage::surfels}, 3.0},
      {"shading",
       [](Experiment& e) { return describe(e.shading); },
       {Stage::stored_gbuffer, Stage::visibility, Stage::finished_ao},
       5.0},
      {"ambient occlusion", ao_parameters, {Stage::surfels}, 2.0},
      {"finished ambient occlusion", [](Experiment& e) { return describe(e.ao.tone); }, {Stage::ao}, 0.1},
      {"reference of ambient occlusion", ao_sampling_parameters, {Stage::surfels}, 1000.0},
  }};
  return all;
}

// Those of the stage and of all before it.
Parameters read_until(Stage stage, Experiment& experiment) {
  Parameters all = inputs_of(stage).reads(experiment);
  for (const Stage before : inputs_of(stage).after) all = concatenate({std::move(all), read_until(before, experiment)});
  return all;
}

bool reads(Stage stage, std::string_view parameter) {
  Experiment experiment;
  return find(inputs_of(stage).reads(experiment), parameter) != nullptr;
}

}  // namespace

const StageInputs& inputs_of(Stage stage) { return stages()[static_cast<std::size_t>(stage)]; }

std::string own_key_of(Stage stage, Experiment experiment) { return key_of(inputs_of(stage).reads(experiment)); }

std::string key_of(Stage stage, Experiment experiment) {
  std::string key;
  for (const Stage before : inputs_of(stage).after) key += key_of(before, experiment);
  return key + std::string(inputs_of(stage).name) + "\n" + own_key_of(stage, std::move(experiment));
}

Experiment declared(Stage stage, Experiment experiment) {
  Experiment defaults;
  defaults.engine = defaults_of(experiment.engine);
  const Parameters of_defaults = describe(defaults);
  const Parameters read = read_until(stage, experiment);
  for (const Parameter& each : describe(experiment)) {
    const bool stays = each.key == scene_key || each.key.starts_with("scene.") || find(read, each.key) != nullptr;
    if (!stays) each.set(require(of_defaults, each.key).value());
  }
  return experiment;
}

bool depends_on(Stage stage, std::string_view parameter) {
  const std::vector<Stage>& before = inputs_of(stage).after;
  return reads(stage, parameter) ||
         std::ranges::any_of(before, [&](Stage earlier) { return depends_on(earlier, parameter); });
}

double cost_of_change(std::string_view parameter) {
  double cost = 0.0;
  for (std::size_t s = 0; s < stage_count; ++s) {
    if (depends_on(static_cast<Stage>(s), parameter)) cost += stages()[s].cost;
  }
  return cost;
}

}  // namespace umbrameter
