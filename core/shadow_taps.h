// What a shadow map's taps are counted by: the filter's weights, the causes of wrong taps, and the histogram of the
// biases at which taps flip. Whole numbers throughout, so that sums do not depend on their order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/image.h"
#include "core/math.h"
#include "core/parameters.h"

namespace umbrameter {

/// Why a tap is wrong, in the order of every array over causes.
enum class Cause : std::uint8_t { acne, false_occlusion, peter_panning, light_leak };
inline constexpr std::size_t cause_count = 4;
/// As columns and keys write them.
inline constexpr std::array<std::string_view, cause_count> cause_names = {"acne", "false_occlusion", "peter_panning",
                                                                          "leak"};

/// The weights of each pixel's wrong taps by cause, x to w in Cause's order. All taps of a pixel weigh weight_sum.
struct WrongTaps {
  Image<uvec4> weights;
  std::uint32_t weight_sum = 1;
};

/// A point of a triangle.
struct SurfacePoint {
  dvec3 in_light{0.0};  ///< light space, metres
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
};

/// What a tap compares: the receiver, and the point that the map holds in the tap's texel.
struct TapSurfaces {
  SurfacePoint receiver;
  SurfacePoint sample;
};

/// A wrong tap of a pixel that the truth calls lit, whose sample the two-plane rule takes for another surface. Laid out
/// as shaders/foreign_taps.comp writes it.
struct ForeignTap {
  std::uint32_t pixel = 0;  ///< x, and y from the bottom in the upper half
  std::uint32_t texel = 0;  ///< x, and y from the bottom in the upper half
  std::uint32_t face = 0;
  std::uint32_t weight = 0;
  float critical_bias = 0.0f;  ///< metres
  float slope = 0.0f;          ///< of the pixel: texel size times tan of the angle to the light, metres
  float bias_unit = 1.0f;      ///< of the pixel: metres that a constant bias of 1 is there
  std::uint32_t instance = 0;  ///< of the sample
  std::uint32_t triangle = 0;
};

/// A shadow map in memory, one image a face, top row (v = 1) first.
struct ShadowMapImages {
  std::vector<Image<float>> depth;  ///< as stored: a share of LightFrame::far_depth; 1 where the light meets nothing
  std::vector<Image<std::uint32_t>> instance;
  std::vector<Image<std::uint32_t>> triangle;
};

/// What a filter's taps weigh. Grid: the outer product of `kernel` with itself about the receiver's texel, every tap a
/// nearest one or, with linear_taps, the four that a bilinear comparison reads. Disk: texels under `points`, turned per
/// pixel by one of `turns`, of weight 1 each.
struct FilterKernel {
  /// Parts of a texel to which a bilinear tap's place is rounded, as graphics hardware does (eight bits).
  static constexpr std::uint32_t texel_parts = 256;
  /// Taps along a side of a grid: with the next odd size a tent of linear taps outweighs 32 bits.
  static constexpr int largest_size = 29;

  std::vector<std::uint32_t> kernel;  ///< of a grid: whole weights along one side, an odd number of them
  bool linear_taps = false;
  std::vector<vec2> points;  ///< of a disk: within the unit disk; empty for a grid
  std::vector<vec2> turns;   ///< of a disk: cosine and sine
  float radius = 0.0f;       ///< of a disk, texels

  bool is_grid() const { return points.empty(); }
  /// Texels along a side of a grid.
  int side() const { return static_cast<int>(kernel.size()) + (linear_taps ? 1 : 0); }
  int tap_count() const { return is_grid() ? side() * side() : static_cast<int>(points.size()); }
  std::uint32_t weight_sum() const {
    if (!is_grid()) return static_cast<std::uint32_t>(points.size());
    std::uint32_t sum = 0;
    for (const std::uint32_t weight : kernel) sum += weight;
    if (linear_taps) sum *= texel_parts;
    return sum * sum;
  }
};

/// A tent, the heaviest kernel, weighs ((n + 1)/2)² along a side.
constexpr std::uint64_t largest_weight_sum(std::uint64_t size) {
  const std::uint64_t side = (size + 1) / 2 * ((size + 1) / 2) * FilterKernel::texel_parts;
  return side * side;
}
static_assert(largest_weight_sum(FilterKernel::largest_size) < std::uint64_t{1} << 32);

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

}  // namespace umbrameter
