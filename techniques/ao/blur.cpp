#include "techniques/ao/blur.h"

#include <array>
#include <string_view>

namespace umbrameter {

Parameters describe(AoBlurParams& params) {
  static constexpr std::array<std::string_view, 2> names{"none", "box"};
  return Description("ao")
      .choice("blur", params.kind, names, {.unit = {}, .meaning = "blur of the result", .basic = true})
      .field("blur-size", params.size, {.unit = "px", .meaning = "width of the blur", .min = 1, .max = 32})
      .take();
}

AoBlurTaps taps_of(const AoBlurParams& params) {
  if (params.kind == AoBlur::none) return {};
  return {-(params.size / 2), params.size};
}

}  // namespace umbrameter
