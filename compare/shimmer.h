// Shimmer: the change of a shadow when only the grid of the shadow map or the camera moves, by less than a texel or a
// pixel. Still images do not show it.
#pragma once

#include "compare/visibility.h"
#include "core/bounds.h"
#include "core/gbuffer.h"
#include "core/image.h"
#include "scenes/view.h"
#include "techniques/shadow/map_layout.h"

namespace umbrameter {

/// Moves the grid of a layout, so that positions in the centre of the map move by this many texels right and up.
/// Orthographic maps are translated; the others rotate about the light, a cube also by the same angle about the third
/// axis, which moves its side faces. `bounds` must be those that the layout was fitted to: they give the new depth
/// range, because a rotated spot light may see farther.
MapLayout shift_grid(const MapLayout& layout, const dvec2& texels, const Bounds& bounds);

/// Rotates the view, or translates an orthographic one, so that a pixel in the centre of the image sees what was this
/// many pixels to its right and below it.
View shift_view(const View& view, const dvec2& pixels);

/// The change between two visibility images.
struct Flips {
  std::uint64_t pixels = 0;  ///< number of compared pixels
  double share = 0.0;        ///< mean of |after − before| over the compared pixels
};

/// Compares the counted pixels.
Flips count_flips(const Image<float>& before, const Image<float>& after, const CountedPixels& counted);

/// Compares the counted pixels that see the same triangle before and after.
Flips count_flips(const Image<float>& before, const Image<float>& after, const CountedPixels& counted,
                  const GBuffer& gbuffer_before, const GBuffer& gbuffer_after);

}  // namespace umbrameter
