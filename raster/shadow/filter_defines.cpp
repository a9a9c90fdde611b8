#include "raster/shadow/filter_defines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "raster/shader_interface.h"

namespace umbrameter {
namespace {

std::string list_of(const std::vector<vec2>& values) {
  std::string text;
  for (const vec2& v : values) text += fmt::format("{}vec2({:.9e}, {:.9e})", text.empty() ? "" : ", ", v.x, v.y);
  return text;
}

}  // namespace

std::string filter_defines(const FilterKernel& filter) {
  std::string text = define("FILTER_IS_GRID", filter.is_grid() ? 1 : 0) +
                     fmt::format("#define FILTER_WEIGHT_SUM {}u\n", filter.weight_sum()) +
                     define("FILTER_TAPS", static_cast<unsigned>(filter.tap_count()));
  if (filter.is_grid()) {
    text += define("FILTER_KERNEL_SIZE", static_cast<unsigned>(filter.kernel.size())) +
            define("FILTER_LINEAR", filter.linear_taps ? 1 : 0) +
            define("FILTER_AREA_SUM", filter.is_area_tent ? FilterKernel::area_sum : 0) +
            define("FILTER_PARTS", FilterKernel::texel_parts) +
            fmt::format("#define FILTER_DIVISOR {}u\n#define FILTER_KERNEL_SUMS {}u\n", filter.divisor,
                        fmt::join(running_sums(filter.kernel), "u, "));
    return text;
  }
  text += define("FILTER_ROTATION", static_cast<unsigned>(filter.rotation)) +
          define("FILTER_SEARCH", filter.search ? static_cast<unsigned>(filter.search->points.size()) : 0);
  text += define("FILTER_HARDENS", filter.hardening ? 1 : 0);
  if (filter.search) text += "#define FILTER_SEARCH_LIST " + list_of(filter.search->points) + "\n";
  return text + define("FILTER_ROTATIONS", static_cast<unsigned>(filter.rotations.size())) +
         "#define FILTER_POINT_LIST " + list_of(filter.points) + "\n#define FILTER_ROTATION_LIST " +
         list_of(filter.rotations) + "\n";
}

}  // namespace umbrameter
