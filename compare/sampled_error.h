// Error against a sampled reference, over any pixels, with the intervals that the sampling leaves.
// What the quantity is called and which pixels count is the caller's business.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/statistics.h"

namespace umbrameter {

struct SampledError {
  std::uint64_t pixels = 0;
  double mean_raster = 0.0;
  Estimate mean_truth;
  Estimate mean_error;  ///< raster − truth: below 0 too dark, above 0 too bright
  Estimate mae;   ///< mean |raster − truth|; the noise of the truth can only raise it, which the lower bound heeds
  Estimate rmse;  ///< corrected for the variance of the truth
  /// Mean of what raster falls below truth, and of what it exceeds it; mae = too_dark + too_bright. The noise of the
  /// truth can only raise either. The lower bounds allow for what it may have added, about twice that.
  Estimate too_dark;
  Estimate too_bright;
  double max_error = 0.0;
  int max_x = -1;  ///< px, row 0 on top; −1 without an error
  int max_y = -1;
  double mean_standard_error = 0.0;  ///< mean root of the pixels' variances
};

/// A quantity by sampling: images of one size, independent between pixels.
struct SampledImage {
  const Image<float>& value;
  const Image<float>& variance;  ///< unbiased estimate of each pixel's; empty where all values are exact
  const Image<float>& samples;   ///< rays of each pixel; 0 where the value is exact; empty where all are
  int degrees_of_freedom = 0;    ///< of each pixel's variance
};

/// Whether the pixel of that index counts. Called from any thread.
using IsCounted = std::function<bool(std::size_t)>;

/// Intervals of means take Student's t quantile with the degrees of freedom of the summed variance (Welch 1947,
/// Satterthwaite 1946), and are never narrower than what the rays cannot see: of N rays in all that agree, 3/N.
SampledError analyze_sampled(const Image<float>& raster, const SampledImage& truth, const IsCounted& is_counted);

}  // namespace umbrameter
