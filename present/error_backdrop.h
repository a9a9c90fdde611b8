// How the images of a run are drawn: the scene behind error maps and causes, and which images belong together.
#pragma once

#include <string_view>
#include <vector>

#include "reports/figures/error_image.h"
#include "reports/files/exr.h"

namespace umbrameter {

/// Figures are recognised by their stems, which are names of layers. The backdrop is the shaded picture of the layers
/// (R, G, B and A); without them, or where the sizes differ, there is none.
ErrorImages error_images_of(const std::vector<ImageFigure>& figures, const LayeredImage& layers);

/// Sets the values of `layer` to 0 where they enter no statistic, if it is the error of a light's shadow
/// ("error_visibility_LIGHT"): outside the map, the cone and the range of a light its shadow has no error.
void hide_uncounted(Image<float>& values, std::string_view layer, const LayeredImage& layers);

}  // namespace umbrameter
