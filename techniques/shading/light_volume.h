// The mesh that a deferred renderer draws for a light: it encloses every point that the light reaches.
#pragma once

#include <array>
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

/// A sphere for a point light, a cone for a spot light. Nothing if the light reaches everything: it is directional or
/// has no range. A spot light wider than 60° gets a sphere, because its cone would be much larger.
std::optional<LightVolume> light_volume(const Light& light);

/// What the fragments of a light's volume came to.
struct LightCounters {
  std::uint32_t shaded = 0;   ///< fragments that were shaded
  std::uint32_t in_vain = 0;  ///< of these, outside of the light's exact sphere or cone, or on the background
  std::uint32_t missed = 0;   ///< pixels inside of it that were not shaded: the camera is inside the volume
  friend bool operator==(const LightCounters&, const LightCounters&) = default;
};

}  // namespace umbrameter
