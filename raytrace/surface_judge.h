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

/// Which surface must be continuous between the two points. seen: the depth that the light sees, for receivers that it
/// sees. own_layer: that of the receiver itself, whatever blocks it, for the others.
enum class Continuity { seen, own_layer };

/// 1 for each tap between whose receiver and sample the depth has no jump, 0 for the others. The light must see the
/// sample. Bisects the segment between them on the map's plane by rays, always into the half with
/// the larger depth step that the slopes do not explain, until rays cannot distinguish its ends (docs/classes.md). With
/// own_layer, each ray passes through surfaces and takes the one that best continues both ends. The result does not
/// depend on the number of threads.
std::vector<std::uint8_t> test_same_surface(const Tracer& tracer, const MapLayout& layout,
                                            std::span<const TapSurfaces> taps, Continuity continuity,
                                            const Progress& progress = {});

}  // namespace umbrameter
