#include "scenes/builtin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "core/lists.h"
#include "core/suggestion.h"
#include "scenes/builtin/scenes.h"
#include "scenes/gltf.h"
#include "scenes/ground.h"
#include "scenes/origin.h"
#include "scenes/transparency.h"
#include "scenes/units.h"

namespace umbrameter {
namespace {

template <Scene (*Make)()>
Scene one_size(std::uint64_t /*number*/) {
  return Make();
}

constexpr std::array<BuiltinScene, 15> scenes{{
    {"courtyard",
     "a courtyard with arcades at midday: fine casters on large receivers, all kinds of errors in one view",
     builtin::make_courtyard, "lights", 0, 1, 1024},
    {"tilted-plane", "one plane under suns at known angles: the exact share of acne is known",
     one_size<builtin::make_tilted_plane>},
    {"contact-box", "nine boxes 0 to 20 cm above the ground: bias detaches their shadows",
     one_size<builtin::make_contact_box>},
    {"thin-leaf", "horizontal and vertical sheets 1 cm and 1 mm thick: bias erases their shadows",
     one_size<builtin::make_thin_leaf>},
    {"corner", "three thick walls at right angles: light leaking along inner edges, AO of 1/4",
     one_size<builtin::make_corner>},
    {"trench", "slots 2 to 20 cm wide, one to four times as deep: shadows and AO where little light enters",
     one_size<builtin::make_trench>},
    {"spheres", "balls of 2 mm to 1 m radius, some with few facets: acne on curved receivers, jagged terminators",
     one_size<builtin::make_spheres>},
    {"ramp", "slopes of 0 to 85 degrees under a sun at the zenith: the bias that each slope needs",
     one_size<builtin::make_ramp>},
    {"long-posts", "rows of thin posts over 160 m under a low sun: perspective aliasing near the camera",
     one_size<builtin::make_long_posts>},
    {"two-occluders", "low plates under the edge of a high roof: light bleeding in filters such as VSM",
     one_size<builtin::make_two_occluders>},
    {"room", "a closed interior with one window and two lamps: walls that light must not leak through, fine casters",
     one_size<builtin::make_room>},
    {"fence", "a fence made of an alpha mask beside the same fence made of geometry: both must give the same result",
     one_size<builtin::make_fence>},
    {"foliage", "alpha-masked leaves before a plain wall: dappled shadows", one_size<builtin::make_foliage>},
    {"city", "streets of houses without instancing: thin parts at every distance", builtin::make_city, "triangles",
     300'000, 10'000, 20'000'000},
    {"forest", "instanced trees, ferns and rocks: light through leaves", builtin::make_forest, "triangles", 2'000'000,
     100'000, 100'000'000},
}};

// 20M, 5e6, 300k or 123456.
std::optional<std::uint64_t> parsed_size(std::string_view text) {
  double scale = 1.0;
  if (!text.empty() && (text.back() == 'k' || text.back() == 'M')) {
    scale = text.back() == 'k' ? 1e3 : 1e6;
    text.remove_suffix(1);
  }
  const std::optional<double> number = parsed<double>(text);
  // Beyond this the conversion would overflow; no scene goes near it.
  if (!number || !(*number > 0.0) || *number * scale > 1e15) return std::nullopt;
  return static_cast<std::uint64_t>(std::llround(*number * scale));
}

Scene make_sized(const BuiltinScene& scene, const std::string& text, const std::string& size) {
  const std::string name(scene.name);
  if (scene.counted.empty()) {
    throw Error(ExitCode::usage, "scene '" + text + "'", "'" + name + "' has one size",
                "omit ':" + size + "', or give a scene with a size, such as forest:" + size);
  }
  const std::string counted(scene.counted);
  const std::string range =
      "'" + name + "' can have " + std::to_string(scene.fewest) + " to " + std::to_string(scene.most) + " " + counted;
  const std::optional<std::uint64_t> number = parsed_size(size);
  if (!number) {
    const std::string example =
        scene.most < 1000000 ? name + ":64" : name + ":1M, " + name + ":1e6 or " + name + ":300k";
    throw Error(ExitCode::usage, "scene '" + text + "'", "'" + size + "' is not a number of " + counted,
                "write it as " + example + "; " + range);
  }
  if (*number < scene.fewest || *number > scene.most) {
    throw Error(ExitCode::usage, "scene '" + text + "'",
                std::to_string(*number) + " " + counted + " are too " + (*number < scene.fewest ? "few" : "many"),
                range);
  }
  return scene.make(*number);
}

[[noreturn]] void fail_unknown(const std::string& text) {
  const std::string name = text.substr(0, text.find(':'));
  std::string names;
  std::string_view nearest = scenes.front().name;
  for (const BuiltinScene& scene : scenes) {
    names.append(names.empty() ? "" : ", ").append(scene.name);
    if (edit_distance(name, scene.name) < edit_distance(name, nearest)) nearest = scene.name;
  }
  // A wider guess would be none: one wrong letter in three.
  const bool is_near = edit_distance(name, nearest) <= std::clamp(static_cast<int>(name.size()) / 3, 1, 3);
  throw Error(ExitCode::unreadable_input, "scene '" + text + "'", "there is no file and no built-in scene of that name",
              (is_near ? "did you mean '" + std::string(nearest) + "'? " : std::string()) +
                  "give a .gltf or .glb file, or one of: " + names);
}

void refuse_part(const std::string& name, const std::string& part) {
  if (part.empty()) return;
  throw Error(ExitCode::usage, "--scene " + part, "'" + name + "' is a built-in scene and has only one scene",
              "omit --scene; it selects a scene in a glTF file");
}

Scene read_scene(const std::string& name_or_path, const std::string& part, const LoadOptions& options) {
  for (const BuiltinScene& scene : scenes) {
    const std::string prefix = std::string(scene.name) + ":";
    const bool is_sized = name_or_path.starts_with(prefix);
    if (scene.name != name_or_path && !is_sized) continue;
    refuse_part(name_or_path, part);
    return is_sized ? make_sized(scene, name_or_path, name_or_path.substr(prefix.size())) : make(scene);
  }
  // What cannot be looked up, such as a folder without permission, is the reader's to explain.
  std::error_code unknown;
  if (name_or_path.empty() || (!std::filesystem::exists(name_or_path, unknown) && !unknown)) {
    fail_unknown(name_or_path);
  }
  return load_gltf(name_or_path, part, options);
}

}  // namespace

std::span<const BuiltinScene> builtin_scenes() { return scenes; }

Scene load_scene(const std::string& name_or_path, const std::string& part, const SceneParams& params,
                 LoadOptions options) {
  // A unit that does not exist is found before a large file is read.
  const double metres = metres_per_unit(params.unit);
  options.blend_makes_holes = params.blend == BlendMode::mask;
  Scene scene = read_scene(name_or_path, part, options);
  apply_blend_mode(scene, params.blend);
  if (metres != 1.0) scale(scene, metres);
  move_to_centre(scene);
  const std::string remark = size_remark(guess_units(bounds_of(scene), metres, is_surrounding(scene)));
  if (!remark.empty()) scene.notes.push_back(remark);
  if (params.ground) add_ground(scene);
  return scene;
}

}  // namespace umbrameter
