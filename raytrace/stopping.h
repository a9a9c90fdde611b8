// When a pixel has enough rays, and what they say then. For raytrace/*.cpp and tests.
#pragma once

#include <array>

#include "raytrace/ao_estimate.h"
#include "raytrace/tracer.h"

namespace umbrameter {

/// Which of a pixel's points are wanted: of `split.points` in all, those beyond the first `begin`.
struct SampleRange {
  Randomisations split;
  int begin = 0;
  int size() const { return split.points - begin; }
};

/// What a pixel's rays say.
struct PixelEstimate {
  double value = 0.0;
  double variance = 0.0;        ///< unbiased
  double standard_error = 0.0;  ///< half width of the 95 % interval over Student's quantile
  int rays = 0;                 ///< all that were traced for it
};

/// Leads one pixel from its first ray to its estimate. Without a tolerance that is params.spp rays. With one a pilot
/// decides how many points follow, and is left out. Those are in two halves of the randomisations, each of which ends
/// when the scatter of the other is small enough, and grows in fixed steps until then. Points are so never chosen by
/// what they show themselves: values and variances stay unbiased, and the half width, from the scatter that decided,
/// is within the tolerance unless params.max_spp ended it.
class Stopping {
 public:
  explicit Stopping(const TruthParams& params);

  bool is_pilot() const { return is_pilot_; }
  const SampleRange& next() const { return next_; }

  /// Takes what all points up to next() have shown, without the pilot's. Whether more are wanted, by next(): after the
  /// pilot they are a new sequence, later the same one goes on.
  bool advance(const TruthParams& params, const AoEstimate& seen);

  /// Once advance() wants no more.
  const PixelEstimate& estimate() const { return estimate_; }

 private:
  struct Half {
    bool is_settled = false;
    double mean = 0.0;
    double variance = 0.0;     // from its own scatter
    double judged_by = 0.0;    // variance of the other half, of as many points
    double least_width = 0.0;  // of the interval: what the points may have missed
  };
  void conclude();

  bool is_pilot_ = false;
  SampleRange next_;
  std::array<Half, 2> halves_;
  PixelEstimate estimate_;
};

/// Degrees of freedom of the standard errors.
int degrees_of_freedom(const TruthParams& params);

/// Over the pixels that have samples.
SamplingPrecision precision_of(const Image<float>& standard_error, const Image<float>& samples,
                               const TruthParams& params);

}  // namespace umbrameter
