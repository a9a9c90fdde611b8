#include "present/costs_text.h"

#include <fmt/format.h>

#include "reports/files/text_layout.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

std::string rays_text(const char* kind, const RayCosts& costs) {
  if (costs.rays == 0) return {};
  return fmt::format("; {} {} rays in {:.2g} s, {:.2g} Mray/s", grouped(costs.rays), kind, costs.seconds,
                     1e-6 * static_cast<double>(costs.rays) / costs.seconds);
}

}  // namespace

std::string costs_text(const Costs& costs, std::uint64_t peak_resident_bytes) {
  if (costs.build.triangles == 0) return {};
  std::string text = fmt::format("traced {} triangles; built in {:.2g} s, {}", grouped(costs.build.triangles),
                                 costs.build.seconds, bytes_text(costs.build.bytes));
  text += rays_text("shadow", costs.shadow) + rays_text("hemisphere", costs.hemisphere);
  if (costs.largest_offset > 0.0) text += "; offset at most " + metres_text(costs.largest_offset);
  return text + "; peak memory " + bytes_text(peak_resident_bytes);
}

}  // namespace umbrameter
