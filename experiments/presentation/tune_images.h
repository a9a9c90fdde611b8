// The images of a tuning on its page: the best point and the default, in one case.
#pragma once

#include "experiments/presentation/tune_report.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {

/// Measures the best point and the default in the first case. Adds the figures of their images to `part` and returns
/// the images for the page's viewer, those of the best point first.
ViewerPack add_tune_images(Presentation& part, const TuneSummary& summary);

}  // namespace umbrameter
