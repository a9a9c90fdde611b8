#include "techniques/ao/parameters.h"

#include <array>

namespace umbrameter {

Parameters describe(AoSamplingParams& params) {
  return Description("ao")
      .field("samples", params.samples,
             {.unit = "1",
              .meaning = "samples per pixel; not of HBAO, GTAO and the bitmask",
              .min = 1,
              .max = 1024,
              .basic = true})
      .field("radius", params.radius,
             {.unit = "m",
              .meaning = "radius of the sampled hemisphere",
              .min = 1e-6,
              .units = {.scene_size = true},
              .basic = true})
      .take();
}

Parameters describe(AoSliceParams& params) {
  static constexpr std::array<std::string_view, 2> spacings{"image", "angle"};
  return Description("ao")
      .field("slices", params.slices,
             {.unit = "1", .meaning = "GTAO and bitmask: slices per pixel", .min = 1, .max = 256})
      .field("steps", params.steps,
             {.unit = "1", .meaning = "GTAO and bitmask: samples on each side of a slice", .min = 1, .max = 1024})
      .choice("slice-spacing", params.spacing, spacings,
              {.unit = {}, .meaning = "slices are even in the image, or in angle about the direction to the viewer"})
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
