#include "techniques/ao/ssao.h"

namespace umbrameter {

Parameters describe(SsaoParams& params) {
  return Description("ao")
      .field("range-check", params.range_check,
             {.unit = {}, .meaning = "fade out surfaces whose depth differs from the pixel's by more than the radius"})
      .take();
}

}  // namespace umbrameter
