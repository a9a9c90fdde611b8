// A cell of a sweep whose images the page has.
#pragma once

#include <cstddef>
#include <string>

#include "experiments/settings/experiment.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {

/// A cell whose images the page has.
struct PageCell {
  ViewerCell cell;        ///< its number and why it was chosen
  Experiment experiment;  ///< lengths of ambient occlusion in metres
};

}  // namespace umbrameter
