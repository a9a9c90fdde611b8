// The arrays into which the rays of a packet are written. For raytrace/*.cpp and tests.
#pragma once

#include <cstddef>

namespace umbrameter {

/// Rays per packet (docs/decisions/packets-of-neighbours.md).
inline constexpr std::size_t packet_width = 16;

/// Arrays of packet_width values.
struct RayLanes {
  float* x = nullptr;  ///< origins
  float* y = nullptr;
  float* z = nullptr;
  float* dx = nullptr;  ///< directions, unit
  float* dy = nullptr;
  float* dz = nullptr;
  float* reach = nullptr;  ///< metres; a ray of negative reach counts as blocked at its origin
};

}  // namespace umbrameter
