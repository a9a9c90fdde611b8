#include "techniques/ao/bitmask.h"

#include <array>

namespace umbrameter {

Parameters describe(BitmaskParams& params) {
  static constexpr std::array<std::string_view, 2> weights{"angle", "cosine"};
  static constexpr std::array<std::string_view, 2> roundings{"up", "nearest"};
  return Description("ao")
      .field("bitmask-thickness", params.thickness,
             {.unit = "ao.radius", .meaning = "bitmask: thickness of every surface", .min = 0.0})
      .field("bitmask-distribution", params.distribution,
             {.unit = "1", .meaning = "bitmask: exponent of the steps' distances", .min = 0.1, .max = 10.0})
      .choice("bitmask-weight", params.weight, weights,
              {.unit = {}, .meaning = "bitmask: sectors of equal angles, or of equal shares of the cosine's integral"})
      .choice(
          "bitmask-rounding", params.rounding, roundings,
          {.unit = {}, .meaning = "bitmask: a surface covers every sector it reaches, or those whose centre it covers"})
      .take();
}

shared::BitmaskMethod::BitmaskSettings settings_of(const Bitmask& technique) {
  const BitmaskParams& params = technique.params;
  const double radius = technique.sampling.radius.number;
  return {technique.slices.slices,
          technique.slices.steps,
          static_cast<float>(radius),
          static_cast<float>(params.distribution),
          static_cast<float>(params.thickness * radius),
          params.weight == BitmaskWeight::cosine ? 1 : 0,
          params.rounding == BitmaskRounding::up ? 1 : 0,
          technique.slices.spacing == AoSliceSpacing::angle ? 1 : 0};
}

}  // namespace umbrameter
