// Connected components of marked pixels: whether an error is one large patch or many specks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace umbrameter {

/// Pixels with the same mark that touch at a side or a corner (8-neighbourhood).
struct Component {
  std::uint8_t mark = 0;
  std::uint64_t pixels = 0;
  double weight = 0.0;    ///< sum of its pixels' weights
  double center_x = 0.0;  ///< mean of its pixels, px; may lie outside the component
  double center_y = 0.0;
};

/// All components, in the order of their first pixels, row by row from the top. Pixels with mark 0 belong to none. The
/// images have the same size.
std::vector<Component> find_components(const Image<std::uint8_t>& marks, const Image<std::uint32_t>& weights);

/// Statistics of the components with one mark; 0 if there are none.
struct ComponentStatistics {
  std::uint64_t count = 0;
  double mean_area = 0.0;          ///< px
  std::uint64_t largest_area = 0;  ///< px
  double largest_share = 0.0;      ///< share of the total weight that is in the largest component
  double largest_x = 0.0;          ///< its centre, px
  double largest_y = 0.0;
};

/// The largest component is the one with the most pixels; among several, the first.
ComponentStatistics summarize(const std::vector<Component>& components, std::uint8_t mark);

}  // namespace umbrameter
