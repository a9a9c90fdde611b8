#include "techniques/ao/hbao.h"

namespace umbrameter {

Parameters describe(HbaoParams& params) {
  return Description("ao")
      .field("hbao-directions", params.directions,
             {.unit = "1", .meaning = "HBAO: directions per pixel", .min = 1, .max = 256})
      .field("hbao-steps", params.steps, {.unit = "1", .meaning = "HBAO: samples per direction", .min = 1, .max = 1024})
      .field("hbao-tangent-bias", params.tangent_bias,
             {.unit = "degrees",
              .meaning = "HBAO: angle above the tangent plane from which surfaces occlude",
              .min = 0.0,
              .max = 90.0})
      .field("hbao-intensity", params.intensity, {.unit = "1", .meaning = "HBAO: factor on the occlusion", .min = 0.0})
      .field("hbao-jitter", params.jitter,
             {.unit = {}, .meaning = "HBAO: shift the steps by an offset that differs from pixel to pixel"})
      .take();
}

shared::HbaoMethod::HbaoSettings settings_of(const Hbao& technique) {
  const HbaoParams& params = technique.params;
  return {params.directions,
          params.steps,
          static_cast<float>(technique.sampling.radius.number),
          static_cast<float>(params.tangent_bias * pi / 180.0),
          static_cast<float>(params.intensity),
          params.jitter ? 1 : 0};
}

}  // namespace umbrameter
