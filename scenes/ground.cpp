#include "scenes/ground.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/short_number.h"

namespace umbrameter {

void add_ground(Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  const double side = ground_diagonals * 2.0 * bounds.radius();
  if (!(side > 0.0)) return;
  Material material;
  material.name = "ground";
  material.base_color = vec4(0.5f, 0.5f, 0.5f, 1.0f);
  Mesh mesh;
  mesh.name = "ground";
  const auto half = static_cast<float>(0.5 * side);
  mesh.positions = {{-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.material = static_cast<std::uint32_t>(scene.materials.size());
  const dvec3 place{bounds.center().x, bounds.min.y, bounds.center().z};
  scene.ground = static_cast<std::uint32_t>(scene.instances.size());
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()),
                             static_cast<std::uint32_t>(scene.objects.size()), glm::translate(dmat4(1.0), place)});
  scene.objects.push_back({"ground"});
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(std::move(material));
  const std::string length = text_of(side);
  scene.notes.push_back("a ground of " + length + " m x " + length + " m, " + text_of(ground_diagonals) +
                        " times the scene's diagonal, was added below its lowest point; it does not count for the "
                        "scene's size");
}

Bounds ground_of(const Scene& scene) {
  Bounds bounds;
  if (!scene.ground) return bounds;
  const Instance& ground = scene.instances[*scene.ground];
  for (const vec3& position : scene.meshes[ground.mesh].positions) {
    bounds.include(dvec3(ground.world_from_mesh * dvec4(dvec3(position), 1.0)));
  }
  return bounds;
}

}  // namespace umbrameter
