// Variance shadow maps (VSM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {

struct VsmText {
#define SHARED static
#define UNUSED [[maybe_unused]]
#include "techniques/shadow/vsm.glsl"
#undef SHARED
#undef UNUSED
};

}  // namespace shared

struct Vsm {
  static constexpr std::string_view name = "vsm";
  using Text = shared::VsmText;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
