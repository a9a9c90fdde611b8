#include "techniques/shadow/vsm.h"

#include "techniques/shadow/technique.h"

namespace umbrameter {

Vsm::Text::Settings Vsm::settings(const ShadowParams& params) {
  return {static_cast<float>(params.moment_bound.min_variance),
          static_cast<float>(params.moment_bound.bleeding_reduction)};
}

}  // namespace umbrameter
