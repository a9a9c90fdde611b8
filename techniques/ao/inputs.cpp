#include "techniques/ao/inputs.h"

#include <array>
#include <string_view>

namespace umbrameter {

Parameters describe(AoInputParams& params) {
  static constexpr std::array<std::string_view, 3> names{"exact", "rgb8", "depth"};
  return Description("ao")
      .choice("normals", params.normals, names,
              {.unit = {}, .meaning = "normals that technique and blur read: exact, 8 bits a component, or from depth"})
      .take();
}

}  // namespace umbrameter
