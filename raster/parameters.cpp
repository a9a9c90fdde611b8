#include "raster/parameters.h"

#include <array>
#include <string_view>

#include "core/shadow_taps.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 6> shadow_filter_names{"nearest", "bilinear", "box",
                                                              "tent",    "gaussian", "poisson"};
constexpr std::array<std::string_view, 2> filter_taps_names{"nearest", "linear"};
constexpr std::array<std::string_view, 2> ao_blur_names{"none", "box"};

}  // namespace

Parameters describe(ShadowParams& params) {
  return Description("shadow")
      .field("resolution", params.resolution,
             {.unit = "texels", .meaning = "side of the shadow map, of each face for a cube", .min = 1, .max = 16384})
      .field("constant-bias", params.constant_bias,
             {.unit = "m",
              .meaning = "constant depth bias, along the light's axis or the point light's ray",
              .units = {.texels = true}})
      .field("slope-bias", params.slope_bias,
             {.unit = "texels", .meaning = "bias times texel size and tan of the angle between surface and light"})
      .field("normal-offset", params.normal_offset,
             {.unit = "texels",
              .meaning = "way along the geometric normal, times texel size and sin of the angle to the light, by which "
                         "the surface point moves before it is looked up"})
      .choice("filter", params.filter, shadow_filter_names,
              {.unit = {}, .meaning = "how taps are weighed: one tap, a square of taps by its shape, or a turned disk"})
      .field("filter-size", params.filter_size,
             {.unit = "texels",
              .meaning = "taps along a side of a box, tent or Gaussian",
              .min = 1,
              .max = FilterKernel::largest_size,
              .odd = true})
      .choice("filter-taps", params.filter_taps, filter_taps_names,
              {.unit = {}, .meaning = "whether each tap of a box, tent or Gaussian is nearest or a bilinear 2×2"})
      .field("filter-samples", params.filter_samples,
             {.unit = "1", .meaning = "points of the Poisson disk", .min = 1, .max = 64})
      .field("filter-radius", params.filter_radius,
             {.unit = "texels", .meaning = "radius of the Poisson disk", .min = 0, .max = 64})
      .take();
}

Parameters describe(AoParams& params) {
  return Description("ao")
      .field("samples", params.samples, {.unit = "1", .meaning = "kernel points a pixel", .min = 1, .max = 1024})
      .field("radius", params.radius,
             {.unit = "m", .meaning = "kernel radius", .min = 1e-6, .units = {.scene_size = true}})
      .field("bias", params.bias,
             {.unit = "m",
              .meaning = "depth by which a surface must be in front of a kernel point to occlude it",
              .units = {.scene_size = true}})
      .field("noise-size", params.noise_size,
             {.unit = "px", .meaning = "side of the tile of random kernel rotations", .min = 1, .max = 64})
      .field("range-check", params.range_check,
             {.unit = {}, .meaning = "whether occluders fade out that are much farther from the point than the radius"})
      .choice("blur", params.blur, ao_blur_names, {.unit = {}, .meaning = "filter over the result"})
      .field("blur-size", params.blur_size, {.unit = "px", .meaning = "side of the blur's box", .min = 1, .max = 32})
      .take();
}

AoParams in_metres(AoParams params, double scene_size) {
  params.radius = to_metres(params.radius, scene_size);
  params.bias = to_metres(params.bias, scene_size);
  return params;
}

}  // namespace umbrameter
