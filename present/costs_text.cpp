#include "present/costs_text.h"

#include <fmt/format.h>

#include "reports/files/text_layout.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

std::string rays_text(const char* kind, const RayCosts& costs) {
  if (costs.rays == 0) return {};
  const double millions = 1e-6 * static_cast<double>(costs.rays);
  return fmt::format("; {:.4g} M {} rays in {:.3g} s, {:.3g} Mray/s", millions, kind, costs.seconds,
                     millions / costs.seconds);
}

}  // namespace

std::string costs_text(const Costs& costs, std::uint64_t peak_resident_bytes) {
  if (costs.build.triangles == 0) return {};
  std::string text = fmt::format("traced {} triangles; built in {:.3g} s, {}", costs.build.triangles,
                                 costs.build.seconds, bytes_text(costs.build.bytes));
  text += rays_text("shadow", costs.shadow) + rays_text("hemisphere", costs.hemisphere);
  if (costs.largest_offset > 0.0) text += "; offset at most " + metres_text(costs.largest_offset);
  return text + "; peak memory " + bytes_text(peak_resident_bytes);
}

}  // namespace umbrameter
