// Shimmer: how much of a shadow changes when nothing but the shadow map's grid or the camera moves, by less than a
// texel or a pixel. Still pictures do not show it.
#pragma once

#include "compare/visibility.h"
#include "core/bounds.h"
#include "core/gbuffer.h"
#include "core/image.h"
#include "scenes/view.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// The frame with its grid moved, so that in the middle of the map positions fall that many texels to the right and up.
/// Orthographic maps move, the others turn about the light; a cube's side faces by as much about the third axis, too.
/// `bounds` are those that the frame was fitted to: what a spot's axis turns to may be deeper than before.
MapLayout shift_grid(const MapLayout& frame, const dvec2& texels, const Bounds& bounds);

/// The view turned, an orthographic one moved, so that in the middle of the image a pixel sees what lay that many
/// pixels to the right and down.
View shift_view(const View& view, const dvec2& pixels);

/// What changed between two images of visibility.
struct Flips {
  std::uint64_t pixels = 0;  ///< compared
  double share = 0.0;        ///< mean of |after − before| over them
};

/// Over the counted pixels.
Flips count_flips(const Image<float>& before, const Image<float>& after, const CountedPixels& counted);

/// Over the counted pixels that see the same triangle in both.
Flips count_flips(const Image<float>& before, const Image<float>& after, const CountedPixels& counted,
                  const GBuffer& gbuffer_before, const GBuffer& gbuffer_after);

}  // namespace umbrameter
