// The plots of a finished sweep, drawn again from its folder: no cell is measured and no scene is read.
#pragma once

#include <filesystem>

#include "reports/figures/figures.h"

namespace umbrameter {

/// The plots and heat maps that the sweep itself draws; none if no cell has counted pixels. Of another version's sweep
/// the fits that need facts of the scene are left out. Throws Error as FinishedSweep and read_run_value() do.
Figures stored_sweep_figures(const std::filesystem::path& folder);

}  // namespace umbrameter
