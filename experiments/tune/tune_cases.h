// The cases of a tuning, and those that it does not see: scenes, cameras, lights and other values to go over.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "experiments/tune/tune_case.h"

namespace umbrameter {

/// Key and values of what the cases go over: {"view.camera", "all"}, {"light.angle", "0,0.5"}.
using CaseAxes = std::vector<std::pair<std::string, std::string>>;

/// All cases of a scene: each combination of the axes; for shadows also each selected light. "all" stands for every
/// camera, light or name of a choice.
std::vector<TuneCase> cases_of(Stages& stages, const Experiment& experiment, SweptQuantity quantity,
                               const CaseAxes& over);

/// Throws Error (usage) as require_sense() of an experiment does, for the lights of all cases: as in compare, a
/// parameter of suns alone makes sense if one of the lights is a sun.
void require_sense(const std::vector<TuneCase>& cases);

/// Index, as view.camera takes it, of the first camera that no case uses; empty if there is none.
std::string unused_camera(const std::vector<TuneCase>& cases);

}  // namespace umbrameter
