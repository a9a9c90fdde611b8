// How the images of a run are drawn: the scene behind error maps and causes, and which images belong together.
#pragma once

#include <vector>

#include "reports/figures/error_image.h"
#include "reports/files/exr.h"

namespace umbrameter {

/// Figures are recognised by their stems, which are names of layers. The backdrop is the shaded picture of the layers
/// (R, G, B and A); without them, or where the sizes differ, there is none.
ErrorImages error_images_of(const std::vector<ImageFigure>& figures, const LayeredImage& layers);

}  // namespace umbrameter
