// Measures why a method of ambient occlusion is wrong: its error by stage. Costs several times the rays of the
// reference, so runs measure it only with run.ao-stages.
#pragma once

#include <string>
#include <vector>

#include "compare/ao_stages.h"
#include "experiments/stages/stages.h"
#include "reports/files/console.h"

namespace umbrameter {

/// The stages from the requested reference, `truth`, to the result of the technique, `drawn`. Traces truth.spp rays per
/// pixel. Throws Error (usage) if the technique has no integral.
AoStages measure_ao_stages(Stages& stages, const Experiment& experiment, const TracedAo& truth,
                           const Image<float>& drawn, const Console& console);

}  // namespace umbrameter
