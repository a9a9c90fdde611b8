// Hemisphere SSAO with a kernel in tangent space, noise rotation and range check (J. de Vries, Learn OpenGL, "SSAO";
// after Mittring, Finding Next Gen: CryEngine 2, 2007).
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/kernel.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"

namespace umbrameter {

struct SsaoParams {
  bool range_check = true;
};
Parameters describe(SsaoParams& params);

struct Ssao {
  static constexpr std::string_view name = "ssao";
  static constexpr std::string_view title = "SSAO";
  static constexpr AoBlur denoiser = AoBlur::box;  ///< 4×4, as in Learn OpenGL
  AoSamplingParams sampling;
  AoBiasParams bias;
  AoNoiseParams noise;
  SsaoParams params;
  AoKernelParams kernel;
};

/// What a sample of weight 1 adds to the occlusion.
inline float share_of_sample(int samples) { return 1.0f / static_cast<float>(samples); }

}  // namespace umbrameter
