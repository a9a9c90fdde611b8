#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "compare/visibility.h"
#include "experiments/run_comparison.h"

namespace umbrameter {
namespace {

constexpr double normal_975 = 1.959963984540054;  // 97.5 % quantile of the normal distribution
constexpr int max_blocks_of_a_side = 16;
constexpr int min_block_side = 8;           // [px]
constexpr std::size_t fewest_blocks = 20;   // with fewer, the normal distribution is too narrow
constexpr double most_moved_pixels = 0.01;  // share of pixels that may see another surface and still be the same view

// The images of which a statistic is a mean; null where a run has none.
struct StoredImages {
  const Image<float>* error = nullptr;
  const Image<float>* classes = nullptr;
  const Image<float>* position = nullptr;  // NaN on background
};

StoredImages images_of(const StoredRun& run, const MeasuredStatistic& statistic) {
  StoredImages images;
  images.position = find_channel(run, "gbuffer_position.X");
  if (statistic.kind == "shadow") {
    const auto layer = run.layers.find(statistic.light);
    if (layer == run.layers.end()) return images;
    images.error = find_channel(run, "error_visibility_" + layer->second + ".Y");
    images.classes = find_channel(run, "class_" + layer->second + ".Y");
  } else {
    images.error = find_channel(run, "error_" + statistic.kind + ".Y");
  }
  return images;
}

// What a pixel adds to the sum of the statistic: its error and its class. Empty for one that is no mean over pixels.
std::function<double(double, PixelClass)> term_of(const std::string& name) {
  if (name == "mae") return [](double e, PixelClass) { return std::abs(e); };
  if (name == "mean_error") return [](double e, PixelClass) { return e; };
  if (name == "too_dark") return [](double e, PixelClass) { return std::max(0.0, -e); };
  if (name == "too_bright") return [](double e, PixelClass) { return std::max(0.0, e); };
  for (const auto& [cause, of_cause] :
       {std::pair("acne", PixelClass::acne), std::pair("false_occlusion", PixelClass::false_occlusion),
        std::pair("peter_panning", PixelClass::peter_panning), std::pair("leak", PixelClass::light_leak)}) {
    if (name == cause) return [c = of_cause](double e, PixelClass k) { return k == c ? std::abs(e) : 0.0; };
  }
  return {};
}

struct BlockSum {
  double sum = 0.0;
  double count = 0.0;
};

struct BlockSums {
  std::vector<BlockSum> blocks;
  BlockSum all;
  double mean() const { return all.sum / all.count; }
};

BlockSums sum_blocks(const StoredImages& images, const std::function<double(double, PixelClass)>& term) {
  const Image<float>& error = *images.error;
  const int columns = std::clamp(error.width / min_block_side, 1, max_blocks_of_a_side);
  const int rows = std::clamp(error.height / min_block_side, 1, max_blocks_of_a_side);
  BlockSums sums{std::vector<BlockSum>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)), {}};
  for (int y = 0; y < error.height; ++y) {
    for (int x = 0; x < error.width; ++x) {
      const std::size_t i = error.index(x, y);
      const auto pixel = images.classes != nullptr ? static_cast<PixelClass>(std::lround((*images.classes)[i]))
                         : std::isnan((*images.position)[i]) ? PixelClass::background
                                                             : PixelClass::correct;
      if (pixel == PixelClass::not_counted || pixel == PixelClass::background) continue;
      const auto block = static_cast<std::size_t>(y * rows / error.height * columns + x * columns / error.width);
      const double value = term(error[i], pixel);
      for (BlockSum* each : {&sums.blocks[block], &sums.all}) {
        each->sum += value;
        each->count += 1.0;
      }
    }
  }
  return sums;
}

bool see_the_same(const Image<float>& a, const Image<float>& b) {
  if (a.width != b.width || a.height != b.height) return false;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool is_same = std::isnan(a[i]) || std::isnan(b[i])
                             ? std::isnan(a[i]) && std::isnan(b[i])
                             : std::abs(a[i] - b[i]) <= 1e-3f * std::max(1.0f, std::abs(a[i]));
    moved += is_same ? 0u : 1u;
  }
  return static_cast<double>(moved) <= most_moved_pixels * static_cast<double>(a.size());
}

bool gives(const BlockSums& sums, double reported) {
  return sums.all.count > 0.0 && std::abs(sums.mean() - reported) <= 1e-6 + 1e-4 * std::abs(reported);
}

}  // namespace

std::optional<PairedDifference> paired_difference(const StoredRun& a, const MeasuredStatistic& of_a, const StoredRun& b,
                                                  const MeasuredStatistic& of_b) {
  const auto term = term_of(of_a.name);
  const StoredImages images_a = images_of(a, of_a);
  const StoredImages images_b = images_of(b, of_b);
  const bool are_stored = images_a.error != nullptr && images_b.error != nullptr && images_a.position != nullptr &&
                          images_b.position != nullptr;
  if (!term || !are_stored || !see_the_same(*images_a.position, *images_b.position)) return std::nullopt;
  // Weighted causes of a filter, or pixels that images do not tell to be counted, give another mean than the reported.
  const BlockSums sums_a = sum_blocks(images_a, term);
  const BlockSums sums_b = sum_blocks(images_b, term);
  if (!gives(sums_a, of_a.value) || !gives(sums_b, of_b.value)) return std::nullopt;
  std::vector<double> without;  // the difference without each block
  const auto mean_without = [](const BlockSums& sums, std::size_t i) {
    return (sums.all.sum - sums.blocks[i].sum) / (sums.all.count - sums.blocks[i].count);
  };
  for (std::size_t i = 0; i < sums_a.blocks.size(); ++i) {
    if (sums_a.blocks[i].count + sums_b.blocks[i].count == 0.0) continue;
    const double difference = mean_without(sums_b, i) - mean_without(sums_a, i);
    if (std::isfinite(difference)) without.push_back(difference);
  }
  if (without.size() < fewest_blocks) return std::nullopt;
  const auto groups = static_cast<double>(without.size());
  double mean = 0.0;
  for (const double each : without) mean += each / groups;
  double squares = 0.0;
  for (const double each : without) squares += (each - mean) * (each - mean);
  // Delete-a-group jackknife (Quenouille 1956; Kott 2001).
  const double half_width = normal_975 * std::sqrt((groups - 1.0) / groups * squares);
  const double difference = of_b.value - of_a.value;
  return PairedDifference{{difference, difference - half_width, difference + half_width}, without.size()};
}

}  // namespace umbrameter
