// Parameters of shadow maps, bias and PCF. technique.h combines them into the shadow.* parameters.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class ShadowFilter : int { nearest, bilinear, box, tent, gaussian, poisson, vogel };
enum class FilterTaps : int { nearest, linear };

/// The shadow map itself.
struct ShadowMapParams {
  int resolution = 1024;
  int cascades = 1;
};
Parameters describe(ShadowMapParams& params);

/// A tap is lit if and only if constant ≥ β − slope · m, where β = receiver depth − stored depth is the critical bias
/// and m = texel size at the receiver · tan θ; all in metres. A constant bias in texels is multiplied by the texel size
/// at the receiver.
struct BiasParams {
  Length constant{1.5, LengthUnit::texels};
  double slope = 0.0;
  double normal_offset = 0.0;
};
Parameters describe(BiasParams& params);

/// Percentage-closer filtering.
struct PcfParams {
  ShadowFilter filter = ShadowFilter::nearest;
  int size = 3;
  FilterTaps taps = FilterTaps::nearest;
  int samples = 16;
  double radius = 2.0;
};
Parameters describe(PcfParams& params);

}  // namespace umbrameter
