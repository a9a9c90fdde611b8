// Connected components of marked pixels: whether an error is one large patch or many specks.
#pragma once

#include <cstdint>
#include <vector>

#include "core/image.h"

namespace umbrameter {

/// Pixels of one mark that hang together over sides or corners (8-neighbourhood).
struct Component {
  std::uint8_t mark = 0;
  std::uint64_t pixels = 0;
  double weight = 0.0;    ///< sum of its pixels' weights
  double center_x = 0.0;  ///< mean of its pixels, px; it need not belong to it
  double center_y = 0.0;
};

/// In the order of each one's first pixel, row by row from the top; pixels of mark 0 belong to none. Images of one
/// size.
std::vector<Component> find_components(const Image<std::uint8_t>& marks, const Image<std::uint32_t>& weights);

/// What is told of the components of one mark; 0 where there is none.
struct ComponentStatistics {
  std::uint64_t count = 0;
  double mean_area = 0.0;          ///< px
  std::uint64_t largest_area = 0;  ///< px
  double largest_share = 0.0;      ///< of the weight of all of them, the part in the largest
  double largest_x = 0.0;          ///< its centre, px
  double largest_y = 0.0;
};

/// The largest has the most pixels; of several the first.
ComponentStatistics summarize(const std::vector<Component>& components, std::uint8_t mark);

}  // namespace umbrameter
