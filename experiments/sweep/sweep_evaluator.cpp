#include "experiments/sweep/sweep_evaluator.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <memory>

#include "compare/ao_response.h"
#include "core/interrupt.h"
#include "experiments/measure/compared_case.h"
#include "experiments/measure/measure_biases.h"

namespace umbrameter {
namespace {

// Draws cells of a sweep that differ only in what the look-up reads, many in one pass.
class LookAhead {
 public:
  // The technique's visibility at the cell with these values of the axes; the same to the bit as that of
  // Stages::draw(). Draws the cells beside it along the axes of lookup_parameters() in the same pass, and keeps them.
  Image<float> visibility(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                          const std::vector<Value>& values);

 private:
  std::string drawn_;  // the values of the other axes, and the number of the pass
  std::vector<Image<float>> images_;
};

// The visibility of one pass takes at most this, unless one image is larger.
constexpr std::size_t most_bytes = std::size_t{256} << 20;

std::size_t images_per_pass(const Size& size) {
  const std::size_t bytes =
      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * sizeof(float);
  return std::clamp<std::size_t>(most_bytes / bytes, 1, max_lookups);
}

std::size_t index_of(const SweepAxis& axis, const Value& value) {
  const auto found = std::ranges::find(axis.values, value);
  return static_cast<std::size_t>(found - axis.values.begin());
}

Image<float> LookAhead::visibility(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                   const std::vector<Value>& values) {
  Experiment cell = cell_in_metres(stages, experiment, axes, values);
  const std::uint32_t light = stages.lights(cell.view.light).front();
  const Parameters of_lookup = stages.has_engine() ? describe(cell.engine) : lookup_parameters(cell.shadow);
  std::vector<std::size_t> varied;
  std::string others;
  std::size_t cells = 1;
  std::size_t index = 0;  // of the cell among those that differ only in the look-up; the last axis varies fastest
  for (std::size_t a = 0; a < axes.size(); ++a) {
    if (find(of_lookup, axes[a].key) == nullptr) {
      others += to_string(values[a]) + "\n";
      continue;
    }
    varied.push_back(a);
    cells *= axes[a].values.size();
    index = index * axes[a].values.size() + index_of(axes[a], values[a]);
  }
  if (cells == 1) return stages.draw(cell, light, false).visibility;

  const std::size_t at_once = stages.has_engine() ? most_frames_at_once : images_per_pass(cell.view.size);
  const std::size_t first = index / at_once * at_once;
  if (others + std::to_string(first) != drawn_) {
    std::vector<Experiment> experiments;
    for (std::size_t i = first; i < std::min(first + at_once, cells); ++i) {
      std::vector<Value> of_cell = values;
      std::size_t rest = i;
      for (auto a = varied.rbegin(); a != varied.rend(); ++a) {
        of_cell[*a] = axes[*a].values[rest % axes[*a].values.size()];
        rest /= axes[*a].values.size();
      }
      experiments.push_back(cell_in_metres(stages, experiment, axes, of_cell));
    }
    images_ = stages.draw_lookups(experiments, light);
    drawn_ = others + std::to_string(first);
  }
  return images_[index - first];
}

void append_scores(std::vector<Value>& row, const std::vector<MetricColumn>& columns, const ComparedImages& images) {
  for (const MetricScore& scored : score(columns, images)) row.emplace_back(scored.score);
}

// Measures the cells of a group one by one.
struct CellByCell {
  Stages& stages;
  const Experiment& experiment;
  const std::vector<SweepAxis>& axes;
  const CellStatistics& statistics;
  LookAhead& look_ahead;

  void operator()(const CellGroup& group, const RowSink& keep) const {
    // Extents may be varied, and not every combination of them makes sense.
    const Experiment of_group = cell_in_metres(stages, experiment, axes, group.values);
    const SweptQuantity quantity = quantity_of(statistics);
    if (quantity != SweptQuantity::ao) {
      stages.check_is_meaningful(of_group, swept_lights(stages, experiment, axes, quantity));
    }
    const std::vector<MetricColumn> metrics = swept_metrics(experiment, statistics);
    for (std::size_t place = 0; place < group.size(); ++place) {
      throw_if_interrupted();
      const std::vector<Value> values = values_at(group, place);
      Experiment cell = cell_in_metres(stages, experiment, axes, values);
      cell.run.metrics.clear();
      const std::function<Image<float>()> draw = [&] {
        return look_ahead.visibility(stages, experiment, axes, values);
      };
      const ComparedCase measured = compare_case(stages, cell, statistics, draw);
      CellStatistics of_cell = measured.statistics({});
      std::vector<Value> row = row_of(of_cell);
      if (!metrics.empty()) append_scores(row, metrics, measured.images());
      keep(place, row);
    }
  }
};

// Passes rows to the sink in the order of the group's places.
template <class Struct>
class RowsInOrder {
 public:
  explicit RowsInOrder(const RowSink& keep) : keep_(keep) {}
  void operator()(const Struct& statistics) {
    cell_ = statistics;
    keep_(place_++, row_of(described_));
  }

 private:
  const RowSink& keep_;
  Struct cell_;
  const Statistics described_ = describe(cell_);  // made once, because it allocates the names of all columns
  std::size_t place_ = 0;
};

void measure_bias_group(Stages& stages, const Experiment& experiment, const CellGroup& group, const RowSink& keep) {
  const std::uint32_t light = stages.lights(experiment.view.light).front();
  const auto measured = measure_biases(stages, experiment, light, group.inner[0].values, group.inner[1].values);
  RowsInOrder<VisibilityStatistics> rows(keep);
  for (std::size_t c = 0; c < group.inner[0].values.size(); ++c) {
    for (const std::vector<VisibilityStatistics>& at_slope : measured) rows(at_slope[c]);
  }
}

// The experiment's parameters of AO for each value of an inner axis.
template <class Read>
auto along(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
           const CellGroup& group, std::string_view key, const Read& read) {
  const auto read_at = [&](const std::vector<Value>& values) {
    return read(cell_in_metres(stages, experiment, axes, values).ao);
  };
  std::vector<decltype(read(AoParams{}))> all;
  std::size_t stride = group.size();
  for (const InnerAxis& inner : group.inner) {
    stride /= inner.values.size();
    if (!inner.axis || axes[*inner.axis].key != key) continue;
    for (std::size_t i = 0; i < inner.values.size(); ++i) all.push_back(read_at(values_at(group, i * stride)));
  }
  if (all.empty()) all.push_back(read_at(group.values));
  return all;
}

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

// The cells' numbers of samples beyond one need a technique whose samples are a prefix.
void measure_ao_group(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                      const CellGroup& group, const RowSink& keep) {
  const auto values_of = [&](std::string_view key, const auto& read) {
    return along(stages, experiment, axes, group, key, read);
  };
  const auto biases =
      values_of(ao_bias_key, [](const AoParams& ao) { return static_cast<float>(ao.bias.depth.number); });
  const auto samples = values_of(ao_samples_key, [](const AoParams& ao) { return ao.sampling.samples; });
  const auto powers = values_of(ao_power_key, [](const AoParams& ao) { return ao.tone.power; });
  const Experiment of_group = cell_in_metres(stages, experiment, axes, group.values);
  AoAxes once{ascending(biases), ascending(samples), {}};
  for (const double intensity : values_of(ao_intensity_key, [](const AoParams& ao) { return ao.tone.intensity; })) {
    for (const double power : powers) {
      AoToneParams& tone = once.tones.emplace_back(of_group.ao.tone);
      tone.intensity = intensity;
      tone.power = power;
    }
  }
  assert(is_ao_one_pass(of_group.ao));
  assert(once.samples.size() == 1 || capabilities_of(make_technique(of_group.ao)).samples_are_prefix);
  const auto truth = stages.ao_truth(of_group);
  const auto surfels = stages.surfels(of_group);
  AoResponse response({truth->ao, truth->variance, truth->samples, truth->degrees_of_freedom}, surfels->gbuffer, once);
  stages.draw_ao_response(of_group, once, [&](std::span<const AoResponseRow> drawn) { response.add(drawn); });
  const std::vector<AoStatistics> measured = response.statistics();
  RowsInOrder<AoStatistics> rows(keep);
  for (const float bias : biases) {
    for (const int count : samples) {
      const std::size_t line = index_in(once.biases, bias) * once.samples.size() + index_in(once.samples, count);
      for (std::size_t tone = 0; tone < once.tones.size(); ++tone) rows(measured[line * once.tones.size() + tone]);
    }
  }
}

// Adds the metrics to the rows that one pass has measured, from the image of each cell.
RowSink with_metrics(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                     const std::vector<MetricColumn>& metrics, SweptQuantity quantity, const CellGroup& group,
                     const RowSink& keep) {
  return [&, quantity](std::size_t place, std::span<const Value> statistics) {
    throw_if_interrupted();
    const Experiment cell = cell_in_metres(stages, experiment, axes, values_at(group, place));
    std::vector<Value> row(statistics.begin(), statistics.end());
    if (quantity == SweptQuantity::ao) {
      append_scores(row, metrics, compared_ao(stages, cell, stages.draw_ao(cell)));
    } else {
      const std::uint32_t light = stages.lights(cell.view.light).front();
      append_scores(row, metrics, compared_visibility(stages, cell, light, stages.draw(cell, light, false).visibility));
    }
    keep(place, row);
  };
}

}  // namespace

std::vector<std::uint32_t> swept_lights(const Stages& stages, const Experiment& experiment,
                                        const std::vector<SweepAxis>& axes, SweptQuantity quantity) {
  std::vector<std::string> names = {experiment.view.light};
  for (const SweepAxis& axis : axes) {
    if (axis.key != "view.light") continue;
    names.clear();
    for (const Value& value : axis.values) names.push_back(to_string(value));
  }
  std::vector<std::uint32_t> lights;
  for (const std::string& name : names) {
    const std::vector<std::uint32_t> selected = stages.lights(name);
    const std::size_t count = quantity == SweptQuantity::image ? selected.size() : 1;
    lights.insert(lights.end(), selected.begin(), selected.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return lights;
}

CellStatistics choose_statistics(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                                 SweptQuantity quantity) {
  if (quantity == SweptQuantity::ao) return AoStatistics{};
  if (quantity == SweptQuantity::image) return ImageStatistics{};
  const std::vector<std::uint32_t> lights = swept_lights(stages, experiment, axes, quantity);
  const bool has_sampled_reference =
      varies_group(axes, "light.") || varies_group(axes, "truth.shadow") ||
      std::ranges::any_of(lights, [&](std::uint32_t light) { return stages.is_sampled(experiment, light); });
  if (has_sampled_reference) return SoftVisibilityStatistics{};
  bool all_sum_comparisons = true;
  for_each_technique(experiment, axes, [&](const Experiment& cell) {
    all_sum_comparisons = all_sum_comparisons && stages.capabilities(cell).sums_comparisons;
  });
  if (!all_sum_comparisons) return EdgeStatistics{};
  return VisibilityStatistics{};
}

bool is_one_pass(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                 const CellStatistics& statistics) {
  if (std::holds_alternative<AoStatistics>(statistics)) {
    return !inner_keys(experiment, axes, SweptQuantity::ao).empty();
  }
  if (!std::holds_alternative<VisibilityStatistics>(statistics)) return false;
  bool all = true;
  for_each_technique(experiment, axes,
                     [&](const Experiment& cell) { all = all && stages.capabilities(cell).taps_independent_of_bias; });
  return all;
}

Experiment cell_in_metres(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                          const std::vector<Value>& values) {
  return stages.in_metres(at_cell(experiment, axes, values));
}

EvaluateGroup make_evaluator(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                             const CellStatistics& statistics) {
  const bool one_pass = is_one_pass(stages, experiment, axes, statistics);
  return [&stages, experiment, axes, statistics, one_pass, look_ahead = std::make_shared<LookAhead>()](
             const CellGroup& group, const RowSink& keep) {
    if (!one_pass) {
      CellByCell{stages, experiment, axes, statistics, *look_ahead}(group, keep);
      return;
    }
    const std::vector<MetricColumn> metrics = swept_metrics(experiment, statistics);
    const RowSink sink =
        metrics.empty() ? keep : with_metrics(stages, experiment, axes, metrics, quantity_of(statistics), group, keep);
    if (std::holds_alternative<AoStatistics>(statistics)) {
      measure_ao_group(stages, experiment, axes, group, sink);
    } else {
      measure_bias_group(stages, cell_in_metres(stages, experiment, axes, group.values), group, sink);
    }
  };
}

}  // namespace umbrameter
