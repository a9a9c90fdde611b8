// The original SSAO: points in the full sphere, no normal (Mittring 2007). An open plane gives 0.5.
// crytek.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"
#include "techniques/ao/ssao.h"

namespace umbrameter {
namespace shared {

struct CrytekMethod : AoScreen {
#include "techniques/ao/crytek.glsl"
};

}  // namespace shared

struct Crytek {
  static constexpr std::string_view name = "crytek";
  static constexpr std::string_view title = "Full-sphere SSAO";
  static constexpr AoBlur denoiser = AoBlur::bilateral;  ///< described with a blur that keeps depth edges
  static constexpr std::string_view text = "crytek.glsl";
  static constexpr std::string_view settings = "CrytekSettings";
  AoSamplingParams sampling;
  AoBiasParams bias;
  AoNoiseParams noise;
  SsaoParams range;
};

shared::CrytekMethod::CrytekSettings settings_of(const Crytek& technique);

}  // namespace umbrameter
