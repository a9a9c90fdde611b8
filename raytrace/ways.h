// Rays from surfels to a light's place. For raytrace/*.cpp alone.
#pragma once

#include <limits>

#include "raytrace/packet.h"
#include "raytrace/surfel.h"
#include "raytrace/vectors.h"
#include "scenes/light.h"

namespace umbrameter {

UMBRAMETER_IN_VECTORS bool is_turned(const vec3& normal, const dvec3& way) {
  return glm::dot(dvec3(normal), way) > 0.0;
}

/// The ways from surfels to a light without extent, or to the middle of one with.
class Ways {
 public:
  explicit Ways(const Light& light)
      : is_distant_(std::holds_alternative<DirectionalLight>(light.shape)),
        position_(light.position()),
        to_distant_(-light.axis()),
        light_(light) {}

  bool is_distant() const { return is_distant_; }
  /// Unit, to a distant light.
  const dvec3& to_distant() const { return to_distant_; }

  /// Whether the surfel is turned to the light: what faces() tells without extent. Asking that of every surfel finds
  /// the way to a distant light anew, which is a tenth of all time in simple scenes.
  bool begin_at(const GBuffer& gbuffer, std::size_t pixel) const {
    const dvec3 way = is_distant_ ? to_distant_ : to_light(light_, dvec3(gbuffer.position[pixel]));
    return is_turned(gbuffer.geometric_normal[pixel], way);
  }

  UMBRAMETER_IN_VECTORS ShadowRay from(const RayOrigin& origin) const {
    ShadowRay ray;
    ray.origin = vec3(origin.point);
    if (is_distant_) {
      ray.direction = vec3(to_distant_);
      ray.reach = std::numeric_limits<float>::infinity();
    } else {
      const dvec3 way = position_ - dvec3(ray.origin);
      const double distance = glm::length(way);
      if (!(distance > 0.0)) return ray;  // the light is at the surfel: nothing lies between
      ray.direction = vec3(way / distance);
      ray.reach = reach_to_light(distance);
    }
    ray.is_clear = is_clear(origin.normal, origin.clear_cosine, ray.direction);
    return ray;
  }

 private:
  bool is_distant_;
  dvec3 position_;
  dvec3 to_distant_;
  const Light& light_;
};

}  // namespace umbrameter
