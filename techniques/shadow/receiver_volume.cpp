#include "techniques/shadow/receiver_volume.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

namespace umbrameter {
namespace {

// The points with normal · p <= limit.
struct HalfSpace {
  dvec3 normal;
  double limit;
};

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Range along(const dvec3& axis, const Bounds& box) {
  const double middle = glm::dot(axis, box.center());
  const double reach = 0.5 * glm::dot(glm::abs(axis), box.extent());
  return {middle - reach, middle + reach};
}

void add_slab(std::vector<HalfSpace>& planes, const dvec3& axis, const Range& range) {
  planes.push_back({axis, range.high});
  planes.push_back({-axis, -range.low});
}

// The four sides of the frustum.
std::vector<HalfSpace> sides_of(const View& view, const dvec3& eye, const dvec3& forward) {
  const dmat4& world_from_camera = view.camera.world_from_camera;
  const auto* lens = std::get_if<PerspectiveProjection>(&view.camera.projection);
  const double height = lens != nullptr ? std::tan(0.5 * lens->vertical_fov)
                                        : std::get<OrthographicProjection>(view.camera.projection).half_height;
  const double width = height * view.width / view.height;
  std::vector<HalfSpace> sides;
  for (const double sign : {1.0, -1.0}) {
    for (const auto& [axis, reach] :
         {std::pair{dvec3(world_from_camera[0]), width}, {dvec3(world_from_camera[1]), height}}) {
      const dvec3 normal = lens != nullptr ? sign * axis - reach * forward : sign * axis;
      sides.push_back({normal, glm::dot(normal, eye) + (lens != nullptr ? 0.0 : reach)});
    }
  }
  return sides;
}

bool touches(std::span<const HalfSpace> planes, const Bounds& box) {
  return std::ranges::all_of(planes, [&](const HalfSpace& each) { return along(each.normal, box).low <= each.limit; });
}

// Of the convex body within all planes.
std::vector<dvec3> vertices_of(const std::vector<HalfSpace>& planes, double size) {
  const double rounding = 1e-9 * size;
  std::vector<dvec3> vertices;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const dvec3 line = glm::cross(planes[i].normal, planes[j].normal);
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        const double volume = glm::dot(line, planes[k].normal);
        if (std::abs(volume) < 1e-9) continue;
        const dvec3 p = (planes[k].limit * line + planes[i].limit * glm::cross(planes[j].normal, planes[k].normal) +
                         planes[j].limit * glm::cross(planes[k].normal, planes[i].normal)) /
                        volume;
        const auto holds = [&](const HalfSpace& each) { return glm::dot(each.normal, p) <= each.limit + rounding; };
        if (std::ranges::all_of(planes, holds)) vertices.push_back(p);
      }
    }
  }
  return vertices;
}

}  // namespace

GBuffer receiver_volume(const View& view, const dvec3& to_light, std::span<const Bounds> boxes, double nearest,
                        double farthest) {
  const dvec3 eye(view.camera.world_from_camera[3]);
  const dvec3 forward(-view.camera.world_from_camera[2]);
  const double near_plane = std::visit([](const auto& lens) { return lens.near_plane; }, view.camera.projection);
  const double far_plane = std::visit([](const auto& lens) { return lens.far_plane; }, view.camera.projection);
  const double start = glm::dot(forward, eye);
  std::vector<HalfSpace> planes = sides_of(view, eye, forward);
  planes.push_back({-forward, -(start + std::max(near_plane, nearest))});
  Bounds all;
  Range depths;
  Range heights;
  for (const Bounds& box : boxes) {
    if (box.empty()) continue;
    all.include(box);
    const Range height = along(to_light, box);
    heights.high = std::max(heights.high, height.high);
    if (!touches(planes, box)) continue;
    heights.low = std::min(heights.low, height.low);
    const Range depth = along(forward, box);
    depths.include(depth.low - start);
    depths.include(depth.high - start);
  }
  const Range kept{std::max({depths.low, near_plane, nearest}), std::min({depths.high, far_plane, farthest})};
  if (!(kept.low < kept.high)) return GBuffer(1, 1);
  planes.pop_back();
  add_slab(planes, forward, {start + kept.low, start + kept.high});
  const dvec3 world_axis = std::abs(to_light.x) < 0.9999 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 side = glm::normalize(glm::cross(world_axis, to_light));
  for (const dvec3& axis : {side, glm::cross(to_light, side)}) add_slab(planes, axis, along(axis, all));
  add_slab(planes, to_light, heights);

  const std::vector<dvec3> vertices = vertices_of(planes, glm::length(eye) + kept.high + all.radius());
  GBuffer surfels(std::max<int>(static_cast<int>(vertices.size()), 1), 1);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    surfels.instance[i] = surfels.triangle[i] = 0;
    surfels.position[i] = vec3(vertices[i]);
    surfels.depth[i] = static_cast<float>(glm::dot(forward, vertices[i]) - start);
  }
  return surfels;
}

}  // namespace umbrameter
