// Moment shadow maps (MSM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {
struct MsmText {
#define SHARED static
#include "techniques/shadow/msm.glsl"
#undef SHARED
};
}  // namespace shared

enum class MomentBound : int { hamburger, hausdorff };

struct MsmParams {
  double moment_bias = 1e-5;
  MomentBound bound = MomentBound::hamburger;
};
Parameters describe(MsmParams& params);

struct Msm : FilteringTechnique<Msm, shared::MsmText> {
  static constexpr std::string_view name = "msm";
  static constexpr std::string_view text = "msm.glsl";
  static constexpr int values = 4;
  static Text::Settings settings(const ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
