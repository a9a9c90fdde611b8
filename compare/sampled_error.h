// Error against a sampled reference, with 95 % intervals of the sampling. The caller names the quantity and selects the
// pixels that count.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/statistics.h"

namespace umbrameter {

/// The meaning of a mean of absolute errors. Noise of the truth hides errors that are smaller, so that their mean is
/// known only within a range: such a statistic has bounds, all others have 95 % intervals.
inline std::string with_bounds(const std::string& meaning) {
  return meaning + "; bounds, where given, have at least 95 % confidence";
}

struct SampledError {
  std::uint64_t pixels = 0;
  double mean_raster = 0.0;
  Estimate mean_truth;
  Estimate mean_error;  ///< raster − truth: below 0 too dark, above 0 too bright
  /// Mean |raster − truth|. Noise of the truth can only raise it; the lower bound allows for it, but is not below the
  /// size that mean_error has at least. Noise adds nothing to the error of a share where raster is 0 or 1.
  Estimate mae;
  /// The most that noise of the truth may have added to mae, but for chance; to too_dark and too_bright half as much.
  double mae_noise = 0.0;
  Estimate rmse;  ///< corrected for the variance of the truth
  /// Means of max(truth − raster, 0) and max(raster − truth, 0); mae = too_dark + too_bright. Noise of the truth can
  /// only raise either. The lower bounds allow for about twice the amount that noise may have added.
  Estimate too_dark;
  Estimate too_bright;
  double max_error = 0.0;
  int max_x = -1;  ///< px, row 0 on top; −1 without an error
  int max_y = -1;
};

/// A sampled quantity. The images have the same size; pixels are statistically independent.
struct SampledImage {
  const Image<float>& value;
  const Image<float>& variance;  ///< unbiased estimate of each value's variance; empty if all values are exact
  const Image<float>& samples;   ///< rays of each pixel; 0 if its value is exact; empty if all values are exact
  int degrees_of_freedom = 0;    ///< of each pixel's variance
  bool is_share = true;          ///< of light or of directions: no sample lies outside 0 to 1
};

/// Whether the pixel with this index counts. Called from any thread.
using IsCounted = std::function<bool(std::size_t)>;

/// Intervals of means take Student's t quantile with the degrees of freedom of the summed variance (Welch 1947,
/// Satterthwaite 1946). The half width is at least 3/N for N rays in all (rule of three): rays that all agree have a
/// sample variance of 0 but can still miss that much.
SampledError analyze_sampled(const Image<float>& raster, const SampledImage& truth, const IsCounted& is_counted);

}  // namespace umbrameter
