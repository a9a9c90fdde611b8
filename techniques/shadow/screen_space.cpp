#include "techniques/shadow/screen_space.h"

#include "core/parameter_selection.h"
#include "techniques/shadow/technique.h"

namespace umbrameter {

Parameters describe(ScreenSpaceParams& params) {
  return Description("shadow")
      .field("contact-shadows", params.is_combined,
             {.unit = {}, .meaning = "darken the technique's result by screen-space shadows"})
      .field("screen-length", params.length,
             {.unit = "m", .meaning = "screen-space shadows: length of the ray", .min = 0, .max = 1e6})
      .field("screen-steps", params.steps,
             {.unit = "1", .meaning = "screen-space shadows: samples along the ray", .min = 1, .max = 1024})
      .field("screen-thickness", params.thickness,
             {.unit = "m", .meaning = "screen-space shadows: assumed thickness of every surface", .min = 0, .max = 1e6})
      .field("screen-bias", params.bias,
             {.unit = "1",
              .meaning = "screen-space shadows: a surface blocks if it lies in front of the ray by more than this "
                         "share of the depth",
              .min = 0,
              .max = 1})
      .field("screen-jitter", params.jitter,
             {.unit = {}, .meaning = "screen-space shadows: shift the samples by interleaved gradient noise"})
      .field("screen-plane", params.plane,
             {.unit = {}, .meaning = "screen-space shadows: ignore what lies behind the receiver's tangent plane"})
      .take();
}

ScreenSpace ScreenSpace::make(const ShadowParams& shadow, double) {
  const ScreenSpaceParams& params = shadow.screen_space;
  return {{static_cast<float>(params.length), params.steps, static_cast<float>(params.thickness),
           static_cast<float>(params.bias), params.jitter ? 1 : 0, params.plane ? 1 : 0}};
}

Parameters ScreenSpace::reads(ShadowParams& params) {
  // Which kind of map a point light has decides which of its pixels are counted.
  return concatenate({describe(params.screen_space), select(describe(params.map_depth), {"shadow.point-map"})});
}

}  // namespace umbrameter
