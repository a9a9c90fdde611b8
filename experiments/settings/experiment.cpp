#include "experiments/settings/experiment.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <string_view>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> class_rule_names{"fast", "exact"};
// Of a parameter that has no limit by its meaning: its cube is finite in single precision.
constexpr double largest_number = 1e12;

constexpr std::array<std::string_view, 4> sweep_measure_names{"auto", "visibility", "ao", "image"};

void require_metres(const Parameters& parameters) {
  for (const Parameter& parameter : parameters) {
    const auto* const* length = std::get_if<Length*>(&parameter.field);
    if (length == nullptr || (*length)->unit == LengthUnit::metres) continue;
    throw Error(ExitCode::usage, parameter.key, to_string(**length) + " is not in metres",
                "pass the experiment through Stages::in_metres() first");
  }
}

// "1.5texels" does, "0.04" does not.
bool names_its_unit(const Parameter& parameter) {
  const auto* const* length = std::get_if<Length*>(&parameter.field);
  return length != nullptr && (*length)->unit != LengthUnit::metres;
}

}  // namespace

Parameters describe(RunParams& params) {
  return Description("run")
      .field("seed", params.seed, {"", "seed of all random numbers", 0, std::numeric_limits<int>::max()})
      .choice("classes", params.classes, class_rule_names,
              {.unit = {},
               .meaning = "separate acne from false occlusion by triangle planes (fast), or also by rays (exact)"})
      .choice("measure", params.measure, sweep_measure_names,
              {.unit = {},
               .meaning = "what is traced, drawn and measured; auto: shadows and AO, in a sweep depending on the axes",
               .aliases = {{"shadows", "visibility"}}})
      .field("shimmer", params.shimmer,
             {"", "measure shimmer: shadow map and camera move by fractions of a texel or pixel"})
      .field("ao-stages", params.ao_stages,
             {"", "split the error of AO by stage, from the method's model to its blur; costs further rays"})
      .field(
          "metrics", params.metrics,
          {"",
           "image metrics of what is measured, also in sweeps: ldr-flip, ssim, edge-roughness, ... (docs/metrics.md)"})
      .field("write-maps", params.write_maps, {"", "write each shadow map with its projection as an EXR file"})
      .field("write-ao-inputs", params.write_ao_inputs,
             {"", "write what the AO technique reads: depth, normals, matrices, kernel and noise, as EXR and JSON"})
      .field("overlay", params.overlay,
             {"", "debug views in a corner of the image and as figures: all, depth, normal, shadow-map:LIGHT, ..."})
      .field("for", params.for_engines,
             {"",
              "recommended bias also as settings of engines, such as godot,three:near=1 (three.js with its near "
              "plane at 1 m)"})
      .take();
}

Parameters describe(Experiment& experiment) {
  Parameters all = concatenate({describe(experiment.scene_params), describe(experiment.view),
                                describe(experiment.light), describe(experiment.shadow), describe(experiment.ao),
                                describe(experiment.shading), describe(experiment.engine), describe(experiment.frame),
                                describe(experiment.truth), describe(experiment.run)});
  for (Parameter& parameter : all) {
    if (!std::holds_alternative<double*>(parameter.field) && !std::holds_alternative<Length*>(parameter.field))
      continue;
    FieldDescription& description = parameter.description;
    description.min = std::max(description.min, -largest_number);
    description.max = std::min(description.max, largest_number);
  }
  return all;
}

std::string renderer_title(const Experiment& experiment) {
  return experiment.engine.adapter.empty() ? title_of(experiment.frame) : experiment.engine.engine;
}

Experiment in_metres(Experiment experiment, double scene_size) {
  experiment.ao = in_metres(experiment.ao, scene_size);
  Length& limit = experiment.truth.ao_distance;
  limit = limit.unit == LengthUnit::automatic ? experiment.ao.sampling.radius.number : to_metres(limit, scene_size);
  return experiment;
}

void require_metres(AoParams params) { require_metres(describe(params)); }

void require_metres(TruthParams params) { require_metres(describe(params)); }

std::string scene_title(const Experiment& experiment) {
  const std::string name = std::filesystem::path(experiment.scene).filename().string();
  return experiment.view.scene.empty() ? name : name + ", scene " + experiment.view.scene;
}

std::string key_of(const Parameters& parameters) {
  std::string key;
  for (const Parameter& parameter : parameters) key += parameter.key + "=" + to_string(parameter.value()) + "\n";
  return key;
}

std::string parameter_reference() {
  Experiment experiment;
  std::string text =
      "# Parameters\n\n"
      "Generated by `umbrameter parameters --markdown`. Each name is a flag (with `--` in front), a key in an\n"
      "experiment file (`[group]`, then the part after the dot) and a column of a sweep.\n";
  std::string group;
  for (const Parameter& parameter : describe(experiment)) {
    const std::string of = parameter.key.substr(0, parameter.key.find('.'));
    if (of != group) {
      group = of;
      text += "\n## " + group + "\n\n| name | default | unit | allowed | meaning |\n| --- | --- | --- | --- | --- |\n";
    }
    const std::string value = to_string(parameter.value());
    text += "| `" + parameter.key + "` | " + (value.empty() ? "" : "`" + value + "`") + " | " +
            parameter.description.unit + " | " + parameter.limits() + " | " + parameter.description.meaning + " |\n";
  }
  return text;
}

// Those that differ from their defaults come first.
Table settings_table(Experiment experiment) {
  Table table{{{"parameter", "", "full name: as a flag, as a key of experiment.toml and as a column"},
               {"value", "", "value in this run; for a varied parameter, its axis"},
               {"default", "", "value without the flag"},
               {"unit", "", "unit of a number that is written without one"},
               {"meaning", "", "what it sets"}},
              {}};
  Experiment defaults;
  defaults.engine = defaults_of(experiment.engine);
  const Parameters of_defaults = describe(defaults);
  for (const Parameter& parameter : describe(experiment)) {
    if (parameter.key.starts_with("frame.") && !has_files(experiment.frame)) continue;
    std::string value = to_string(parameter.value());
    for (const auto& [key, text] : experiment.axes) {
      if (key == parameter.key) value = "varied: " + text;
    }
    const Parameter& usual = require(of_defaults, parameter.key);
    const bool has_own_units = names_its_unit(parameter) && names_its_unit(usual);
    std::string meaning = parameter.description.meaning;
    if (parameter.description.units.scene_size) meaning += "; " + std::string(unit_name(LengthUnit::scene_percent));
    table.rows.push_back({parameter.key, value, to_string(usual.value()),
                          has_own_units ? "" : parameter.description.unit, std::move(meaning)});
  }
  std::stable_partition(table.rows.begin(), table.rows.end(),
                        [](const std::vector<Value>& row) { return row[1] != row[2]; });
  return table;
}

}  // namespace umbrameter
