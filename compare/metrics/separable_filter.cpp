#include "compare/metrics/separable_filter.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace umbrameter {
namespace {

// Adds the pair at distance d to a row of results; `before` and `after` hold f(−d) and f(+d) of each pixel.
void add_pair(KernelKind kind, float weight, const float* before, const float* center, const float* after, float* sum,
              std::size_t count) {
  switch (kind) {
    case KernelKind::even:
      for (std::size_t x = 0; x < count; ++x) sum[x] += weight * (after[x] + before[x]);
      break;
    case KernelKind::odd:
      for (std::size_t x = 0; x < count; ++x) sum[x] += weight * (after[x] - before[x]);
      break;
    case KernelKind::zero_sum:
      for (std::size_t x = 0; x < count; ++x) sum[x] += weight * ((after[x] - center[x]) + (before[x] - center[x]));
      break;
  }
}

void start_row(const Kernel& kernel, const float* center, float* sum, std::size_t count) {
  const float weight = kernel.kind == KernelKind::even ? kernel.weights.front() : 0.0f;
  for (std::size_t x = 0; x < count; ++x) sum[x] = weight * center[x];
}

Image<float> filtered_rows(const Image<float>& image, const Kernel& kernel) {
  Image<float> result(image.width, image.height);
  const auto width = static_cast<std::size_t>(image.width);
  const std::size_t radius = kernel.weights.size() - 1;
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    const float* row = image.pixels.data() + y * width;
    std::vector<float> padded(width + 2 * radius);
    std::fill_n(padded.begin(), radius, row[0]);
    std::copy_n(row, width, padded.begin() + static_cast<std::ptrdiff_t>(radius));
    std::fill_n(padded.end() - static_cast<std::ptrdiff_t>(radius), radius, row[width - 1]);
    const float* center = padded.data() + radius;
    float* sum = result.pixels.data() + y * width;
    start_row(kernel, center, sum, width);
    for (std::size_t d = 1; d <= radius; ++d) {
      add_pair(kernel.kind, kernel.weights[d], center - d, center, center + d, sum, width);
    }
  });
  return result;
}

Image<float> filtered_columns(const Image<float>& image, const Kernel& kernel) {
  Image<float> result(image.width, image.height);
  const auto width = static_cast<std::size_t>(image.width);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    const auto row = [&](std::ptrdiff_t offset) {
      const std::ptrdiff_t line =
          std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(y) + offset, 0, image.height - 1);
      return image.pixels.data() + static_cast<std::size_t>(line) * width;
    };
    float* sum = result.pixels.data() + y * width;
    start_row(kernel, row(0), sum, width);
    for (std::size_t d = 1; d < kernel.weights.size(); ++d) {
      const auto offset = static_cast<std::ptrdiff_t>(d);
      add_pair(kernel.kind, kernel.weights[d], row(-offset), row(0), row(offset), sum, width);
    }
  });
  return result;
}

}  // namespace

Kernel gaussian_kernel(double sigma, int radius) {
  const auto weight = [&](int d) { return std::exp(-d * d / (2.0 * sigma * sigma)); };
  double sum = weight(0);
  for (int d = 1; d <= radius; ++d) sum += 2.0 * weight(d);
  Kernel kernel;
  for (int d = 0; d <= radius; ++d) kernel.weights.push_back(static_cast<float>(weight(d) / sum));
  return kernel;
}

Kernel box_kernel(int radius) {
  const auto size = static_cast<std::size_t>(radius) + 1;
  return {KernelKind::even, std::vector<float>(size, 1.0f / static_cast<float>(2 * radius + 1))};
}

Image<float> filtered(const Image<float>& image, const Kernel& horizontal, const Kernel& vertical) {
  return image.empty() ? image : filtered_columns(filtered_rows(image, horizontal), vertical);
}

}  // namespace umbrameter
