// Error of a shaded image against the traced one, and how much of it each input of the technique causes.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "compare/sampled_error.h"
#include "core/gbuffer.h"
#include "core/image.h"
#include "core/math.h"

namespace umbrameter {

/// What can be wrong with the technique's image: three of its inputs, and the GPU's evaluation of the light model.
/// Arrays over causes and the numbers of classify_image() have this order.
inline constexpr std::size_t image_cause_count = 4;
inline constexpr std::array<std::string_view, image_cause_count> image_cause_names = {"shadows", "ambient occlusion",
                                                                                      "G-buffer", "shading"};

/// Statistics of linear luminance × exposure over the pixels that see a surface.
struct ImageStatistics {
  SampledError error;
  double near_edges = 0.0;     ///< share of the pixels within edge_reach_px of an edge of a hard shadow
  double mae_off_edges = 0.0;  ///< mean absolute error of the others
  /// By how much the mean absolute error falls if this input is replaced by the reference's. Parts can overlap or
  /// cancel, so they need not add up. A negative part hides the error of another input.
  std::array<double, image_cause_count> parts{};
  // Mean absolute differences between the results for the compact G-buffer's surfels and for the exact ones.
  double gbuffer_visibility = 0.0;  ///< of visibility, over pixels and lights
  double gbuffer_ao = 0.0;          ///< of accessibility
  double gbuffer_image = 0.0;       ///< of the image
};
Statistics describe(ImageStatistics& statistics);

/// How far a shadow edge affects pixels, if texels are as large as pixels: the reach of a 3×3 kernel and a bias.
inline constexpr double edge_reach_px = 3.0;

/// Luminance × exposure.
Image<float> luminance(const Image<vec3>& image, float exposure);

/// The images of a comparison, as luminance × exposure.
struct ImageErrorInput {
  const Image<float>& raster;
  SampledImage truth;
  std::array<const Image<float>*, image_cause_count> replaced;  ///< for each cause: `raster` without it
  const Image<float>& edge_distance;  ///< px, to the nearest edge of any light's hard shadow; infinite without one
  const GBuffer& gbuffer;
};

ImageStatistics analyze_image(const ImageErrorInput& input);

inline constexpr std::uint8_t no_image_cause = image_cause_count;

/// For each pixel the cause whose replacement changes the image most; no_image_cause if the error is below `threshold`,
/// and on the background.
Image<std::uint8_t> classify_image(const ImageErrorInput& input, float threshold);

}  // namespace umbrameter
