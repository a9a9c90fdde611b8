// Converts a shadow bias from one engine's numbers to those of another, by way of what it does in metres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/light.h"
#include "techniques/engine_bias/bias_spec.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Where a light's map is converted: each cascade, or the nearest and the farthest receiver of a spot or point light or
/// of a warped map.
/// Throws Error (usage) if such a light reaches no surfel.
std::vector<MapPlace> places_of(const Light& light, const MapLayout& layout, const GBuffer& surfels);

/// Name of the first place of a map whose texels grow with the distance.
inline constexpr const char* nearest_receiver = "nearest receiver";

/// The places with the spec's own texels and ranges. Throws Error (usage) if their numbers do not match.
std::vector<MapPlace> places_for(const BiasSpec& spec, const std::vector<MapPlace>& places);

/// What a bias does at a place.
struct BiasTerms {
  double constant = 0.0;  ///< metres
  double normal = 0.0;    ///< metres
  OffsetKind offset{};    ///< of `normal`
  double slope = 0.0;     ///< polygon offset factor
};

/// Whether every number that is not 0 is known and has a formula for this light.
bool has_terms(const BiasSpec& source, const MapPlace& place);

/// Throws Error (usage) unless has_terms().
BiasTerms terms_of(const BiasSpec& source, const MapPlace& place);

/// How the reason starts where an engine has a number, but it is not known here what it means.
inline constexpr std::string_view no_formula = "there is no conversion here";

/// A number of the target, or why there is none.
struct ConvertedNumber {
  std::optional<double> value;
  std::string reason;
  std::string code{};          ///< in place of the number's own; empty: as it is
  std::string code_remark{};   ///< explains the code
  bool is_other_kind = false;  ///< there is no value since the number moves something else: set it to 0
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
  /// Of share_numbers(): for each number the value that others need, for each place if sets_each_place().
  std::vector<std::vector<double>> shared{};
};

struct ConvertedBias {
  BiasSpec source;
  std::vector<MapPlace> places;  ///< of our own map
  std::vector<MapPlace> source_places;
  std::vector<BiasTerms> terms;
  std::vector<ConvertedTarget> targets;
  bool takes_all = false;  ///< no target was named
};

/// Terms at each place, in the target's numbers.
ConvertedTarget convert_terms(const std::vector<BiasTerms>& terms, BiasSpec target,
                              const std::vector<MapPlace>& places);

/// Whether the target has a number for every term that is not 0, if not for its kind of offset.
bool is_complete(const ConvertedTarget& target);

/// Whether the target's number for the offset is of another kind than the source's, which is then left out.
bool has_other_offset(const ConvertedTarget& target);

/// Lets targets of one engine, for views of one light, have the same numbers: the largest bias that one of them needs.
void share_numbers(const std::vector<ConvertedTarget*>& targets);

/// Without targets: to all engines for which a part of the source has an equivalent.
ConvertedBias convert_bias(BiasSpec source, std::vector<BiasSpec> targets, const std::vector<MapPlace>& places);

/// The one value that reaches the source's bias at every place, for an engine with one number for all; nothing if a
/// place has none.
struct ChosenValue {
  double value = 0.0;
  std::size_t place = 0;       ///< that decided, unless
  bool is_of_another = false;  ///< another target of share_numbers() did
  double excess = 1.0;         ///< largest factor by which it exceeds the source's bias elsewhere
};
std::optional<ChosenValue> choose_value(const ConvertedTarget& target, std::size_t number);

/// Whether the engine has a number for each place: a cascade of an engine that sets each.
bool sets_each_place(const ConvertedTarget& target);

/// What to set a number to at each place: up to three significant digits and up to a step of the engine's inspector,
/// away from 0, and within the engine's limits. One value for all unless sets_each_place(). Nothing if a place has
/// none.
std::optional<std::vector<double>> set_values(const ConvertedTarget& target, std::size_t number);

}  // namespace umbrameter
