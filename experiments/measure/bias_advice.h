// Which constant bias is right for one light's shadow map, from one pass over all of them. Only for hard shadows.
#pragma once

#include <vector>

#include "experiments/stages/stages.h"
#include "results/bias_advice.h"

namespace umbrameter {

/// Whether advise_bias() gives flips for this experiment: its technique has one tap per pixel.
bool has_tap_flips(const Experiment& experiment);

/// One light's map and reference. At least one pixel must be counted. Searches biases from a hundredth to a hundred
/// texels on both sides of 0, and farther where the plateau reaches an end. `further` biases, in the unit of the
/// experiment's own, become cells, too; they do not change what is recommended.
BiasAdvice advise_bias(Stages& stages, const Experiment& experiment, std::uint32_t light,
                       const std::vector<double>& further = {});

}  // namespace umbrameter
