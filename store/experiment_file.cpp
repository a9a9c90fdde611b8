#include "store/experiment_file.h"

#include <string>

#include "core/error.h"
#include "experiments/settings/sweep.h"
#include "reports/files/data.h"

namespace umbrameter {

Experiment load_experiment(const std::filesystem::path& path, Experiment experiment) {
  const ExperimentFile file = read_experiment(path);
  experiment.scene = file.scene;
  experiment.axes = file.axes;
  const Parameters parameters = describe(experiment);
  const auto at_line = [&](const std::string& key, const auto& action) {
    try {
      action();
    } catch (const Error& error) {
      throw Error(error.code(), path.string() + ":" + std::to_string(file.lines.at(key)), error.what());
    }
  };
  for (const auto& [key, value] : file.values) {
    if (key.starts_with("preset.")) continue;  // what a preset says of itself
    at_line(key, [&, &k = key, &v = value] { require(parameters, k).set(v); });
  }
  for (const auto& [key, text] : file.axes) {
    at_line("vary." + key, [&, &k = key, &t = text] { parse_axis(parameters, k, t); });
  }
  return experiment;
}

std::string engine_in(const std::filesystem::path& path) {
  for (const auto& [key, value] : read_experiment(path).values) {
    if (key == engine_key) return to_string(value);
  }
  return {};
}

}  // namespace umbrameter
