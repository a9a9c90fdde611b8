// Exponential shadow maps (ESM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {
struct EsmText {
#define SHARED static
#include "techniques/shadow/esm.glsl"
#undef SHARED
};
}  // namespace shared

struct EsmParams {
  double exponent = 40.0;
  int blur = 5;
};
Parameters describe(EsmParams& params);

struct Esm : FilteringTechnique<Esm, shared::EsmText> {
  static constexpr std::string_view name = "esm";
  static constexpr std::string_view text = "esm.glsl";
  static constexpr int values = 1;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
