#include "experiments/sweep_progress.h"

#include <algorithm>
#include <cmath>

#include "experiments/stage_inputs.h"

namespace umbrameter {
namespace {

// The number of the reference that the next cell needs.
double reference_of(const SweepAdvance& advance) {
  const auto references = static_cast<double>(advance.references);
  return std::min(std::floor(advance.cells * references + 1e-9), references - 1.0);
}

void update_share(SweepAdvance& advance) {
  const auto references = static_cast<double>(advance.references);
  const double reference = reference_of(advance);
  const double cells = advance.cells * references - reference;
  const double share = advance.traced > 0.0 ? 0.5 * advance.traced + 0.5 * cells : cells;
  advance.share = std::clamp((reference + share) / references, advance.share, 1.0);
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

void advance_cells(SweepAdvance& advance, double cells) {
  const double before = reference_of(advance);
  advance.cells = cells;
  if (reference_of(advance) != before) advance.traced = 0.0;
  update_share(advance);
}

void advance_tracing(SweepAdvance& advance, double traced) {
  advance.traced = traced;
  update_share(advance);
}

}  // namespace umbrameter
