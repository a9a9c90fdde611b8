// The built-in scenes, for trying the tool and for tests: made by code, or files that the program contains.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "scenes/load_options.h"
#include "scenes/scene.h"
#include "scenes/scene_params.h"

namespace umbrameter {

struct BuiltinScene {
  std::string_view name;
  std::string_view purpose;  ///< one line: what it is there to show
  Scene (*make)(std::uint64_t number);
  std::string_view counted{};  ///< what NUMBER in "name:NUMBER" counts: "triangles" or "lights"; empty: it takes none
  std::uint64_t preset = 0;    ///< NUMBER of the plain name; 0: the scene's own lights
  std::uint64_t fewest = 0;    ///< min of NUMBER
  std::uint64_t most = 0;      ///< max of NUMBER
};

/// The scene in its own size.
inline Scene make(const BuiltinScene& scene) { return scene.make(scene.preset); }

/// All of them; the first is the default.
std::span<const BuiltinScene> builtin_scenes();

/// The built-in scene of that name, or the glTF file at that path; `part` selects one of several scenes in a file, by
/// name or index. A colon and a number behind a built-in name ask for about that many triangles, as in forest:20M and
/// city:5e6, or for that many lights, as in courtyard:64. Throws Error (unreadable_input) that lists the built-in names
/// when it is neither, and Error (usage) when the scene cannot have that many or a part of a built-in scene is asked
/// for. Then applies the parameters: transparent surfaces are treated as they say, and every length is scaled to
/// metres. A scene far from its origin is moved there, and a size that is not credible is noted. Last, a ground is
/// added. The parameters also decide options.blend_makes_holes.
Scene load_scene(const std::string& name_or_path, const std::string& part = {}, const SceneParams& params = {},
                 LoadOptions options = {});

}  // namespace umbrameter
