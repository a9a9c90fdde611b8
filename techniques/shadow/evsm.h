// Exponential variance shadow maps: EVSM2 with one warp of the depth, EVSM4 with a second one.
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {
struct EvsmText {
#define SHARED static
#include "techniques/shadow/evsm.glsl"
#undef SHARED
};
}  // namespace shared

struct EvsmParams {
  double positive_exponent = 40.0;
  double negative_exponent = 5.0;
};
Parameters describe(EvsmParams& params);

/// Of two values for each warp.
template <int values_of_warps>
struct Evsm : FilteringTechnique<Evsm<values_of_warps>, shared::EvsmText> {
  static constexpr std::string_view name = values_of_warps == 2 ? "evsm2" : "evsm4";
  static constexpr std::string_view text = "evsm.glsl";
  static constexpr int values = values_of_warps;
  static shared::EvsmText::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
};
using Evsm2 = Evsm<2>;
using Evsm4 = Evsm<4>;

}  // namespace umbrameter
