#include "techniques/ao/parameters.h"

#include <array>
#include <string_view>

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 2> ao_blur_names{"none", "box"};

}  // namespace

Parameters describe(AoParams& params) {
  return Description("ao")
      .field("samples", params.samples,
             {.unit = "1", .meaning = "samples per pixel", .min = 1, .max = 1024, .basic = true})
      .field("radius", params.radius,
             {.unit = "m",
              .meaning = "radius of the sampled hemisphere",
              .min = 1e-6,
              .units = {.scene_size = true},
              .basic = true})
      .field(
          "bias", params.bias,
          {.unit = "m", .meaning = "min depth difference between occluder and sample", .units = {.scene_size = true}})
      .field("noise-size", params.noise_size,
             {.unit = "px", .meaning = "side of the tile of random rotations", .min = 1, .max = 64})
      .field("range-check", params.range_check,
             {.unit = {}, .meaning = "fade out occluders much farther away than the radius"})
      .choice("blur", params.blur, ao_blur_names, {.unit = {}, .meaning = "blur of the result", .basic = true})
      .field("blur-size", params.blur_size, {.unit = "px", .meaning = "width of the blur", .min = 1, .max = 32})
      .take();
}

AoParams in_metres(AoParams params, double scene_size) {
  params.radius = to_metres(params.radius, scene_size);
  params.bias = to_metres(params.bias, scene_size);
  return params;
}

}  // namespace umbrameter
