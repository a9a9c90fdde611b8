#include "techniques/ao/ssao.h"

namespace umbrameter {

Parameters describe(SsaoParams& params) {
  return Description("ao")
      .field("range-check", params.range_check,
             {.unit = {}, .meaning = "fade out occluders much farther away than the radius"})
      .take();
}

}  // namespace umbrameter
