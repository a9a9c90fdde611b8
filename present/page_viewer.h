// The layers of a run for the page's image viewer.
#pragma once

#include "reports/page/viewer_data.h"
#include "results/measurement.h"
#include "results/scene_facts.h"

namespace umbrameter {

/// Every layer of the measurement but those for programs; the bias curves of its lights; the objects and materials in
/// view. `is_full`: see ViewerData::full.
ViewerData viewer_data(const SceneFacts& scene, const Measurement& measurement, bool is_full);

/// Adds a cell of a sweep to the pack. All but the first have rounded numbers and no picture.
void add_cell_images(ViewerPack& pack, const SceneFacts& scene, const Measurement& measurement, const ViewerCell& cell,
                     bool is_full);

}  // namespace umbrameter
