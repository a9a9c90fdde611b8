// Small scenes for tests: quads, boxes, spheres and disks with one material, and surfels on a plane without a camera.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "core/gbuffer.h"
#include "scenes/scene.h"

namespace umbrameter::shapes {

inline Scene empty_scene() {
  Scene scene;
  scene.name = "test";
  Material grey;
  grey.name = "grey";
  grey.base_color = vec4(0.5f, 0.5f, 0.5f, 1.0f);
  grey.double_sided = true;
  scene.materials.push_back(grey);
  return scene;
}

inline std::uint32_t add_mesh(Scene& scene, Mesh mesh, const dmat4& transform = dmat4(1.0)) {
  const auto id = static_cast<std::uint32_t>(scene.instances.size());
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({"object " + std::to_string(id)});
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size() - 1),
                             static_cast<std::uint32_t>(scene.objects.size() - 1), transform});
  return id;
}

/// Corner a, edges u and v; the front looks along u × v.
inline Mesh quad(vec3 a, vec3 u, vec3 v) {
  Mesh mesh;
  mesh.positions = {a, a + u, a + u + v, a + v};
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

inline Mesh box(vec3 low, vec3 high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                                (i & 4) != 0 ? high.z : low.z);
  }
  for (const uvec3 t : {uvec3(0, 2, 1),
                        {1, 2, 3},
                        {4, 5, 6},
                        {5, 7, 6},
                        {0, 1, 4},
                        {1, 5, 4},
                        {2, 6, 3},
                        {3, 6, 7},
                        {0, 4, 2},
                        {2, 4, 6},
                        {1, 3, 5},
                        {3, 7, 5}}) {
    mesh.triangles.push_back(t);
  }
  return mesh;
}

/// Latitude by longitude; vertices lie on the sphere, so that facets lie inside of it.
inline Mesh sphere(vec3 center, float radius, int rows, int columns) {
  Mesh mesh;
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double theta = pi * r / rows;
      const double phi = 2.0 * pi * c / columns;
      mesh.positions.push_back(center + radius * vec3(dvec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                            std::sin(theta) * std::sin(phi))));
    }
  }
  const auto at = [columns](int r, int c) { return static_cast<std::uint32_t>(r * columns + c % columns); };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      if (r > 0) mesh.triangles.emplace_back(at(r, c), at(r, c + 1), at(r + 1, c + 1));
      if (r + 1 < rows) mesh.triangles.emplace_back(at(r, c), at(r + 1, c + 1), at(r + 1, c));
    }
  }
  return mesh;
}

/// Regular polygon of `corners` sides with the area of the disk, in the plane y = center.y.
inline Mesh disk(vec3 center, float radius, int corners) {
  Mesh mesh;
  const double step = 2.0 * pi / corners;
  const double outer = radius * std::sqrt(step / std::sin(step));
  mesh.positions.push_back(center);
  for (int i = 0; i < corners; ++i) {
    mesh.positions.push_back(center + vec3(dvec3(outer * std::cos(step * i), 0.0, outer * std::sin(step * i))));
  }
  for (int i = 0; i < corners; ++i) {
    mesh.triangles.emplace_back(0u, static_cast<std::uint32_t>(1 + i),
                                static_cast<std::uint32_t>(1 + (i + 1) % corners));
  }
  return mesh;
}

/// One pixel for each point, on triangle `triangle` of the instance, with that normal.
inline GBuffer surfels(const std::vector<vec3>& points, vec3 normal, std::uint32_t instance,
                       const std::function<std::uint32_t(vec3)>& triangle_of) {
  GBuffer gbuffer(static_cast<int>(points.size()), 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    gbuffer.instance[i] = instance;
    gbuffer.triangle[i] = triangle_of(points[i]);
    gbuffer.position[i] = points[i];
    gbuffer.geometric_normal[i] = normal;
    gbuffer.shading_normal[i] = normal;
  }
  return gbuffer;
}

/// A light that travels from `towards_light` to the origin.
inline Light directional(const dvec3& towards_light) {
  Light light;
  light.name = "sun";
  const dvec3 z = glm::normalize(towards_light);
  const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), z));
  light.world_from_light = dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(0, 0, 0, 1));
  return light;
}

}  // namespace umbrameter::shapes
