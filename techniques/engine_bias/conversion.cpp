#include "techniques/engine_bias/conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/digits.h"
#include "core/error.h"
#include "core/lists.h"

namespace umbrameter {
namespace {

constexpr std::string_view light_names[] = {"directional", "spot", "point"};

std::optional<double> per_unit_of(const BiasSpec& spec, const BiasNumber& number, const MapPlace& place) {
  const std::optional<double> metres = number.per_unit(place, spec.settings);
  return metres && std::isfinite(*metres) && *metres != 0.0 ? metres : std::nullopt;
}

// Whether the setting is the near plane, and the place is nearer.
bool is_before_plane(const BiasSpec& spec, std::size_t setting, const MapPlace& place) {
  const std::string_view name = spec.engine->settings[setting].name;
  return (name == "near" || name == "minZ") && place.depth > 0.0 && place.depth < spec.settings.values[setting];
}

std::string why_unknown(const BiasSpec& spec, const BiasNumber& number, const MapPlace& place) {
  const std::optional<double> metres = number.per_unit(place, spec.settings);
  if (!metres) {
    return std::string(no_formula) + " for a " + std::string(light_names[static_cast<int>(place.light)]) + " light";
  }
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    if (!std::isnan(spec.settings.values[i])) continue;
    const BiasSetting& setting = spec.engine->settings[i];
    return "it needs " + std::string(setting.name) + "=, " + std::string(setting.meaning);
  }
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    if (!is_before_plane(spec, i, place)) continue;
    return fmt::format("the {} of this image is {:.3g} m away, nearer than {} = {:g} m", place.name, place.depth,
                       spec.engine->settings[i].name, spec.settings.values[i]);
  }
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    const BiasSetting& setting = spec.engine->settings[i];
    if (!setting.is_light_range || place.light == LightKind::directional || place.depth <= spec.settings.values[i])
      continue;
    return fmt::format(
        "the {} of this image is {:.3g} m away, beyond {} = {:g} m; give the range of your light, {}:{}=", place.name,
        place.depth, setting.name, spec.settings.values[i], spec.engine->name, setting.name);
  }
  return "the " + place.name + " lies outside its depth range, or its settings leave the number without effect";
}

// An engine's planes that hold a lamp's receiver, as in "three:near=0.1".
std::string nearer_plane(const BiasSpec& spec, const MapPlace& place) {
  for (std::size_t i = 0; i < spec.settings.values.size(); ++i) {
    if (!is_before_plane(spec, i, place)) continue;
    return fmt::format("{}:{}={:g}", spec.engine->name, spec.engine->settings[i].name,
                       std::pow(10.0, std::floor(std::log10(place.depth) - 1e-9)));
  }
  return {};
}

// Our own flags for an offset.
std::string flags_of(const OffsetKind& kind) {
  const std::string flag = kind.side == OffsetSide::receiver ? "--shadow.normal-offset" : "--shadow.caster-offset";
  std::string text = flag + " {}";
  if (kind.profile != OffsetProfile::sine) {
    text += " " + flag + "-profile " + std::string(offset_profile_names[static_cast<std::size_t>(kind.profile)]);
  }
  if (kind.direction == OffsetDirection::across) text += " --shadow.normal-offset-direction across";
  return text + (kind.facing == OffsetFacing::front ? " --shadow.normal-offset-facing front" : "");
}

// Away from 0, up to a multiple of the unit.
double multiple_above(double number, double unit) {
  return std::copysign(std::ceil(std::abs(number) / unit - 1e-9) * unit, number);
}

// Of two values of a number at a place the one that moves farther away from acne.
double larger_bias(const ConvertedTarget& target, std::size_t number, std::size_t place, double a, double b) {
  const PerUnit per_unit = target.spec.engine->numbers[number].per_unit;
  const bool is_reversed = per_unit(target.places[place], target.spec.settings).value_or(1.0) < 0.0;
  return is_reversed ? std::min(a, b) : std::max(a, b);
}

double rounded_up(double number, double step) {
  if (number == 0.0) return number;
  const double rounded = multiple_above(number, step_of_last_digit(number, 3));
  return step > 0.0 ? multiple_above(rounded, step) : rounded;
}

const char* profile_text(OffsetProfile profile) {
  if (profile == OffsetProfile::constant) return "alike at every angle";
  return profile == OffsetProfile::sine ? "× sin θ" : "× (1 − cos θ)";
}

// Of a length.
const char* length_text(OffsetProfile profile) {
  if (profile == OffsetProfile::constant) return "the same at every angle";
  return profile == OffsetProfile::sine ? "proportional to sin θ" : "proportional to 1 − cos θ";
}

}  // namespace

std::string text_of(const OffsetKind& kind) {
  std::string text = kind.side == OffsetSide::receiver ? "moves the receiver along its normal"
                                                       : "moves the caster inwards along its normal";
  text += std::string(", by a length ") + profile_text(kind.profile);
  return text + (kind.direction == OffsetDirection::normal ? "" : ", less the component in the direction of the light");
}

std::string offset_difference(const OffsetKind& kind, const OffsetKind& given) {
  std::vector<std::string> parts;
  if (kind.side != given.side) {
    parts.emplace_back(kind.side == OffsetSide::receiver
                           ? "it moves the receiver (the given offset moves the caster)"
                           : "it moves the caster inwards (the given offset moves the receiver)");
  }
  if (kind.profile != given.profile) {
    parts.push_back(std::string("its length along the normal is ") + length_text(kind.profile) +
                    " (that of the given offset is " + length_text(given.profile) + ")");
  }
  if (kind.direction != given.direction) {
    parts.emplace_back(kind.direction == OffsetDirection::normal
                           ? "it includes the component along the light's direction (the given offset leaves it out)"
                           : "it leaves out the component along the light's direction (the given offset includes it)");
  }
  return joined(parts, "; ");
}

double BiasSettings::operator[](std::string_view name) const {
  const auto found = std::ranges::find(*described, name, &BiasSetting::name);
  return values.at(static_cast<std::size_t>(found - described->begin()));
}

std::vector<MapPlace> places_of(const Light& light, const MapLayout& layout, const GBuffer& surfels) {
  std::vector<MapPlace> places;
  if (has_equal_texels(layout)) {
    for (const MapView& view : layout.views) {
      places.push_back({layout.views.size() == 1 ? "map" : view_name(layout, places.size()), LightKind::directional,
                        2.0 * view.half_extent / layout.resolution, view.range_share * layout.far_depth,
                        layout.resolution});
    }
    return places;
  }
  const bool is_spot = std::holds_alternative<SpotLight>(light.shape);
  const auto* const point = std::get_if<PointLight>(&light.shape);
  const double range = is_spot ? std::get<SpotLight>(light.shape).range : point != nullptr ? point->range : 0.0;
  const LightKind kind = layout.warp ? LightKind::directional : is_spot ? LightKind::spot : LightKind::point;
  const auto place_at = [&](const char* name, const dvec3& position) {
    const dvec3 local(layout.light_from_world * dvec4(position, 1.0));
    const dvec3 size = glm::abs(local);
    // Texels grow with it.
    const double depth = layout.warp ? local.y - layout.warp->center.y
                         : is_spot   ? size.z
                                     : std::max({size.x, size.y, size.z});
    return MapPlace{
        name,  kind, texel_at(layout, position), metres_per_map_depth(layout, depth), layout.resolution, depth,
        false, range};
  };
  for (std::size_t i = 0; i < surfels.depth.size(); ++i) {
    if (!surfels.is_surface(i)) continue;
    const dvec3 position(surfels.position[i]);
    if (exclusion_of(light, layout, position, dvec3(surfels.geometric_normal[i])) != PixelExclusion::none) continue;
    MapPlace place = place_at(nearest_receiver, position);
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

bool has_terms(const BiasSpec& source, const MapPlace& place) {
  for (std::size_t i = 0; i < source.numbers.size(); ++i) {
    if (source.numbers[i] == 0.0) continue;
    if (std::isnan(source.numbers[i]) || !per_unit_of(source, source.engine->numbers[i], place)) return false;
  }
  return true;
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
      const bool has_rest = std::ranges::any_of(source.engine->numbers, [&](const BiasNumber& other) {
        return per_unit_of(source, other, place).has_value();
      });
      const std::string plane = nearer_plane(source, place);
      throw Error(ExitCode::usage, std::string(source.engine->name) + " " + name, why_unknown(source, number, place),
                  !plane.empty() ? "set the plane before it, " + plane
                  : has_rest     ? "set " + name + "=0 to convert the rest"
                                 : "give the bias in metres or texels");
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
      converted.reason = offset_difference(number.offset, terms.offset);
      converted.is_other_kind = true;
      continue;
    }
    const std::optional<double> per_unit = per_unit_of(target, number, place);
    if (!per_unit) {
      converted.reason = why_unknown(target, number, place);
      continue;
    }
    converted.value = amounts[term] / *per_unit;
    if (number.takes_any_offset) {
      converted.code = flags_of(terms.offset);
      if (terms.offset.direction == OffsetDirection::across)
        converted.code_remark = "across: moves the receiver only perpendicular to the direction of the light";
    }
    conversion.has_equivalent = true;
  }
  constexpr const char* names[] = {"constant bias", "normal offset", "bias by slope"};
  for (std::size_t term = 0; term < 3; ++term) {
    if (amounts[term] != 0.0 && !has_term[term])
      conversion.missing.push_back(std::string("no setting for the ") + names[term]);
  }
  return conversion;
}

ConvertedTarget convert_terms(const std::vector<BiasTerms>& terms, BiasSpec target,
                              const std::vector<MapPlace>& places) {
  ConvertedTarget converted{at_light(std::move(target), places.front()), {}, {}};
  converted.places = places_for(converted.spec, places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    converted.conversions.push_back(convert(terms[i], converted.spec, converted.places[i]));
  }
  return converted;
}

bool has_other_offset(const ConvertedTarget& target) {
  return std::ranges::any_of(target.conversions, [](const BiasConversion& each) {
    return std::ranges::any_of(each.numbers, &ConvertedNumber::is_other_kind);
  });
}

bool is_complete(const ConvertedTarget& target) {
  return std::ranges::all_of(target.conversions, [](const BiasConversion& each) {
    return each.missing.empty() && std::ranges::all_of(each.numbers, [](const ConvertedNumber& number) {
             return number.value || number.is_other_kind;
           });
  });
}

ConvertedBias convert_bias(BiasSpec source, std::vector<BiasSpec> targets, const std::vector<MapPlace>& places) {
  ConvertedBias result{at_light(std::move(source), places.front()), places, {}, {}, {}, false};
  result.source_places = places_for(result.source, places);
  for (const MapPlace& place : result.source_places) result.terms.push_back(terms_of(result.source, place));
  result.takes_all = targets.empty();
  for (const BiasEngine& engine : bias_engines()) {
    if (result.takes_all && engine.no_numbers.empty()) targets.push_back(default_target(engine));
  }
  for (BiasSpec& spec : targets) {
    ConvertedTarget target = convert_terms(result.terms, std::move(spec), places);
    const bool has_equivalent = std::ranges::any_of(target.conversions, &BiasConversion::has_equivalent);
    if (!result.takes_all || (has_equivalent && target.spec.engine != result.source.engine)) {
      result.targets.push_back(std::move(target));
    }
  }
  return result;
}

void share_numbers(const std::vector<ConvertedTarget*>& targets) {
  const std::size_t count = targets.front()->spec.engine->numbers.size();
  std::vector<std::vector<double>> shared(count);
  for (std::size_t n = 0; n < count; ++n) {
    for (const ConvertedTarget* target : targets) {
      const std::optional<ChosenValue> chosen = choose_value(*target, n);
      if (!chosen) continue;
      const bool sets_each = sets_each_place(*target);
      for (std::size_t i = 0; i < (sets_each ? target->places.size() : 1); ++i) {
        const double value = sets_each ? *target->conversions[i].numbers[n].value : chosen->value;
        if (i == shared[n].size()) shared[n].push_back(value);
        shared[n][i] = larger_bias(*target, n, i, value, shared[n][i]);
      }
    }
  }
  for (ConvertedTarget* target : targets) target->shared = shared;
}

std::optional<ChosenValue> choose_value(const ConvertedTarget& target, std::size_t number) {
  std::optional<ChosenValue> chosen;
  for (std::size_t i = 0; i < target.conversions.size(); ++i) {
    const std::optional<double> value = target.conversions[i].numbers[number].value;
    if (!value) return std::nullopt;
    if (!chosen || larger_bias(target, number, i, *value, chosen->value) != chosen->value)
      chosen = ChosenValue{*value, i};
  }
  if (chosen && !target.shared.empty() && !sets_each_place(target)) {
    const double own = chosen->value;
    chosen->value = larger_bias(target, number, chosen->place, target.shared[number].front(), own);
    chosen->is_of_another = chosen->value != own;
  }
  for (const BiasConversion& conversion : target.conversions) {
    const double own = *conversion.numbers[number].value;
    if (own != 0.0) chosen->excess = std::max(chosen->excess, chosen->value / own);
  }
  return chosen;
}

bool sets_each_place(const ConvertedTarget& target) {
  const MapPlace& first = target.places.front();
  const bool is_cascade = first.light == LightKind::directional && first.depth == 0.0;
  return target.spec.engine->sets_each_cascade && target.places.size() > 1 && is_cascade;
}

std::optional<std::vector<double>> set_values(const ConvertedTarget& target, std::size_t number) {
  const BiasNumber& described = target.spec.engine->numbers[number];
  std::vector<double> values;
  const std::optional<ChosenValue> chosen = choose_value(target, number);
  for (std::size_t i = 0; i < target.conversions.size(); ++i) {
    const ConvertedNumber& own = target.conversions[i].numbers[number];
    if (own.is_other_kind) {
      values.push_back(0.0);
      continue;
    }
    if (!chosen) return {};
    double exact = chosen->value;
    if (sets_each_place(target)) {
      exact = *own.value;
      if (!target.shared.empty()) exact = larger_bias(target, number, i, target.shared[number][i], exact);
    }
    const double value = rounded_up(exact, described.step);
    values.push_back(std::clamp(value, described.min, described.max));
  }
  return values;
}

}  // namespace umbrameter
