// The sums over pixels from which SampledError follows. For code that adds pixels in its own order.
#pragma once

#include <cstdint>
#include <limits>

#include "compare/sampled_error.h"

namespace umbrameter {

/// Of the part of the absolute error that has one sign.
struct PartSums {
  double low = 0.0;               // of estimates that are at most the part, on average
  double low_variance = 0.0;      // of `low`
  double low_squares = 0.0;       // of its pixels' variances
  double variance = 0.0;          // of the measured part, an upper bound
  double variance_squares = 0.0;  // of its pixels' variances
};

struct ErrorSums {
  std::uint64_t pixels = 0;
  double raster = 0.0;
  double truth = 0.0;
  double error = 0.0;
  double absolute = 0.0;
  double absolute_bias = 0.0;  // what noise of the truth may have added to the absolute error
  double squared = 0.0;
  double squared_noise = 0.0;  // of each pixel's squared error times its variance
  double variance = 0.0;
  double variance_squared = 0.0;
  double min_samples = std::numeric_limits<double>::infinity();
  double max_error = 0.0;
  int max_x = -1;
  PartSums too_dark;
  PartSums too_bright;
};

/// Adds a part of the pixels: all but max_error and max_x.
void add(ErrorSums& total, const ErrorSums& part);

/// What noise of the standard error s adds to the mean of an absolute error e: E|e + sZ| − |e| for standard normal Z
/// (mean of the folded normal distribution, Leone, Nelson and Nottingham 1961).
double folded_excess(double e, double s);

/// The most that noise adds, on average, to the absolute error of a technique against a share v. With an estimate v' it
/// adds 2·E max(v' − raster, 0) if v ≤ raster, else 2·E max(raster − v', 0). Either is at most 2·min(raster, 1 −
/// raster), because v' has the mean v and stays within 0 to 1: noise adds nothing where the technique shows all or
/// nothing.
double most_excess(double raster);

/// Noise may have moved a measured error away from zero: its excess is taken as if the error were this many standard
/// errors smaller, which bounds it for all but 2.5 % of the pixels.
double noise_reach(int degrees_of_freedom);

/// The most that noise may have added to an absolute error that was measured as |error|: its excess after that reach,
/// but at most `most`.
double possible_excess(double error, double s, double reach, double most);

/// The largest share that so many rays miss with a probability of at least 5 % (rule of three).
double unseen_share(double samples);

/// Of the 95 % interval of a sum over independent pixels, from the sum of their variances and of the variances'
/// squares.
double half_width_of_sum(double variance, double squares, int degrees_of_freedom);

/// All but max_error, max_x and max_y.
SampledError statistics_of(const ErrorSums& total, int degrees_of_freedom);

}  // namespace umbrameter
