// The histogram of critical biases: one pass over the taps holds the exact error at every constant bias.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/parameters.h"
#include "techniques/shadow/causes.h"

namespace umbrameter {

__extension__ using WideCount = unsigned __int128;

/// The biases of an axis that one pass answers together.
struct BiasAxes {
  std::vector<float> constant;           ///< in `unit`, ascending, no two equal
  std::vector<float> slope;              ///< texels
  LengthUnit unit = LengthUnit::metres;  ///< metres, or texels as large as they are at the receiver
};

/// Taps that are wrong at some bias of the axis, counted by where they flip. A tap of bin k is lit from
/// constant[k] on and blocked below: bin 0 holds those lit at every bias, the last bin those blocked at every one.
struct BiasHistogram {
  struct Bin {
    std::array<std::uint64_t, cause_count> weights{};
    /// What the pixels' squared error has more on one side of the flip than on the other, and the largest error of a
    /// pixel on that side, in weights; [0] over pixels that the truth calls lit, [1] over blocked ones.
    std::array<WideCount, 2> squares{};
    std::array<std::uint32_t, 2> largest{};
    friend bool operator==(const Bin&, const Bin&) = default;
  };

  BiasAxes axes;
  std::uint32_t weight_sum = 1;
  std::vector<std::vector<Bin>> by_slope;  ///< for each slope bias, one bin more than there are constant biases
};

/// The constant bias in metres from which on a tap is lit. Not inline: other modules may be compiled to contract it.
float flip_of(float critical_bias, float slope, float slope_factor);

/// Metres that a constant bias of 1 is at a receiver where a texel's side is that long.
inline float bias_unit_of(LengthUnit unit, float texel) { return unit == LengthUnit::texels ? texel : 1.0f; }

/// Whether that bias lights a tap that flips at `flip` metres: the shaders' lights(). Not inline, as flip_of().
bool lights(float bias, float bias_unit, float flip);

/// The bin of BiasHistogram that a tap with that flip falls into: how many biases leave it blocked; all of them where
/// the flip is not a number. bias_unit is bias_unit_of() at the tap's receiver.
std::size_t bin_of(const BiasAxes& axes, float flip, float bias_unit);

}  // namespace umbrameter
