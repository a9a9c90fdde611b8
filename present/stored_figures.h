// The figures of a finished run, drawn again from what it stored.
#pragma once

#include "reports/figures/figures.h"
#include "store/stored_run.h"

namespace umbrameter {

/// Of images.exr, as compare draws them: reference, technique, error and causes of each light, ambient occlusion and
/// its stages, the error of the shaded image. Of summary.json: the stages as a sum. Empty for a run that stored
/// neither. For the plots of a sweep see stored_sweep_figures().
Figures stored_figures(const StoredRun& run);

}  // namespace umbrameter
