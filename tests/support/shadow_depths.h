// Depths of a shadow map in metres.
#pragma once

#include <limits>
#include <vector>

#include "techniques/shadow/map_layout.h"

namespace umbrameter::test {

/// Of each face, as depth_of(); infinity where the light meets nothing.
inline std::vector<Image<float>> to_metres(const ShadowMapImages& images, const MapLayout& layout) {
  std::vector<Image<float>> faces = images.depth;
  for (Image<float>& face : faces) {
    for (float& depth : face.pixels) {
      depth = depth < 1.0f ? static_cast<float>(static_cast<double>(depth) * layout.far_depth)
                           : std::numeric_limits<float>::infinity();
    }
  }
  return faces;
}

}  // namespace umbrameter::test
