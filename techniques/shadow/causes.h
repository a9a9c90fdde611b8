// The causes of wrong taps, and the structs that count wrong taps. All counts are integers, so that sums do not depend
// on their order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// Why a tap is wrong. Every array over causes has this order.
enum class Cause : std::uint8_t { acne, false_occlusion, peter_panning, light_leak };
inline constexpr std::size_t cause_count = 4;
/// Names in columns and keys.
inline constexpr std::array<std::string_view, cause_count> cause_names = {"acne", "false_occlusion", "peter_panning",
                                                                          "leak"};

/// The weight of each pixel's wrong taps by cause; x to w are in the order of Cause. The weights of all taps of a pixel
/// add up to weight_sum.
struct WrongTaps {
  Image<uvec4> weights;
  std::uint32_t weight_sum = 1;
};

/// What a technique draws.
struct RasterVisibility {
  Image<float> visibility;  ///< 1 lit, 0 blocked; back-facing: 0; background and outside the map: 1
  /// 0 on background, on back-facing surfels, where the truth is below 0, and everywhere if there is no truth. For a
  /// binary truth, the sum of a pixel's weights divided by weight_sum is |visibility − truth|.
  WrongTaps wrong;
};

/// A point of a triangle.
struct SurfacePoint {
  dvec3 in_light{0.0};  ///< light space, metres
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
};

/// The two points that a tap compares: the receiver, and the sample in the tap's texel.
struct TapSurfaces {
  SurfacePoint receiver;
  SurfacePoint sample;
};

/// A wrong tap whose sample lies on another surface by the two-plane rule: false occlusion if the pixel is lit in the
/// reference, peter-panning otherwise. The memory layout is that of shaders/unresolved_taps.comp.
struct UnresolvedTap {
  std::uint32_t pixel = 0;  ///< x, and y from the bottom in the upper half
  std::uint32_t texel = 0;  ///< x, and y from the bottom in the upper half
  std::uint32_t view = 0;
  std::uint32_t weight = 0;
  float critical_bias = 0.0f;  ///< metres
  float slope = 0.0f;          ///< of the pixel: texel size · tan θ, metres
  float bias_unit = 1.0f;      ///< of the pixel: metres per unit of constant bias
  std::uint32_t instance = 0;  ///< of the sample
  std::uint32_t triangle = 0;
};

}  // namespace umbrameter
