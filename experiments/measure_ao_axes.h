// Measures the ambient occlusion of many biases, numbers of samples and tones in one pass.
#pragma once

#include <string_view>
#include <vector>

#include "compare/ao.h"
#include "experiments/stages.h"

namespace umbrameter {

inline constexpr std::string_view ao_bias_key = "ao.bias";
inline constexpr std::string_view ao_samples_key = "ao.samples";
inline constexpr std::string_view ao_intensity_key = "ao.intensity";
inline constexpr std::string_view ao_power_key = "ao.power";

/// Values that replace those of an experiment, in any order, none of them empty.
struct AoCells {
  std::vector<float> biases;  ///< metres
  std::vector<int> samples;
  std::vector<double> intensities;
  std::vector<double> powers;
};

/// Whether one pass measures every bias, intensity and power: the technique's samples flip at the bias, and no blur
/// or upsampling follows it.
bool is_ao_one_pass(const AoParams& params);

/// The error at every combination; powers vary fastest, then intensities, then numbers of samples. The experiment must
/// be one of is_ao_one_pass(); more than one number of samples needs a technique whose samples are a prefix.
std::vector<AoStatistics> measure_ao_axes(Stages& stages, const Experiment& experiment, const AoCells& cells);

}  // namespace umbrameter
