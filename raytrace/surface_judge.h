// Whether a shadow map's sample and its receiver lie on one surface, as the light sees it: the exact judge of the taps
// that no rule about two planes can settle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "raytrace/tracer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// 1 for each pair whose receiver and sample are joined by depths that the light sees without a jump, 0 for the others.
/// The light must see both points. Rays halve the way between them on the map's plane, always into the half with the
/// larger step of depth that slopes do not explain, until it is as short as rays can tell apart; docs/classes.md
/// derives the decision. The answer does not depend on the number of threads.
std::vector<std::uint8_t> judge_own(const Tracer& tracer, const MapLayout& frame, std::span<const TapSurfaces> taps,
                                    const Progress& progress = {});

}  // namespace umbrameter
