// Projection to a shadow map on the CPU. With IEEE 754 arithmetic the results are bit-identical to those of
// light_map.glsl.
#pragma once

#include <optional>

#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The view of a cube or paraboloid map that sees a direction.
int face_of(MapKind kind, const dvec3& direction);

/// In the frame of the view; z: what the position on the map is divided by, metres.
dvec3 on_face(MapKind kind, int face, const dvec3& p);

/// Where a position falls on the map.
struct Receiver {
  dvec3 in_light{0.0};      ///< light space, metres
  double depth = 0.0;       ///< metres; see MapLayout
  double axis_depth = 0.0;  ///< metres along the axis of the map or face; paraboloid: plus the radial distance
  dvec2 texels{0.0};        ///< position in texels from the map's lower left corner
  ivec2 texel{0};
  int view = 0;
  bool is_inside = false;
  dvec3 plane{0.0};  ///< geometric normal in light space
};
/// dither: threshold of the pixel for blended cascades, dither_at(); 0: no blending.
Receiver project_to_map(const MapLayout& layout, const dvec3& world, double dither = 0.0);

/// The light's ray through a texel's centre, in light space. The direction is not normalised.
struct TexelRay {
  dvec3 origin{0.0};
  dvec3 direction{0.0, 0.0, -1.0};
};
TexelRay texel_ray(const MapLayout& layout, const ivec2& texel, int view);

/// Depth at which the light's ray through a texel's centre meets the plane of a receiver, metres. Empty if it does not
/// meet its front. The texel may lie outside the map.
std::optional<double> plane_depth(const MapLayout& layout, const Receiver& receiver, const ivec2& texel, int view);

}  // namespace umbrameter
