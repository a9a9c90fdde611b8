#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/metrics/metric.h"
#include "compare/metrics/ssim.h"

namespace umbrameter {
namespace {

// Exponents of the five scales, the finest first (section 3 of the paper).
constexpr std::array<double, 5> exponents = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};

// Means of 2 × 2 pixels. An odd last row or column counts twice, as its authors' code continues the image.
Image<float> halved(const Image<float>& image) {
  Image<float> result((image.width + 1) / 2, (image.height + 1) / 2);
  for (int y = 0; y < result.height; ++y) {
    for (int x = 0; x < result.width; ++x) {
      const int right = std::min(2 * x + 1, image.width - 1);
      const int below = std::min(2 * y + 1, image.height - 1);
      result.at(x, y) =
          0.25f * (image.at(2 * x, 2 * y) + image.at(right, 2 * y) + image.at(2 * x, below) + image.at(right, below));
    }
  }
  return result;
}

// 1 where any of the 2 × 2 pixels counts.
Image<float> halved_mask(const Image<float>& mask) {
  Image<float> result = halved(mask);
  for (float& value : result.pixels) value = value > 0.0f ? 1.0f : 0.0f;
  return result;
}

// The value of a coarse map at a pixel of the fine image; beyond the outermost windows that of the nearest.
float value_at(const Image<float>& map, int scale, int x, int y, int radius) {
  return map.at(std::clamp(x >> scale, radius, map.width - 1 - radius),
                std::clamp(y >> scale, radius, map.height - 1 - radius));
}

double power(double base, double exponent) { return std::pow(std::max(base, 0.0), exponent); }

MetricResult measure(const MetricInput& input) {
  constexpr int radius = 5;
  constexpr int coarsest = static_cast<int>(exponents.size()) - 1;
  MetricResult result{std::numeric_limits<double>::quiet_NaN(),
                      Image<float>(input.test.width, input.test.height, std::numeric_limits<float>::quiet_NaN())};
  // The coarsest scale must hold a window.
  if (std::min(input.test.width, input.test.height) < (2 * radius + 1) << coarsest) return result;

  Image<float> test = input.test;
  Image<float> reference = input.reference;
  Image<float> mask(test.width, test.height);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = input.is_counted(i) ? 1.0f : 0.0f;
  std::array<Image<float>, exponents.size()> maps;
  double score = 1.0;
  for (int scale = 0; scale <= coarsest; ++scale) {
    if (scale > 0) {
      test = halved(test);
      reference = halved(reference);
      mask = halved_mask(mask);
    }
    const auto s = static_cast<std::size_t>(scale);
    SsimMaps both = ssim_maps(test, reference, ssim_window());
    maps[s] = std::move(scale == coarsest ? both.similarity : both.contrast_structure);
    const double mean = mean_of_map(maps[s], [&](std::size_t i) { return mask[i] > 0.0f; }).score;
    if (std::isnan(mean)) return result;
    score *= power(mean, exponents[s]);
  }
  result.score = score;
  for (int y = 0; y < input.test.height; ++y) {
    for (int x = 0; x < input.test.width; ++x) {
      const std::size_t i = input.test.index(x, y);
      if (!input.is_counted(i)) continue;
      double product = 1.0;
      for (int scale = 0; scale <= coarsest; ++scale) {
        const auto s = static_cast<std::size_t>(scale);
        product *= power(static_cast<double>(value_at(maps[s], scale, x, y, radius)), exponents[s]);
      }
      result.map[i] = static_cast<float>(product);
    }
  }
  return result;
}

}  // namespace

const Metric ms_ssim_metric = {
    "ms-ssim",
    "multi-scale structural similarity",
    "1",
    "0 to 1, 1 is equal",
    "product over five scales of (mean contrast and structure term)^exponent, with the luminance term at the coarsest",
    "Wang, Simoncelli and Bovik, Multi-scale structural similarity for image quality assessment, 2003",
    true,
    measure,
    ColorRule::display_luma};

}  // namespace umbrameter
