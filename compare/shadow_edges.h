// Finds the shadow edges of a visibility image, and the distance of every pixel to the nearest edge. Silhouettes, where
// a near surface ends in front of a far one, are not shadow edges.
#pragma once

#include <cstdint>

#include "compare/visibility.h"
#include "core/gbuffer.h"
#include "core/image.h"

namespace umbrameter {

/// The edge between a pixel and its neighbour: 2 · pixel for the neighbour on the right, 2 · pixel + 1 for that below.
using EdgeId = std::uint32_t;

struct EdgePixels {
  std::size_t first = 0;
  std::size_t second = 0;
};
inline EdgePixels pixels_of(EdgeId edge, int image_width) {
  const std::size_t first = edge / 2;
  return {first, first + (edge % 2 == 0 ? 1 : static_cast<std::size_t>(image_width))};
}

/// The midpoint of the two surfels; world, metres.
dvec3 position_of(EdgeId edge, const GBuffer& gbuffer);

/// Bit 0: an edge to the right of the pixel; bit 1: one below it.
struct ShadowEdges {
  Image<std::uint8_t> bits;
  std::uint64_t count = 0;
};

/// Whether two neighbouring pixels see the same surface without a depth discontinuity: they see the same instance, and
/// the line between the surfels is within 45° of both tangent planes. At a discontinuity this line is nearly parallel
/// to the view direction.
bool is_one_surface(const GBuffer& gbuffer, std::size_t pixel, std::size_t neighbour);

/// Finds edges between neighbouring pixels that are on one surface and both counted, and of which one is lit
/// (visibility ≥ ½) and the other is not. The images have the same size and fewer than 2³¹ pixels.
ShadowEdges find_shadow_edges(const Image<float>& visibility, const GBuffer& gbuffer, const CountedPixels& counted);

struct NearestEdges {
  Image<float>
      distance;        ///< px, from a pixel's centre to the middle between an edge's two pixels; infinite without one
  Image<EdgeId> edge;  ///< the nearest in the image; no_id if there is no edge
};

/// The exact Euclidean distance transform (Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012).
NearestEdges nearest_edges(const ShadowEdges& edges);

}  // namespace umbrameter
