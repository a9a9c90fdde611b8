// What the techniques under test are set to: the shadow.* and ao.* parameters.
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

enum class AoBlur : int { none, box };

/// The ao.* parameters: hemisphere SSAO with a kernel in tangent space, noise rotation and range check
/// (J. de Vries, Learn OpenGL, "SSAO"; after Crytek 2007).
struct AoParams {
  int samples = 64;
  Length radius{2.0, LengthUnit::scene_percent};
  Length bias{0.1, LengthUnit::scene_percent};  ///< a twentieth of the radius, as in the source
  int noise_size = 4;
  bool range_check = true;
  AoBlur blur = AoBlur::box;
  int blur_size = 4;
};
Parameters describe(AoParams& params);

/// With lengths in metres, as draw_ao() takes them. scene_size is the diagonal of the scene's bounds, metres.
AoParams in_metres(AoParams params, double scene_size);

}  // namespace umbrameter
