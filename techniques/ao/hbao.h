// Horizon-based ambient occlusion, uniform weight (Bavoil, Sainz and Dimitrov 2008).
// hbao.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"

namespace umbrameter {
namespace shared {

struct HbaoMethod : AoScreen {
#include "techniques/ao/hbao.glsl"
};

}  // namespace shared

/// The numbers are our choice.
struct HbaoParams {
  int directions = 6;
  int steps = 6;
  double tangent_bias = 5.0;
  double intensity = 1.0;
  bool jitter = true;
};
Parameters describe(HbaoParams& params);

struct Hbao {
  static constexpr std::string_view name = "hbao";
  static constexpr std::string_view title = "HBAO";
  static constexpr AoBlur denoiser = AoBlur::bilateral;  ///< NVIDIA's sample: 7 taps along each axis, by depth
  static constexpr std::string_view text = "hbao.glsl";
  static constexpr std::string_view settings = "HbaoSettings";
  static constexpr bool reads_samples = false;
  AoSamplingParams sampling;
  AoNoiseParams noise;
  HbaoParams params;
};

shared::HbaoMethod::HbaoSettings settings_of(const Hbao& technique);

}  // namespace umbrameter
