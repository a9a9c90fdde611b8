// Many small lights for deferred shading, in place of the courtyard's own.
#include <algorithm>
#include <cmath>

#include "scenes/builtin/placing.h"
#include "scenes/builtin/scenes.h"

namespace umbrameter::builtin {
namespace {

struct Zone {
  double share;  // of the lights
  dvec3 low, high;
};

// In the court, under the arcade, on the terrace, and before the fronts and the roof of the arcade.
constexpr Zone zones[] = {{0.60, {-6.8, 0.3, -5.2}, {7.0, 3.0, 8.2}},
                          {0.15, {-6.8, 0.5, -8.9}, {7.0, 3.4, -6.2}},
                          {0.15, {-10.8, 1.7, -4.8}, {-7.2, 4.2, 6.0}},
                          {0.10, {-10.8, 3.4, -5.6}, {7.0, 6.0, -4.6}}};

dvec3 place_in(const Zone& zone, std::uint32_t seed) {
  return {chance(seed, 1, zone.low.x, zone.high.x), chance(seed, 2, zone.low.y, zone.high.y),
          chance(seed, 3, zone.low.z, zone.high.z)};
}

dvec3 chosen_place(std::uint32_t seed) {
  double left = chance(seed, 0);
  for (const Zone& zone : zones) {
    if (left < zone.share) return place_in(zone, seed);
    left -= zone.share;
  }
  return place_in(zones[0], seed);
}

// A hue of 0 to 6 with a tenth to a half of white, the largest component 1.
vec3 tint(std::uint32_t seed) {
  const double hue = chance(seed, 4, 0.0, 6.0);
  const double white = chance(seed, 5, 0.1, 0.5);
  vec3 color(0.0f);
  for (int i = 0; i < 3; ++i) {
    const double pure = std::clamp(std::abs(std::fmod(hue + 2.0 * i, 6.0) - 3.0) - 1.0, 0.0, 1.0);
    color[i] = static_cast<float>(white + (1.0 - white) * pure);
  }
  return color;
}

}  // namespace

std::vector<Light> small_lights(std::uint64_t number) {
  std::vector<Light> lights;
  for (std::uint32_t i = 0; i < number; ++i) {
    const std::uint32_t seed = hash(71, i);
    const bool is_spot = i % 2 == 1;
    double range = chance(seed, 6, 1.5, 4.0);
    dvec3 eye = chosen_place(seed);
    const double angle = chance(seed, 7, 0.0, 2.0 * pi);
    const double tilt = chance(seed, 8, 0.1, 1.2);  // from straight down
    dvec3 axis(std::sin(tilt) * std::cos(angle), -std::cos(tilt), std::sin(tilt) * std::sin(angle));
    double outer = chance(seed, 9, 15.0, 40.0);
    if (i == 0) {  // between the camera "overview" and the corner of the fence: it holds both
      eye = dvec3(5.6, 3.4, 10.7);
      range = 4.0;
    } else if (i == 1) {  // the camera "arcade" is inside of its cone
      eye = dvec3(6.6, 3.0, -7.9);
      axis = glm::normalize(dvec3(-0.6, -1.9, 0.25));
      outer = 40.0;
      range = 4.0;
    }
    Light light{(is_spot ? "spot " : "point ") + std::to_string(i), looking(eye, eye + axis), tint(seed),
                0.5 * range * range, PointLight{range}};
    if (is_spot) light.shape = SpotLight{range, degrees(0.6 * outer), degrees(outer)};
    lights.push_back(light);
  }
  return lights;
}

}  // namespace umbrameter::builtin
