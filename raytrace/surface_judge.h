// Whether a shadow map's sample and its receiver lie on one surface, as seen from the light. Decides by rays the taps
// that the rule about the planes of two triangles leaves open.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.h"
#include "raytrace/tracer.h"
#include "techniques/shadow/causes.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// 1 for each tap between whose receiver and sample the depth seen from the light has no jump, 0 for the others. The
/// light must see both points. Bisects the segment between them on the map's plane by rays, always into the half with
/// the larger depth step that the slopes do not explain, until rays cannot distinguish its ends (docs/classes.md). The
/// result does not depend on the number of threads.
std::vector<std::uint8_t> test_same_surface(const Tracer& tracer, const MapLayout& layout,
                                            std::span<const TapSurfaces> taps, const Progress& progress = {});

}  // namespace umbrameter
