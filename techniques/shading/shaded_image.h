// The shaded image that a technique draws.
#pragma once

#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "techniques/shading/light_volume.h"

namespace umbrameter {

struct ShadedImage {
  Image<vec3> radiance;      ///< linear, without exposure; 0 on the background
  Image<vec3> light_buffer;  ///< deferred path only: the sum over the lights, without ambient light
  /// Deferred path only: one per light; zeros for a light that is drawn over the whole image.
  std::vector<LightCounters> counters;
};

}  // namespace umbrameter
