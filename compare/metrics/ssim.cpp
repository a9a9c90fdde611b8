#include "compare/metrics/ssim.h"

#include <limits>

#include "compare/metrics/metric.h"
#include "core/parallel.h"

namespace umbrameter {
namespace {

constexpr double c1 = 0.01 * 0.01;  // (K₁ L)² of the paper, for values from 0 to L = 1
constexpr double c2 = 0.03 * 0.03;

// Variances are differences of larger numbers; about the middle of the range they lose fewer digits.
constexpr float middle = 0.5f;

template <class F>
Image<float> of_pixels(const Image<float>& like, F f) {
  Image<float> result(like.width, like.height);
  for (std::size_t i = 0; i < like.size(); ++i) result[i] = f(i);
  return result;
}

}  // namespace

SsimMaps ssim_maps(const Image<float>& test, const Image<float>& reference, const Kernel& window,
                   bool sample_variance) {
  const Image<float> x = of_pixels(test, [&](std::size_t i) { return test[i] - middle; });
  const Image<float> y = of_pixels(test, [&](std::size_t i) { return reference[i] - middle; });
  const auto mean_of = [&](auto f) { return filtered(of_pixels(test, f), window, window); };
  const Image<float> mean_x = filtered(x, window, window);
  const Image<float> mean_y = filtered(y, window, window);
  const Image<float> mean_xx = mean_of([&](std::size_t i) { return x[i] * x[i]; });
  const Image<float> mean_yy = mean_of([&](std::size_t i) { return y[i] * y[i]; });
  const Image<float> mean_xy = mean_of([&](std::size_t i) { return x[i] * y[i]; });

  const int radius = static_cast<int>(window.weights.size()) - 1;
  const double count = (2.0 * radius + 1.0) * (2.0 * radius + 1.0);
  const double factor = sample_variance ? count / (count - 1.0) : 1.0;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  SsimMaps maps{Image<float>(test.width, test.height, nan), Image<float>(test.width, test.height, nan)};
  parallel_for(static_cast<std::size_t>(test.height), [&](std::size_t row) {
    if (static_cast<int>(row) < radius || static_cast<int>(row) >= test.height - radius) return;
    for (int column = radius; column < test.width - radius; ++column) {
      const std::size_t i = test.index(column, static_cast<int>(row));
      const double mx = static_cast<double>(mean_x[i]);
      const double my = static_cast<double>(mean_y[i]);
      const double covariance = factor * (static_cast<double>(mean_xy[i]) - mx * my);
      // At least that by Cauchy and Schwarz, which rounding would break.
      const double variances =
          std::max(factor * (static_cast<double>(mean_xx[i]) - mx * mx + static_cast<double>(mean_yy[i]) - my * my),
                   2.0 * covariance);
      const double a = mx + static_cast<double>(middle);
      const double b = my + static_cast<double>(middle);
      const double structure = (2.0 * covariance + c2) / (variances + c2);
      maps.contrast_structure[i] = static_cast<float>(structure);
      maps.similarity[i] = static_cast<float>((2.0 * a * b + c1) / (a * a + b * b + c1) * structure);
    }
  });
  return maps;
}

const Metric ssim_metric = {
    "ssim",
    "structural similarity, Gaussian window of 11 × 11",
    "1",
    "−1 to 1, 1 is equal",
    "mean over windows of (2 μx μy + C1)(2 σxy + C2) / ((μx² + μy² + C1)(σx² + σy² + C2))",
    "Wang et al., Image quality assessment: from error visibility to structural similarity, 2004",
    true,
    [](const MetricInput& input) {
      return mean_of_map(ssim_maps(input.test, input.reference, ssim_window()).similarity, input.is_counted);
    },
    ColorRule::display_luma};

const Metric ssim_uniform_metric = {
    "ssim-uniform",
    "structural similarity, uniform window of 7 × 7",
    "1",
    "−1 to 1, 1 is equal",
    "as ssim, with equal weights and sample variances (n − 1)",
    "the defaults of scikit-image, structural_similarity",
    true,
    [](const MetricInput& input) {
      return mean_of_map(ssim_maps(input.test, input.reference, box_kernel(3), true).similarity, input.is_counted);
    },
    ColorRule::display_channels};

}  // namespace umbrameter
