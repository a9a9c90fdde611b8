// Debug views: each becomes a figure, and a small overlay at the lower edge of the shaded image.
#pragma once

#include "present/presentation.h"

namespace umbrameter {

/// The image with overlays, and a figure for each of the measurement's debug views.
Presentation present_debug_views(const Measurement& measurement);

}  // namespace umbrameter
