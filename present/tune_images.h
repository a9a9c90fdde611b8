// The images of a tuning on its page: the best point and the default, in one case.
#pragma once

#include "present/tune_report.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {

/// The images of a point in one case.
struct TunePointImages {
  std::string name;    ///< "best"
  std::string values;  ///< point_text()
  Measurement measurement;
};

/// Adds the figures of the points' images to `part` and returns the images for the page's viewer, those of the first
/// point first. `title` is that of the case.
ViewerPack add_tune_images(Presentation& part, const SceneFacts& scene, const std::string& title,
                           const std::vector<TunePointImages>& points);

}  // namespace umbrameter
