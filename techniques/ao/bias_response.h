// The response of hemisphere SSAO to its bias: for each sample, how many biases of an axis it passes. A sample occludes
// up to a critical bias and at none above, so that one pass holds the result at every bias; in a progressive kernel
// also at every smaller number of samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "techniques/ao/tone.h"

namespace umbrameter {

/// A sample that occludes at the first `biases` values of the axis.
struct OccludingSample {
  std::uint32_t bits = 0;  ///< index of the sample in the upper 10 bits, number of biases in the lower 22
  float weight = 0.0f;     ///< that it adds to the occlusion

  int index() const { return static_cast<int>(bits >> 22u); }
  std::uint32_t biases() const { return bits & 0x3fffffu; }
};

/// The axes that one pass measures.
struct AoAxes {
  std::vector<float> biases;  ///< metres, ascending, each once
  std::vector<int> samples;   ///< ascending, each once
  std::vector<AoToneParams> tones;

  std::size_t cells() const { return biases.size() * samples.size() * tones.size(); }
};

/// The occluding samples of one row of the image, in the order of their index in each pixel.
struct AoResponseRow {
  int y = 0;                                   ///< from the top
  int samples = 0;                             ///< room for each pixel in `occluding`
  std::span<const std::uint32_t> counts;       ///< of each pixel
  std::span<const OccludingSample> occluding;  ///< pixel x from x · samples on

  std::span<const OccludingSample> pixel(std::size_t x) const {
    return occluding.subspan(x * static_cast<std::size_t>(samples), counts[x]);
  }
};

}  // namespace umbrameter
