// Measures why a method of ambient occlusion is wrong: its error by stage. Costs several times the rays of the
// reference, so runs measure it only with run.ao-stages.
#pragma once

#include <string>
#include <vector>

#include "compare/ao_stages.h"
#include "experiments/stages/stages.h"
#include "raytrace/ao_integral.h"
#include "reports/files/console.h"

namespace umbrameter {

/// What the technique draws.
struct AoDraws {
  Image<float> with_many_samples;
  Image<float> without_blur;
  Image<float> result;
};

/// `truth` and `traced` are independent.
AoStageImages ao_stage_images(const TracedAo& truth, TracedIntegral traced, AoDraws drawn);

/// The stages from the requested reference, `truth`, to the result of the technique, `drawn`. Traces truth.spp rays per
/// pixel. Throws Error (usage) if the technique has no integral.
AoStages measure_ao_stages(Stages& stages, const Experiment& experiment, const TracedAo& truth,
                           const Image<float>& drawn, const Console& console);

}  // namespace umbrameter
