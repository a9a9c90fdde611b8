#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/print_json.h"
#include "experiments/measure/scene_report.h"
#include "present/scene_report.h"
#include "raster/gl/context.h"
#include "raytrace/tracer.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

Json devices_json() {
  Json devices = Json::array();
  for (const GlDevice& device : list_gl_devices()) {
    devices.push_back({{"index", device.index},
                       {"name", device.name},
                       {"renderer", device.renderer},
                       {"version", device.version},
                       {"software", device.software}});
  }
  return devices;
}

void say_devices(const Console& console, const Json& devices) {
  print_line(console, fmt::format("{:<10} {}", "umbrameter", UMBRAMETER_VERSION));
  print_line(console, fmt::format("{:<10} {}", "Embree", embree_version()));
  // A driver that is offered in several ways has one line.
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Json& device : devices) {
    std::string text =
        fmt::format("{}, {}{}", device["renderer"].get<std::string>(), device["version"].get<std::string>(),
                    device["software"].get<bool>() ? " (software)" : "");
    const std::string index = std::to_string(device["index"].get<int>());
    const auto same = std::ranges::find(lines, text, &std::pair<std::string, std::string>::second);
    if (same == lines.end()) {
      lines.emplace_back(index, std::move(text));
    } else {
      same->first += ", " + index;
    }
  }
  for (const auto& [indices, text] : lines) {
    print_line(console, fmt::format("{:<10} {}: {}", "OpenGL", indices, text));
  }
  if (devices.empty()) {
    print_line(
        console,
        fmt::format("{:<10} no usable device; install a driver (Debian: libegl1 libegl-mesa0 libgl1 libgl1-mesa-dri)",
                    "OpenGL"));
  }
}

}  // namespace

ExitCode run_info(const CommandLine& line, const Console& console) {
  Json json;
  json["version"] = UMBRAMETER_VERSION;
  json["embree"] = embree_version();
  const SceneChoice choice = chosen_scene(line);
  if (!line.scene.empty()) {
    const SceneReport report =
        make_scene_report(line.scene, choice.part, {load_options(line), line.measure_memory, choice.scene_params});
    json["scene"] = to_json(report);
    for (const std::string& text : to_lines(report)) print_line(console, text);
  } else {
    for (const auto& [key, text] : line.settings) {
      throw Error(ExitCode::usage, (key == "view.scene" ? "--scene " : "--" + key + " ") + text, "no file given",
                  "add the .gltf or .glb file that contains the scene");
    }
    json["gl_devices"] = devices_json();
    say_devices(console, json["gl_devices"]);
  }
  print_json(console, json);
  return ExitCode::ok;
}

}  // namespace umbrameter
