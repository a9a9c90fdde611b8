// The law that ties the bias to the size of a texel, fitted to what sweeps over the resolution say. Reads no rows
// itself.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "compare/bias_curves.h"

namespace umbrameter {

/// A bias that was read off an axis, known to a step of that axis.
struct LawPoint {
  double texel = 0.0;  ///< mean side of a texel, metres
  double slope = 0.0;  ///< slope-scaled bias in use, texels
  double bias = 0.0;   ///< constant bias, metres
  double step = 1.0;   ///< width of the axis's interval that the bias lies in, metres
};

/// Of values of the ascending axis. Nothing at an end of the axis beyond which the true one may lie: at both for the
/// bias of least error, at the lower one for the least bias that is free of something.
std::optional<LawPoint> point_of_least_error(const BiasCell& cell, double texel, std::span<const double> axis);
std::optional<LawPoint> point_of_least_free(const BiasCell& cell, double texel, std::span<const double> axis);

struct Fitted {
  double value = 0.0;
  std::optional<double> standard_error{};  ///< nothing where there are no more points than coefficients
};

/// bias = c0 + c1·texel·tan θ, for one light and view at several resolutions. Constant biases alone cannot tell c1 from
/// tan θ and give their product. A slope-scaled bias s takes s·texel·tan θ off the constant one that is needed until
/// nothing but c0 is left, so that over several of them bias = c0 + max(c1 − s, 0)·texel·tan θ gives both.
struct BiasLaw {
  std::size_t points = 0;
  double first_slope = 0.0;              ///< s₀, the least slope-scaled bias of the points, texels
  Fitted constant{};                     ///< c0, metres
  Fitted per_texel{};                    ///< (c1 − s₀)·tan θ, texels
  std::optional<Fitted> tangent{};       ///< tan θ where the bias is decided, 1; needs two s below c1
  std::optional<Fitted> slope_factor{};  ///< c1, texels of slope-scaled bias
  double flat_from = std::numeric_limits<double>::infinity();  ///< the least s taken to be c1 or more, texels
  double residual = 0.0;                                       ///< root mean square of what the law misses, metres
  double residual_texels = 0.0;                                ///< the same, each point's in its own texels
};

/// The constant bias that a law tells for a texel (metres) and a slope-scaled bias (texels), metres.
double bias_of(const BiasLaw& law, double texel, double slope);

/// Least squares, each point weighted by 1/step²; of all places of the bend among the slope-scaled biases the one that
/// misses least. Nothing where the texels do not differ.
std::optional<BiasLaw> fit_law(std::span<const LawPoint> points);

}  // namespace umbrameter
