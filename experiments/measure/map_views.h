// Measures the views of one light's map in a run: error of each cascade or cube face, seams, and shimmer of the fit.
#pragma once

#include "results/shadow_shape.h"

namespace umbrameter {

struct ShadowMeasurement;
class Stages;

/// Of a measurement with both sides.
MapViews measure_map_views(Stages& stages, const ShadowMeasurement& shadow);

}  // namespace umbrameter
