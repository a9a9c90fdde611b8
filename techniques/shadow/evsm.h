// Exponential variance shadow maps: EVSM2 with one warp of the depth, EVSM4 with a second one.
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {

struct EvsmText {
#define SHARED static
#define UNUSED [[maybe_unused]]
#include "techniques/shadow/evsm.glsl"
#undef SHARED
#undef UNUSED
};

}  // namespace shared

struct EvsmParams {
  double positive_exponent = 40.0;
  double negative_exponent = 5.0;
};
Parameters describe(EvsmParams& params);

struct Evsm2 {
  static constexpr std::string_view name = "evsm2";
  using Text = shared::EvsmText;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

struct Evsm4 {
  static constexpr std::string_view name = "evsm4";
  using Text = shared::EvsmText;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
