// Measures the shaded image: the technique's, the traced one, their difference, and which input causes it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/image_error.h"
#include "experiments/measure/metric_scores.h"
#include "experiments/stages/stages.h"
#include "raster/shading/shading_pass.h"

namespace umbrameter {

/// Throws Error (usage) if the deferred path would have to shade transparent materials.
void check_shading(const Stages& stages, const Experiment& experiment);

/// Draws and shades only the required sides, by these lights.
ImageMeasurement measure_image(Stages& stages, const Experiment& experiment, std::span<const std::uint32_t> lights,
                               Sides sides);

}  // namespace umbrameter
