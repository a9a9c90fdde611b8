// The histogram of critical biases: one pass over the taps gives the exact error at every constant bias.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/image.h"
#include "core/parameters.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

__extension__ using WideCount = unsigned __int128;

/// The biases that one pass measures together.
struct BiasAxes {
  std::vector<float> constant;           ///< in `unit`, strictly ascending
  std::vector<float> slope;              ///< texels
  LengthUnit unit = LengthUnit::metres;  ///< metres, texels at the receiver, or the map's depth
};

/// The taps that are wrong at some bias of the axis, binned by the bias at which they flip. A tap of bin k is lit at
/// constant[k] and above, blocked below. Bin 0 holds taps that are lit at every bias, the last bin taps that are
/// blocked at every bias.
struct BiasHistogram {
  struct Bin {
    std::array<std::uint64_t, cause_count> weights{};
    /// When the taps of this bin become wrong: the increase of the pixels' summed squared error, and the largest error
    /// of a pixel from then on, both in weights. [0]: pixels that are lit in the reference, [1]: blocked ones.
    std::array<WideCount, 2> squares{};
    std::array<std::uint32_t, 2> largest{};
    friend bool operator==(const Bin&, const Bin&) = default;
  };

  BiasAxes axes;
  std::uint32_t weight_sum = 1;
  std::vector<std::vector<Bin>> by_slope;  ///< for each slope-scaled bias: constant.size() + 1 bins
};

/// Where the tap of each pixel flips, for techniques with one tap per pixel. It gives the image of causes at every bias
/// of the axis.
struct TapFlips {
  BiasAxes axes;  ///< one slope-scaled bias
  /// 0: not counted, or correct at every bias of the axis. Otherwise 1 + the bin of BiasHistogram: the tap is lit at
  /// constant[bin - 1] and above, blocked below.
  Image<std::uint16_t> bin;
  Image<Cause> cause;  ///< of the error, where bin is not 0
};

/// The smallest constant bias, in metres, at which a tap is lit. Not inline: the compiler options of other modules may
/// allow contraction to a fused multiply-add.
float flip_bias(float critical_bias, float slope, float slope_factor);

/// Whether a tap that flips at `flip` metres is lit at this bias. The shaders have the same function. Not inline, like
/// flip_bias().
bool is_lit_at(float bias, float bias_unit, float flip);

/// The bin of BiasHistogram for a tap with this flip: the number of biases at which the tap is blocked. If the flip is
/// NaN, that is all of them. bias_unit: metres per unit of constant bias at the
/// tap's receiver.
std::size_t bias_bin(const BiasAxes& axes, float flip, float bias_unit);

}  // namespace umbrameter
