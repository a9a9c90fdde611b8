// The mesh that a deferred renderer draws for a light: it encloses every point that the light reaches.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/math.h"
#include "scenes/scene.h"
#include "scenes/view.h"

namespace umbrameter {

/// Convex and closed; triangles are counter-clockwise seen from outside. World, metres.
struct LightVolume {
  std::vector<vec3> positions;
  std::vector<uvec3> triangles;
};

/// A sphere for a point light, a cone for a spot light. Empty if the light has no range or is directional. A spot light
/// with an outer cone angle above 60° gets a sphere, because a cone around it would be much larger.
std::optional<LightVolume> light_volume(const Light& light);

/// Counts the fragments of a light's volume.
struct LightCounters {
  std::uint32_t shaded = 0;   ///< fragments that were shaded
  std::uint32_t in_vain = 0;  ///< of these, outside the light's exact sphere or cone, or on the background
  std::uint32_t missed = 0;   ///< pixels inside the exact sphere or cone that were not shaded
  friend bool operator==(const LightCounters&, const LightCounters&) = default;
};

}  // namespace umbrameter
