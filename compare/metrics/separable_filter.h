// Filters of scalar images that are products of a row and a column of weights. Beyond the edges an image continues with
// the value at its edge.
#pragma once

#include <vector>

#include "core/image.h"

namespace umbrameter {

/// Weights of one direction, from the centre outwards. With d the distance from the centre:
enum class KernelKind {
  even,      ///< Σ w(d) · (f(+d) + f(−d)), the centre once
  odd,       ///< Σ w(d) · (f(+d) − f(−d)): a first derivative
  zero_sum,  ///< Σ w(d) · (f(+d) + f(−d) − 2 f(0)): a second derivative, exactly 0 where the image is constant
};
struct Kernel {
  KernelKind kind = KernelKind::even;
  std::vector<float> weights;
};

/// exp(−d²/2σ²) up to that radius, scaled so that all weights sum to 1.
Kernel gaussian_kernel(double sigma, int radius);
/// Equal weights that sum to 1.
Kernel box_kernel(int radius);

Image<float> filtered(const Image<float>& image, const Kernel& horizontal, const Kernel& vertical);

}  // namespace umbrameter
