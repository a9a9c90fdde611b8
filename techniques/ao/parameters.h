// Parameters that several AO techniques read. technique.h combines them into the ao.* parameters.
#pragma once

#include "core/parameters.h"

namespace umbrameter {

/// How far and how often a technique looks for occluders.
struct AoSamplingParams {
  int samples = 64;
  Length radius{2.0, LengthUnit::scene_percent};
};
Parameters describe(AoSamplingParams& params);

enum class AoSliceSpacing : int { image, angle };

/// Techniques that search planes through the direction to the viewer. The numbers are those of XeGTAO, quality "High".
struct AoSliceParams {
  int slices = 3;
  int steps = 3;
  AoSliceSpacing spacing = AoSliceSpacing::image;
};
Parameters describe(AoSliceParams& params);

/// Bias of techniques that compare depths.
struct AoBiasParams {
  Length depth{0.1, LengthUnit::scene_percent};  ///< 1/20 of the radius, as in Learn OpenGL, "SSAO"
};
Parameters describe(AoBiasParams& params);

}  // namespace umbrameter
