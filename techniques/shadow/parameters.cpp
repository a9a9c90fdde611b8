#include "techniques/shadow/parameters.h"

#include <array>
#include <string_view>

#include "techniques/shadow/filter.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 7> shadow_filter_names{"nearest",  "bilinear", "box",  "tent",
                                                              "gaussian", "poisson",  "vogel"};
constexpr std::array<std::string_view, 2> filter_taps_names{"nearest", "linear"};

}  // namespace

Parameters describe(ShadowMapParams& params) {
  return Description("shadow")
      .field(
          "resolution", params.resolution,
          {.unit = "texels", .meaning = "side of the shadow map or cube face", .min = 1, .max = 16384, .basic = true})
      .field("cascades", params.cascades,
             {.unit = "1", .meaning = "views of a directional light's map, nearer ones finer", .min = 1, .max = 8})
      .take();
}

Parameters describe(BiasParams& params) {
  return Description("shadow")
      .field("constant-bias", params.constant,
             {.unit = "m",
              .meaning = "constant bias, along the light's axis or ray",
              .units = {.texels = true},
              .basic = true})
      .field("slope-bias", params.slope, {.unit = "texels", .meaning = "slope-scaled bias, times tan θ", .basic = true})
      .field("normal-offset", params.normal_offset,
             {.unit = "texels", .meaning = "normal offset, times sin θ", .basic = true})
      .take();
}

Parameters describe(PcfParams& params) {
  return Description("shadow")
      .choice("filter", params.filter, shadow_filter_names,
              {.unit = {}, .meaning = "PCF kernel", .basic = true, .aliases = {{"pcf", "box"}}})
      .field("filter-size", params.size,
             {.unit = "texels",
              .meaning = "side of the box, tent or Gaussian kernel",
              .min = 1,
              .max = FilterKernel::largest_size,
              .odd = true,
              .basic = true})
      .choice("filter-taps", params.taps, filter_taps_names,
              {.unit = {}, .meaning = "taps of a box, tent or Gaussian kernel; linear: bilinear 2×2"})
      .field("filter-samples", params.samples,
             {.unit = "1", .meaning = "taps of the Poisson or Vogel disk", .min = 1, .max = 64})
      .field("filter-radius", params.radius,
             {.unit = "texels", .meaning = "radius of the Poisson or Vogel disk", .min = 0, .max = 64})
      .take();
}

}  // namespace umbrameter
