// How other engines state a shadow bias: the numbers of each, and how many metres one unit of a number is. It reads no
// scene: a MapPlace says how large a texel and the depth range are. To add an engine, add its entry in engines.cpp.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "techniques/shadow/map_depth.h"
#include "techniques/shadow/normal_offset.h"

namespace umbrameter {

enum class LightKind { directional, spot, point };

/// Where a bias acts: a cascade of a directional light, or a depth of a spot or point light's map.
struct MapPlace {
  std::string name;  ///< "cascade 2", "nearest receiver"
  LightKind light = LightKind::directional;
  double texel = 0.0;  ///< side of a texel there, metres
  double range = 0.0;  ///< change of depth when the stored number changes by 1, metres
  int resolution = 0;  ///< texels along a side of the map
  /// from the light along the map's axis, metres; of a directional light 0, or from the centre of its map's warp
  double depth = 0.0;
  bool is_range_given = false;  ///< `range` is the user's own, and comes before an engine's settings
  double light_range = 0.0;     ///< of a spot or point light, metres; 0: unlimited
};

/// What a number changes. constant: receiver towards the light, or caster away from it, metres. normal: a
/// NormalOffset, metres. slope: polygon offset factor, which adds so many texels × the larger slope of the surface
/// along the two axes of the map.
enum class BiasTerm { constant, normal, slope };

enum class OffsetSide { receiver, caster };  ///< receiver outwards, or caster inwards

/// Two offsets are equivalent only if profile, side and direction agree.
struct OffsetKind {
  OffsetProfile profile = OffsetProfile::constant;
  OffsetSide side = OffsetSide::receiver;
  OffsetDirection direction = OffsetDirection::normal;
  OffsetFacing facing = OffsetFacing::viewer;  ///< differs only on the backs of double-sided faces
  friend bool operator==(const OffsetKind& a, const OffsetKind& b) {
    return a.profile == b.profile && a.side == b.side && a.direction == b.direction;
  }
};

/// "moves the receiver along its normal, by a length × sin θ".
std::string text_of(const OffsetKind& kind);
/// What `kind` does otherwise than the given one: "it moves the caster inwards (the given offset moves the receiver)".
std::string offset_difference(const OffsetKind& kind, const OffsetKind& given);

inline constexpr double no_default = std::numeric_limits<double>::quiet_NaN();

/// A setting that enters an engine's formula. A choice is one of the named values.
struct BiasSetting {
  std::string_view name;
  double value = no_default;  ///< the engine's default
  std::string_view unit;
  std::string_view meaning;
  std::vector<std::pair<std::string_view, double>> choices{};
  bool is_light_range = false;  ///< the light's own where none is given, and the default where that is unlimited
  bool is_faces = false;        ///< a CasterFaces instead of BiasEngine::faces
};

/// Values of an engine's settings, in their order.
struct BiasSettings {
  const std::vector<BiasSetting>* described = nullptr;
  std::vector<double> values;
  double operator[](std::string_view name) const;
};

/// Metres of one unit (slope: texels × slope of one unit); nothing where the formula is not known for this light.
using PerUnit = std::optional<double> (*)(const MapPlace& place, const BiasSettings& settings);

struct BiasNumber {
  std::string_view name;  ///< in the engine's own API
  std::string_view unit;
  double value = 0.0;  ///< the engine's default; no_default: it must be given
  BiasTerm term = BiasTerm::constant;
  PerUnit per_unit = nullptr;
  std::string_view formula;  ///< of per_unit, for people: "t; of spot lights: t / d" where lamps have another
  std::string_view code;     ///< how to set it, with {} for the number and {i} for the cascade, from 0
  OffsetKind offset{};       ///< BiasTerm::normal
  double min = -std::numeric_limits<double>::infinity();  ///< to which the engine itself clamps
  double max = std::numeric_limits<double>::infinity();
  double step = 0.0;                   ///< of the inspector; 0: none or unknown
  bool takes_any_offset = false;       ///< as a target: our own flags beside the number set profile, side and direction
  double value_of_point = no_default;  ///< the engine's default for a point light, where it is another

  double default_of(LightKind light) const {
    return light == LightKind::point && !std::isnan(value_of_point) ? value_of_point : value;
  }
  /// Of a light that has a number.
  std::string_view formula_for(LightKind light) const {
    const std::size_t other = formula.find("; of ");
    if (other == std::string_view::npos) return formula;
    return light == LightKind::directional ? formula.substr(0, other) : formula.substr(formula.find(": ", other) + 2);
  }
};

struct BiasEngine {
  std::string_view name;   ///< in --from and --to
  std::string_view title;  ///< with version
  std::string_view source;
  std::vector<BiasNumber> numbers{};
  std::vector<BiasSetting> settings{};
  std::string_view note{};           ///< what no number changes
  std::string_view unverified{};     ///< what is second-hand or not verified
  std::string_view note_of_lamps{};  ///< what holds for spot and point lights only
  std::string_view no_numbers{};     ///< why it has no numbers
  bool is_unit = false;              ///< a neutral unit
  bool sets_each_cascade = false;
  double polygon_factor = 0.0;  ///< polygon offset with which every caster is drawn besides the numbers
  double polygon_units = 0.0;
  double units_per_factor = 0.0;         ///< polygon offset units that come with a number's polygon offset factor of 1
  CasterFaces faces = CasterFaces::all;  ///< that cast
  double constant_of_range = 0.0;        ///< constant bias of suns besides the numbers, of MapPlace::range
  std::string_view comment = "//";       ///< begins a comment in its code
  std::string_view adapter{};            ///< another name of the engine: that of its adapter and presets
};

/// Whether a number of the engine is of this term.
bool has_number(const BiasEngine& engine, BiasTerm term);

/// Those of which no number can be converted.
std::vector<BiasEngine> engines_without_numbers();

/// All of them, neutral units first.
const std::vector<BiasEngine>& bias_engines();

/// Throws Error (usage) with a suggestion.
const BiasEngine& require_bias_engine(std::string_view name);

}  // namespace umbrameter
