#include "techniques/engine_bias/bias_spec.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/lists.h"
#include "core/suggestion.h"

namespace umbrameter {
namespace {

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

// "shadow_normal_bias", "shadowNormalBias" and "normal_bias" are one name.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (c != '_' && c != '-' && c != '.') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return plain.starts_with("shadow") ? plain.substr(6) : plain;
}

double read_number(std::string_view text, const std::string& place) {
  const std::optional<double> number = parsed<double>(text.starts_with('+') ? text.substr(1) : text);
  if (number && std::isfinite(*number)) return *number;
  throw Error(ExitCode::usage, place, text.empty() ? "no value given" : quoted(text) + " is not a number",
              "write " + place.substr(place.find(' ') + 1) + "=0.5, for example");
}

std::vector<double> read_lengths(std::string_view text, const std::string& place) {
  std::vector<double> lengths;
  for (const std::string_view part : split(text, '/')) {
    lengths.push_back(read_number(part, place));
    if (!(lengths.back() > 0.0)) throw Error(ExitCode::usage, place, "a length in metres must be above 0");
  }
  return lengths;
}

[[noreturn]] void reject_name(const BiasEngine& engine, std::string_view name, bool is_source) {
  std::vector<std::string> names;
  for (const BiasNumber& number : engine.numbers) {
    if (is_source) names.emplace_back(number.name);
  }
  for (const BiasSetting& setting : engine.settings) names.emplace_back(setting.name);
  names.insert(names.end(), {"texel", "range"});
  const std::string all = joined(names, ", ");
  const std::string what = std::string(engine.name) + " " + std::string(name);
  const bool is_number = std::ranges::any_of(
      engine.numbers, [&](const BiasNumber& number) { return plain_name(number.name) == plain_name(name); });
  if (!is_source && is_number) {
    throw Error(ExitCode::usage, what, "a number of a target is the answer and cannot be given", "settings are " + all);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].starts_with("shadow_")) names.push_back(names[i].substr(7));
  }
  const std::string similar = suggestion(similar_names(std::string(name), names));
  throw Error(ExitCode::usage, what, "unknown number or setting", similar.empty() ? "known are " + all : similar);
}

void set_setting(BiasSpec& spec, const BiasSetting& setting, std::string_view text, const std::string& place) {
  double& value = spec.settings.values[static_cast<std::size_t>(&setting - spec.engine->settings.data())];
  std::vector<std::string> names;
  for (const auto& [name, choice] : setting.choices) {
    if (name == text) {
      value = choice;
      return;
    }
    names.emplace_back(name);
  }
  if (!names.empty()) {
    throw Error(ExitCode::usage, place, quoted(text) + " is not allowed", "choose one of " + joined(names, ", "));
  }
  value = read_number(text, place);
  if (value < 0.0) throw Error(ExitCode::usage, place, "it must not be below 0");
}

void read_item(BiasSpec& spec, std::string_view item, bool is_source) {
  const BiasEngine& engine = *spec.engine;
  const std::size_t equals = item.find('=');
  // "three:-0.0005" is its first number.
  const bool is_bare =
      equals == std::string_view::npos && is_source && !item.empty() &&
      (engine.numbers.size() == 1 || std::string_view("+-.0123456789").find(item[0]) != std::string_view::npos);
  if (equals == std::string_view::npos && !is_bare) {
    throw Error(ExitCode::usage, std::string(engine.name) + " " + std::string(item), "no value given",
                "write NAME=VALUE");
  }
  const std::string_view name = is_bare ? engine.numbers.front().name : item.substr(0, equals);
  const std::string_view text = is_bare ? item : item.substr(equals + 1);
  const std::string place = std::string(engine.name) + " " + std::string(name);
  if (name == "texel" || name == "range") {
    (name == "texel" ? spec.texels : spec.ranges) = read_lengths(text, place);
    return;
  }
  for (const BiasSetting& setting : engine.settings) {
    if (plain_name(setting.name) == plain_name(name)) return set_setting(spec, setting, text, place);
  }
  for (std::size_t i = 0; is_source && i < engine.numbers.size(); ++i) {
    if (plain_name(engine.numbers[i].name) != plain_name(name)) continue;
    spec.numbers[i] = read_number(text, place);
    return;
  }
  reject_name(engine, name, is_source);
}

BiasSpec spec_of(const BiasEngine& engine) {
  if (!engine.no_numbers.empty()) {
    throw Error(ExitCode::usage, std::string(engine.title),
                "its bias cannot be converted: " + std::string(engine.no_numbers));
  }
  return default_target(engine);
}

}  // namespace

const BiasEngine& require_bias_engine(std::string_view name) {
  std::vector<std::string> names;
  std::string all;
  for (const BiasEngine& engine : bias_engines()) {
    if (engine.name == name || (!engine.adapter.empty() && engine.adapter == name)) return engine;
    names.emplace_back(engine.name);
    if (engine.no_numbers.empty()) all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string similar = suggestion(similar_names(std::string(name), names));
  const bool is_length = !name.empty() && name.find_first_not_of("+-.0123456789") > 0;
  throw Error(ExitCode::usage, quoted(name), name.empty() ? "no engine named" : "unknown engine or unit",
              is_length ? "write a length as metres:0.02 or texels:2"
              : name.find('=') != std::string_view::npos
                  ? "write a length as texels:2, and an engine's numbers as godot:bias=0.1"
              : similar.empty() ? "known are " + all
                                : similar);
}

BiasSpec default_target(const BiasEngine& engine) {
  BiasSpec spec;
  spec.engine = &engine;
  spec.settings.described = &engine.settings;
  for (const BiasSetting& setting : engine.settings) {
    spec.settings.values.push_back(setting.is_light_range ? no_default : setting.value);
  }
  // Open until the light is known.
  for (const BiasNumber& number : engine.numbers) {
    spec.numbers.push_back(std::isnan(number.value_of_point) ? number.value : no_default);
  }
  return spec;
}

CasterFaces faces_of(const BiasSpec& spec) {
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    if (spec.engine->settings[i].is_faces) return static_cast<CasterFaces>(spec.settings.values[i]);
  }
  return spec.engine->faces;
}

BiasSpec at_light(BiasSpec spec, const MapPlace& place) {
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    const BiasSetting& setting = spec.engine->settings[i];
    const bool is_open = setting.is_light_range && place.light != LightKind::directional;
    if (!is_open || !std::isnan(spec.settings.values[i])) continue;
    spec.settings.values[i] = place.light_range > 0.0 ? place.light_range : setting.value;
  }
  for (std::size_t i = 0; i < spec.numbers.size(); ++i) {
    if (std::isnan(spec.numbers[i])) spec.numbers[i] = spec.engine->numbers[i].default_of(place.light);
  }
  return spec;
}

BiasSpec parse_bias_source(std::string_view text) {
  const std::size_t colon = text.find(':');
  BiasSpec spec = spec_of(require_bias_engine(text.substr(0, colon)));
  if (colon != std::string_view::npos) {
    for (const std::string_view item : split(text.substr(colon + 1), ',')) read_item(spec, item, true);
  }
  for (std::size_t i = 0; i < spec.numbers.size(); ++i) {
    if (!std::isnan(spec.numbers[i]) || !std::isnan(spec.engine->numbers[i].value)) continue;
    const std::string name = std::string(spec.engine->name) + ":" + std::string(spec.engine->numbers[i].name);
    throw Error(ExitCode::usage, "--from " + std::string(text), "no value given", "write --from " + name + "=0.05");
  }
  return spec;
}

std::vector<BiasSpec> parse_bias_targets(std::string_view text) {
  std::vector<BiasSpec> targets;
  for (std::string_view item : split(text, ',')) {
    const std::size_t colon = item.find(':');
    const bool starts = colon != std::string_view::npos || item.find('=') == std::string_view::npos || targets.empty();
    if (starts) {
      targets.push_back(spec_of(require_bias_engine(item.substr(0, colon))));
      if (colon == std::string_view::npos) continue;
      item.remove_prefix(colon + 1);
    }
    read_item(targets.back(), item, false);
  }
  return targets;
}

}  // namespace umbrameter
