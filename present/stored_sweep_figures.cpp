#include "present/stored_sweep_figures.h"

#include <optional>

#include "present/sweep_report.h"
#include "store/finished_sweep.h"
#include "store/read_bias_curves.h"
#include "store/run_value.h"

namespace umbrameter {

Figures stored_sweep_figures(const std::filesystem::path& folder) {
  const FinishedSweep sweep(folder);
  const SweepResults rows = sweep.rows();
  const std::optional<RunResults> run = read_run_value(folder, false);
  const std::optional<BiasCurves> curves = run ? run->sweep->curves : read_bias_curves(rows);
  Presentation presentation = present_sweep(rows, best_rows(rows), curves, {});
  return {{}, std::move(presentation.plots), std::move(presentation.heat_maps), {}};
}

}  // namespace umbrameter
