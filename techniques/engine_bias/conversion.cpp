#include "techniques/engine_bias/conversion.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <variant>

#include "core/error.h"
#include "core/suggestion.h"

namespace umbrameter {
namespace {

constexpr std::string_view light_names[] = {"directional", "spot", "point"};

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

// "shadow_normal_bias", "shadowNormalBias" and "normal_bias" are one name.
std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (c != '_' && c != '-' && c != '.') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return plain.starts_with("shadow") ? plain.substr(6) : plain;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

double read_number(std::string_view text, const std::string& place) {
  double number = 0.0;
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error == std::errc() && end == digits.data() + digits.size() && std::isfinite(number)) return number;
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
  std::string all;
  for (const std::string& each : names) all += (all.empty() ? "" : ", ") + each;
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
    std::string all;
    for (const std::string& each : names) all += (all.empty() ? "" : ", ") + each;
    throw Error(ExitCode::usage, place, quoted(text) + " is not allowed", "choose one of " + all);
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

std::optional<double> per_unit_of(const BiasSpec& spec, const BiasNumber& number, const MapPlace& place) {
  const std::optional<double> metres = number.per_unit(place, spec.settings);
  return metres && std::isfinite(*metres) && *metres != 0.0 ? metres : std::nullopt;
}

std::string why_unknown(const BiasSpec& spec, const BiasNumber& number, const MapPlace& place) {
  const std::optional<double> metres = number.per_unit(place, spec.settings);
  if (!metres) {
    return "no formula is known here for a " + std::string(light_names[static_cast<int>(place.light)]) + " light";
  }
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    if (!std::isnan(spec.settings.values[i])) continue;
    const BiasSetting& setting = spec.engine->settings[i];
    return "it needs " + std::string(setting.name) + "=, " + std::string(setting.meaning);
  }
  return "the place lies outside its depth range, or its settings leave the number without effect";
}

// Our own flags for an offset.
std::string flags_of(const OffsetKind& kind) {
  const std::string flag = kind.side == OffsetSide::receiver ? "--shadow.normal-offset" : "--shadow.caster-offset";
  std::string text = flag + " {}";
  if (kind.profile != OffsetProfile::sine) {
    text += " " + flag + "-profile " + std::string(offset_profile_names[static_cast<std::size_t>(kind.profile)]);
  }
  return text + (kind.direction == OffsetDirection::across ? " --shadow.normal-offset-direction across" : "");
}

}  // namespace

std::string text_of(const OffsetKind& kind) {
  std::string text = kind.side == OffsetSide::receiver ? "moves the receiver " : "moves the caster inwards ";
  text += kind.direction == OffsetDirection::normal ? "along its normal"
                                                    : "along its normal without the part along the light";
  if (kind.profile == OffsetProfile::sine) return text + ", × sin θ";
  return text + (kind.profile == OffsetProfile::constant ? ", alike at every angle" : ", × (1 − cos θ)");
}

double BiasSettings::operator[](std::string_view name) const {
  const auto found = std::ranges::find(*described, name, &BiasSetting::name);
  return values.at(static_cast<std::size_t>(found - described->begin()));
}

const BiasEngine& require_bias_engine(std::string_view name) {
  std::vector<std::string> names;
  std::string all;
  for (const BiasEngine& engine : bias_engines()) {
    if (engine.name == name) return engine;
    names.emplace_back(engine.name);
    if (engine.no_numbers.empty()) all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string similar = suggestion(similar_names(std::string(name), names));
  throw Error(ExitCode::usage, quoted(name), name.empty() ? "no engine named" : "unknown engine or unit",
              similar.empty() ? "known are " + all : similar);
}

std::vector<MapPlace> places_of(const Light& light, const MapLayout& layout, const GBuffer& surfels) {
  std::vector<MapPlace> places;
  if (layout.kind == MapKind::orthographic) {
    for (const MapView& view : layout.views) {
      const std::string name = layout.views.size() == 1 ? "map" : "cascade " + std::to_string(places.size() + 1);
      places.push_back({name, LightKind::directional, 2.0 * view.half_extent / layout.resolution, layout.far_depth,
                        layout.resolution});
    }
    return places;
  }
  const bool is_spot = std::holds_alternative<SpotLight>(light.shape);
  const auto place_at = [&](const char* name, const dvec3& position) {
    const dvec3 local(layout.light_from_world * dvec4(position, 1.0));
    const dvec3 size = glm::abs(local);
    const double depth = is_spot ? size.z : std::max({size.x, size.y, size.z});
    return MapPlace{name,
                    is_spot ? LightKind::spot : LightKind::point,
                    texel_at(layout, position),
                    metres_per_map_depth(layout, depth),
                    layout.resolution,
                    depth};
  };
  for (std::size_t i = 0; i < surfels.depth.size(); ++i) {
    if (!surfels.is_surface(i)) continue;
    const dvec3 position(surfels.position[i]);
    if (exclusion_of(light, layout, position, dvec3(surfels.geometric_normal[i])) != PixelExclusion::none) continue;
    MapPlace place = place_at("nearest receiver", position);
    if (places.empty()) places = {place, place};
    if (place.depth < places[0].depth) places[0] = place;
    if (place.depth > places[1].depth) places[1] = place;
  }
  if (places.empty()) {
    throw Error(ExitCode::usage, "--light", "the camera sees nothing that this light reaches",
                "choose another --camera or --light");
  }
  places[1].name = "farthest receiver";
  return places;
}

BiasSpec default_target(const BiasEngine& engine) {
  BiasSpec spec;
  spec.engine = &engine;
  spec.settings.described = &engine.settings;
  for (const BiasSetting& setting : engine.settings) spec.settings.values.push_back(setting.value);
  for (const BiasNumber& number : engine.numbers) spec.numbers.push_back(number.value);
  return spec;
}

BiasSpec parse_bias_source(std::string_view text) {
  const std::size_t colon = text.find(':');
  BiasSpec spec = spec_of(require_bias_engine(text.substr(0, colon)));
  if (colon != std::string_view::npos) {
    for (const std::string_view item : split(text.substr(colon + 1), ',')) read_item(spec, item, true);
  }
  for (std::size_t i = 0; i < spec.numbers.size(); ++i) {
    if (!std::isnan(spec.numbers[i])) continue;
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

std::vector<MapPlace> places_for(const BiasSpec& spec, const std::vector<MapPlace>& places) {
  const auto value_at = [&](const std::vector<double>& values, std::size_t i, const char* name) {
    if (values.size() > 1 && values.size() != places.size()) {
      throw Error(ExitCode::usage, std::string(spec.engine->name) + " " + name,
                  "it has " + std::to_string(values.size()) + " values, the map " + std::to_string(places.size()) +
                      (places.size() == 1 ? " place" : " places"),
                  "give one value, or one for each row of the table: " + std::string(name) + "=10/20/40");
    }
    return values.size() > 1 ? values[i] : values.front();
  };
  std::vector<MapPlace> own = places;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!spec.texels.empty()) own[i].texel = value_at(spec.texels, i, "texel");
    if (spec.ranges.empty()) continue;
    own[i].range = value_at(spec.ranges, i, "range");
    own[i].is_range_given = true;
  }
  return own;
}

BiasTerms terms_of(const BiasSpec& source, const MapPlace& place) {
  BiasTerms terms;
  for (std::size_t i = 0; i < source.numbers.size(); ++i) {
    const BiasNumber& number = source.engine->numbers[i];
    if (number.term == BiasTerm::normal) terms.offset = number.offset;
    if (source.numbers[i] == 0.0) continue;
    const std::optional<double> per_unit = per_unit_of(source, number, place);
    if (!per_unit) {
      const std::string name(number.name);
      throw Error(ExitCode::usage, std::string(source.engine->name) + " " + name, why_unknown(source, number, place),
                  "set " + name + "=0 to convert the rest");
    }
    double& term = number.term == BiasTerm::constant ? terms.constant
                   : number.term == BiasTerm::normal ? terms.normal
                                                     : terms.slope;
    term += source.numbers[i] * *per_unit;
  }
  return terms;
}

BiasConversion convert(const BiasTerms& terms, const BiasSpec& target, const MapPlace& place) {
  BiasConversion conversion;
  bool has_term[3] = {false, false, false};
  const double amounts[3] = {terms.constant, terms.normal, terms.slope};
  for (const BiasNumber& number : target.engine->numbers) {
    const auto term = static_cast<std::size_t>(number.term);
    has_term[term] = true;
    ConvertedNumber& converted = conversion.numbers.emplace_back();
    if (amounts[term] == 0.0) {
      converted.value = 0.0;
      continue;
    }
    if (number.term == BiasTerm::normal && !number.takes_any_offset && number.offset != terms.offset) {
      converted.reason = "the source " + text_of(terms.offset) + "; this one " + text_of(number.offset);
      continue;
    }
    const std::optional<double> per_unit = per_unit_of(target, number, place);
    if (!per_unit) {
      converted.reason = why_unknown(target, number, place);
      continue;
    }
    converted.value = amounts[term] / *per_unit;
    if (number.takes_any_offset) converted.code = flags_of(terms.offset);
    conversion.has_equivalent = true;
  }
  constexpr const char* names[] = {"constant bias", "normal offset", "bias by slope"};
  for (std::size_t term = 0; term < 3; ++term) {
    if (amounts[term] != 0.0 && !has_term[term])
      conversion.missing.push_back(std::string("no number for the ") + names[term]);
  }
  return conversion;
}

ConvertedBias convert_bias(BiasSpec source, std::vector<BiasSpec> targets, const std::vector<MapPlace>& places) {
  ConvertedBias result{std::move(source), places, {}, {}, {}};
  result.source_places = places_for(result.source, places);
  for (const MapPlace& place : result.source_places) result.terms.push_back(terms_of(result.source, place));
  const bool takes_all = targets.empty();
  for (const BiasEngine& engine : bias_engines()) {
    if (takes_all && engine.no_numbers.empty()) targets.push_back(default_target(engine));
  }
  for (BiasSpec& spec : targets) {
    ConvertedTarget target{std::move(spec), {}, {}};
    target.places = places_for(target.spec, places);
    for (std::size_t i = 0; i < places.size(); ++i) {
      target.conversions.push_back(convert(result.terms[i], target.spec, target.places[i]));
    }
    const bool has_equivalent = std::ranges::any_of(target.conversions, &BiasConversion::has_equivalent);
    if (!takes_all || (has_equivalent && target.spec.engine != result.source.engine)) {
      result.targets.push_back(std::move(target));
    }
  }
  return result;
}

std::optional<ChosenValue> choose_value(const ConvertedTarget& target, std::size_t number) {
  std::optional<ChosenValue> chosen;
  const PerUnit per_unit = target.spec.engine->numbers[number].per_unit;
  for (std::size_t i = 0; i < target.conversions.size(); ++i) {
    const std::optional<double> value = target.conversions[i].numbers[number].value;
    if (!value) return std::nullopt;
    const double sign = per_unit(target.places[i], target.spec.settings).value_or(1.0) < 0.0 ? -1.0 : 1.0;
    if (!chosen || sign * *value > sign * chosen->value) chosen = ChosenValue{*value, i};
  }
  for (const BiasConversion& conversion : target.conversions) {
    const double own = *conversion.numbers[number].value;
    if (own != 0.0) chosen->excess = std::max(chosen->excess, chosen->value / own);
  }
  return chosen;
}

}  // namespace umbrameter
