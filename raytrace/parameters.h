// What the reference is set to: the truth.* parameters.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class AoWeight : int { cosine, uniform };

/// The truth.* parameters.
struct TruthParams {
  int spp = 256;
  AoWeight ao_weight = AoWeight::cosine;
  double ao_distance = 0.0;
};
Parameters describe(TruthParams& params);

}  // namespace umbrameter
