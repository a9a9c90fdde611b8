#include "compare/ao_response.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "core/quantiles.h"
#include "techniques/ao/ssao.h"

namespace umbrameter {
namespace {

// What each pixel adds to a cell.
enum Quantity : std::size_t { value, absolute, squared, squared_noise, excess, quantities };

constexpr std::size_t part_count = 8;

// folded_excess(e, 1) by cubic Hermite interpolation; its slope is −erfc(e/√2). Within 10⁻¹¹.
class UnitExcess {
 public:
  static constexpr int intervals = 1152;
  static constexpr double step = 9.0 / intervals;

  UnitExcess() {
    const auto value = [](int i) { return folded_excess(i * step, 1.0); };
    const auto slope = [](int i) { return -step * std::erfc(i * step / std::sqrt(2.0)); };
    for (int i = 0; i < intervals; ++i) {
      const double rise = value(i + 1) - value(i);
      cubics_[static_cast<std::size_t>(i)] = {value(i), slope(i), 3.0 * rise - 2.0 * slope(i) - slope(i + 1),
                                              slope(i) + slope(i + 1) - 2.0 * rise};
    }
  }
  /// At a number of steps, from 0 on.
  double operator()(double steps) const {
    if (steps >= intervals) return 0.0;  // below 10⁻¹⁹
    const int i = static_cast<int>(steps);
    const double t = steps - i;
    const std::array<double, 4>& c = cubics_[static_cast<std::size_t>(i)];
    return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
  }

 private:
  std::array<std::array<double, 4>, intervals> cubics_;
};

const UnitExcess& unit_excess() {
  static const UnitExcess table;
  return table;
}

// The biases below `end`, down to the end of the run before, at which the occlusion has the same sum.
struct Run {
  std::uint32_t end = 0;
  float sum = 0.0f;
};

// Adds, in single precision and in the order of the samples, as the shader does.
void add_sample(std::vector<Run>& runs, const OccludingSample& sample) {
  std::size_t i = 0;
  for (; i < runs.size() && runs[i].end <= sample.biases(); ++i) runs[i].sum += sample.weight;
  const std::uint32_t begin = i > 0 ? runs[i - 1].end : 0;
  if (i == runs.size() || begin == sample.biases()) return;
  runs.insert(runs.begin() + static_cast<std::ptrdiff_t>(i), {sample.biases(), runs[i].sum + sample.weight});
}

float accessibility(float occlusion, int samples) {
  return std::max(1.0f - occlusion * share_of_sample(samples), 0.0f);
}

}  // namespace

struct AoResponse::Pixel {
  double truth = 0.0;
  double variance = 0.0;
  double deviation = 0.0;
  double reach = 0.0;                     // an error this large may be noise of the truth
  double steps = 0.0;                     // of UnitExcess, for an error of 1
  std::array<double, quantities> open{};  // what it adds to a cell in which it is open
  std::span<const OccludingSample> samples{};
  std::size_t next = 0;  // of `samples`
  std::vector<Run> runs{};
};

namespace {

// What a pixel adds at these accessibilities, less what it adds when it is open: [quantity][tone]. Also the absolute
// errors.
template <class Pixel>
void add_up(const Pixel& pixel, std::span<const float> accessibilities, double* out, double* errors) {
  const std::size_t tones = accessibilities.size();
  const float* ao = accessibilities.data();
  // Copies, which `out` cannot alias.
  const std::array<double, quantities> open = pixel.open;
  const double truth = pixel.truth;
  const double variance = pixel.variance;
  for (std::size_t t = 0; t < tones; ++t) {
    const double accessible = static_cast<double>(ao[t]);
    const double error = accessible - truth;
    errors[t] = std::abs(error);
    out[value * tones + t] = accessible - open[value];
    out[absolute * tones + t] = std::abs(error) - open[absolute];
    out[squared * tones + t] = error * error - open[squared];
    out[squared_noise * tones + t] = error * error * variance - open[squared_noise];
  }
  if (variance <= 0.0) {
    std::fill_n(out + excess * tones, tones, 0.0);
    return;
  }
  const UnitExcess& table = unit_excess();
  const double reach = pixel.reach;
  const double steps = pixel.steps;
  const double deviation = pixel.deviation;
  for (std::size_t t = 0; t < tones; ++t) {
    const double certain = std::max(errors[t] - reach, 0.0);
    const double added = std::min(deviation * table(certain * steps), most_excess(static_cast<double>(ao[t])));
    out[excess * tones + t] = added - open[excess];
  }
}

}  // namespace

AoResponse::AoResponse(const SampledImage& truth, const GBuffer& gbuffer, AoAxes axes)
    : truth_(truth),
      gbuffer_(gbuffer),
      axes_(std::move(axes)),
      noise_reach_(noise_reach(truth.degrees_of_freedom)),
      parts_(part_count) {
  assert(!axes_.biases.empty() && !axes_.samples.empty() && !axes_.tones.empty());
  for (Part& part : parts_) {
    part.changes.assign(axes_.cells() * quantities, 0.0);
    part.largest.assign(axes_.cells(), 0.0);
    part.floor.assign(axes_.samples.size() * axes_.tones.size(), 0.0);
  }
  for (const int samples : axes_.samples) {
    std::vector<float>& table = counted_tones_.emplace_back();
    for (int sum = 0; sum <= samples; ++sum) {
      const float ao = accessibility(static_cast<float>(sum), samples);
      for (const AoToneParams& tone : axes_.tones) table.push_back(with_tone(ao, tone));
    }
  }
}

void AoResponse::raise_largest(Part& part, std::size_t samples, std::size_t tone, std::size_t begin, std::size_t end,
                               double error) const {
  const std::size_t line = samples * axes_.tones.size() + tone;
  if (error <= part.floor[line]) return;
  double* largest = part.largest.data() + line * axes_.biases.size();
  for (std::size_t b = begin; b < end; ++b) largest[b] = std::max(largest[b], error);
}

void AoResponse::add_pixel(Part& part, const Pixel& pixel, std::size_t samples, Scratch& scratch) const {
  const std::size_t biases = axes_.biases.size();
  const std::size_t tones = axes_.tones.size();
  const std::size_t size = quantities * tones;
  const int count = axes_.samples[samples];
  double* line = part.changes.data() + samples * biases * size;
  std::uint32_t begin = 0;
  bool was_open = true;
  for (const Run& run : pixel.runs) {
    const std::uint32_t first = std::exchange(begin, run.end);
    double* change = line + first * size;
    if (run.sum == 0.0f) {  // and at every larger bias
      if (!was_open) {
        for (std::size_t i = 0; i < size; ++i) change[i] -= scratch.last[i];
      }
      for (std::size_t t = 0; t < tones; ++t) {
        raise_largest(part, samples, t, first, biases, pixel.open[absolute]);
      }
      return;
    }
    std::span<const float> ao = scratch.tones;
    if (run.sum == std::floor(run.sum)) {
      ao = std::span(counted_tones_[samples]).subspan(static_cast<std::size_t>(run.sum) * tones, tones);
    } else {
      const float open = accessibility(run.sum, count);
      for (std::size_t t = 0; t < tones; ++t) scratch.tones[t] = with_tone(open, axes_.tones[t]);
    }
    add_up(pixel, ao, scratch.now.data(), scratch.errors.data());
    if (was_open) {
      for (std::size_t i = 0; i < size; ++i) change[i] += scratch.now[i];
    } else {
      for (std::size_t i = 0; i < size; ++i) change[i] += scratch.now[i] - scratch.last[i];
    }
    for (std::size_t t = 0; t < tones; ++t) {
      raise_largest(part, samples, t, first, run.end, scratch.errors[t]);
    }
    std::swap(scratch.now, scratch.last);
    was_open = false;
  }
}

void AoResponse::add_row(Part& part, const AoResponseRow& row) const {
  constexpr std::array<float, 1> one{1.0f};
  std::vector<Pixel> occluded;
  for (std::size_t x = 0; x < row.counts.size(); ++x) {
    const std::size_t i = gbuffer_.instance.index(static_cast<int>(x), row.y);
    if (!gbuffer_.is_surface(i)) continue;
    Pixel pixel;
    pixel.truth = static_cast<double>(truth_.value[i]);
    pixel.variance = truth_.variance.empty() ? 0.0 : static_cast<double>(truth_.variance[i]);
    pixel.deviation = std::sqrt(pixel.variance);
    pixel.reach = noise_reach_ * pixel.deviation;
    if (pixel.variance > 0.0) pixel.steps = 1.0 / (UnitExcess::step * pixel.deviation);
    double error = 0.0;
    add_up(pixel, one, pixel.open.data(), &error);
    ErrorSums& open = part.open;
    ++open.pixels;
    open.raster += pixel.open[value];
    open.truth += pixel.truth;
    open.absolute += pixel.open[absolute];
    open.absolute_bias += pixel.open[excess];
    open.squared += pixel.open[squared];
    open.squared_noise += pixel.open[squared_noise];
    open.variance += pixel.variance;
    open.variance_squared += pixel.variance * pixel.variance;
    const double samples = truth_.samples.empty() ? 0.0 : static_cast<double>(truth_.samples[i]);
    if (samples > 0.0) open.min_samples = std::min(open.min_samples, samples);
    if (row.counts[x] == 0) {
      part.largest_open = std::max(part.largest_open, pixel.open[absolute]);
      continue;
    }
    pixel.samples = row.pixel(x);
    pixel.runs = {{static_cast<std::uint32_t>(axes_.biases.size()), 0.0f}};
    occluded.push_back(std::move(pixel));
  }
  Scratch scratch{std::vector<float>(axes_.tones.size()), std::vector<double>(quantities * axes_.tones.size()),
                  std::vector<double>(quantities * axes_.tones.size()), std::vector<double>(axes_.tones.size())};
  // The number of samples is the outer loop, because its part of the changes fits into the processor's first cache.
  for (std::size_t s = 0; s < axes_.samples.size(); ++s) {
    for (Pixel& pixel : occluded) {
      while (pixel.next < pixel.samples.size() && pixel.samples[pixel.next].index() < axes_.samples[s]) {
        add_sample(pixel.runs, pixel.samples[pixel.next++]);
      }
      add_pixel(part, pixel, s, scratch);
    }
    for (std::size_t t = 0; t < axes_.tones.size(); ++t) {
      const std::size_t line = s * axes_.tones.size() + t;
      const auto first = part.largest.begin() + static_cast<std::ptrdiff_t>(line * axes_.biases.size());
      part.floor[line] = *std::min_element(first, first + static_cast<std::ptrdiff_t>(axes_.biases.size()));
    }
  }
}

void AoResponse::add(std::span<const AoResponseRow> rows) {
  parallel_for(part_count, [&](std::size_t p) {
    for (const AoResponseRow& row : rows) {
      if (static_cast<std::size_t>(row.y) % part_count == p) add_row(parts_[p], row);
    }
  });
}

std::vector<AoStatistics> AoResponse::statistics() const {
  const std::size_t biases = axes_.biases.size();
  const std::size_t tones = axes_.tones.size();
  ErrorSums open;
  double largest_open = 0.0;
  for (const Part& part : parts_) {
    umbrameter::add(open, part.open);
    largest_open = std::max(largest_open, part.largest_open);
  }
  std::vector<AoStatistics> all(axes_.cells());
  for (std::size_t s = 0; s < axes_.samples.size(); ++s) {
    for (std::size_t t = 0; t < tones; ++t) {
      ErrorSums sums = open;
      for (std::size_t b = 0; b < biases; ++b) {
        for (const Part& part : parts_) {
          const double* change = part.changes.data() + (s * biases + b) * quantities * tones + t;
          sums.raster += change[value * tones];
          sums.absolute += change[absolute * tones];
          sums.squared += change[squared * tones];
          sums.squared_noise += change[squared_noise * tones];
          sums.absolute_bias += change[excess * tones];
        }
        sums.error = sums.raster - sums.truth;
        SampledError& error = all[(b * axes_.samples.size() + s) * tones + t].error;
        error = statistics_of(sums, truth_.degrees_of_freedom);
        error.too_dark = error.too_bright = {};
        error.max_error = largest_open;
        for (const Part& part : parts_) {
          error.max_error = std::max(error.max_error, part.largest[(s * tones + t) * biases + b]);
        }
      }
    }
  }
  return all;
}

}  // namespace umbrameter
