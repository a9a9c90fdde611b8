#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "present/bias_conversion.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json place_json(const MapPlace& place) {
  Json json{{"name", place.name}, {"texel_m", place.texel}, {"range_m", place.range}};
  if (place.light != LightKind::directional) json["depth_m"] = place.depth;
  return json;
}

Json spec_json(const BiasSpec& spec) {
  const BiasEngine& engine = *spec.engine;
  Json json{{"engine", engine.name}, {"title", engine.title}, {"source", engine.source}};
  json["note"] = engine.note;
  json["unverified"] = engine.unverified;
  json["settings"] = Json::object();
  for (std::size_t i = 0; i < engine.settings.size(); ++i) {
    const double value = spec.settings.values[i];
    json["settings"][std::string(engine.settings[i].name)] = std::isnan(value) ? Json(nullptr) : Json(value);
  }
  return json;
}

}  // namespace

Json to_json(const ConvertedTarget& target) {
  Json json = spec_json(target.spec);
  const BiasEngine& engine = *target.spec.engine;
  json["places"] = Json::array();
  for (const MapPlace& place : target.places) json["places"].push_back(place_json(place));
  json["missing"] = target.conversions.front().missing;
  json["numbers"] = Json::array();
  for (std::size_t n = 0; n < engine.numbers.size(); ++n) {
    const BiasNumber& number = engine.numbers[n];
    Json each{{"name", number.name}, {"unit", number.unit}, {"values", Json::array()}, {"reason", nullptr}};
    for (const BiasConversion& conversion : target.conversions) {
      const ConvertedNumber& converted = conversion.numbers[n];
      each["values"].push_back(converted.value ? Json(*converted.value) : Json(nullptr));
      if (!converted.value) each["reason"] = converted.reason;
    }
    if (const std::optional<std::vector<double>> set = set_values(target, n)) each["set"] = *set;
    if (const std::optional<ChosenValue> chosen = choose_value(target, n)) {
      each["chosen"] = {{"value", std::clamp(chosen->value, number.min, number.max)},
                        {"place", chosen->is_of_another ? "another case" : target.places[chosen->place].name},
                        {"excess", chosen->excess}};
    }
    json["numbers"].push_back(each);
  }
  json["code"] = code_lines(target);
  return json;
}

Json to_json(const ConvertedBias& bias) {
  Json json;
  json["from"] = spec_json(bias.source);
  json["from"]["numbers"] = Json::object();
  for (std::size_t i = 0; i < bias.source.numbers.size(); ++i) {
    json["from"]["numbers"][std::string(bias.source.engine->numbers[i].name)] = bias.source.numbers[i];
  }
  json["map"] = Json::array();
  for (std::size_t i = 0; i < bias.places.size(); ++i) {
    Json place = place_json(bias.places[i]);
    const BiasTerms& terms = bias.terms[i];
    place["bias_m"] = terms.constant;
    place["bias_texels"] = terms.constant / bias.places[i].texel;
    place["bias_of_range"] = terms.constant / bias.places[i].range;
    place["normal_offset_m"] = terms.normal;
    place["slope"] = terms.slope;
    json["map"].push_back(place);
  }
  json["to"] = Json::array();
  for (const ConvertedTarget& target : bias.targets) json["to"].push_back(to_json(target));
  json["notes"] = conversion_notes(bias);
  return json;
}

}  // namespace umbrameter
