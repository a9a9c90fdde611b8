// The engine that takes the place of our own techniques: which adapter is started, and the parameters that it
// describes. They are the engine.* parameters: flags, axes, keys of experiment files and columns like all others.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"

namespace umbrameter {

enum class EngineParameterType : int { number, integer, boolean, choice };

/// A parameter of an engine, in the engine's own name and unit, and its value.
struct EngineParameter {
  std::string name;  ///< without "engine."
  std::string meaning;
  std::string unit;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices{};
  EngineParameterType type = EngineParameterType::number;
  bool is_of_ao = false;  ///< it changes ambient occlusion, not shadows
  int bias = 0;           ///< 1: a bias, of which larger values light more; -1: smaller values do; 0: no bias
  // The value: the member of the parameter's type.
  double number = 0.0;
  int integer = 0;
  bool is_set = false;
  int chosen = 0;  ///< index into choices
};

/// The engine.* parameters.
struct EngineParams {
  std::string adapter;  ///< name of an adapter that ships, or a command; empty: our own techniques
  std::string engine;   ///< "three.js 0.187.0", as the adapter describes it
  std::vector<EngineParameter> parameters;
};
Parameters describe(EngineParams& params);

/// From now on every Experiment is made with this engine and its defaults. Parameters are looked up by name in default
/// experiments, so call it once, before the command line is read or a stored run with an engine is shown.
void use_engine(EngineParams engine);
/// Of an engine that use_engine() set; without one, our own techniques.
const EngineParams& engine_in_use();

inline constexpr std::string_view engine_key = "engine.adapter";

/// Whether the parameter with this full name is one of an engine's ambient occlusion.
bool is_engine_ao(std::string_view key);
/// Whether it is the side of an engine's shadow map in texels: engine.map-size, shadow-map-size or resolution.
bool is_engine_map_size(std::string_view key);
/// Its value; nothing if the engine has no such parameter.
std::optional<int> map_size_of(const EngineParams& params);

/// The same engine, whose parameters have their defaults; of an engine that is not in use, those of now.
EngineParams defaults_of(const EngineParams& params);

}  // namespace umbrameter
