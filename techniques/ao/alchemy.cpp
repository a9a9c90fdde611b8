#include "techniques/ao/alchemy.h"

#include <array>

namespace umbrameter {

Parameters describe(AlchemyParams& params) {
  static constexpr std::array<std::string_view, 2> estimators{"alchemy", "sao"};
  return Description("ao")
      .choice("alchemy-estimator", params.estimator, estimators,
              {.unit = {}, .meaning = "Alchemy AO: estimator of 2011, or that of Scalable Ambient Obscurance, 2012"})
      .field("alchemy-turns", params.turns,
             {.unit = "1", .meaning = "Alchemy AO: turns of the spiral of samples", .min = 1, .max = 1024})
      .field("alchemy-bias", params.bias,
             {.unit = "ao.radius", .meaning = "Alchemy AO: height above the tangent plane that does not occlude"})
      .field("alchemy-intensity", params.intensity,
             {.unit = "1", .meaning = "Alchemy AO: factor on the occlusion", .min = 0.0})
      .field("alchemy-mip-chain", params.mip_chain,
             {.unit = {}, .meaning = "Alchemy AO: far samples read a depth pyramid, as in Scalable Ambient Obscurance"})
      .field("alchemy-mip-offset", params.mip_offset,
             {.unit = "1",
              .meaning = "Alchemy AO: a sample p pixels away reads level floor(log2(p)) less this",
              .min = 0,
              .max = 16})
      .field("alchemy-mip-levels", params.mip_levels,
             {.unit = "1",
              .meaning = "Alchemy AO: levels of the depth pyramid beyond the depth buffer",
              .min = 1,
              .max = 14})
      .take();
}

shared::AlchemyMethod::AlchemySettings settings_of(const Alchemy& technique) {
  const AlchemyParams& params = technique.params;
  const double radius = technique.sampling.radius.number;
  return {technique.sampling.samples,
          params.turns,
          static_cast<float>(radius),
          static_cast<float>(params.bias * radius),
          static_cast<float>(params.intensity),
          params.estimator == AlchemyEstimator::sao ? 1 : 0,
          params.mip_chain ? params.mip_levels : 0,
          params.mip_offset};
}

}  // namespace umbrameter
