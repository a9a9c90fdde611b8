// Measures the ambient occlusion of many biases, numbers of samples and tones in one pass.
#pragma once

#include <vector>

#include "compare/ao.h"
#include "experiments/stages/stages.h"
#include "results/swept.h"

namespace umbrameter {

/// Values that replace those of an experiment, in any order, none of them empty.
struct AoCells {
  std::vector<float> biases;  ///< metres
  std::vector<int> samples;
  std::vector<double> intensities;
  std::vector<double> powers;
};

/// The error at every combination; powers vary fastest, then intensities, then numbers of samples. The experiment must
/// be one of is_ao_one_pass(); more than one number of samples needs a technique whose samples are a prefix.
std::vector<AoStatistics> measure_ao_axes(Stages& stages, const Experiment& experiment, const AoCells& cells);

}  // namespace umbrameter
