#include "experiments/settings/engine_bias.h"

#include <algorithm>

namespace umbrameter {

std::optional<SweepAxis> engine_bias_axis(Experiment experiment) {
  std::optional<SweepAxis> found;
  const std::vector<EngineParameter> offered = experiment.engine.parameters;
  for (const auto& [key, text] : experiment.axes) {
    const auto bias = std::ranges::find_if(
        offered, [&key = key](const EngineParameter& each) { return each.bias != 0 && "engine." + each.name == key; });
    if (bias == offered.end()) continue;
    if (found) return std::nullopt;
    found = parse_axis(describe(experiment), key, text);
    std::ranges::sort(found->values, {}, [sign = bias->bias](const Value& value) { return sign * to_number(value); });
  }
  return found;
}

}  // namespace umbrameter
