// Convolution shadow maps (CSM).
#pragma once

#include "techniques/shadow/prefiltered.h"

namespace umbrameter {
namespace shared {

struct CsmText {
#define SHARED static
#define UNUSED [[maybe_unused]]
#include "techniques/shadow/csm.glsl"
#undef SHARED
#undef UNUSED
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

struct Csm {
  static constexpr std::string_view name = "csm";
  using Text = shared::CsmText;
  static Text::Settings settings(const ShadowParams& params);
  static Prefiltered make(const ShadowParams& params, double light_extent);
  static Parameters map_parameters(ShadowParams& params);
  static Parameters lookup_parameters(ShadowParams& params);
};

}  // namespace umbrameter
