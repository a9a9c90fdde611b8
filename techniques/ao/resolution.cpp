#include "techniques/ao/resolution.h"

#include <array>
#include <string_view>

namespace umbrameter {

Parameters describe(AoResolutionParams& params) {
  static constexpr std::array<std::string_view, 2> names{"full", "half"};
  return Description("ao")
      .choice("resolution", params.kind, names,
              {.unit = {}, .meaning = "resolution of technique and blur; half: every second pixel of both axes"})
      .field(
          "upsampling-plane-distance", params.plane_distance,
          {.unit = "ao.radius",
           .meaning =
               "half resolution: distance from the tangent plane at which a weight falls to 1/e; 0: it has no effect",
           .min = 0.0})
      .field("upsampling-normal-exponent", params.normal_exponent,
             {.unit = "1", .meaning = "half resolution: exponent of the cosine between normals", .min = 0.0})
      .take();
}

ivec2 ao_image_size(AoResolution resolution, const ivec2& view_size) {
  return resolution == AoResolution::half ? (view_size + 1) / 2 : view_size;
}

}  // namespace umbrameter
