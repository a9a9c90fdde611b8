// Proof that a frame of another renderer shows the same surfaces, at the same pixels, as our own primary rays hit. Each
// way in which frames of different programs usually differ is tried and named.
#pragma once

#include <cstdint>
#include <string>

#include "core/gbuffer.h"
#include "scenes/depth_convention.h"
#include "scenes/view.h"

namespace umbrameter {

/// Where a frame says that surfaces are: positions, or depths. NaN where it shows none; row 0 is the top row.
struct FrameSurfaces {
  Image<vec3> position{};  ///< world, metres; empty: depth
  Image<float> depth{};
  DepthConvention convention = DepthConvention::axis;
  double near_plane = 0.0;  ///< of the camera that wrote the depths, metres; 0: the view's
  double far_plane = 0.0;
};

/// World positions at the pixels' centres; NaN where the frame shows no surface in front of the camera.
Image<vec3> positions_of(const FrameSurfaces& frame, const View& view);

/// How well a frame's surfaces fit ours. A pixel has a partner if both show a surface, or neither; and the frame's
/// position is seen at most partner_distance pixels from the pixel's centre and lies as near to the plane of our
/// triangle, measured in pixels at that distance.
struct FrameAlignment {
  std::uint64_t surfaces = 0;   ///< pixels at which the frame or we see a surface
  std::uint64_t unmatched = 0;  ///< of these, without a partner
  dvec2 shift{0.0};           ///< the frame's content lies so many pixels to the right of and below ours; NaN: unknown
  double median_error = 0.0;  ///< where both show a surface, pixels; infinite if that is nowhere in front of the camera
  /// What would have to be undone so that the frame fits, for people: "rows begin at the bottom"; empty: nothing known
  /// helps, or nothing is wrong.
  std::string remedy;
  double unmatched_with_remedy = 0.0;  ///< share, 0 to 1

  double share_unmatched() const {
    return surfaces > 0 ? static_cast<double>(unmatched) / static_cast<double>(surfaces) : 0.0;
  }
  bool fits() const;
};

inline constexpr double partner_distance = 0.25;  ///< pixels
/// A frame with a larger share of unmatched pixels, or a larger consistent shift, does not fit. Silhouettes of a street
/// of houses are 5 % of a picture of 480 × 270 pixels.
inline constexpr double most_unmatched = 0.1;
inline constexpr double most_shift = 0.05;  ///< pixels

/// The images have the view's size. Where the frame does not fit, looks for the remedy: exchanged rows or columns, a
/// shift, another kind of depth, exchanged or negated axes, and usual units of length.
FrameAlignment align_frame(const FrameSurfaces& frame, const GBuffer& gbuffer, const View& view);

/// Why the frame does not fit, as a clause for a message.
std::string misfit_text(const FrameAlignment& alignment);

/// Our surfels, moved to the frame's positions in the planes of their triangles. Pixels without a partner become
/// background.
GBuffer surfels_of_frame(const FrameSurfaces& frame, const GBuffer& gbuffer, const View& view);

}  // namespace umbrameter
