#include "scenes/view.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> surfel_source_names = {"raster", "traced"};
constexpr double degree = pi / 180.0;

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

dmat4 frame_towards(const dvec3& towards_viewer, const dvec3& origin) {
  const dvec3 z = glm::normalize(towards_viewer);
  const dvec3 x = glm::normalize(glm::cross(dvec3(0, 1, 0), z));
  const dvec3 y = glm::cross(z, x);
  return {dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), dvec4(origin, 1)};
}

// From in front (+Z, glTF 2.0, section 3.4), a little aside and above; the nearest position along that direction
// from which each box corner stands within the image.
// Where the axis must pass so that what is seen reaches equally far to both sides of it: with `across` and `towards`
// the places of points across the image and towards the camera, max + min of (across − shift) / (distance − towards) is
// 0. It falls with the shift, so it is bisected.
double balanced_shift(const std::array<double, 8>& across, const std::array<double, 8>& towards, double distance) {
  double low = *std::min_element(across.begin(), across.end());
  double high = *std::max_element(across.begin(), across.end());
  for (int step = 0; step < 60; ++step) {
    const double shift = 0.5 * (low + high);
    double most = -std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < across.size(); ++i) {
      const double seen = (across[i] - shift) / (distance - towards[i]);
      most = std::max(most, seen);
      least = std::min(least, seen);
    }
    (most + least > 0.0 ? low : high) = shift;
  }
  return 0.5 * (low + high);
}

Camera fitted_camera(const Bounds& bounds, double aspect) {
  constexpr double azimuth = 30.0 * degree;
  constexpr double elevation = 25.0 * degree;
  constexpr double margin = 0.94;
  const dvec3 direction{std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                        std::cos(azimuth) * std::cos(elevation)};
  Camera camera;
  camera.name = "fitted";
  PerspectiveProjection lens;
  const dmat4 axes = frame_towards(direction, dvec3(0));
  const dvec2 tangent = margin * std::tan(0.5 * lens.vertical_fov) * dvec2(aspect, 1.0);
  const dvec3 center = bounds.empty() ? dvec3(0) : bounds.center();
  const double radius = std::max(bounds.radius(), 1e-6 * (1.0 + glm::length(center)));
  // Each corner at (x, y, z) of the camera's axes asks |x − shift| ≤ tangent · (distance − z), likewise for y.
  const double infinite = std::numeric_limits<double>::infinity();
  dvec2 upper(-infinite);
  dvec2 lower(-infinite);
  std::array<std::array<double, 8>, 3> corners{};
  for (std::size_t i = 0; i < 8; ++i) {
    const dvec3 offset = bounds.empty() ? dvec3(0) : bounds.corner(static_cast<int>(i)) - center;
    const dvec3 local = glm::transpose(dmat3(axes)) * offset;
    upper = glm::max(upper, dvec2(local) + tangent * local.z);
    lower = glm::max(lower, -dvec2(local) + tangent * local.z);
    for (int c = 0; c < 3; ++c) corners[static_cast<std::size_t>(c)][i] = local[c];
  }
  const double nearest = *std::max_element(corners[2].begin(), corners[2].end());
  const dvec2 needed = (upper + lower) / (2.0 * tangent);
  const double distance = std::max({needed.x, needed.y, nearest + 0.1 * radius});
  const dvec2 shift{balanced_shift(corners[0], corners[2], distance), balanced_shift(corners[1], corners[2], distance)};
  camera.world_from_camera =
      frame_towards(direction, center + distance * direction + dvec3(axes[0]) * shift.x + dvec3(axes[1]) * shift.y);
  lens.near_plane = 0.5 * (distance - nearest);
  camera.projection = lens;
  return camera;
}

Light sun() {
  Light light;
  light.name = "sun";
  light.world_from_light = frame_towards({0.45, 1.0, 0.35}, dvec3(0));
  light.intensity = 1e5;
  return light;
}

template <class Named>
std::string listed(const std::vector<Named>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(i) + (items[i].name.empty() ? "" : " '" + items[i].name + "'");
  }
  return text;
}

/// An exact name wins over an index, so that a light named "7" can be reached.
template <class Named>
std::size_t select(const std::vector<Named>& items, const std::string& wanted, const std::string& kind) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == wanted) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  const std::string what = "--" + kind + " " + wanted;
  if (found.size() > 1) {
    std::string indices;
    for (const std::size_t i : found) indices += (indices.empty() ? "" : ", ") + std::to_string(i);
    throw Error(ExitCode::usage, what, std::to_string(found.size()) + " " + kind + "s of the scene have this name",
                "choose one by its index: " + indices);
  }
  std::size_t index = 0;
  const auto [end, status] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (status == std::errc() && end == wanted.data() + wanted.size() && index < items.size()) return index;
  const std::string remedy =
      items.empty() ? "leave --" + kind + " away, and one is made up"
                    : "it has " + listed(items) + ": give an index or a name, or leave --" + kind + " away";
  throw Error(ExitCode::usage, what, "the scene has no such " + kind, remedy);
}

}  // namespace

Parameters describe(ViewParams& params) {
  return Description("view")
      .field("size", params.size, {"px", "width and height of the images", 1, 16384})
      .field("scene", params.scene,
             {"", "one of several scenes in a file, by name or index; empty: the file's default"})
      .field("camera", params.camera, {"", "camera by name or index; empty: the first of the scene"})
      .field("light", params.light, {"", "light by name or index; empty: all, or the first where one is swept"})
      .choice("surfels", params.surfels, surfel_source_names,
              {"", "which side finds the surface points that both sides answer for"})
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
  if (!name_or_index.empty()) return scene.cameras[select(scene.cameras, name_or_index, "camera")];
  if (!scene.cameras.empty()) return scene.cameras.front();
  notes.push_back(
      "the scene has no camera: one was fitted to its bounds, 30 degrees beside the front (+Z) and 25 degrees above; "
      "add a camera to the file to choose another view");
  return fitted_camera(bounds_of(scene), aspect);
}

void add_missing_light(Scene& scene, std::vector<std::string>& notes) {
  if (!scene.lights.empty()) return;
  notes.push_back(
      "the scene has no light: a directional sun shines from (0.45, 1, 0.35); add a KHR_lights_punctual light to the "
      "file to choose another");
  scene.lights.push_back(sun());
}

std::vector<std::uint32_t> select_lights(const Scene& scene, const std::string& name_or_index) {
  if (!name_or_index.empty()) return {static_cast<std::uint32_t>(select(scene.lights, name_or_index, "light"))};
  std::vector<std::uint32_t> all(scene.lights.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

std::vector<std::string> layer_names(const std::vector<Light>& lights) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    std::string name = lights[i].name;
    for (char& c : name) {
      const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
      if (!kept) c = '_';
    }
    if (name.empty()) name = std::to_string(i);
    while (std::find(names.begin(), names.end(), name) != names.end()) name.append("_").append(std::to_string(i));
    names.push_back(std::move(name));
  }
  return names;
}

}  // namespace umbrameter
