// Which parameters have an effect: each technique, kernel and fit lists those that it reads. A new one adds its line.
#pragma once

#include "techniques/shadow/technique.h"

namespace umbrameter {

/// The parameters that decide the result with these settings, under some light: those of the map, those of the
/// technique, and the words that select them. Any other parameter changes nothing. Does not throw for parameters that
/// exclude each other.
Parameters read_parameters(ShadowParams& params);

}  // namespace umbrameter
