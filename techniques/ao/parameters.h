// Parameters of the ambient-occlusion technique (ao.*).
#pragma once

#include "core/parameters.h"

namespace umbrameter {

enum class AoBlur : int { none, box };

/// Hemisphere SSAO with a kernel in tangent space, noise rotation and range check
/// (J. de Vries, Learn OpenGL, "SSAO"; after Crytek 2007).
struct AoParams {
  int samples = 64;
  Length radius{2.0, LengthUnit::scene_percent};
  Length bias{0.1, LengthUnit::scene_percent};  ///< 1/20 of the radius, as in the source
  int noise_size = 4;
  bool range_check = true;
  AoBlur blur = AoBlur::box;
  int blur_size = 4;
};
Parameters describe(AoParams& params);

/// Converts all lengths to metres, as draw_ao() expects. scene_size is the diagonal of the scene's bounds, metres.
AoParams in_metres(AoParams params, double scene_size);

}  // namespace umbrameter
