#include "techniques/shadow/vsm.h"

#include "techniques/shadow/technique.h"

namespace umbrameter {

Vsm::Text::Settings Vsm::settings(const ShadowParams& params) {
  return {static_cast<float>(params.moment_bound.min_variance),
          static_cast<float>(params.moment_bound.bleeding_reduction)};
}

Prefiltered Vsm::make(const ShadowParams& params, double) {
  return make_prefiltered(params, "vsm.glsl", bytes_of(settings(params)), 2);
}

Parameters Vsm::map_parameters(ShadowParams& params) { return moment_map_parameters(params); }

Parameters Vsm::lookup_parameters(ShadowParams& params) { return describe(params.moment_bound); }

}  // namespace umbrameter
