// The blur that follows every AO technique.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class AoBlur : int { none, box };

struct AoBlurParams {
  AoBlur kind = AoBlur::box;
  int size = 4;
};
Parameters describe(AoBlurParams& params);

/// The blur along one axis: the mean of `count` pixels, of which the first has the offset `first`, positive to the
/// right or down. The same taps apply to both axes. One tap does not blur. Pixels are clamped to the edge of the image.
struct AoBlurTaps {
  int first = 0;
  int count = 1;
};
/// An even number of taps extends one pixel further to the left and up.
AoBlurTaps taps_of(const AoBlurParams& params);

}  // namespace umbrameter
