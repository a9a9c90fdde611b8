// Measures the shaded image: the technique's, the traced one, their difference, and which input causes it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/image_error.h"
#include "experiments/metric_scores.h"
#include "experiments/stages.h"
#include "raster/shading/shading_pass.h"

namespace umbrameter {

struct ImageMeasurement {
  Experiment experiment;  ///< the parameters of this measurement
  std::vector<std::uint32_t> lights;
  std::optional<ShadedImage> raster;
  std::optional<Image<vec3>> truth;           ///< linear, without exposure
  Image<float> standard_error;                ///< of the truth's luminance × exposure; empty if nothing was sampled
  std::optional<ImageStatistics> statistics;  ///< if raster and truth are present
  std::vector<MetricScore> metrics{};  ///< of run.metrics, of the displayed image; if raster and truth are present
  Image<std::uint8_t> causes;          ///< classify_image(); if raster and truth are present
  /// What the compact G-buffer changes, G-buffer − exact; of the deferred path, if raster and truth are present.
  struct GBufferChange {
    std::vector<Image<float>> visibility;  ///< per light
    Image<float> ao;
    Image<float> image;  ///< luminance × exposure
  };
  std::optional<GBufferChange> gbuffer_change;
};

/// Errors below this step of an 8-bit image have no cause in ImageMeasurement::causes.
inline constexpr float visible_step = 1.0f / 255.0f;

/// Throws Error (usage) if the deferred path would have to shade transparent materials.
void check_shading(const Stages& stages, const Experiment& experiment);

/// Draws and shades only the required sides, by these lights.
ImageMeasurement measure_image(Stages& stages, const Experiment& experiment, std::span<const std::uint32_t> lights,
                               Sides sides);

}  // namespace umbrameter
