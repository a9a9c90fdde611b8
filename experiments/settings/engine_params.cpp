#include "experiments/settings/engine_params.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace umbrameter {
namespace {

constexpr std::string_view prefix = "engine.";

EngineParams& in_use() {
  static EngineParams engine;
  return engine;
}

auto field_of(EngineParameter& parameter) {
  using Field = decltype(Parameter::field);
  switch (parameter.type) {
    case EngineParameterType::integer:
      return Field(&parameter.integer);
    case EngineParameterType::boolean:
      return Field(&parameter.is_set);
    case EngineParameterType::choice:
      return Field(ChoiceRef{&parameter.chosen, parameter.choices});
    case EngineParameterType::number:
      break;
  }
  return Field(&parameter.number);
}

}  // namespace

Parameters describe(EngineParams& params) {
  Parameters all = Description("engine")
                       .field("adapter", params.adapter,
                              {"", "engine to measure in place of our techniques: name of an adapter, or a command"})
                       .take();
  for (EngineParameter& each : params.parameters) {
    all.push_back({std::string(prefix) + each.name,
                   {.unit = each.unit, .meaning = each.meaning, .min = each.min, .max = each.max, .basic = true},
                   field_of(each)});
  }
  return all;
}

void use_engine(EngineParams engine) { in_use() = std::move(engine); }

const EngineParams& engine_in_use() { return in_use(); }

bool is_engine_ao(std::string_view key) {
  if (!key.starts_with(prefix)) return false;
  const std::string_view name = key.substr(prefix.size());
  return std::ranges::any_of(engine_in_use().parameters,
                             [&](const EngineParameter& each) { return each.is_of_ao && each.name == name; });
}

bool is_engine_map_size(std::string_view key) {
  return key == "engine.map-size" || key == "engine.shadow-map-size" || key == "engine.resolution";
}

std::optional<int> map_size_of(const EngineParams& params) {
  for (const EngineParameter& each : params.parameters) {
    if (!is_engine_map_size(std::string(prefix) + each.name)) continue;
    if (each.type == EngineParameterType::integer) return each.integer;
    if (each.type == EngineParameterType::number) return static_cast<int>(std::lround(each.number));
    if (each.type != EngineParameterType::choice) continue;
    const int size = std::atoi(each.choices[static_cast<std::size_t>(each.chosen)].c_str());
    if (size > 0) return size;
  }
  return std::nullopt;
}

EngineParams defaults_of(const EngineParams& params) { return params.adapter == in_use().adapter ? in_use() : params; }

}  // namespace umbrameter
