// Exponential shadow maps: visibility from the filtered exponential of the stored depth. (T. Annen, T. Mertens, H.-P.
// Seidel, E. Flerackers and J. Kautz, Exponential Shadow Maps, Graphics Interface 2008.)
#pragma once

#include "core/parameters.h"
#include "techniques/shadow/capabilities.h"

namespace umbrameter {

struct EsmParams {
  double exponent = 40.0;
  int blur = 5;
};
Parameters describe(EsmParams& params);

/// The filtered map holds the mean of exp(c·z) over a box of texels, where z is the stored depth divided by far_depth.
/// Visibility at depth d is min(1, exp(−c·d)·mean). Where all z ≤ d, this approximates a filtered depth comparison.
struct Esm {
  static constexpr TechniqueCapabilities capabilities{};
  EsmParams params;
};

}  // namespace umbrameter
