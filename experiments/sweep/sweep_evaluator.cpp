#include "experiments/sweep/sweep_evaluator.h"

#include <algorithm>
#include <functional>
#include <memory>

#include "core/interrupt.h"
#include "experiments/measure/measure.h"
#include "experiments/measure/measure_ao_axes.h"
#include "experiments/measure/measure_biases.h"
#include "experiments/measure/measure_image.h"
#include "experiments/measure/metric_scores.h"
#include "experiments/sweep/look_ahead.h"

namespace umbrameter {
namespace {

// The statistics of a cell, and where its images come from.
struct MeasuredCell {
  CellStatistics statistics;
  std::function<ComparedImages()> images;
};

// Measures one cell. The overload selects the kind of statistics; its argument is not read.
struct MeasureCell {
  Stages& stages;
  const Experiment& experiment;
  const std::function<Image<float>()>& draw_visibility;

  std::uint32_t light() const { return stages.lights(experiment.view.light).front(); }

  MeasuredCell operator()(const VisibilityStatistics&) const {
    if (stages.has_engine()) draw_visibility();  // with other cells in one request; measure_shadow() then finds it
    ShadowMeasurement measured = measure_shadow(stages, experiment, light(), {});
    return {std::get<VisibilityStatistics>(*measured.statistics), of_visibility(measured.raster->visibility)};
  }
  MeasuredCell operator()(const EdgeStatistics&) const {
    const Image<float> drawn = draw_visibility();
    return {measure_edges(stages, experiment, light(), drawn), of_visibility(drawn)};
  }
  MeasuredCell operator()(const SoftVisibilityStatistics&) const {
    const Image<float> drawn = draw_visibility();
    const auto truth = stages.truth(experiment, light());
    const auto counted = stages.counted(experiment, light());
    return {analyze_soft_visibility(drawn, sampled(*truth), *counted), of_visibility(drawn)};
  }
  MeasuredCell operator()(const AoStatistics&) const {
    AoMeasurement measured = measure_ao(stages, experiment, {});
    return {*measured.statistics, [this, drawn = *measured.raster] { return compared_ao(stages, experiment, drawn); }};
  }
  MeasuredCell operator()(const ImageStatistics&) const {
    ImageMeasurement measured = measure_image(stages, experiment, stages.lights(experiment.view.light), {});
    return {*measured.statistics, [this, images = ColorImages{measured.raster->radiance, *measured.truth}] {
              return compared_image(stages, experiment, images);
            }};
  }

 private:
  std::function<ComparedImages()> of_visibility(Image<float> drawn) const {
    return [this, drawn = std::move(drawn)] { return compared_visibility(stages, experiment, light(), drawn); };
  }
};

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
      const MeasureCell measure{stages, cell, draw};
      const MeasuredCell measured = std::visit(measure, statistics);
      std::vector<Value> row = row_of(measured.statistics);
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

void measure_ao_group(Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                      const CellGroup& group, const RowSink& keep) {
  const auto values_of = [&](std::string_view key, const auto& read) {
    return along(stages, experiment, axes, group, key, read);
  };
  const AoCells cells{
      values_of(ao_bias_key, [](const AoParams& ao) { return static_cast<float>(ao.bias.depth.number); }),
      values_of(ao_samples_key, [](const AoParams& ao) { return ao.sampling.samples; }),
      values_of(ao_intensity_key, [](const AoParams& ao) { return ao.tone.intensity; }),
      values_of(ao_power_key, [](const AoParams& ao) { return ao.tone.power; })};
  RowsInOrder<AoStatistics> rows(keep);
  const Experiment of_group = cell_in_metres(stages, experiment, axes, group.values);
  for (const AoStatistics& statistics : measure_ao_axes(stages, of_group, cells)) rows(statistics);
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
  const bool has_sampled_reference = varies_group(axes, "light.") || varies_group(axes, "truth.shadow") ||
                                     std::any_of(lights.begin(), lights.end(), [&](std::uint32_t light) {
                                       return stages.is_sampled(experiment, light);
                                     });
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
