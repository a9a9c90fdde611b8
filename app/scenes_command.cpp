#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/contact_sheet.h"
#include "app/scene_report.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "reports/drawing.h"
#include "reports/output.h"
#include "reports/text_layout.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t name_width = 15;
constexpr std::size_t line_width = 96;
constexpr Size default_tile{480, 300};

// A built-in scene, in its own size or in the one that its name asks for.
struct Chosen {
  const BuiltinScene* description = nullptr;
  std::string name;
};

// What only making the scene tells.
struct Listed {
  const BuiltinScene* description = nullptr;
  std::string name;
  std::uint64_t triangles = 0;
  std::vector<std::string> cameras;
  std::vector<std::string> lights;
};

Listed list(const Chosen& chosen) {
  const Scene scene = load_scene(chosen.name);
  Listed listed{chosen.description, chosen.name, count(scene).triangles, {}, {}};
  for (const Camera& camera : scene.cameras) listed.cameras.push_back(camera.name);
  for (const Light& light : scene.lights) listed.lights.push_back(light.name);
  return listed;
}

Chosen find_scene(const std::string& name) {
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == std::string_view(name).substr(0, name.find(':'))) return {&scene, name};
  }
  throw Error(ExitCode::usage, "scene '" + name + "'", "there is no built-in scene of that name",
              "'umbrameter scenes' lists them");
}

std::vector<Chosen> choose(const std::vector<std::string>& names) {
  std::vector<Chosen> all;
  for (const std::string& name : names) all.push_back(find_scene(name));
  if (!names.empty()) return all;
  for (const BuiltinScene& scene : builtin_scenes()) all.push_back({&scene, std::string(scene.name)});
  return all;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

std::string counted(const char* noun, const std::vector<std::string>& names) {
  return fmt::format("{}{} {}", noun, names.size() == 1 ? "" : "s", joined(names));
}

std::string size_text(const Listed& scene) {
  const std::string triangles = grouped(scene.triangles) + " triangles";
  if (scene.description->triangles == 0) return triangles;
  return fmt::format("{}; {}:NUMBER for {} to {}", triangles, scene.description->name,
                     grouped(scene.description->fewest), grouped(scene.description->most));
}

void say_scene(const Console& console, const Listed& scene) {
  const std::string facts =
      fmt::format("{}; {}; {}", size_text(scene), counted("camera", scene.cameras), counted("light", scene.lights));
  std::string label = scene.name;
  for (const std::string& paragraph : {std::string(scene.description->purpose), facts}) {
    for (const std::string& text : wrapped(paragraph, line_width - name_width)) {
      say(console, fmt::format("{:<{}}{}", label, name_width, text));
      label.clear();
    }
  }
}

// The numbers of triangles that may be asked for; null for a scene of one size.
Json sizes_json(const BuiltinScene& description) {
  return description.triangles == 0 ? Json(nullptr) : Json{description.fewest, description.most};
}

Json to_json(const Listed& scene) {
  return {{"name", scene.name},           {"purpose", scene.description->purpose},
          {"triangles", scene.triangles}, {"sizes", sizes_json(*scene.description)},
          {"cameras", scene.cameras},     {"lights", scene.lights}};
}

std::string to_markdown(const std::vector<Listed>& scenes) {
  std::string text =
      "# Built-in scenes\n\n"
      "Made by `umbrameter scenes --markdown`; the picture by `umbrameter scenes --sheet docs/images/scenes.png`. "
      "Each\n"
      "name is a SCENE for every command; `umbrameter scene NAME -o FILE.glb` writes it as glTF.\n\n"
      "![All built-in scenes](images/scenes.png)\n\n"
      "Each is seen from its first perspective camera, with traced shadows of its first sun and all its lamps and "
      "with\n"
      "traced ambient occlusion, on diffuse surfaces. One rule of exposure for all: the surfaces' mean luminance is "
      "0.3,\n"
      "or less where more than 2 % of them would be white.\n\n"
      "| scene | what it is there to show | triangles | cameras | lights |\n| --- | --- | --- | --- | --- |\n";
  std::string sizes;
  for (const Listed& scene : scenes) {
    const BuiltinScene& description = *scene.description;
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", scene.name, description.purpose, grouped(scene.triangles),
                        joined(scene.cameras), joined(scene.lights));
    if (description.triangles == 0) continue;
    sizes += fmt::format("- `{}:NUMBER` has about that many triangles, from {} to {}.\n", description.name,
                         grouped(description.fewest), grouped(description.most));
  }
  if (sizes.empty()) return text;
  return text +
         "\nSome come in other sizes than the usual one of the table; NUMBER is written like `20M`, `300k` or "
         "`5e6`:\n\n" +
         sizes;
}

Size tile_size(const std::string& given) {
  Size size = default_tile;
  if (!given.empty()) {
    const Parameters parameters =
        Description("sheet").field("size", size, {"px", "width and height of a picture", 8, 4096}).take();
    require(parameters, "sheet.size").set_text(given);
  }
  return size;
}

void write_sheet(const CommandLine& line, const Console& console, const std::vector<Chosen>& scenes) {
  require_drawing_name(line.sheet);
  // Told now, not after minutes of drawing.
  prepare_output_folder(line.sheet.has_parent_path() ? line.sheet.parent_path() : ".");
  const Size size = tile_size(line.tile_size);
  const ThreadLimit threads(line.threads);
  std::vector<SheetTile> tiles;
  {
    ProgressBar bar(console, "drawing scenes");
    for (const Chosen& chosen : scenes) {
      throw_if_interrupted();
      const auto done = static_cast<double>(tiles.size());
      const auto all = static_cast<double>(scenes.size());
      Scene scene = load_scene(chosen.name);
      const std::string facts = grouped(count(scene).triangles) + " triangles";
      const Progress progress = [&](double share) { bar.show((done + share) / all); };
      tiles.push_back(
          {chosen.name, facts, std::string(chosen.description->purpose), draw_tile(std::move(scene), size, progress)});
    }
  }
  write_drawing(line.sheet, draw_sheet("The built-in scenes of Umbrameter", tiles));
  say(console, fmt::format("{}: {} scenes", line.sheet.string(), tiles.size()));
}

}  // namespace

ExitCode run_scenes(const CommandLine& line, const Console& console) {
  const std::vector<Chosen> scenes = choose(line.names);
  if (!line.sheet.empty()) {
    write_sheet(line, console, scenes);
    if (console.json) {
      fmt::print("{}\n", Json{{"file", line.sheet.string()}, {"scenes", scenes.size()}}.dump(2));
    }
    return ExitCode::ok;
  }
  if (!line.tile_size.empty()) {
    throw Error(ExitCode::usage, "--size", "it is about the contact sheet", "add --sheet FILE, or leave it away");
  }
  std::vector<Listed> all;
  Json json = Json::array();
  for (const Chosen& scene : scenes) {
    throw_if_interrupted();
    all.push_back(list(scene));
    json.push_back(to_json(all.back()));
    if (!line.markdown) say_scene(console, all.back());
  }
  if (console.json) {
    fmt::print("{}\n", json.dump(2));
  } else if (line.markdown) {
    fmt::print("{}", to_markdown(all));
  }
  return ExitCode::ok;
}

}  // namespace umbrameter
