// Screen-space shadows (contact shadows): a march through the camera's depth buffer towards the light.
#pragma once

#include <string_view>

#include "core/math.h"
#include "core/parameters.h"
#include "techniques/shadow/capabilities.h"

namespace umbrameter {
struct ShadowParams;

namespace shared {

using glm::fract;

#define SHARED inline
#include "techniques/shadow/screen_space.glsl"
#undef SHARED

}  // namespace shared

/// The defaults of length and steps are those of Filament's LightManager::ShadowOptions.
struct ScreenSpaceParams {
  bool is_combined = false;
  double length = 0.3;
  int steps = 8;
  double thickness = 0.1;
  double bias = 0.002;
  bool jitter = true;
  bool plane = true;
};
Parameters describe(ScreenSpaceParams& params);

struct ScreenSpace {
  static constexpr std::string_view name = "screen-space";
  static constexpr TechniqueCapabilities capabilities{};
  static ScreenSpace make(const ShadowParams& params, double light_extent);
  static Parameters reads(ShadowParams& params);
  shared::MarchSettings march;
};

}  // namespace umbrameter
