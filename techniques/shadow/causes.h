// Why a shadow map's tap is wrong, and the records in which wrong taps are counted. Whole numbers throughout, so that
// sums do not depend on their order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/image.h"
#include "core/math.h"

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
/// as shaders/unresolved_taps.comp writes it.
struct UnresolvedTap {
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

}  // namespace umbrameter
