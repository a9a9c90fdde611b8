// Half floats as small integers that deflate well: each is predicted from its neighbours, and what remains is stored.
// The page's script undoes it (viewer/planes.ts).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace umbrameter {

using Words = std::vector<std::uint16_t>;

enum class Predictor {
  none,        ///< 0
  paeth,       ///< PNG specification (third edition), 9.4: left, above or upper left, whichever is nearest to gradient
  gradient,    ///< left + above − upper left
  difference,  ///< a given number for each pixel
};
inline constexpr const char* predictor_names[] = {"none", "paeth", "gradient", "difference"};

/// Integers of `bits` bits in the order of the values whose half floats have these bits, without the lowest 16 − bits.
Words ordered(const Words& halves, int bits);

/// ordered() of the differences of half floats; 0 where these are no numbers.
Words ordered_differences(const Words& from, const Words& take);

/// Bytes of what the prediction misses of images whose rows have `columns` pixels, modulo 2^bits, with alternating
/// signs: 0, −1, 1, −2, … . Of several channels each after the first is less what is missed of the channel before it.
/// Without prediction the two bytes of all channels stand together, else all low bytes come before all high ones.
std::string residual_bytes(const std::vector<Words>& channels, int columns, int bits, Predictor predictor,
                           const Words& given = {});

}  // namespace umbrameter
