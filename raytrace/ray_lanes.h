// Where the rays of a packet are written. For raytrace/*.cpp and tests.
#pragma once

namespace umbrameter {

/// A packet's rays, to be written: arrays of its width.
struct RayLanes {
  float* x = nullptr;  ///< origins
  float* y = nullptr;
  float* z = nullptr;
  float* dx = nullptr;  ///< directions, unit
  float* dy = nullptr;
  float* dz = nullptr;
  float* reach = nullptr;  ///< metres; a negative one is blocked where it starts
};

}  // namespace umbrameter
