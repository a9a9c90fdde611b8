// One quantity of one experiment, for sweeps and tunings: technique and reference, drawn once, of which statistics and
// image metrics are taken over any of the pixels.
#pragma once

#include <functional>

#include "experiments/measure/metric_scores.h"
#include "experiments/stages/stages.h"
#include "results/swept.h"

namespace umbrameter {

struct ComparedCase {
  std::function<CellStatistics(const LeftOut&)> statistics;  ///< those of a shaded image are always of all pixels
  std::function<ComparedImages()> images;
};

/// Draws and traces the light's visibility, ambient occlusion or the image of all lights that view.light selects.
/// `kind` selects the statistics; its values are not read. draw_visibility(), if given, draws the visibility. By
/// cause it is called first and its image is not used: an engine then has this frame from a request for several.
/// Refers to `stages`. The experiment is in metres.
ComparedCase compare_case(Stages& stages, const Experiment& experiment, const CellStatistics& kind,
                          const std::function<Image<float>()>& draw_visibility = {});

}  // namespace umbrameter
