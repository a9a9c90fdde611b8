// How much one light's shadow shimmers in a run.
#pragma once

#include <optional>

#include "compare/shimmer.h"

namespace umbrameter {

struct ShadowMeasurement;
class Stages;

struct Shimmer {
  double grid_mean = 0.0;     ///< share of the counted pixels, over the moves of the map's grid
  double grid_largest = 0.0;  ///< the same, of the worst move
  Flips camera;               ///< mean over the moves of the camera
  /// What the truth itself changed at the pixels of the same moves; of a light without extent.
  std::optional<Flips> camera_truth;
};

/// Draws the map and the visibility anew for four moves of the map's grid and four of the camera.
Shimmer measure_shimmer(Stages& stages, const ShadowMeasurement& shadow);

}  // namespace umbrameter
