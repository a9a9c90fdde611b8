// The plots of a finished sweep, drawn again from its folder: no cell is measured and no scene is read.
#pragma once

#include <filesystem>

#include "reports/figures/figures.h"

namespace umbrameter {

/// The plots and heat maps that the sweep itself draws; none if no cell has counted pixels. Left out are formulas
/// of the bias, which depend on the scene. Throws Error as load_experiment() and
/// ResultsStore::load() do, and (unreadable_input) if both files belong to different sweeps.
Figures stored_sweep_figures(const std::filesystem::path& folder);

}  // namespace umbrameter
