#include "scenes/builtin/placing.h"

#include <glm/gtc/matrix_transform.hpp>

namespace umbrameter::builtin {
namespace {

constexpr vec3 warm_white{1.0f, 0.86f, 0.66f};

}  // namespace

double chance(std::uint32_t seed, std::uint32_t index, double low, double high) {
  return low + (high - low) * static_cast<double>(to_unit_float(hash(seed, index)));
}

dmat4 moved(const dvec3& offset) { return glm::translate(dmat4(1.0), offset); }
dmat4 turned(double angle, const dvec3& axis) { return glm::rotate(dmat4(1.0), degrees(angle), axis); }
dmat4 scaled(const dvec3& factors) { return glm::scale(dmat4(1.0), factors); }

dmat4 looking(const dvec3& eye, const dvec3& target, const dvec3& up) {
  const dvec3 z = glm::normalize(eye - target);
  const dvec3 x = glm::normalize(glm::cross(up, z));
  return {dvec4(x, 0.0), dvec4(glm::cross(z, x), 0.0), dvec4(z, 0.0), dvec4(eye, 1.0)};
}

std::uint32_t add_material(Scene& scene, const std::string& name, const vec3& linear_color) {
  Material material;
  material.name = name;
  material.base_color = vec4(linear_color, 1.0f);
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t add_sheet_material(Scene& scene, const std::string& name, const vec3& linear_color) {
  const std::uint32_t index = add_material(scene, name, linear_color);
  scene.materials[index].double_sided = true;
  return index;
}

std::uint32_t add_mesh(Scene& scene, Mesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

void place(Scene& scene, std::uint32_t mesh, const std::string& name, const dmat4& world_from_mesh) {
  scene.instances.push_back({mesh, static_cast<std::uint32_t>(scene.objects.size()), world_from_mesh});
  scene.objects.push_back({name});
}

void place_once(Scene& scene, Mesh mesh, const dmat4& world_from_mesh) {
  const std::string name = mesh.name;
  place(scene, add_mesh(scene, std::move(mesh)), name, world_from_mesh);
}

void add_camera(Scene& scene, const std::string& name, const dmat4& world_from_camera, double vertical_fov_degrees) {
  scene.cameras.push_back({name, world_from_camera, PerspectiveProjection{degrees(vertical_fov_degrees), 0.05}});
}

void add_sun(Scene& scene, const std::string& name, const dvec3& center, const dvec3& to_light, double distance,
             double lux, const dvec3& up) {
  scene.lights.push_back({name, looking(center + distance * glm::normalize(to_light), center, up),
                          vec3(1.0f, 0.93f, 0.82f), lux, DirectionalLight{}});
}

void add_lamp(Scene& scene, const std::string& name, const dvec3& at, double candela) {
  scene.lights.push_back({name, moved(at), warm_white, candela, PointLight{}});
}

void add_spot(Scene& scene, const std::string& name, const dmat4& world_from_light, double inner, double outer,
              double candela) {
  scene.lights.push_back({name, world_from_light, warm_white, candela, SpotLight{0.0, degrees(inner), degrees(outer)}});
}

}  // namespace umbrameter::builtin
