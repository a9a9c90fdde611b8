// Which parameters of ambient occlusion have an effect: those that the technique's describe() lists, and those of what
// follows it.
#pragma once

#include "techniques/ao/technique.h"

namespace umbrameter {

/// The parameters that decide the result with these settings, with the words that select them. Any other parameter
/// changes nothing.
Parameters read_parameters(AoParams& params);

}  // namespace umbrameter
