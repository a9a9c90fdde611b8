#include "techniques/ao/gtao.h"

namespace umbrameter {

Parameters describe(GtaoParams& params) {
  return Description("ao")
      .field("gtao-radius-multiplier", params.radius_multiplier,
             {.unit = "ao.radius", .meaning = "GTAO: radius at which the falloff ends", .min = 1e-3})
      .field("gtao-falloff", params.falloff_range,
             {.unit = "1",
              .meaning = "GTAO: last part of the radius, over which occluders fade out",
              .min = 0.0,
              .max = 1.0})
      .field("gtao-distribution", params.distribution,
             {.unit = "1", .meaning = "GTAO: exponent of the steps' distances", .min = 0.1, .max = 10.0})
      .field("gtao-thin-compensation", params.thin_compensation,
             {.unit = "1",
              .meaning = "GTAO: the falloff multiplies depth differences by 1 + this: thin occluders fade sooner",
              .min = 0.0,
              .max = 100.0})
      .field("gtao-power", params.power,
             {.unit = "1", .meaning = "GTAO: exponent of the result", .min = 0.1, .max = 10.0})
      .take();
}

shared::GtaoMethod::GtaoSettings settings_of(const Gtao& technique) {
  const GtaoParams& params = technique.params;
  return {technique.slices.slices,
          technique.slices.steps,
          static_cast<float>(technique.sampling.radius.number * params.radius_multiplier),
          static_cast<float>(params.falloff_range),
          static_cast<float>(params.distribution),
          static_cast<float>(params.thin_compensation),
          static_cast<float>(params.power),
          technique.slices.spacing == AoSliceSpacing::angle ? 1 : 0};
}

}  // namespace umbrameter
