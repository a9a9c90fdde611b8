// Presets: files of the folder presets/ that set our parameters as an engine's own numbers would.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/parameters.h"

namespace umbrameter {

/// One file: parameters of [shadow] or of [ao], and a table [preset] that describes them.
struct Preset {
  std::string name;       ///< of the file, without .toml
  std::string engine;     ///< with its version
  std::string meaning;    ///< which of the engine's techniques, in half a line
  std::string kind;       ///< "directional", "spot", "point" or "ao"
  std::string source;     ///< files of that version that have its formulas
  std::string confirmed;  ///< "run": held against the engine itself; "source": read there; "second-hand"
  std::string numbers;  ///< the engine's own, as convert takes them with --from; empty: convert has no formula for them
  std::string differs;  ///< what our technique cannot do as the engine does; empty: nothing known
  std::filesystem::path file;
  std::vector<std::pair<std::string, Value>> values;  ///< full parameter name, value
};

inline constexpr std::string_view preset_kinds[] = {"directional", "spot", "point", "ao"};
inline constexpr std::string_view preset_confirmations[] = {"run", "source", "second-hand"};

/// In the order of their names. Throws Error (usage), with file and line, for a file that is no preset.
std::vector<Preset> installed_presets();

/// Throws Error (usage) for an unknown name, with what may be meant.
Preset require_preset(const std::string& name);

void apply_preset(const Preset& preset, const Parameters& parameters);

}  // namespace umbrameter
