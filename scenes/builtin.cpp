#include "scenes/builtin.h"

#include <array>
#include <filesystem>
#include <system_error>

#include "core/error.h"
#include "core/parameters.h"
#include "scenes/builtin/scenes.h"
#include "scenes/gltf.h"

namespace umbrameter {
namespace {

template <Scene (*Make)()>
Scene one_size(std::uint64_t /*triangles*/) {
  return Make();
}

constexpr std::array<BuiltinScene, 5> scenes{{
    {"courtyard", "an arcaded court at midday: fine casters on large receivers, everything at once",
     one_size<builtin::make_courtyard>},
    {"tilted-plane", "one plane under suns at known angles: acne whose share is known from mathematics",
     one_size<builtin::make_tilted_plane>},
    {"contact-box", "nine boxes 0 to 20 cm above the ground: shadows that bias detaches",
     one_size<builtin::make_contact_box>},
    {"thin-leaf", "sheets 1 cm and 1 mm thick, lying and standing: casters that bias erases",
     one_size<builtin::make_thin_leaf>},
    {"corner", "three thick walls at right angles: light leaking along inner edges, AO of 1/4",
     one_size<builtin::make_corner>},
}};

[[noreturn]] void fail_unknown(const std::string& text) {
  std::string names;
  std::string_view nearest = scenes.front().name;
  for (const BuiltinScene& scene : scenes) {
    names.append(names.empty() ? "" : ", ").append(scene.name);
    if (edit_distance(text, scene.name) < edit_distance(text, nearest)) nearest = scene.name;
  }
  // A wider guess would be none.
  const bool is_near = edit_distance(text, nearest) <= 3;
  throw Error(ExitCode::unreadable_input, "scene '" + text + "'",
              "there is no such file, and no built-in scene of that name",
              (is_near ? "did you mean '" + std::string(nearest) + "'? " : std::string()) +
                  "give a .gltf or .glb file, or one of: " + names);
}

void refuse_part(const std::string& name, const std::string& part) {
  if (part.empty()) return;
  throw Error(ExitCode::usage, "--scene " + part, "'" + name + "' is built in and is one scene",
              "leave --scene away; it selects one of several scenes in a glTF file");
}

}  // namespace

std::span<const BuiltinScene> builtin_scenes() { return scenes; }

Scene load_scene(const std::string& name_or_path, const std::string& part) {
  for (const BuiltinScene& scene : scenes) {
    if (scene.name != name_or_path) continue;
    refuse_part(name_or_path, part);
    return make(scene);
  }
  // What cannot be looked up, such as a folder without permission, is the reader's to explain.
  std::error_code unknown;
  if (name_or_path.empty() || (!std::filesystem::exists(name_or_path, unknown) && !unknown)) {
    fail_unknown(name_or_path);
  }
  return load_gltf(name_or_path, part);
}

}  // namespace umbrameter
