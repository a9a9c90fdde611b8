// A floor under a half plane's edge, a light straight above it, and the shares of the light that are seen past it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/support/shapes.h"

namespace umbrameter::edge {

inline constexpr double edge_height = 2.0;
inline constexpr double light_height = 5.0;

// A floor at y = 0 and a half plane x < 0 at y = 2, so far reaching that no line from the floor to a light passes it.
struct Edge {
  Scene scene = shapes::empty_scene();
  std::uint32_t floor = 0;
  explicit Edge(double turn = 0.0) {
    dmat4 turned(1.0);
    turned[0] = dvec4(std::cos(turn), 0, -std::sin(turn), 0);
    turned[2] = dvec4(std::sin(turn), 0, std::cos(turn), 0);
    floor = shapes::add_mesh(scene, shapes::quad({-8, 0, 8}, {16, 0, 0}, {0, 0, -16}));
    shapes::add_mesh(scene, shapes::quad({-30, edge_height, 30}, {30, 0, 0}, {0, 0, -60}), turned);
  }
  GBuffer surfels(const std::vector<vec3>& points) const {
    return shapes::surfels(points, {0, 1, 0}, floor, [](vec3 p) { return p.x > -p.z ? 0u : 1u; });
  }
};

// Shines straight down from above the edge, turned about the vertical.
inline Light lamp(Emitter emitter, double turn = 0.0) {
  Light light;
  light.name = "lamp";
  light.shape = SpotLight{};
  light.world_from_light = {dvec4(std::cos(turn), 0, -std::sin(turn), 0), dvec4(std::sin(turn), 0, std::cos(turn), 0),
                            dvec4(0, 1, 0, 0), dvec4(0, light_height, 0, 1)};
  light.world_from_light[1] = dvec4(glm::cross(dvec3(0, 1, 0), dvec3(light.world_from_light[0])), 0);
  light.emitter = emitter;
  return light;
}

// TRUTH: V = clamp(½ + x(H − h)/(hW), 0, 1).
inline double of_rectangle(double x, double width) {
  return std::clamp(0.5 + x * (light_height - edge_height) / (edge_height * width), 0.0, 1.0);
}

// u = clamp(x(H − h)/(hr), −1, 1), V = ½ + (u√(1 − u²) + asin u)/π: the part of a disk on one side of a line.
inline double of_disk(double u) {
  u = std::clamp(u, -1.0, 1.0);
  return 0.5 + (u * std::sqrt(1.0 - u * u) + std::asin(u)) / pi;
}
inline double of_disk(double x, double radius) {
  return of_disk(x * (light_height - edge_height) / (edge_height * radius));
}

}  // namespace umbrameter::edge
