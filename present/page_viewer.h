// The layers of a run for the page's image viewer.
#pragma once

#include "reports/files/exr.h"
#include "reports/page/viewer_data.h"
#include "results/measurement.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// Every layer of `image`, which is layers_of() the measurement, but for world positions; the bias curves of the
/// measurement's lights; the objects and materials in view. `is_full`: see ViewerData::full.
ViewerData viewer_data(const SceneFacts& scene, const Measurement& measurement, const LayeredImage& image,
                       bool is_full);

/// The same for a further cell of a sweep, with rounded numbers and without the picture.
ViewerData further_viewer_data(const SceneFacts& scene, const Measurement& measurement, bool is_full);

}  // namespace umbrameter
