// Structural similarity of scalar images with values from 0 to 1.
// Wang, Bovik, Sheikh and Simoncelli, Image quality assessment: from error visibility to structural similarity, IEEE
// Transactions on Image Processing 13(4), 2004.
#pragma once

#include "compare/metrics/separable_filter.h"
#include "core/image.h"

namespace umbrameter {

struct SsimMaps {
  Image<float> similarity;  ///< luminance term · contrast and structure term
  Image<float> contrast_structure;
};

/// One value per window, at its centre. NaN where the window does not lie inside the image, as its authors leave these
/// out. `sample_variance` divides by n − 1 instead of n, for equal weights.
SsimMaps ssim_maps(const Image<float>& test, const Image<float>& reference, const Kernel& window,
                   bool sample_variance = false);

/// The window of the authors: a Gaussian of σ = 1.5 pixels over 11 × 11 pixels.
inline Kernel ssim_window() { return gaussian_kernel(1.5, 5); }

}  // namespace umbrameter
