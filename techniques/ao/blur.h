// The blur that follows every AO technique.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

/// own: that of the technique's publication (blur_of() in technique.h replaces it).
enum class AoBlur : int { own, none, box, gaussian, bilateral, xegtao };

struct AoBlurParams {
  AoBlur kind = AoBlur::own;
  int size = 4;
  int passes = 1;
  double plane_distance = 0.05;
  double normal_exponent = 8.0;
};
Parameters describe(AoBlurParams& params);

/// The blur, not `own`, along one axis: `count` pixels, of which the first has the offset `first`, positive to the
/// right or down. The same taps apply to both axes. One tap does not blur. Pixels are clamped to the edge of the image.
struct AoBlurTaps {
  int first = 0;
  int count = 1;
};
/// An even number of taps of a box extends one pixel further to the left and up. A Gaussian is symmetric. The denoiser
/// of XeGTAO has 3 taps, whatever the size.
AoBlurTaps taps_of(const AoBlurParams& params);

/// Standard deviation of the Gaussian of a blur of this size, pixels: it is cut at twice that.
double deviation_of(const AoBlurParams& params);

/// Of a pixel itself in the last pass of the denoiser of XeGTAO, whose neighbours beside it weigh at most 1; earlier
/// passes divide it by 5.
inline constexpr double denoiser_center_weight = 1.2;

}  // namespace umbrameter
