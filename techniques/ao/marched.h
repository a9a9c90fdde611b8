// Ray-marched SSAO: hemisphere rays through the depth buffer, pixel by pixel; an upper bound of what the depth buffer
// holds, not a real-time method. marched.glsl has the formulas, for the shader too.
#pragma once

#include <string_view>

#include "core/parameters.h"
#include "techniques/ao/blur.h"
#include "techniques/ao/noise.h"
#include "techniques/ao/parameters.h"
#include "techniques/ao/screen.h"

namespace umbrameter {
namespace shared {

struct MarchedMethod : AoScreen {
#include "techniques/ao/marched.glsl"
};

}  // namespace shared

enum class MarchedWeight : int { cosine, uniform };

/// Our choice.
struct MarchedParams {
  int steps = 1024;
  double thickness = 1.0;
  double bias = 1e-3;
  MarchedWeight weight = MarchedWeight::cosine;
};
Parameters describe(MarchedParams& params);

struct Marched {
  static constexpr std::string_view name = "ray-marched";
  static constexpr std::string_view title = "Ray-marched SSAO";
  static constexpr AoBlur denoiser = AoBlur::none;  ///< ours has no denoiser
  static constexpr std::string_view text = "marched.glsl";
  static constexpr std::string_view settings = "MarchedSettings";
  AoSamplingParams sampling;
  AoNoiseParams noise;
  MarchedParams params;
};

shared::MarchedMethod::MarchedSettings settings_of(const Marched& technique);

}  // namespace umbrameter
