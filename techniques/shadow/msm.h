// Moment shadow maps (MSM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {

struct MsmText {
#define SHARED static
#define UNUSED [[maybe_unused]]
#include "techniques/shadow/msm.glsl"
#undef SHARED
#undef UNUSED
};

}  // namespace shared

enum class MomentBound : int { hamburger, hausdorff };

struct MsmParams {
  double moment_bias = 1e-5;
  MomentBound bound = MomentBound::hamburger;
};
Parameters describe(MsmParams& params);

struct Msm {
  static constexpr std::string_view name = "msm";
  using Text = shared::MsmText;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
