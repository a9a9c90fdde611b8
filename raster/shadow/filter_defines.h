// Passes a PCF kernel to the shaders as #defines.
#pragma once

#include <string>

#include "techniques/shadow/filter.h"

namespace umbrameter {

/// The #defines that shaders/shadow_filter.glsl needs for this kernel. The radius is a uniform and not included.
std::string filter_defines(const FilterKernel& filter);

}  // namespace umbrameter
