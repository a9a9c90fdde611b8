// Which parameters of shading have an effect.
#pragma once

#include "techniques/shading/parameters.h"

namespace umbrameter {

/// The parameters that decide the image with these settings, under some light. Any other parameter changes nothing.
Parameters read_parameters(ShadingParams& params);

}  // namespace umbrameter
