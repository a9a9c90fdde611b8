#include "techniques/shadow/esm.h"

#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

Parameters describe(EsmParams& params) {
  return Description("shadow")
      .field("esm-exponent", params.exponent,
             // The exponential of the largest is still a 32-bit float, summed over the largest blur.
             {.unit = "1", .meaning = "ESM: exponent over the map's depth range", .min = 1, .max = 80})
      .field("esm-blur", params.blur,
             {.unit = "texels", .meaning = "ESM: side of the blur of the map", .min = 1, .max = 63, .odd = true})
      .take();
}

Esm::Text::Settings Esm::settings(const ShadowParams& params) { return {static_cast<float>(params.esm.exponent)}; }

Prefiltered Esm::make(const ShadowParams& params, double light_extent) {
  Prefiltered made = FilteringTechnique::make(params, light_extent);
  made.format = MomentFormat::f32;
  made.blur = blur_weights(params.moment_map.kernel, params.esm.blur);
  return made;
}

Parameters Esm::map_parameters(ShadowParams& params) {
  return concatenate({describe(params.esm), select(describe(params.moment_map), {"shadow.blur-kernel"}),
                      describe(params.map_sampling)});
}

Parameters Esm::lookup_parameters(ShadowParams&) { return {}; }

}  // namespace umbrameter
