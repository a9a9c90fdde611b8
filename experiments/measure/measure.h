// Measures one configuration: the results of technique and reference, and their difference.
#pragma once

#include "experiments/stages/stages.h"
#include "results/measurement.h"

namespace umbrameter {

/// How visibility is compared with its reference: by the cause of each wrong tap, by the edges of a binary reference,
/// or with a sampled one.
enum class ShadowKind { by_cause, by_edges, sampled };

/// The kind that tells most about this experiment's technique and light.
ShadowKind kind_of(const Stages& stages, const Experiment& experiment, std::uint32_t light);

/// The statistics of what the technique has drawn, with causes where they are of that kind, over the counted pixels.
ShadowStatistics analyze_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, ShadowKind kind,
                                const RasterVisibility& drawn, const CountedPixels& counted);

/// The technique's visibility, with the causes of its wrong taps by run.classes, and how the rules agree on them.
RasterVisibility draw_causes(Stages& stages, const Experiment& experiment, std::uint32_t light,
                             std::optional<ClassAgreement>& agreement);

/// The technique's image, or the traced one, with its exposure. Without an image measurement: a picture shaded with the
/// technique's results if there are any, otherwise with the reference's. Linear, 1 is about white.
Image<vec3> picture_of(const Stages& stages, const Measurement& measurement);

ShadowMeasurement measure_shadow(Stages& stages, const Experiment& experiment, std::uint32_t light, Sides sides);
AoMeasurement measure_ao(Stages& stages, const Experiment& experiment, Sides sides);

}  // namespace umbrameter
