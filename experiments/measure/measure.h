// Measures one configuration: the results of technique and reference, and their difference.
#pragma once

#include "experiments/stages/stages.h"
#include "results/measurement.h"

namespace umbrameter {

/// Compares visibility `drawn` by the technique with the binary reference of a light without extent.
EdgeStatistics measure_edges(Stages& stages, const Experiment& experiment, std::uint32_t light,
                             const Image<float>& drawn);

/// The technique's image, or the traced one, with its exposure. Without an image measurement: a picture shaded with the
/// technique's results if there are any, otherwise with the reference's. Linear, 1 is about white.
Image<vec3> picture_of(const Stages& stages, const Measurement& measurement);
Image<vec3> picture_of(const Stages& stages, const Measurement& measurement);

ShadowMeasurement measure_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, Sides sides);
AoMeasurement measure_ao(Stages& stages, const Experiment& experiment, Sides sides);

}  // namespace umbrameter
