// The exposures at which HDR-FLIP compares two images.
// Andersson, Nilsson, Shirley and Akenine-Möller, Visualizing Errors in Rendered High Dynamic Range Images,
// Eurographics Short Papers 2021; below "the paper".
#pragma once

#include "compare/metrics/color_metric.h"

namespace umbrameter {

struct ExposureRange {
  double start = 0.0;  ///< [EV]
  double stop = 0.0;   ///< [EV], at least start
  int count = 2;
};

/// From the start, where the brightest pixel of the reference is almost white, to the stop, where its median pixel is.
/// Pixels that are black are left out of the median if it would be 0. What the parameters set replaces what the
/// reference suggests; the number of exposures is then about one per stop, at least 2. A black image has start and stop
/// 0. Throws Error (usage) where the start is after the stop.
ExposureRange exposure_range(const Image<vec3>& reference, const ColorMetricParams& params);

/// The tone-mapping curve of the paper for a linear value: Narkowicz's fit of ACES, without its exposure of 0.6.
double aces(double value);

}  // namespace umbrameter
