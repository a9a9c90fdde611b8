// The law that ties the bias to the size of a texel, fitted to what sweeps over the resolution say. Reads no rows
// itself.
#pragma once

#include <cstddef>
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
/// tan θ and give their product, per_texel. A slope-scaled bias s takes s·texel·tan θ off the constant one that is
/// needed, so that over several of them bias = c0 + (c1 − s)·texel·tan θ gives both.
struct BiasLaw {
  std::size_t points = 0;
  Fitted constant{};                     ///< c0, metres
  Fitted per_texel{};                    ///< c1·tan θ, texels
  std::optional<Fitted> tangent{};       ///< tan θ where the bias is decided, 1
  std::optional<Fitted> slope_factor{};  ///< c1, texels of slope-scaled bias
  double residual = 0.0;                 ///< root mean square of what the law misses, metres
  double residual_texels = 0.0;          ///< the same, each point's in its own texels
};

/// Least squares, each point weighted by 1/step². Nothing where the texels do not differ.
std::optional<BiasLaw> fit_law(std::span<const LawPoint> points);

}  // namespace umbrameter
