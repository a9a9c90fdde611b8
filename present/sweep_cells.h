// The numbers of a sweep's cells on its page.
#pragma once

#include "reports/page/cells.h"
#include "results/page_cell.h"
#include "store/sweep_results.h"

namespace umbrameter {

/// The rows of the sweep, at most 20,000 at even steps and those of `shown`, and what repeats a cell with `compare`.
ReportCells report_cells(const SweepResults& sweep, const Experiment& experiment, const std::vector<PageCell>& shown);

}  // namespace umbrameter
