// Variance shadow maps (VSM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {
struct VsmText {
#define SHARED static
#include "techniques/shadow/vsm.glsl"
#undef SHARED
};
}  // namespace shared

struct Vsm : FilteringTechnique<Vsm, shared::VsmText> {
  static constexpr std::string_view name = "vsm";
  static constexpr std::string_view text = "vsm.glsl";
  static constexpr int values = 2;
  static Text::Settings settings(const ShadowParams& params);
};

}  // namespace umbrameter
