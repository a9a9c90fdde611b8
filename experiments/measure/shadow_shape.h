// Measures the shape of one light's shadow error.
#pragma once

#include "experiments/stages/stages.h"
#include "results/measurement.h"

namespace umbrameter {

/// Of a measurement with both sides.
ShadowShape measure_shape(Stages& stages, const ShadowMeasurement& shadow);

}  // namespace umbrameter
