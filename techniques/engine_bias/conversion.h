// Converts a shadow bias from one engine's numbers to those of another, by way of what it does in metres.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/light.h"
#include "techniques/engine_bias/engine.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Where a light's map is converted: each cascade, or the nearest and the farthest receiver of a spot or point light.
/// Throws Error (usage) if such a light reaches no surfel.
std::vector<MapPlace> places_of(const Light& light, const MapLayout& layout, const GBuffer& surfels);

/// An engine, its numbers and settings as a user gives them.
struct BiasSpec {
  const BiasEngine* engine = nullptr;
  std::vector<double> numbers;  ///< of a source
  BiasSettings settings;
  std::vector<double> texels;  ///< instead of the places' own, metres; none, one or one for each
  std::vector<double> ranges;  ///< likewise
};

/// "godot:bias=0.1,normal_bias=2", "metres:0.05", "three". Numbers that are not named have the engine's defaults; their
/// names are those of the API, with or without "shadow". Throws Error (usage).
BiasSpec parse_bias_source(std::string_view text);

/// "three:near=1,far=80,unity-urp": engines with settings. Throws Error (usage).
std::vector<BiasSpec> parse_bias_targets(std::string_view text);

/// An engine without settings: its defaults.
BiasSpec default_target(const BiasEngine& engine);

/// The places with the spec's own texels and ranges. Throws Error (usage) if their numbers do not match.
std::vector<MapPlace> places_for(const BiasSpec& spec, const std::vector<MapPlace>& places);

/// What a bias does at a place.
struct BiasTerms {
  double constant = 0.0;  ///< metres
  double normal = 0.0;    ///< metres
  OffsetKind offset{};    ///< of `normal`
  double slope = 0.0;     ///< polygon offset factor
};

/// Throws Error (usage) if a number that is not 0 has no formula for this light, or needs a setting that is not given.
BiasTerms terms_of(const BiasSpec& source, const MapPlace& place);

/// A number of the target, or why there is none.
struct ConvertedNumber {
  std::optional<double> value;
  std::string reason;
  std::string code{};  ///< in place of the number's own; empty: as it is
};

struct BiasConversion {
  std::vector<ConvertedNumber> numbers;  ///< of the engine, in its order
  std::vector<std::string> missing;      ///< parts of the source for which the target has no number
  bool has_equivalent = false;           ///< a part of the source that is not 0 has one
};
BiasConversion convert(const BiasTerms& terms, const BiasSpec& target, const MapPlace& place);

/// A target, its places and what the source's bias is at each of them.
struct ConvertedTarget {
  BiasSpec spec;
  std::vector<MapPlace> places;
  std::vector<BiasConversion> conversions;
};

struct ConvertedBias {
  BiasSpec source;
  std::vector<MapPlace> places;  ///< of our own map
  std::vector<MapPlace> source_places;
  std::vector<BiasTerms> terms;
  std::vector<ConvertedTarget> targets;
};

/// Without targets: to all engines for which a part of the source has an equivalent.
ConvertedBias convert_bias(BiasSpec source, std::vector<BiasSpec> targets, const std::vector<MapPlace>& places);

/// The one value that reaches the source's bias at every place, for an engine with one number for all; nothing if a
/// place has none.
struct ChosenValue {
  double value = 0.0;
  std::size_t place = 0;  ///< that decided
  double excess = 1.0;    ///< largest factor by which it exceeds the source's bias elsewhere
};
std::optional<ChosenValue> choose_value(const ConvertedTarget& target, std::size_t number);

}  // namespace umbrameter
