#include "techniques/shadow/msm.h"

#include <array>

#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

Parameters describe(MsmParams& params) {
  static constexpr std::array<std::string_view, 2> bounds{"hamburger", "hausdorff"};
  return Description("shadow")
      .field("msm-moment-bias", params.moment_bias,
             {.unit = "1",
              .meaning = "MSM: how far each moment is blended towards ½, against rounding; about 6e-5 for unorm16",
              .min = 0,
              .max = 0.1})
      .choice("msm-bound", params.bound, bounds,
              {.unit = {}, .meaning = "MSM: hausdorff also uses that all depths lie within the map's range"})
      .take();
}

Msm::Text::Settings Msm::settings(const ShadowParams& params) {
  return {params.moment_map.format == MomentFormat::unorm16 ? 1 : 0, params.msm.bound == MomentBound::hausdorff ? 1 : 0,
          static_cast<float>(params.msm.moment_bias), static_cast<float>(params.moment_bound.bleeding_reduction)};
}

Parameters Msm::lookup_parameters(ShadowParams& params) {
  return concatenate({describe(params.msm), select(describe(params.moment_bound), {"shadow.bleeding-reduction"})});
}

}  // namespace umbrameter
