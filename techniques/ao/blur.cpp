#include "techniques/ao/blur.h"

#include <array>
#include <cassert>
#include <string_view>

namespace umbrameter {

Parameters describe(AoBlurParams& params) {
  static constexpr std::array<std::string_view, 6> names{"own", "none", "box", "gaussian", "bilateral", "xegtao"};
  return Description("ao")
      .choice("blur", params.kind, names,
              {.unit = {}, .meaning = "blur; own: that of the technique's publication", .basic = true})
      .field("blur-size", params.size,
             {.unit = "px", .meaning = "width of the blur; that of xegtao is always 3", .min = 1, .max = 32})
      .field("blur-passes", params.passes, {.unit = "1", .meaning = "passes of the blur", .min = 1, .max = 16})
      .field("blur-plane-distance", params.plane_distance,
             {.unit = "ao.radius",
              .meaning =
                  "bilateral blur: distance from the tangent plane at which a weight falls to 1/e; 0: it has no effect",
              .min = 0.0})
      .field("blur-normal-exponent", params.normal_exponent,
             {.unit = "1", .meaning = "bilateral blur: exponent of the cosine between normals", .min = 0.0})
      .take();
}

AoBlurTaps taps_of(const AoBlurParams& params) {
  assert(params.kind != AoBlur::own);
  if (params.kind == AoBlur::none) return {};
  if (params.kind == AoBlur::xegtao) return {-1, 3};
  const int before = params.size / 2;
  if (params.kind == AoBlur::box) return {-before, params.size};
  return {-before, 2 * before + 1};
}

double deviation_of(const AoBlurParams& params) { return 0.25 * params.size; }

}  // namespace umbrameter
