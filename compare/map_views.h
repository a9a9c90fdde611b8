// Statistics of the views of a shadow map, its cascades or cube faces: the error at the pixels that each view serves,
// the seams between views, and the shimmer of areas that follow the camera.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "compare/error_shape.h"
#include "core/statistics.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

/// The error at the counted pixels that look up one view, as shares of these pixels. Causes are NaN if the error has
/// none.
struct ViewStatistics {
  std::uint64_t view = 0;    ///< index, the finest cascade first
  std::uint64_t pixels = 0;  ///< counted pixels that look it up
  double share = 0.0;        ///< of all counted pixels
  double mean_texel = 0.0;   ///< metres
  double mae = 0.0;
  double mean_error = 0.0;
  std::array<double, cause_count> causes{};
};
Statistics describe(ViewStatistics& statistics);

/// One entry for each view. `wrong` holds the causes, or is nullptr if the error has none. A normal offset does not
/// change which view a pixel is counted for.
std::vector<ViewStatistics> analyze_views(const ShapeInput& input, const Image<float>& drawn, const WrongTaps* wrong);

/// Width of the zone along a cascade's border where seams are measured, as a share of the cascade's extent.
inline constexpr double seam_zone = 0.1;

/// The counted pixels near a border between two views whose position both views hold; 1 for these. At a cascade's
/// border the zone is the outer seam_zone of the finer cascade's extent, at the edges of a cube's
/// faces or of paraboloids one texel wide.
Image<std::uint8_t> find_seams(const GBuffer& gbuffer, const MapLayout& layout, const CountedPixels& counted);

/// The difference between two views at the same surfels: the step that is seen where one view ends.
struct SeamStatistics {
  std::uint64_t pixels = 0;      ///< compared pixels
  double share = 0.0;            ///< of the counted pixels
  double mean_difference = 0.0;  ///< mean |visibility from the neighbour − from the pixel's own view|
  double largest_difference = 0.0;
};
Statistics describe(SeamStatistics& statistics);

/// `own` and `neighbour` are the visibility from each pixel's view without blending, and from the view beside it.
SeamStatistics analyze_seams(const Image<std::uint8_t>& seams, const Image<float>& own, const Image<float>& neighbour,
                             const CountedPixels& counted);

/// The change of visibility at the same surfels when the map is fitted for a camera that moved. The reference does not
/// change.
struct FitShimmer {
  double step = 0.0;         ///< metres
  std::uint64_t pixels = 0;  ///< compared pixels, over all moves
  double mean_change = 0.0;
  double largest_change = 0.0;  ///< mean of the worst move
};
Statistics describe(FitShimmer& shimmer);

}  // namespace umbrameter
