#include "techniques/shadow/parameters.h"

#include <array>
#include <string_view>

#include "techniques/shadow/filter.h"

namespace umbrameter {
namespace {

constexpr std::array<std::string_view, 9> shadow_filter_names{
    "nearest", "bilinear", "box", "tent", "gaussian", "poisson", "vogel", "optimized", "area-tent"};
constexpr std::array<std::string_view, 2> filter_taps_names{"nearest", "linear"};
constexpr std::array<std::string_view, 2> offset_direction_names{"normal", "across"};
constexpr std::array<std::string_view, 2> offset_facing_names{"viewer", "front"};
constexpr std::array<std::string_view, 2> offset_texel_names{"receiver", "middle"};
constexpr std::array<std::string_view, 3> disk_rotation_names{"random", "fixed", "gradient"};

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
              .units = {.texels = true, .map_depth = true},
              .basic = true})
      .field("slope-bias", params.slope, {.unit = "texels", .meaning = "slope-scaled bias, times tan θ", .basic = true})
      .field("normal-offset", params.normal_offset.texels,
             {.unit = "texels", .meaning = "normal offset, times its profile (sin θ)", .basic = true})
      .field("normal-offset-metres", params.normal_offset.metres,
             {.unit = "m", .meaning = "normal offset, times its profile; added to that in texels"})
      .choice("normal-offset-profile", params.normal_offset.profile, offset_profile_names,
              {.unit = {}, .meaning = "factor of the normal offset: sin θ, 1, 1 − cos θ or sin θ + 0.168"})
      .choice("normal-offset-direction", params.offset_direction, offset_direction_names,
              {.unit = {}, .meaning = "normal offset along the normal, or only its part across the light"})
      .choice("normal-offset-facing", params.offset_facing, offset_facing_names,
              {.unit = {}, .meaning = "normal of back faces: turned to the viewer, or that of the front"})
      .choice(
          "normal-offset-texel", params.offset_texel, offset_texel_names,
          {.unit = {}, .meaning = "texel size in the normal offset: at the receiver, or in the middle of a warped map"})
      .field("receiver-plane", params.receiver_plane,
             {.unit = {}, .meaning = "compare each tap with the depth of the receiver's plane at the tap"})
      .field("cone-bias", params.cone,
             {.unit = "1", .meaning = "bias per distance of a tap's texel centre from the receiver", .min = 0})
      .take();
}

Parameters describe(PcfParams& params) {
  return Description("shadow")
      .choice("filter", params.filter, shadow_filter_names,
              {.unit = {}, .meaning = "PCF kernel", .basic = true, .aliases = {{"pcf", "box"}}})
      .field("filter-size", params.size,
             {.unit = "texels",
              .meaning = "side of the PCF kernel, except disks",
              .min = 1,
              .max = FilterKernel::largest_size,
              .basic = true})
      .choice("filter-taps", params.taps, filter_taps_names,
              {.unit = {}, .meaning = "taps of a box, tent or Gaussian kernel; linear: bilinear 2×2"})
      .field("filter-samples", params.samples,
             {.unit = "1", .meaning = "taps of the Poisson or Vogel disk", .min = 1, .max = 64})
      .field("filter-radius", params.radius,
             {.unit = "texels", .meaning = "radius of the Poisson or Vogel disk", .min = 0, .max = 64})
      .choice("filter-rotation", params.rotation, disk_rotation_names,
              {.unit = {}, .meaning = "rotation of the disk: random per pixel, fixed, or interleaved gradient noise"})
      .take();
}

Parameters describe(PcssParams& params) {
  return Description("shadow")
      .field("pcss-blockers", params.blockers,
             {.unit = "1", .meaning = "PCSS: taps of the blocker search", .min = 1, .max = 64})
      .field("pcss-light-scale", params.light_scale,
             {.unit = "1", .meaning = "PCSS and DPCF: assumed size of the light over its size in the scene", .min = 0})
      .field("pcss-max-radius", params.max_radius,
             {.unit = "texels", .meaning = "PCSS and DPCF: largest radius of search and filter", .min = 0, .max = 512})
      .field("pcss-min-radius", params.min_radius,
             {.unit = "texels", .meaning = "PCSS: smallest radius of the filter", .min = 0, .max = 64})
      .field("pcss-search-cone", params.search_cone,
             {.unit = {}, .meaning = "PCSS: average only blockers between the receiver and some point of the light"})
      .take();
}

}  // namespace umbrameter
