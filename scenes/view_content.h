// What a camera sees of a scene, roughly and fast: for choosing a view, never for measuring.
#pragma once

#include "scenes/triangle_sample.h"

namespace umbrameter {

/// Shares are of the image, 0 to 1. A back face is one of a material that is not double-sided: the camera looks through
/// it.
struct ViewContent {
  double seen = 0.0;     ///< shows a surface
  double behind = 0.0;   ///< has a back face before all that it shows
  double front = 0.0;    ///< its nearest triangle, whatever its material, turns its front to the camera
  double lit = 0.0;      ///< shows a surface, from the side that faces a light
  double cut = 0.0;      ///< has a surface between the eye and the near plane
  double variety = 0.0;  ///< entropy of the surfaces that are shown by their pixels, nats; 0 when it is one plane

  /// Share of the pixels with any triangle whose nearest one is a back face.
  double behind_of_covered() const { return covered > 0.0 ? behind / covered : 0.0; }
  double covered = 0.0;  ///< shows a surface or a back face
};

/// Draws the sample into a depth buffer of about 2000 pixels. `aspect` is width by height.
ViewContent look(const TriangleSample& sample, const Camera& camera, double aspect);

}  // namespace umbrameter
