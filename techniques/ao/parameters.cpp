#include "techniques/ao/parameters.h"

namespace umbrameter {

Parameters describe(AoSamplingParams& params) {
  return Description("ao")
      .field("samples", params.samples,
             {.unit = "1", .meaning = "samples per pixel", .min = 1, .max = 1024, .basic = true})
      .field("radius", params.radius,
             {.unit = "m",
              .meaning = "radius of the sampled hemisphere",
              .min = 1e-6,
              .units = {.scene_size = true},
              .basic = true})
      .take();
}

Parameters describe(AoBiasParams& params) {
  return Description("ao")
      .field(
          "bias", params.depth,
          {.unit = "m", .meaning = "min depth difference between occluder and sample", .units = {.scene_size = true}})
      .take();
}

}  // namespace umbrameter
