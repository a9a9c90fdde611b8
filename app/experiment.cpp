#include "app/experiment.h"

#include <array>
#include <filesystem>
#include <limits>
#include <string_view>

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> class_rule_names{"fast", "exact"};
constexpr std::array<std::string_view, 3> sweep_measure_names{"auto", "visibility", "ao"};

}  // namespace

Parameters describe(RunParams& params) {
  return Description("run")
      .field("seed", params.seed, {"", "seed of all random numbers", 0, std::numeric_limits<int>::max()})
      .choice("classes", params.classes, class_rule_names,
              {.unit = {}, .meaning = "test for acne against false occlusion: triangle planes, or rays where needed"})
      .choice("measure", params.measure, sweep_measure_names,
              {.unit = {}, .meaning = "what a sweep measures; auto: by its axes"})
      .field("shimmer", params.shimmer,
             {"", "measure shimmer: shadow map and camera move by fractions of a texel or pixel"})
      .take();
}

Parameters describe(Experiment& experiment) {
  return concatenate({describe(experiment.reading), describe(experiment.view), describe(experiment.light),
                      describe(experiment.shadow), describe(experiment.ao), describe(experiment.truth),
                      describe(experiment.run)});
}

Experiment in_metres(Experiment experiment, double scene_size) {
  experiment.ao = in_metres(experiment.ao, scene_size);
  Length& limit = experiment.truth.ao_distance;
  limit = limit.unit == LengthUnit::automatic ? experiment.ao.radius.number : to_metres(limit, scene_size);
  return experiment;
}

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
      "Made by `umbrameter parameters --markdown` from the descriptions in the code. Each name is the flag (`--` in\n"
      "front), the key in an experiment file (`[group]`, then the part after the dot) and the column of a sweep.\n";
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

Table settings_table(Experiment experiment) {
  Table table{{{"parameter", "", "full name: flag, key and column"},
               {"value", "", "as set for this run; of a varied parameter its axis"},
               {"unit", "", "of the value"},
               {"meaning", "", "what it sets"}},
              {}};
  for (const Parameter& parameter : describe(experiment)) {
    std::string value = to_string(parameter.value());
    for (const auto& [key, text] : experiment.axes) {
      if (key == parameter.key) value = "varied: " + text;
    }
    table.rows.push_back({parameter.key, value, parameter.description.unit, parameter.description.meaning});
  }
  return table;
}

}  // namespace umbrameter
