#include "techniques/shadow/esm.h"

namespace umbrameter {

Parameters describe(EsmParams& params) {
  return Description("shadow")
      .field("esm-exponent", params.exponent,
             // The exponential of the largest is still a 32-bit float, summed over the largest blur.
             {.unit = "1", .meaning = "ESM: exponent over the map's depth range", .min = 1, .max = 80})
      .field("esm-blur", params.blur,
             {.unit = "texels", .meaning = "ESM: side of the box blur of the map", .min = 1, .max = 63, .odd = true})
      .take();
}

}  // namespace umbrameter
