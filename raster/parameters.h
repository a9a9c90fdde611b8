// What the techniques under test are set to: the shadow.* and ao.* parameters.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class ShadowFilter : int { nearest, bilinear, box, tent, gaussian, poisson };
enum class FilterTaps : int { nearest, linear };

/// The shadow.* parameters. A tap is lit exactly when constant_bias ≥ β − slope_bias · m, with the critical bias
/// β = receiver depth − stored depth and m = texel size at the receiver · tan θ, all in metres.
struct ShadowParams {
  int resolution = 1024;
  double constant_bias = 0.02;
  double slope_bias = 0.0;
  double normal_offset = 0.0;
  ShadowFilter filter = ShadowFilter::nearest;
  int filter_size = 3;
  FilterTaps filter_taps = FilterTaps::nearest;
  int filter_samples = 16;
  double filter_radius = 2.0;
};
Parameters describe(ShadowParams& params);

enum class AoBlur : int { none, box };

/// The ao.* parameters: hemisphere SSAO with a kernel in tangent space, noise rotation and range check
/// (J. de Vries, Learn OpenGL, "SSAO"; after Crytek 2007).
struct AoParams {
  int samples = 64;
  double radius = 0.5;
  double bias = 0.025;
  int noise_size = 4;
  bool range_check = true;
  AoBlur blur = AoBlur::box;
  int blur_size = 4;
};
Parameters describe(AoParams& params);

}  // namespace umbrameter
