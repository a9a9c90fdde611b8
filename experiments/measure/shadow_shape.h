// Measures the shape of one light's shadow error, by view of its map as well, and its shimmer.
#pragma once

#include "experiments/stages/stages.h"
#include "results/measurement.h"

namespace umbrameter {

/// Of a measurement with both sides.
ShadowShape measure_shape(Stages& stages, const ShadowMeasurement& shadow);

/// Draws the map and the visibility again for four moves of the map's grid and four of the camera.
Shimmer measure_shimmer(Stages& stages, const ShadowMeasurement& shadow);

}  // namespace umbrameter
