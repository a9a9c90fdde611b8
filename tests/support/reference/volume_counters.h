// Counts on the CPU what the deferred path's light volumes shade; for tests.
#pragma once

#include "core/gbuffer.h"
#include "techniques/shading/light_volume.h"
#include "techniques/shading/parameters.h"

namespace umbrameter {

struct VolumeCount {
  LightCounters counters;
  /// Pixels left out of the count because the rasteriser's rounding decides: the ray passes close to the mesh's
  /// outline, or meets the mesh close to the surface.
  std::uint32_t undecided = 0;
};

/// Intersects the ray of each pixel with the volume's triangles and with the exact sphere or cone.
VolumeCount count_volume(const GBuffer& gbuffer, const View& view, const Light& light, VolumeFaces faces);

}  // namespace umbrameter
