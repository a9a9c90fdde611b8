#include "experiments/sweep/axis_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "core/error.h"
#include "experiments/settings/stage_inputs.h"
#include "techniques/ao/read_parameters.h"
#include "techniques/shading/read_parameters.h"
#include "techniques/shadow/read_parameters.h"

namespace umbrameter {
namespace {

// The stages whose results the statistics of a quantity are computed from.
std::vector<Stage> measured_stages(SweptQuantity quantity) {
  const std::vector<Stage> shadow = {Stage::visibility, Stage::counted, Stage::binary_reference, Stage::area_reference,
                                     Stage::pixel_reference};
  const std::vector<Stage> occlusion = {Stage::finished_ao, Stage::ao_reference};
  if (quantity == SweptQuantity::visibility) return shadow;
  if (quantity == SweptQuantity::ao) return occlusion;
  std::vector<Stage> image = {Stage::shading};
  image.insert(image.end(), shadow.begin(), shadow.end());
  image.insert(image.end(), occlusion.begin(), occlusion.end());
  return image;
}

bool is_measured(SweptQuantity quantity, std::string_view parameter) {
  const std::vector<Stage> stages = measured_stages(quantity);
  return std::ranges::any_of(stages, [&](Stage stage) { return depends_on(stage, parameter); });
}

bool is_read_by_technique(Experiment& experiment, std::string_view key) {
  const bool is_ours = key.starts_with("shadow.") || key.starts_with("ao.") || key.starts_with("shading.");
  if (is_ours && !experiment.engine.adapter.empty()) return false;
  if (key.starts_with("shadow.")) return find(read_parameters(experiment.shadow), key) != nullptr;
  if (key.starts_with("ao.")) return find(read_parameters(experiment.ao), key) != nullptr;
  if (key.starts_with("shading.")) return find(read_parameters(experiment.shading), key) != nullptr;
  return true;
}

// Other values of a parameter on which it may depend whether another one is read: words, and cascades.
std::vector<Value> alternatives(const Parameter& parameter) {
  if (const auto* choice = std::get_if<ChoiceRef>(&parameter.field))
    return {choice->names.begin(), choice->names.end()};
  if (std::holds_alternative<bool*>(parameter.field)) return {false, true};
  const auto* const* number = std::get_if<int*>(&parameter.field);
  const FieldDescription& limits = parameter.description;
  if (number == nullptr || **number + 1 > limits.max || limits.odd || limits.power_of_two) return {};
  return {std::int64_t{**number} + 1};
}

// "shadow.filter nearest does not read it", and what would, of which all axes have an effect.
Error unread(SweptQuantity quantity, const Experiment& given, const std::string& key, const std::string& what,
             const std::vector<SweepAxis>& axes = {}) {
  if (!is_measured(quantity, key)) {
    for (const SweptQuantity other : {SweptQuantity::visibility, SweptQuantity::ao, SweptQuantity::image}) {
      const auto is_of_other = [&](const SweepAxis& axis) { return is_measured(other, axis.key); };
      if (!is_measured(other, key) || !std::ranges::all_of(axes, is_of_other)) continue;
      return {ExitCode::usage, what, fmt::format("it has no effect on {}", quantity_title(quantity)),
              fmt::format("leave it out, or use --measure {}", quantity_name(other))};
    }
    return {ExitCode::usage, what, "it has no effect on any measurement", "leave it out"};
  }
  if (!given.engine.adapter.empty() && !key.starts_with("engine.")) {
    return {ExitCode::usage, what, fmt::format("{} does not read it", given.engine.engine),
            "vary engine.* parameters; --help-all lists them"};
  }
  Experiment experiment = given;
  for (const Parameter& parameter : describe(experiment)) {
    const Value before = parameter.value();
    std::string users;
    for (const Value& value : alternatives(parameter)) {
      parameter.set(value);
      if (is_read_by_technique(experiment, key)) users += (users.empty() ? "" : ", ") + to_string(value);
    }
    parameter.set(before);
    if (users.empty()) continue;
    return {ExitCode::usage, what, fmt::format("{} {} does not read it", parameter.key, to_string(before)),
            fmt::format("leave it out, or set {} to {}{}", parameter.key,
                        users.find(',') == std::string::npos ? "" : "one of ", users)};
  }
  return {ExitCode::usage, what, "nothing reads it with these settings",
          fmt::format("leave it out; its meaning is: {}", require(describe(experiment), key).description.meaning)};
}

// Each combination of words, and the first and the last of whole numbers, until take() returns true. What a technique
// reads does not depend on other numbers.
bool any_combination(Experiment& experiment, const std::vector<SweepAxis>& axes, const std::function<bool()>& take,
                     std::size_t axis = 0) {
  if (axis == axes.size()) return take();
  const SweepAxis& varied = axes[axis];
  std::vector<Value> values = varied.values;
  if (std::holds_alternative<double>(values.front())) {
    values.resize(1);
  } else if (std::holds_alternative<std::int64_t>(values.front()) && values.size() > 1) {
    values = {values.front(), values.back()};
  }
  return std::ranges::any_of(values, [&](const Value& value) {
    set_value(describe(experiment), varied, value);
    return any_combination(experiment, axes, take, axis + 1);
  });
}

}  // namespace

bool is_read(SweptQuantity quantity, Experiment experiment, std::string_view parameter) {
  return is_measured(quantity, parameter) && is_read_by_technique(experiment, parameter);
}

void require_read(SweptQuantity quantity, const Experiment& experiment, const std::string& parameter) {
  if (!is_read(quantity, experiment, parameter)) throw unread(quantity, experiment, parameter, parameter);
}

void require_effect(SweptQuantity quantity, const std::vector<Experiment>& experiments,
                    const std::vector<SweepAxis>& axes, const std::vector<SweepAxis>& others) {
  std::vector<SweepAxis> varied = axes;
  varied.insert(varied.end(), others.begin(), others.end());
  for (const SweepAxis& axis : axes) {
    const bool has_effect =
        is_measured(quantity, axis.key) && std::ranges::any_of(experiments, [&](Experiment experiment) {
          return any_combination(experiment, varied, [&] { return is_read_by_technique(experiment, axis.key); });
        });
    if (has_effect) continue;
    Experiment first = experiments.front();
    for (const SweepAxis& each : varied) set_value(describe(first), each, each.values.front());
    throw unread(quantity, first, axis.key, "--vary " + axis.key, varied);
  }
}

}  // namespace umbrameter
