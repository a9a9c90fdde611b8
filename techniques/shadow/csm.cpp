#include "techniques/shadow/csm.h"

#include <string>

#include "techniques/shadow/technique.h"

namespace umbrameter {

Parameters describe(CsmMapParams& params) {
  return Description("shadow")
      .field("csm-terms", params.terms,
             {.unit = "1", .meaning = "CSM: terms of the Fourier series, two to a layer", .min = 1, .max = 16})
      .take();
}

Parameters describe(CsmLookupParams& params) {
  return Description("shadow")
      .field(
          "csm-ringing-reduction", params.ringing_reduction,
          {.unit = "1", .meaning = "CSM: a in the weight exp(−a·(k/M)²) of the k-th of M terms", .min = 0, .max = 10})
      .field("csm-contrast", params.contrast,
             {.unit = "1",
              .meaning = "CSM: factor of the visibility that the series gives, which is ½ at the occluder's depth",
              .min = 1,
              .max = 10})
      .take();
}

Csm::Text::Settings Csm::settings(const ShadowParams& params) {
  return {params.csm_map.terms, params.moment_map.format == MomentFormat::unorm16 ? 1 : 0,
          static_cast<float>(params.csm_lookup.ringing_reduction), static_cast<float>(params.csm_lookup.contrast)};
}

Prefiltered Csm::make(const ShadowParams& params, double light_extent) {
  Prefiltered made = FilteringTechnique::make(params, light_extent);
  made.constants = "settings.terms = " + std::to_string(params.csm_map.terms) + ";";
  made.groups = (params.csm_map.terms + 1) / 2;
  return made;
}

Parameters Csm::map_parameters(ShadowParams& params) {
  return concatenate({FilteringTechnique::map_parameters(params), describe(params.csm_map)});
}

Parameters Csm::lookup_parameters(ShadowParams& params) { return describe(params.csm_lookup); }

}  // namespace umbrameter
