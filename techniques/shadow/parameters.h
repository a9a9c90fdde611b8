// The shadow.* parameters: what a shadow-map technique is set to.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class ShadowFilter : int { nearest, bilinear, box, tent, gaussian, poisson };
enum class FilterTaps : int { nearest, linear };

/// The shadow.* parameters. A tap is lit exactly when constant_bias ≥ β − slope_bias · m, with the critical bias
/// β = receiver depth − stored depth and m = texel size at the receiver · tan θ, all in metres. A constant bias in
/// texels is multiplied by the texel size at the receiver.
struct ShadowParams {
  int resolution = 1024;
  Length constant_bias{1.5, LengthUnit::texels};
  double slope_bias = 0.0;
  double normal_offset = 0.0;
  ShadowFilter filter = ShadowFilter::nearest;
  int filter_size = 3;
  FilterTaps filter_taps = FilterTaps::nearest;
  int filter_samples = 16;
  double filter_radius = 2.0;
};
Parameters describe(ShadowParams& params);

}  // namespace umbrameter
