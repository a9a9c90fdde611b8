// Ground-truth ambient occlusion: cosine-weighted, analytic between the horizons of slices (Jimenez et al. 2016).
// gtao.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"

namespace umbrameter {
namespace shared {

struct GtaoMethod : AoScreen {
#include "techniques/ao/gtao.glsl"
};

}  // namespace shared

/// The defaults are those of Intel's XeGTAO, quality "High".
struct GtaoParams {
  double radius_multiplier = 1.457;
  double falloff_range = 0.615;
  double distribution = 2.0;
  double thin_compensation = 0.0;
  double power = 2.2;
};
Parameters describe(GtaoParams& params);

struct Gtao {
  static constexpr std::string_view name = "gtao";
  static constexpr std::string_view title = "GTAO";
  static constexpr AoBlur denoiser = AoBlur::xegtao;
  static constexpr std::string_view text = "gtao.glsl";
  static constexpr std::string_view settings = "GtaoSettings";
  static constexpr bool reads_samples = false;
  static constexpr bool has_bent_normal = true;
  AoSamplingParams sampling;
  AoNoiseParams noise;
  AoSliceParams slices;
  GtaoParams params;
};

shared::GtaoMethod::GtaoSettings settings_of(const Gtao& technique);

}  // namespace umbrameter
