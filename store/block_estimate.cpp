#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "compare/error_sums.h"
#include "compare/soft_visibility.h"
#include "compare/visibility.h"
#include "core/jackknife.h"
#include "core/quantiles.h"
#include "results/layers.h"
#include "store/run_comparison.h"

namespace umbrameter {
namespace {

constexpr int max_blocks_of_a_side = 8;
constexpr int min_block_side = 8;           // [px]
constexpr double most_moved_pixels = 0.01;  // share of pixels that may see another surface and still be the same view

// The images of which a statistic is a mean; null where a run has none.
struct StoredImages {
  const Image<float>* error = nullptr;
  const Image<float>* truth = nullptr;
  const Image<float>* raster = nullptr;
  const Image<float>* variance = nullptr;        // of the reference
  const Image<float>* standard_error = nullptr;  // its root
  const Image<float>* classes = nullptr;
  const Image<float>* counted = nullptr;
  const Image<float>* position = nullptr;                 // NaN on background
  std::array<const Image<float>*, cause_count> causes{};  // of a filter with several taps
  int degrees_of_freedom = 0;                             // of the variance
};

StoredImages images_of(const StoredRun& run, const MeasuredStatistic& statistic) {
  StoredImages images;
  images.degrees_of_freedom = statistic.degrees_of_freedom;
  std::string light;
  const auto find = [&](Layer layer) { return find_values(run.images, layer, light); };
  images.position = find_channel(run.images, layer_name(Layer::gbuffer_position) + ".X");
  if (statistic.kind == "shadow") {
    const auto layer = run.layers.find(statistic.light);
    if (layer == run.layers.end()) return images;
    light = layer->second;
    images.error = find(Layer::error_visibility);
    images.truth = find(Layer::truth_visibility);
    images.raster = find(Layer::raster_visibility);
    images.variance = find(Layer::truth_visibility_variance);
    images.classes = find(Layer::classes);
    images.counted = find(Layer::counted);
    for (std::size_t c = 0; c < cause_count; ++c) images.causes[c] = find(layer_of(static_cast<Cause>(c)));
  } else if (statistic.kind == "ao") {
    images.error = find(Layer::error_ao);
    images.truth = find(Layer::truth_ao);
    images.raster = find(Layer::raster_ao);
    images.variance = find(Layer::truth_ao_variance);
  } else {
    images.error = find(Layer::error_image);
    images.standard_error = find(Layer::truth_image_standard_error);
  }
  return images;
}

bool is_counted(const StoredImages& images, std::size_t i) {
  if (images.counted != nullptr) return (*images.counted)[i] > 0.0f;
  if (images.classes == nullptr) return !std::isnan((*images.position)[i]);
  const auto pixel = static_cast<PixelClass>(std::lround((*images.classes)[i]));
  return pixel != PixelClass::not_counted && pixel != PixelClass::background;
}

// What the images hold of a pixel; 0 where there is no image, which gives() finds out.
struct PixelValues {
  double error = 0.0;
  double truth = 0.0;
  double raster = 0.0;
  double variance = 0.0;
  std::array<double, cause_count> causes{};                      // parts of the absolute error
  double most_excess = std::numeric_limits<double>::infinity();  // that noise may have added to the absolute error
};

PixelValues values_at(const StoredImages& images, std::size_t i) {
  const auto value = [i](const Image<float>* image) {
    return image != nullptr ? static_cast<double>((*image)[i]) : 0.0;
  };
  const double standard_error = value(images.standard_error);
  PixelValues values{value(images.error), value(images.truth), value(images.raster),
                     value(images.variance) + standard_error * standard_error};
  const long main_cause = std::lround(value(images.classes)) - static_cast<long>(PixelClass::acne);
  for (std::size_t c = 0; c < cause_count; ++c) {
    const double of_one_tap = static_cast<long>(c) == main_cause ? std::abs(values.error) : 0.0;
    values.causes[c] = images.causes[c] != nullptr ? value(images.causes[c]) : of_one_tap;
  }
  if (images.raster != nullptr) values.most_excess = most_excess(values.raster);  // a share, unlike a shaded image
  return values;
}

double one(const PixelValues&) { return 1.0; }
double penumbra(const PixelValues& p) { return penumbra_weight(p.truth, p.variance); }

// A statistic as a ratio of sums over pixels.
struct PixelMean {
  double (*term)(const PixelValues&) = nullptr;  // what a pixel adds; null: it is no such ratio
  bool is_root = false;                          // the statistic is the root of the ratio
  double (*weight)(const PixelValues&) = one;
  double (*of_excess)(const PixelValues&) = nullptr;  // times what noise adds to the absolute error; null: nothing
};

// The most that noise may have added to a pixel's term. mean.of_excess must not be null.
double excess_of(const PixelMean& mean, const PixelValues& values, double reach) {
  const double s = std::sqrt(values.variance);
  return mean.of_excess(values) * possible_excess(values.error, s, reach, values.most_excess);
}

template <Cause cause>
double error_of_cause(const PixelValues& p) {
  return p.causes[static_cast<std::size_t>(cause)];
}

PixelMean mean_of(const std::string& name) {
  const auto too_dark = [](const PixelValues& p) { return std::max(0.0, -p.error); };
  const auto too_bright = [](const PixelValues& p) { return std::max(0.0, p.error); };
  const auto truth = [](const PixelValues& p) { return p.truth; };
  const auto raster = [](const PixelValues& p) { return p.raster; };
  // max(e, 0) is (|e| + e)/2, and noise adds nothing to the mean of e.
  const auto half = [](const PixelValues&) { return 0.5; };
  const std::pair<const char*, PixelMean> means[] = {
      {"mae", {[](const PixelValues& p) { return std::abs(p.error); }, false, one, one}},
      {"rmse", {[](const PixelValues& p) { return p.error * p.error - p.variance; }, true}},
      {"mean_error", {[](const PixelValues& p) { return p.error; }}},
      {"lit", {truth}},
      {"mean_truth", {truth}},
      {"blocked", {[](const PixelValues& p) { return 1.0 - p.truth; }}},
      {"mean_raster", {raster}},
      {"penumbra", {penumbra}},
      {"penumbra_mae",
       {[](const PixelValues& p) { return penumbra_error(p.raster, p.truth, p.variance); }, false, penumbra,
        [](const PixelValues& p) { return std::max(penumbra(p), 0.0); }}},
      {"too_dark", {too_dark, false, one, half}},
      {"too_bright", {too_bright, false, one, half}},
      {"false_blocked", {too_dark, false, one, half}},
      {"false_lit", {too_bright, false, one, half}},
      {"acne", {error_of_cause<Cause::acne>}},
      {"false_occlusion", {error_of_cause<Cause::false_occlusion>}},
      {"peter_panning", {error_of_cause<Cause::peter_panning>}},
      {"leak", {error_of_cause<Cause::light_leak>}}};
  for (const auto& [known, mean] : means) {
    if (name == known) return mean;
  }
  return {};
}

struct BlockSum {
  double sum = 0.0;
  double weight = 0.0;
};

struct BlockSums {
  std::vector<BlockSum> blocks;
  int columns = 1;
  BlockSum all;
  double excess = 0.0;
  bool is_root = false;

  BlockPlace place(std::size_t block) const {
    return {static_cast<int>(block) % columns, static_cast<int>(block) / columns};
  }

  double value() const { return value_of(all.sum, all.weight); }
  double value_without(std::size_t block) const {
    return value_of(all.sum - blocks[block].sum, all.weight - blocks[block].weight);
  }

 private:
  double value_of(double sum, double weight) const {
    return is_root ? std::sqrt(std::max(0.0, sum) / weight) : sum / weight;
  }
};

BlockSums sum_blocks(const StoredImages& images, const PixelMean& of) {
  const double reach = noise_reach(images.degrees_of_freedom);
  const Image<float>& error = *images.error;
  const int columns = std::clamp(error.width / min_block_side, 1, max_blocks_of_a_side);
  const int rows = std::clamp(error.height / min_block_side, 1, max_blocks_of_a_side);
  BlockSums sums{std::vector<BlockSum>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)),
                 columns,
                 {},
                 0.0,
                 of.is_root};
  for (int y = 0; y < error.height; ++y) {
    for (int x = 0; x < error.width; ++x) {
      const std::size_t i = error.index(x, y);
      if (!is_counted(images, i)) continue;
      const int block = y * rows / error.height * columns + x * columns / error.width;
      const PixelValues values = values_at(images, i);
      const double term = of.term(values);
      const double weight = of.weight(values);
      if (of.of_excess != nullptr) sums.excess += excess_of(of, values, reach);
      for (BlockSum* each : {&sums.blocks[static_cast<std::size_t>(block)], &sums.all}) {
        each->sum += term;
        each->weight += weight;
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
  return sums.all.weight > 0.0 && std::abs(sums.value() - reported) <= 1e-6 + 1e-4 * std::abs(reported);
}

// The sums of a statistic, if the run's images give its value. Runs of earlier versions do not hold the causes of each
// tap, or the counted pixels.
std::optional<BlockSums> sums_of(const StoredRun& run, const MeasuredStatistic& statistic) {
  const PixelMean mean = mean_of(statistic.name);
  const StoredImages images = images_of(run, statistic);
  if (mean.term == nullptr || images.error == nullptr || images.position == nullptr) return std::nullopt;
  BlockSums sums = sum_blocks(images, mean);
  if (!gives(sums, statistic.value)) return std::nullopt;
  return sums;
}

// The interval about `value` from the values without each block.
std::optional<BlockEstimate> jackknife(double value, const std::vector<double>& without,
                                       const std::vector<BlockPlace>& places) {
  if (without.size() < fewest_blocks) return std::nullopt;
  const JackknifeVariance spread = jackknife_variance(without, places);
  const double half_width = student_95(spread.degrees_of_freedom) * std::sqrt(spread.variance);
  return BlockEstimate{value, half_width, 0.0, 0.0, without.size()};
}

// What noise may have added to the statistic of each of two runs that see the same surfels, as far as it does not
// cancel in their difference. With one reference, noise adds n(e) to the error e of the one and n(e + d) to that of the
// other, where d is the difference of the techniques. As n falls no faster than |e| grows, these differ by at most |d|.
std::array<double, 2> uncommon_excess(const StoredImages& a, const StoredImages& b, const PixelMean& mean) {
  std::array<double, 2> sums{};
  if (mean.of_excess == nullptr) return sums;
  const std::array<double, 2> reach = {noise_reach(a.degrees_of_freedom), noise_reach(b.degrees_of_freedom)};
  for (std::size_t i = 0; i < a.error->size(); ++i) {
    const std::array<PixelValues, 2> values = {values_at(a, i), values_at(b, i)};
    const bool is_shared = values[0].truth == values[1].truth && values[0].variance == values[1].variance;
    const double most =
        is_shared ? std::abs(values[1].error - values[0].error) : std::numeric_limits<double>::infinity();
    for (std::size_t run = 0; run < 2; ++run) {
      if (!is_counted(run == 0 ? a : b, i)) continue;
      const double share = mean.of_excess(values[run]);
      if (share > 0.0) sums[run] += std::min(excess_of(mean, values[run], reach[run]), share * most);
    }
  }
  return sums;
}

// Whether each counted pixel is right or wrong and nothing between, and the reference exact. The RMS error is then the
// root of the mean absolute error.
bool is_right_or_wrong(const StoredImages& images) {
  for (std::size_t i = 0; i < images.error->size(); ++i) {
    if (!is_counted(images, i)) continue;
    const PixelValues values = values_at(images, i);
    if (values.variance > 0.0 || (values.error != 0.0 && std::abs(values.error) != 1.0)) return false;
  }
  return true;
}

}  // namespace

std::optional<BlockEstimate> estimate_over_blocks(const StoredRun& run, const MeasuredStatistic& statistic) {
  const std::optional<BlockSums> sums = sums_of(run, statistic);
  if (!sums) return std::nullopt;
  std::vector<double> without;
  std::vector<BlockPlace> places;
  for (std::size_t i = 0; i < sums->blocks.size(); ++i) {
    if (sums->blocks[i].weight == 0.0 || !std::isfinite(sums->value_without(i))) continue;
    without.push_back(sums->value_without(i));
    places.push_back(sums->place(i));
  }
  std::optional<BlockEstimate> estimate = jackknife(statistic.value, without, places);
  if (estimate) estimate->added = sums->excess / sums->all.weight;
  return estimate;
}

std::size_t count_counted_blocks(const StoredRun& run, const MeasuredStatistic& statistic) {
  const std::optional<BlockSums> sums = sums_of(run, statistic);
  if (!sums) return 0;
  return static_cast<std::size_t>(
      std::ranges::count_if(sums->blocks, [](const BlockSum& block) { return block.weight > 0.0; }));
}

std::optional<BlockEstimate> paired_difference(const StoredRun& a, const MeasuredStatistic& of_a, const StoredRun& b,
                                               const MeasuredStatistic& of_b) {
  std::optional<BlockSums> sums_a = sums_of(a, of_a);
  std::optional<BlockSums> sums_b = sums_of(b, of_b);
  const StoredImages images_a = images_of(a, of_a);
  const StoredImages images_b = images_of(b, of_b);
  if (!sums_a || !sums_b || !see_the_same(*images_a.position, *images_b.position)) return std::nullopt;
  // √b − √a is (b − a) / (√a + √b): with its interval the RMS error has the verdict of the mean absolute error, of
  // which it says the same.
  double scale = 1.0;
  if (sums_a->is_root && of_a.value + of_b.value > 0.0 && is_right_or_wrong(images_a) && is_right_or_wrong(images_b)) {
    scale = 1.0 / (of_a.value + of_b.value);
    sums_a->is_root = sums_b->is_root = false;
  }
  std::vector<double> without;
  std::vector<BlockPlace> places;
  for (std::size_t i = 0; i < sums_a->blocks.size(); ++i) {
    if (sums_a->blocks[i].weight + sums_b->blocks[i].weight == 0.0) continue;
    const double difference = scale * (sums_b->value_without(i) - sums_a->value_without(i));
    if (!std::isfinite(difference)) continue;
    without.push_back(difference);
    places.push_back(sums_a->place(i));
  }
  std::optional<BlockEstimate> estimate = jackknife(of_b.value - of_a.value, without, places);
  if (estimate) {
    const auto [in_a, in_b] = uncommon_excess(images_a, images_b, mean_of(of_a.name));
    estimate->added = in_b / sums_b->all.weight;
    estimate->taken = in_a / sums_a->all.weight;
  }
  return estimate;
}

}  // namespace umbrameter
