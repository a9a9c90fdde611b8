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
  double mean_standard_error = 0.0;  ///< of the truth's pixels
};

/// Images of one size; standard_error is that of each pixel of truth, independent between pixels.
AoStatistics analyze_ao(const Image<float>& raster, const Image<float>& truth, const Image<float>& standard_error,
                        const GBuffer& gbuffer);

/// The statistics as one row, in the order of ao_columns(): the measured columns of an AO sweep.
std::vector<Column> ao_columns();
std::vector<Value> to_row(const AoStatistics& statistics);

}  // namespace umbrameter
