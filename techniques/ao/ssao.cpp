#include "techniques/ao/ssao.h"

#include "techniques/ao/technique.h"

namespace umbrameter {

Parameters describe(SsaoParams& params) {
  return Description("ao")
      .field("range-check", params.range_check,
             {.unit = {}, .meaning = "fade out occluders much farther away than the radius"})
      .take();
}

Ssao Ssao::make(const AoParams& params) {
  return {params.sampling, params.bias, params.noise, params.ssao, params.kernel};
}

Parameters describe(Ssao& technique) {
  return concatenate({describe(technique.sampling), describe(technique.bias), describe(technique.noise),
                      describe(technique.params), describe(technique.kernel)});
}

}  // namespace umbrameter
