// Shadow error, against a binary reference, of a technique that does not sum depth comparisons. Such a technique has no
// taps that could be wrong, so the error is split by sign and by distance to the reference's shadow edges.
#pragma once

#include <cstdint>

#include "compare/error_shape.h"
#include "core/statistics.h"

namespace umbrameter {

/// All shares are of the counted pixels, 0 to 1; mae is the sum of the four parts. At an edge: EdgeDistances::at_edge.
struct EdgeStatistics {
  std::uint64_t pixels = 0;  ///< counted: facing the light, inside its map, cone and range
  double lit = 0.0;          ///< share that is lit in the reference
  double blocked = 0.0;      ///< share that is blocked in the reference
  double mae = 0.0;          ///< mean |technique − reference|
  double rmse = 0.0;         ///< root of the mean of (technique − reference)²
  double mean_error = 0.0;   ///< mean of technique − reference: below 0 too dark, above 0 too bright
  double max_error = 0.0;    ///< largest |technique − reference|
  int max_x = -1;            ///< where it is first, row by row from the top, px; −1 without an error
  int max_y = -1;
  double too_dark_away = 0.0;       ///< the analogue of acne
  double too_dark_at_edge = 0.0;    ///< blur, false occlusion
  double too_bright_at_edge = 0.0;  ///< blur, peter-panning
  double too_bright_away = 0.0;     ///< light bleeding
  double mean_texel = 0.0;          ///< mean side of a texel at the counted surfels, metres
};
Statistics describe(EdgeStatistics& statistics);

/// `shape` must be the result of analyze_error_shape(input, technique).
EdgeStatistics analyze_edges(const ShapeInput& input, const Image<float>& technique, const ErrorShape& shape);

}  // namespace umbrameter
