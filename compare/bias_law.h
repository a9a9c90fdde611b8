// Fits bias = c0 + c1 · texel · tan θ to the best biases of sweeps over the resolution.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "compare/bias_curves.h"

namespace umbrameter {

/// A bias on a sweep axis, known to within one step of that axis.
struct FitPoint {
  double texel = 0.0;  ///< mean side of a texel, metres
  double slope = 0.0;  ///< slope-scaled bias, texels
  double bias = 0.0;   ///< constant bias, metres
  double step = 1.0;   ///< width of the interval between axis values that contains the bias, metres
};

/// A cell as a point of the fit: the bias with the least error, or the least bias that is free of an error such as
/// acne. `axis` holds the constant biases in ascending order. Empty if the cell is at an end of the axis beyond which
/// the optimum may lie: either end for the least error, the lower end for the least bias without that error.
std::optional<FitPoint> point_of_least_error(const BiasCell& cell, double texel, std::span<const double> axis);
std::optional<FitPoint> point_of_least_free(const BiasCell& cell, double texel, std::span<const double> axis);

struct Fitted {
  double value = 0.0;
  std::optional<double> standard_error{};  ///< empty unless there are more points than coefficients
};

/// bias = c0 + c1·texel·tan θ, for one light and view at several resolutions. Constant biases alone determine only the
/// product c1·tan θ. A slope-scaled bias s reduces the required constant bias by s·texel·tan θ, but not below c0. So
/// with several slope-scaled biases, the fit of bias = c0 + max(c1 − s, 0)·texel·tan θ determines both.
struct BiasFit {
  std::size_t points = 0;
  double first_slope = 0.0;              ///< s₀, the smallest slope-scaled bias of the points, texels
  Fitted constant{};                     ///< c0, metres
  Fitted per_texel{};                    ///< (c1 − s₀)·tan θ, texels
  std::optional<Fitted> tangent{};       ///< tan θ at the surface that limits the bias; needs two values of s below c1
  std::optional<Fitted> slope_factor{};  ///< c1, texels of slope-scaled bias
  double flat_from = std::numeric_limits<double>::infinity();  ///< smallest s of the points with s ≥ c1, texels
  double residual = 0.0;                                       ///< RMS residual, metres
  double residual_texels = 0.0;                                ///< RMS residual, in units of each point's texel
};

/// The constant bias, in metres, that the fit gives for a texel size (metres) and a slope-scaled bias (texels).
double bias_of(const BiasFit& law, double texel, double slope);

/// Least squares with each point weighted by 1/step². Tries every position of the bend s = c1 among the slope-scaled
/// biases and returns the fit with the smallest residual. Empty if all texel sizes are equal, and unless there are more
/// different points, by texel size and slope-scaled bias, than the two or three coefficients.
std::optional<BiasFit> fit_law(std::span<const FitPoint> points);

}  // namespace umbrameter
