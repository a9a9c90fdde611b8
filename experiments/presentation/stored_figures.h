// The image figures of a finished run, drawn again from its images.exr.
#pragma once

#include <vector>

#include "experiments/stored_run.h"
#include "reports/figures/figures.h"

namespace umbrameter {

/// Reference, technique, error and causes of each light and of ambient occlusion, and the error of the shaded image,
/// as compare draws them. Empty if the run has no images.exr.
std::vector<ImageFigure> stored_figures(const StoredRun& run);

}  // namespace umbrameter
