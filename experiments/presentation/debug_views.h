// Pictures of what a renderer works with: buffers, shadow maps, the scene as a light sees it. Each becomes a figure,
// and a small overlay at the lower edge of the shaded image.
#pragma once

#include "experiments/presentation/presentation.h"

namespace umbrameter {

/// Throws Error (usage) if run.overlay, a comma-separated list, names an unknown view or light, or the light buffer
/// without deferred shading. To be called before any work is done.
void check_debug_views(const Stages& stages, const Experiment& experiment);

/// The image with overlays, and a figure for each view that run.overlay lists, in that order; "all" lists every view.
/// The measurement must hold the technique's results, including its image.
Presentation present_debug_views(Stages& stages, const Measurement& measurement);

}  // namespace umbrameter
