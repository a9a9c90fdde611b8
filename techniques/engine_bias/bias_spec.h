// An engine, its numbers and settings, as a user writes them.
#pragma once

#include <string_view>
#include <vector>

#include "techniques/engine_bias/engine.h"

namespace umbrameter {

/// Settings have the engine's defaults where none are given.
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

/// The faces that cast in the engine.
CasterFaces faces_of(const BiasSpec& spec);

/// With the light's range where the engine's formula has one and none is given.
BiasSpec at_light(BiasSpec spec, const MapPlace& place);

/// An engine without settings: its defaults.
BiasSpec default_target(const BiasEngine& engine);

}  // namespace umbrameter
