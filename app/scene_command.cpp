#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "raster/gl/context.h"
#include "raytrace/tracer.h"
#include "reports/output.h"
#include "scenes/builtin.h"
#include "scenes/gltf.h"

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_listed = 24;

const char* kind_of(const Light& light) {
  static constexpr const char* names[] = {"directional", "spot", "point"};
  return names[light.shape.index()];
}

const char* kind_of(const Camera& camera) {
  return std::holds_alternative<PerspectiveProjection>(camera.projection) ? "perspective" : "orthographic";
}

Json scene_json(const std::string& name) {
  const Scene scene = load_scene(name);
  const SceneCounts counts = count(scene);
  const Bounds bounds = bounds_of(scene);
  Json json;
  json["name"] = name;
  json["triangles"] = counts.triangles;
  json["stored_triangles"] = counts.stored_triangles;
  json["vertices"] = counts.vertices;
  json["meshes"] = scene.meshes.size();
  json["instances"] = scene.instances.size();
  json["objects"] = scene.objects.size();
  json["materials"] = scene.materials.size();
  json["textures"] = scene.textures.size();
  if (!bounds.empty()) {
    json["bounds_m"] = {{bounds.min.x, bounds.min.y, bounds.min.z}, {bounds.max.x, bounds.max.y, bounds.max.z}};
  }
  json["cameras"] = Json::array();
  for (const Camera& camera : scene.cameras)
    json["cameras"].push_back({{"name", camera.name}, {"kind", kind_of(camera)}});
  json["lights"] = Json::array();
  for (const Light& light : scene.lights) json["lights"].push_back({{"name", light.name}, {"kind", kind_of(light)}});
  json["notes"] = scene.notes;
  return json;
}

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

void say_named(const Console& console, const char* title, const Json& items) {
  for (std::size_t i = 0; i < items.size() && i < most_listed; ++i) {
    const std::string name = items[i]["name"].get<std::string>();
    say(console, fmt::format("{:<10} {}: {} ({})", i == 0 ? title : "", i, name.empty() ? "without a name" : name,
                             items[i]["kind"].get<std::string>()));
  }
  if (items.empty()) say(console, fmt::format("{:<10} none", title));
  if (items.size() > most_listed) say(console, fmt::format("{:<10} … {} more", "", items.size() - most_listed));
}

void say_scene(const Console& console, const Json& json) {
  say(console, fmt::format("{:<10} {}", "scene", json["name"].get<std::string>()));
  say(console,
      fmt::format("{:<10} {} in all, {} stored; {} vertices", "triangles", json["triangles"].get<std::uint64_t>(),
                  json["stored_triangles"].get<std::uint64_t>(), json["vertices"].get<std::uint64_t>()));
  say(console, fmt::format("{:<10} {} objects, {} instances of {} meshes, {} materials, {} textures", "parts",
                           json["objects"].get<std::size_t>(), json["instances"].get<std::size_t>(),
                           json["meshes"].get<std::size_t>(), json["materials"].get<std::size_t>(),
                           json["textures"].get<std::size_t>()));
  if (json.contains("bounds_m")) {
    const Json& low = json["bounds_m"][0];
    const Json& high = json["bounds_m"][1];
    say(console, fmt::format("{:<10} [{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}] m", "bounds",
                             low[0].get<double>(), low[1].get<double>(), low[2].get<double>(), high[0].get<double>(),
                             high[1].get<double>(), high[2].get<double>()));
  }
  say_named(console, "cameras", json["cameras"]);
  say_named(console, "lights", json["lights"]);
  for (const Json& text : json["notes"]) say(console, fmt::format("{:<10} {}", "note", text.get<std::string>()));
}

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace); }

}  // namespace

ExitCode run_scenes(const Console& console) {
  Json json = Json::array();
  for (const BuiltinScene& scene : builtin_scenes()) {
    json.push_back({{"name", scene.name}, {"purpose", scene.purpose}});
    say(console, fmt::format("{:<14} {}", scene.name, scene.purpose));
  }
  if (console.json) fmt::print("{}\n", dump(json));
  return ExitCode::ok;
}

ExitCode run_scene(const CommandLine& line, const Console& console) {
  const Scene scene = load_scene(line.scene);
  const std::vector<unsigned char> glb = to_glb(scene);
  write_text(line.output, {reinterpret_cast<const char*>(glb.data()), glb.size()});
  say(console, fmt::format("{}: {} triangles, {} bytes", line.output.string(), count(scene).triangles, glb.size()));
  if (console.json) fmt::print("{}\n", dump({{"file", line.output.string()}, {"bytes", glb.size()}}));
  return ExitCode::ok;
}

ExitCode run_info(const CommandLine& line, const Console& console) {
  Json json;
  json["version"] = UMBRAMETER_VERSION;
  json["embree"] = embree_version();
  if (!line.scene.empty()) {
    json["scene"] = scene_json(line.scene);
    say_scene(console, json["scene"]);
  } else {
    json["gl_devices"] = devices_json();
    say(console, fmt::format("{:<10} {}", "umbrameter", UMBRAMETER_VERSION));
    say(console, fmt::format("{:<10} {}", "Embree", embree_version()));
    for (const Json& device : json["gl_devices"]) {
      say(console, fmt::format("{:<10} {}: {}, {}{}", "OpenGL", device["index"].get<int>(),
                               device["renderer"].get<std::string>(), device["version"].get<std::string>(),
                               device["software"].get<bool>() ? " (software)" : ""));
    }
    if (json["gl_devices"].empty()) {
      say(console,
          fmt::format("{:<10} no usable device; install a driver (Debian: libegl-mesa0 libgl1-mesa-dri)", "OpenGL"));
    }
  }
  if (console.json) fmt::print("{}\n", dump(json));
  return ExitCode::ok;
}

ExitCode run_parameters(const CommandLine& line) {
  if (line.markdown) {
    fmt::print("{}", parameter_reference());
    return ExitCode::ok;
  }
  Experiment experiment;
  for (const Parameter& parameter : describe(experiment)) {
    const std::string value = to_string(parameter.value());
    fmt::print("{:<24} {:<10} {:<7} {}; {}\n", parameter.key, value.empty() ? "—" : value, parameter.description.unit,
               parameter.description.meaning, parameter.limits());
  }
  return ExitCode::ok;
}

}  // namespace umbrameter
