// Error of a shaded image against the traced one, with the share of each input of the technique.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "compare/sampled_error.h"
#include "core/gbuffer.h"
#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// The inputs of the technique's image that can be wrong, and what is left.
enum class ImageCause : std::uint8_t { shadows, ao, gbuffer, shading };
inline constexpr std::size_t image_cause_count = 4;
inline constexpr std::array<std::string_view, image_cause_count> image_cause_names = {"shadows", "ambient occlusion",
                                                                                      "G-buffer", "shading"};

/// Linear luminance (Rec. 709 weights) times the exposure.
struct ImageStatistics {
  SampledError error;
  double near_edges = 0.0;     ///< share of the pixels that are near a shadow edge of the reference
  double mae_off_edges = 0.0;  ///< mean absolute error of the others
  /// The part of the mean absolute error that goes when this input is replaced by the reference's. Parts can overlap or
  /// cancel, so they need not add up; below 0: the input hides the error of another one.
  std::array<double, image_cause_count> parts{};
  /// What the compact G-buffer changes, mean absolute difference.
  double gbuffer_visibility = 0.0;  ///< visibility, mean over pixels and lights
  double gbuffer_ao = 0.0;
  double gbuffer_image = 0.0;  ///< of the image, all else equal
};
Statistics describe(ImageStatistics& statistics);

/// Shadow edges farther away than this do not affect a pixel: a 3×3 kernel of texels as large as a pixel, and a bias.
inline constexpr double edge_reach_px = 3.0;

float luminance(const vec3& color);
Image<float> luminance(const Image<vec3>& image, float exposure);

/// The images with one input replaced by the reference's.
struct ImageErrorInput {
  const Image<float>& raster;
  SampledImage truth;
  std::array<const Image<float>*, image_cause_count> replaced;
  const Image<float>& edge_distance;  ///< px, to the nearest shadow edge of any light; infinite without one
  const GBuffer& gbuffer;
};

ImageStatistics analyze_image(const ImageErrorInput& input);

/// Per pixel the input whose replacement changes the error most; `none` where the error is below `threshold`, and on
/// the background.
inline constexpr std::uint8_t no_image_cause = image_cause_count;
Image<std::uint8_t> classify_image(const ImageErrorInput& input, float threshold);

}  // namespace umbrameter
