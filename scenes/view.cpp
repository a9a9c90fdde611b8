#include "scenes/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/lists.h"
#include "scenes/fitted_camera.h"
#include "scenes/light.h"
#include "scenes/selection.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> surfel_source_names = {"raster", "traced"};

const OrthographicProjection* orthographic(const View& view) {
  return std::get_if<OrthographicProjection>(&view.camera.projection);
}

double aspect_of(const View& view) { return static_cast<double>(view.width) / view.height; }

/// Half of the image's width and height: metres (orthographic) or tangents (perspective).
dvec2 half_size(const View& view) {
  if (const auto* parallel = orthographic(view)) {
    return {parallel->half_height * aspect_of(view), parallel->half_height};
  }
  const double tangent = std::tan(0.5 * std::get<PerspectiveProjection>(view.camera.projection).vertical_fov);
  return {tangent * aspect_of(view), tangent};
}

template <class Named>
std::string listed(const std::vector<Named>& items, const std::vector<std::size_t>& indices) {
  constexpr std::size_t max_listed = 24;
  std::string text;
  for (std::size_t n = 0; n < indices.size() && n < max_listed; ++n) {
    const std::string& name = items[indices[n]].name;
    text += (n == 0 ? "" : ", ") + std::to_string(indices[n]) + (name.empty() ? "" : " '" + name + "'");
  }
  return indices.size() > max_listed ? text + " and " + std::to_string(indices.size() - max_listed) + " more" : text;
}

template <class Named>
std::size_t select(const std::vector<Named>& items, const std::string& wanted, const std::string& kind) {
  const std::vector<std::size_t> found = select_items(items, wanted);
  if (found.size() == 1) return found.front();
  const std::string what = "--" + kind + " " + wanted;
  if (found.size() > 1) {
    throw Error(ExitCode::usage, what, std::to_string(found.size()) + " " + kind + "s of the scene have this name",
                "choose one by its index: " + listed(items, found));
  }
  std::vector<std::size_t> all(items.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const std::string remedy = items.empty() ? "omit --" + kind + " to use a default " + kind
                             : wanted == "all"
                                 ? "in a sweep write their numbers: --vary view." + kind + "=" +
                                       joined(all, ",", [](std::size_t i) { return std::to_string(i); })
                                 : "it has " + listed(items, all) + ": give an index or a name, or omit --" + kind;
  throw Error(ExitCode::usage, what, "the scene has no such " + kind, remedy);
}

}  // namespace

Parameters describe(ViewParams& params) {
  return Description("view")
      .field("size", params.size,
             {.unit = "px", .meaning = "image size, width x height", .min = 1, .max = 16384, .basic = true})
      .field("scene", params.scene,
             {.unit = {}, .meaning = "scene in the file, by name or index; empty: the file's default", .basic = true})
      .field("camera", params.camera,
             {.unit = {}, .meaning = "camera, by name or index; empty: the first", .basic = true})
      .field("light", params.light,
             {.unit = {}, .meaning = "light, by name or index; empty: all, or the first in a sweep", .basic = true})
      .choice("surfels", params.surfels, surfel_source_names,
              {"", "renderer of the G-buffer that reference and technique share"})
      .take();
}

dmat4 view_from_world(const View& view) {
  const dmat4& world = view.camera.world_from_camera;
  const dmat3 transposed = glm::transpose(dmat3(world));
  dmat4 inverse(transposed);
  inverse[3] = dvec4(-(transposed * dvec3(world[3])), 1.0);
  return inverse;
}

dmat4 clip_from_view(const View& view) {
  const dvec2 half = half_size(view);
  dmat4 clip(0.0);
  clip[0][0] = 1.0 / half.x;
  clip[1][1] = 1.0 / half.y;
  if (const auto* parallel = orthographic(view)) {
    const double depth = parallel->far_plane - parallel->near_plane;
    clip[2][2] = 1.0 / depth;
    clip[3][2] = parallel->far_plane / depth;
    clip[3][3] = 1.0;
    return clip;
  }
  const auto& lens = std::get<PerspectiveProjection>(view.camera.projection);
  const bool infinite = std::isinf(lens.far_plane);
  clip[2][2] = infinite ? 0.0 : lens.near_plane / (lens.far_plane - lens.near_plane);
  clip[2][3] = -1.0;
  clip[3][2] = infinite ? lens.near_plane : lens.far_plane * clip[2][2];
  return clip;
}

Ray pixel_ray(const View& view, int x, int y) {
  const dvec2 half = half_size(view);
  const dvec2 image{half.x * (2.0 * (x + 0.5) / view.width - 1.0), half.y * (1.0 - 2.0 * (y + 0.5) / view.height)};
  dvec3 origin;
  dvec3 direction{0, 0, -1};
  if (const auto* parallel = orthographic(view)) {
    origin = {image, -parallel->near_plane};
  } else {
    direction = {image, -1.0};
    origin = std::get<PerspectiveProjection>(view.camera.projection).near_plane * direction;
  }
  const dmat4& world = view.camera.world_from_camera;
  return {dvec3(world * dvec4(origin, 1.0)), glm::normalize(dmat3(world) * direction)};
}

dvec3 to_viewer(const View& view, const dvec3& position) {
  const dvec3 axis = glm::normalize(dvec3(view.camera.world_from_camera[2]));
  if (orthographic(view) != nullptr) return axis;
  const dvec3 offset = dvec3(view.camera.world_from_camera[3]) - position;
  const double distance = glm::length(offset);
  return distance > 0.0 ? offset / distance : axis;
}

Camera select_camera(const Scene& scene, const std::string& name_or_index, double aspect,
                     std::vector<std::string>& notes) {
  if (name_or_index.empty() && scene.cameras.empty()) {
    FittedCamera fitted = fit_camera(scene, aspect);
    notes.push_back(std::move(fitted.note));
    return fitted.camera;
  }
  const std::size_t chosen = name_or_index.empty() ? 0 : select(scene.cameras, name_or_index, "camera");
  std::string remark = camera_remark(scene, scene.cameras[chosen], aspect);
  if (!remark.empty()) notes.push_back(std::move(remark));
  return scene.cameras[chosen];
}

void add_missing_light(Scene& scene, std::vector<std::string>& notes) {
  if (!scene.lights.empty()) return;
  notes.push_back(
      "the scene has no light: using a sun from the direction (0.45, 1, 0.35); add a KHR_lights_punctual light to the "
      "file to choose another");
  scene.lights.push_back(default_sun());
}

std::vector<std::uint32_t> select_lights(const Scene& scene, const std::string& name_or_index) {
  if (!name_or_index.empty()) return {static_cast<std::uint32_t>(select(scene.lights, name_or_index, "light"))};
  std::vector<std::uint32_t> all(scene.lights.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::vector<std::string> layer_names(const std::vector<Light>& lights) {
  // Leaves room for what figures put before and behind it: file systems allow 255 bytes.
  constexpr std::size_t max_characters = 64;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::string name = lights[i].name.substr(0, max_characters);
    for (char& c : name) {
      const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
      if (!kept) c = '_';
    }
    if (name.empty()) name = std::to_string(i);
    while (std::ranges::find(names, name) != names.end()) name.append("_").append(std::to_string(i));
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace umbrameter
