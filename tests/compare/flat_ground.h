// Level ground seen straight from above, one surfel a pixel, for tests whose answer is counted in pixels.
#pragma once

#include "compare/visibility.h"

namespace umbrameter {

/// The pixel (x, y) lies at (x, 0, y) · pixel metres, of instance 0.
struct FlatGround {
  GBuffer gbuffer;
  CountedPixels counted;
  Light light;
  MapLayout layout;

  /// The light comes from `to_light`, its map has texels of that many metres.
  FlatGround(int width, int height, double pixel, const dvec3& to_light, double texel) : gbuffer(width, height) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        gbuffer.instance.at(x, y) = 0;
        gbuffer.triangle.at(x, y) = 0;
        gbuffer.position.at(x, y) = vec3(dvec3(x, 0, y) * pixel);
        gbuffer.geometric_normal.at(x, y) = vec3(0, 1, 0);
        gbuffer.shading_normal.at(x, y) = vec3(0, 1, 0);
      }
    }
    counted.exclusion = Image<PixelExclusion>(width, height, PixelExclusion::none);
    counted.totals[0] = gbuffer.instance.size();
    counted.mean_texel = texel;
    const dvec3 z = glm::normalize(to_light);
    const dvec3 x = glm::normalize(glm::cross(dvec3(0, 0, 1), z));
    light.world_from_light = dmat4(dvec4(x, 0), dvec4(glm::cross(z, x), 0), dvec4(z, 0), dvec4(0, 0, 0, 1));
    layout.kind = MapKind::orthographic;
    layout.resolution = 1000;
    layout.views.front().half_extent = 0.5 * texel * layout.resolution;
  }
};

/// Blocked from column `first` on, lit before it.
inline Image<float> blocked_from(const FlatGround& ground, int first) {
  Image<float> truth(ground.gbuffer.width, ground.gbuffer.height, 1.0f);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = first; x < truth.width; ++x) truth.at(x, y) = 0.0f;
  }
  return truth;
}

}  // namespace umbrameter
