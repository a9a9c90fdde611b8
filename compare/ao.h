// Ambient-occlusion error against a sampled reference, with the interval that the sampling leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/table.h"
#include "core/gbuffer.h"
#include "core/image.h"

namespace umbrameter {

/// A statistic and its 95 % interval from the reference's sampling.
struct Estimate {
  double value = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

/// Over all surfels; accessibility, 1 is open.
struct AoStatistics {
  std::uint64_t pixels = 0;
  double mean_raster = 0.0;
  Estimate mean_truth;
  Estimate mean_error;  ///< raster − truth: below 0 too dark, above 0 too bright
  Estimate mae;   ///< mean |raster − truth|; the noise of the truth can only raise it, which the lower bound heeds
  Estimate rmse;  ///< corrected for the variance of the truth
  double max_error = 0.0;
  int max_x = -1;  ///< px, row 0 on top; −1 without an error
  int max_y = -1;
};

/// Accessibility by sampling: images of one size, independent between pixels.
struct SampledAo {
  const Image<float>& ao;
  const Image<float>& variance;  ///< unbiased estimate of each pixel's
  const Image<float>& samples;   ///< rays of each pixel; 0 where the value is exact
  int degrees_of_freedom = 0;    ///< of each pixel's variance
};

/// Intervals of means take Student's t quantile with the degrees of freedom of the summed variance (Welch 1947,
/// Satterthwaite 1946), and are never narrower than what the rays cannot see: of N rays in all that agree, 3/N.
AoStatistics analyze_ao(const Image<float>& raster, const SampledAo& truth, const GBuffer& gbuffer);

/// The statistics as one row, in the order of ao_columns(): the measured columns of an AO sweep.
std::vector<Column> ao_columns();
std::vector<Value> to_row(const AoStatistics& statistics);

}  // namespace umbrameter
