// The resolution at which an AO technique and its blur run, and the upsampling that follows a lower one.
#pragma once

#include "core/math.h"
#include "core/parameters.h"

namespace umbrameter {

enum class AoResolution : int { full, half };

struct AoResolutionParams {
  AoResolution kind = AoResolution::full;
  double plane_distance = 0.05;
  double normal_exponent = 8.0;
};
Parameters describe(AoResolutionParams& params);

/// Pixels of the AO image of a view of that size, before upsampling.
ivec2 ao_image_size(AoResolution resolution, const ivec2& view_size);

}  // namespace umbrameter
