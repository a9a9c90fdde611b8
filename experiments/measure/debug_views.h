// Pictures of what a renderer works with: buffers, shadow maps, the scene as a light sees it.
#pragma once

#include <vector>

#include "experiments/stages/stages.h"
#include "results/measurement.h"

namespace umbrameter {

/// Throws Error (usage) if run.overlay, a comma-separated list, names an unknown view or light, or the light buffer
/// without deferred shading. To be called before any work is done.
void check_debug_views(const Stages& stages, const Experiment& experiment);

/// The views that run.overlay lists, in that order, each once; "all" lists every view. The measurement must hold the
/// technique's results, including its image.
std::vector<DebugView> make_debug_views(Stages& stages, const Measurement& measurement);

}  // namespace umbrameter
