// Scenes made by code, for trying the tool and for tests.
#pragma once

#include <span>
#include <string_view>

#include "scenes/scene.h"

namespace umbrameter {

struct BuiltinScene {
  std::string_view name;
  std::string_view purpose;  ///< one line: what it is there to show
  Scene (*make)();
};

/// All of them; the first is the default.
std::span<const BuiltinScene> builtin_scenes();

/// The built-in scene of that name, or the glTF file at that path.
/// Throws Error (unreadable_input) that lists the built-in names when it is neither.
Scene load_scene(const std::string& name_or_path);

}  // namespace umbrameter
