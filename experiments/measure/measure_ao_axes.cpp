#include "experiments/measure/measure_ao_axes.h"

#include <algorithm>
#include <cassert>

#include "compare/ao_response.h"

namespace umbrameter {
namespace {

template <class T>
std::vector<T> ascending(std::vector<T> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

template <class T>
std::size_t index_in(const std::vector<T>& ascending, T value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(ascending, value) - ascending.begin());
}

}  // namespace

std::vector<AoStatistics> measure_ao_axes(Stages& stages, const Experiment& experiment, const AoCells& cells) {
  AoAxes axes{ascending(cells.biases), ascending(cells.samples), {}};
  assert(is_ao_one_pass(experiment.ao));
  assert(axes.samples.size() == 1 || capabilities_of(make_technique(experiment.ao)).samples_are_prefix);
  for (const double intensity : cells.intensities) {
    for (const double power : cells.powers) {
      AoToneParams& tone = axes.tones.emplace_back(experiment.ao.tone);
      tone.intensity = intensity;
      tone.power = power;
    }
  }
  const auto truth = stages.ao_truth(experiment);
  const auto surfels = stages.surfels(experiment);
  AoResponse response({truth->ao, truth->variance, truth->samples, truth->degrees_of_freedom}, surfels->gbuffer, axes);
  stages.draw_ao_response(experiment, axes, [&](std::span<const AoResponseRow> rows) { response.add(rows); });
  const std::vector<AoStatistics> of_axes = response.statistics();
  std::vector<AoStatistics> measured;
  for (const float bias : cells.biases) {
    for (const int samples : cells.samples) {
      const std::size_t line = index_in(axes.biases, bias) * axes.samples.size() + index_in(axes.samples, samples);
      const auto first = of_axes.begin() + static_cast<std::ptrdiff_t>(line * axes.tones.size());
      measured.insert(measured.end(), first, first + static_cast<std::ptrdiff_t>(axes.tones.size()));
    }
  }
  return measured;
}

}  // namespace umbrameter
