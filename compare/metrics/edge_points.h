// Where the edges of a reference are in another image, and how soft they are. Error metrics favour the image that is
// nearest on average, which a blurred edge is not; these say whether edges are in place, straight and as wide as they
// should be.
#pragma once

#include <cstddef>
#include <vector>

#include "compare/metrics/metric.h"

namespace umbrameter {

/// A place where an edge of the reference crosses a row of pixels or, where it is nearer to horizontal, a column.
///
/// The light under a profile across the edge gives its place: an edge moves by the difference of the two sums over the
/// row, times the cosine of its slope. That is exact for images whose pixels are means over their area, at any angle
/// and softness; for symmetric penumbrae it is the place of the 50 % contour. Points where either image does not reach
/// both plateaus (0.1 and 0.9) within 32 pixels, or where another edge or an uncounted pixel is nearer, are not found;
/// nor are those of edges too short to have a slope.
struct EdgePoint {
  std::size_t pixel = 0;  ///< index in the images, of the pixel before the crossing
  bool is_found = false;
  double displacement = 0.0;     ///< px across the edge; above 0 the dark side is larger in the test image
  double width = 0.0;            ///< px: width of a linear ramp with the slope of the penumbra's middle
  double reference_width = 0.0;  ///< px
  dvec2 tangent{0.0};            ///< of the edge, unit, px, y down; 0 if not found
  std::size_t edge = 0;          ///< points of one connected edge, crossed in one direction, have the same number
};

/// All points of the reference's edges, in a fixed order.
std::vector<EdgePoint> find_edge_points(const MetricInput& input);

}  // namespace umbrameter
