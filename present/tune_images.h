// The images of a tuning on its page: the best point and the default, in one case.
#pragma once

#include "present/presentation.h"
#include "reports/page/viewer_data.h"
#include "results/run_results.h"

namespace umbrameter {

/// Adds the figures of the points' images to `part` and returns the images for the page's viewer, those of the first
/// point first.
ViewerPack add_tune_images(Presentation& part, const SceneFacts& scene, const TuneFindings& tune);

}  // namespace umbrameter
