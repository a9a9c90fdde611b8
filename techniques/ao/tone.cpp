#include "techniques/ao/tone.h"

#include <algorithm>
#include <cmath>

namespace umbrameter {

Parameters describe(AoToneParams& params) {
  return Description("ao")
      .field("intensity", params.intensity,
             {.unit = "1", .meaning = "factor on the occlusion, after the blur", .min = 0.0})
      .field("power", params.power,
             {.unit = "1", .meaning = "exponent of the result, after blur and intensity", .min = 0.01, .max = 100.0})
      .take();
}

float with_tone(float ao, const AoToneParams& params) {
  if (params.intensity != 1.0) ao = std::max(0.0f, 1.0f - static_cast<float>(params.intensity) * (1.0f - ao));
  return params.power == 1.0 ? ao : std::pow(ao, static_cast<float>(params.power));
}

}  // namespace umbrameter
