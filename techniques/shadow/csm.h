// Convolution shadow maps (CSM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {
struct CsmText {
#define SHARED static
#include "techniques/shadow/csm.glsl"
#undef SHARED
};
}  // namespace shared

struct CsmMapParams {
  int terms = 16;
};
Parameters describe(CsmMapParams& params);

struct CsmLookupParams {
  double ringing_reduction = 1.0;
  double contrast = 2.0;
};
Parameters describe(CsmLookupParams& params);

struct Csm : FilteringTechnique<Csm, shared::CsmText> {
  static constexpr std::string_view name = "csm";
  static constexpr std::string_view text = "csm.glsl";
  static constexpr int values = 4;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
