// A PCF kernel as shaders read it.
#pragma once

#include <string>

#include "techniques/shadow/filter.h"

namespace umbrameter {

/// The kernel as shaders/shadow_filter.glsl reads it. The radius is not part of it.
std::string filter_defines(const FilterKernel& filter);

}  // namespace umbrameter
