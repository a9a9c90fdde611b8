#include "experiments/sweep/sweep_progress.h"

#include <algorithm>
#include <cmath>

#include "experiments/settings/stage_inputs.h"

namespace umbrameter {
namespace {

// The number of the reference that the next cell needs.
double reference_of(const SweepProgress& progress) {
  const auto references = static_cast<double>(progress.references);
  return std::min(std::floor(progress.cells * references + 1e-9), references - 1.0);
}

void update_share(SweepProgress& progress) {
  const auto references = static_cast<double>(progress.references);
  const double reference = reference_of(progress);
  const double cells = progress.cells * references - reference;
  const double share = progress.traced > 0.0 ? 0.5 * progress.traced + 0.5 * cells : cells;
  progress.share = std::clamp((reference + share) / references, progress.share, 1.0);
}

}  // namespace

std::size_t count_references(const SweepPlan& plan) {
  std::size_t references = 1;
  for (const SweepAxis& axis : plan.axes) {
    const bool is_traced_again = depends_on(Stage::binary_reference, axis.key) ||
                                 depends_on(Stage::area_reference, axis.key) ||
                                 depends_on(Stage::ao_reference, axis.key);
    if (is_traced_again) references *= axis.values.size();
  }
  return references;
}

void advance_cells(SweepProgress& progress, double cells) {
  const double before = reference_of(progress);
  progress.cells = cells;
  if (reference_of(progress) != before) progress.traced = 0.0;
  update_share(progress);
}

void advance_tracing(SweepProgress& progress, double traced) {
  progress.traced = traced;
  update_share(progress);
}

}  // namespace umbrameter
