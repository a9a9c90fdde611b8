#include "scenes/light.h"

#include <cmath>

#include "scenes/fitted_camera.h"

namespace umbrameter {

std::string_view kind_of(const Light& light) {
  static constexpr std::string_view names[] = {"directional", "spot", "point"};
  return names[light.shape.index()];
}

dmat3 axes_of(const Light& light) {
  const dvec3 z = -light.axis();
  const dvec3 x = glm::normalize(glm::cross(dvec3(light.world_from_light[1]), z));
  return {x, glm::cross(z, x), z};
}

dvec4 homogeneous_position(const Light& light) {
  const bool is_directional = std::holds_alternative<DirectionalLight>(light.shape);
  return is_directional ? dvec4(to_light(light, dvec3(0.0)), 0.0) : dvec4(light.position(), 1.0);
}

dvec3 to_light(const Light& light, const dvec3& position) {
  if (std::holds_alternative<DirectionalLight>(light.shape)) return -light.axis();
  const dvec3 offset = light.position() - position;
  const double distance = glm::length(offset);
  return distance > 0.0 ? offset / distance : -light.axis();
}

Light default_sun() {
  Light light;
  light.name = "sun";
  light.world_from_light = frame_towards({0.45, 1.0, 0.35}, dvec3(0));
  light.intensity = 1e5;
  return light;
}

bool faces(const Light& light, const dvec3& position, const dvec3& normal) {
  // How far the light's rim rises above its middle, along the normal.
  struct Rise {
    dvec3 along;  // x, y and z of the light
    double operator()(const std::monostate&) const { return 0.0; }
    double operator()(const SphereEmitter& sphere) const { return sphere.radius; }
    double operator()(const DiskEmitter& disk) const { return disk.radius * std::hypot(along.x, along.y); }
    double operator()(const RectangleEmitter& rectangle) const {
      return 0.5 * (rectangle.width * std::abs(along.x) + rectangle.height * std::abs(along.y));
    }
    double operator()(const DistantEmitter& distant) const {
      return std::tan(0.5 * distant.angular_diameter) * std::hypot(along.x, along.y);
    }
  };
  const double cosine = glm::dot(normal, to_light(light, position));
  if (std::holds_alternative<std::monostate>(light.emitter)) return cosine > 0.0;
  const bool is_distant = std::holds_alternative<DirectionalLight>(light.shape);
  const double distance = is_distant ? 1.0 : glm::length(light.position() - position);
  return cosine * distance + std::visit(Rise{glm::transpose(axes_of(light)) * normal}, light.emitter) > 0.0;
}

}  // namespace umbrameter
