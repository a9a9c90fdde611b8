// Measures the shimmer of one light's shadow in a run.
#pragma once

#include "results/shadow_shape.h"

namespace umbrameter {

struct GpuGBuffer;
struct ShadowMeasurement;
class Stages;

/// The visibility of the measured technique from a map that is drawn with this layout, at these surfels, which `view`
/// sees.
Image<float> draw_visibility_with(Stages& stages, const ShadowMeasurement& shadow, const MapLayout& layout,
                                  const GpuGBuffer& surfels, const View& view);

/// Draws the map and the visibility again for four moves of the map's grid and four of the camera.
Shimmer measure_shimmer(Stages& stages, const ShadowMeasurement& shadow);

}  // namespace umbrameter
