#include "techniques/ao/marched.h"

#include <array>

namespace umbrameter {

Parameters describe(MarchedParams& params) {
  static constexpr std::array<std::string_view, 2> weights{"cosine", "uniform"};
  return Description("ao")
      .field("march-steps", params.steps,
             {.unit = "1", .meaning = "ray marching: max steps of a ray; fewer if it crosses fewer pixels", .min = 1})
      .field("march-thickness", params.thickness,
             {.unit = "ao.radius", .meaning = "ray marching: thickness of every surface", .min = 0.0})
      .field("march-bias", params.bias,
             {.unit = "ao.radius", .meaning = "ray marching: height above the tangent plane that does not occlude"})
      .choice("march-weight", params.weight, weights,
              {.unit = {}, .meaning = "ray marching: distribution of the rays in the hemisphere"})
      .take();
}

shared::MarchedMethod::MarchedSettings settings_of(const Marched& technique) {
  const MarchedParams& params = technique.params;
  const double radius = technique.sampling.radius.number;
  return {technique.sampling.samples,
          params.steps,
          static_cast<float>(radius),
          static_cast<float>(params.bias * radius),
          static_cast<float>(params.thickness * radius),
          params.weight == MarchedWeight::uniform ? 1 : 0};
}

}  // namespace umbrameter
