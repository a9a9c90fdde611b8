// When a pixel has enough rays, and its estimate then. For raytrace/*.cpp and tests.
#pragma once

#include <array>

#include "raytrace/randomized_estimate.h"
#include "raytrace/tracer.h"

namespace umbrameter {

/// The next points of a pixel's sequence: from `begin` to `split.points`.
struct SampleRange {
  Randomisations split;
  int begin = 0;
  int size() const { return split.points - begin; }
};

/// The result of a pixel.
struct PixelEstimate {
  double value = 0.0;
  double variance = 0.0;        ///< unbiased
  double standard_error = 0.0;  ///< half width of the 95 % interval over Student's quantile
  int rays = 0;                 ///< including the pilot
};

/// Decides how many points one pixel needs. Without a tolerance: params.spp. With a tolerance, a pilot predicts the
/// number of points and is discarded. The randomisations that follow form two halves. Each half grows in fixed steps
/// and stops when the scatter of the other half is small enough, so that its number of points does not depend on its
/// own values: means and variances stay unbiased. The half width of the interval, from the scatters that stopped the
/// halves, is within the tolerance unless params.max_spp stopped them (docs/reference.md).
class AdaptiveSampleCount {
 public:
  explicit AdaptiveSampleCount(const TruthParams& params);

  bool is_pilot() const { return is_pilot_; }
  const SampleRange& next() const { return next_; }

  /// Takes the estimate from all points up to the end of next(), without those of the pilot. Returns whether more are
  /// needed; next() then gives them. After the pilot a new sequence begins; later the same sequence continues.
  bool advance(const TruthParams& params, const RandomizedEstimate& estimate);

  /// After advance() has returned false.
  const PixelEstimate& estimate() const { return estimate_; }

 private:
  struct Half {
    bool has_stopped = false;
    double mean = 0.0;
    double variance = 0.0;        // from its own scatter
    double other_variance = 0.0;  // of the other half with as many points, which stopped this one
    double min_width = 0.0;       // min_half_width() when it stopped
  };
  void conclude();

  bool is_pilot_ = false;
  SampleRange next_;
  std::array<Half, 2> halves_;
  PixelEstimate estimate_;
};

/// Degrees of freedom of the standard errors.
int degrees_of_freedom(const TruthParams& params);

/// Statistics of the intervals of all pixels that have samples.
SamplingPrecision precision_of(const Image<float>& standard_error, const Image<float>& samples,
                               const TruthParams& params);

}  // namespace umbrameter
