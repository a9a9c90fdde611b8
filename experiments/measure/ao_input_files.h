// What a technique of ambient occlusion reads, as files: with them, anyone can recompute it outside.
// docs/ambient-occlusion/files.md explains them.
#pragma once

#include <string>

#include "experiments/stages/stages.h"
#include "reports/files/exr.h"

namespace umbrameter {

inline constexpr const char* ao_input_image_file = "ao_inputs.exr";
inline constexpr const char* ao_input_values_file = "ao_inputs.json";

/// The layers "depth" (metres along the camera's axis; infinite on background), "position" (NaN on background) and
/// "normal" (0 on background), both in view space and rounded as the shaders round them.
LayeredImage ao_input_layers(Stages& stages, const Experiment& experiment);

/// JSON: the camera's matrices, kernel, noise, and every parameter with lengths in metres.
std::string ao_input_values(Stages& stages, const Experiment& experiment);

}  // namespace umbrameter
