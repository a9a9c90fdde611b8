// Shadow maps as EXR files, with all that a look-up outside this program needs. docs/techniques/files.md explains them.
#pragma once

#include <cstdint>
#include <string>

#include "experiments/stages/stages.h"
#include "reports/files/exr.h"

namespace umbrameter {

/// "shadow_map_sun.exr"
std::string map_file_name(const Stages& stages, std::uint32_t light);

/// For each view N the layers "viewN_depth" (metres; infinity where the light hits nothing), "viewN_instance" and
/// "viewN_triangle" and, if the technique filters the map, "viewN_filteredL" with the four values of each of its
/// layers L. The
/// attributes hold the projection (MapLayout) and the parameters of the technique.
LayeredImage map_layers(Stages& stages, const Experiment& experiment, std::uint32_t light);

}  // namespace umbrameter
