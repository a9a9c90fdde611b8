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

/// The pixel of the view whose surfel a pixel of the AO image shows; rows count from the top. At half resolution it is
/// the top left one of each block of 2×2, the only one that every block has where a side of the view is odd.
ivec2 surfel_pixel(AoResolution resolution, const ivec2& ao_pixel);

}  // namespace umbrameter
