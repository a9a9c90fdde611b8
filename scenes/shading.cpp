#include "scenes/shading.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "scenes/light.h"

namespace umbrameter {
namespace {

constexpr vec3 sky_color{0.72f, 0.80f, 0.90f};
constexpr vec3 ambient_tint{0.86f, 0.94f, 1.08f};
constexpr double ambient_share = 0.25;
constexpr double key_quantile = 0.9;

// KHR_lights_punctual, "Range Property".
double range_window(double distance, double range) {
  if (range <= 0.0) return 1.0;
  const double ratio = distance / range;
  return std::clamp(1.0 - ratio * ratio * ratio * ratio, 0.0, 1.0);
}

// KHR_lights_punctual, "Inner and Outer Cone Angles".
double cone_falloff(const SpotLight& spot, double cosine) {
  const double outer = std::cos(spot.outer_cone_angle);
  const double scale = 1.0 / std::max(0.001, std::cos(spot.inner_cone_angle) - outer);
  const double t = std::clamp((cosine - outer) * scale, 0.0, 1.0);
  return t * t;
}

// The illuminance that 90 % of the directly lit surfels stay below: one exposure for the whole picture.
double key_illuminance(std::vector<float>& sums) {
  std::erase_if(sums, [](float sum) { return !(sum > 0.0f); });
  if (sums.empty()) return 1.0;
  const auto key = sums.begin() + static_cast<std::ptrdiff_t>(key_quantile * static_cast<double>(sums.size() - 1));
  std::nth_element(sums.begin(), key, sums.end());
  return *key;
}

}  // namespace

double illuminance(const Light& light, const dvec3& position, const dvec3& normal) {
  const dvec3 direction = to_light(light, position);
  const double cosine = glm::dot(normal, direction);
  if (cosine <= 0.0) return 0.0;
  if (std::holds_alternative<DirectionalLight>(light.shape)) return light.intensity * cosine;
  const double distance = std::max(glm::length(light.position() - position), 1e-3);
  double candela = light.intensity;
  double range = 0.0;
  if (const auto* spot = std::get_if<SpotLight>(&light.shape)) {
    candela *= cone_falloff(*spot, glm::dot(light.axis(), -direction));
    range = spot->range;
  } else {
    range = std::get<PointLight>(light.shape).range;
  }
  return candela * cosine * range_window(distance, range) / (distance * distance);
}

Image<vec3> shade(const GBuffer& gbuffer, std::span<const LitBy> lights, const Image<float>* ao) {
  Image<vec3> direct(gbuffer.width, gbuffer.height, vec3(0));
  parallel_for(static_cast<std::size_t>(gbuffer.height), [&](std::size_t y) {
    for (int x = 0; x < gbuffer.width; ++x) {
      const std::size_t i = direct.index(x, static_cast<int>(y));
      if (!gbuffer.is_surface(i)) continue;
      for (const LitBy& lit : lights) {
        const double lux = illuminance(*lit.light, dvec3(gbuffer.position[i]), dvec3(gbuffer.shading_normal[i]));
        direct[i] += lit.light->color * static_cast<float>(lux) * (*lit.visibility)[i];
      }
    }
  });
  std::vector<float> sums;
  for (const vec3& e : direct.pixels) sums.push_back((e.x + e.y + e.z) / 3.0f);
  const auto key = static_cast<float>(key_illuminance(sums));
  Image<vec3> picture(gbuffer.width, gbuffer.height, sky_color);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (!gbuffer.is_surface(i)) continue;
    const float open = ao != nullptr ? (*ao)[i] : 1.0f;
    picture[i] = gbuffer.albedo[i] * (direct[i] / key + ambient_tint * (static_cast<float>(ambient_share) * open));
  }
  return picture;
}

}  // namespace umbrameter
