// Draws cells of a sweep that differ only in what the look-up reads, many in one pass. The evaluator then measures them
// one by one.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiments/settings/sweep.h"
#include "experiments/stages/stages.h"

namespace umbrameter {

class LookAhead {
 public:
  /// The technique's visibility at the cell with these values of the axes; the same to the bit as that of
  /// Stages::draw(). Draws the cells beside it along the axes of lookup_parameters() in the same pass, and keeps them.
  Image<float> visibility(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                          const std::vector<Value>& values);

 private:
  std::string drawn_;  // the values of the other axes, and the number of the pass
  std::vector<Image<float>> images_;
};

}  // namespace umbrameter
