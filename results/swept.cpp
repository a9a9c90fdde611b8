#include "results/swept.h"

#include <algorithm>
#include <array>

#include "core/error.h"

namespace umbrameter {
namespace {

// Calls `take` for each combination of axis values that are words: techniques, kernels, switches and lights. Other axes
// stay at their first value, because capabilities do not depend on numbers.
void for_each_technique_from(Experiment experiment, const std::vector<SweepAxis>& axes,
                             const std::function<void(const Experiment&)>& take, std::size_t axis) {
  if (axis == axes.size()) return take(experiment);
  const Parameters parameters = describe(experiment);
  const std::vector<Value>& values = axes[axis].values;
  const bool is_word = !values.empty() && (std::holds_alternative<std::string>(values.front()) ||
                                           std::holds_alternative<bool>(values.front()));
  for (const Value& value : axes[axis].values) {
    set_value(parameters, axes[axis], value);
    for_each_technique_from(experiment, axes, take, axis + 1);
    if (!is_word) return;
  }
}

}  // namespace

std::string_view quantity_name(SweptQuantity quantity) {
  return quantity == SweptQuantity::ao ? "ao" : quantity == SweptQuantity::image ? "image" : "visibility";
}

std::string_view quantity_title(SweptQuantity quantity) {
  return quantity == SweptQuantity::ao      ? "ambient occlusion"
         : quantity == SweptQuantity::image ? "the shaded image"
                                            : "shadows";
}

SweptQuantity quantity_of(const CellStatistics& statistics) {
  if (std::holds_alternative<AoStatistics>(statistics)) return SweptQuantity::ao;
  return std::holds_alternative<ImageStatistics>(statistics) ? SweptQuantity::image : SweptQuantity::visibility;
}

bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group) {
  return std::ranges::any_of(axes, [&](const SweepAxis& axis) { return axis.key.rfind(group, 0) == 0; });
}

bool varies_filter(const std::vector<SweepAxis>& axes, const Parameters& parameters) {
  if (varies_group(axes, "shadow.filter")) return true;
  const bool has_filter = to_string(require(parameters, "shadow.filter").value()) != "nearest";
  return std::ranges::any_of(axes, [&](const SweepAxis& axis) {
    return axis.key == "shadow.technique" && std::ranges::any_of(axis.values, [&](const Value& value) {
             const std::string technique = to_string(value);
             return has_filter || (technique != "pcf" && technique != "pcss");
           });
  });
}

bool needs_biases(const std::vector<SweepAxis>& axes) {
  constexpr std::array<std::string_view, 4> keys = {"shadow.technique", "shadow.filter", "shadow.filter-size",
                                                    "shadow.filter-radius"};
  const bool has_biases = std::ranges::find(axes, constant_bias_key, &SweepAxis::key) != axes.end();
  return !has_biases && std::ranges::any_of(axes, [&](const SweepAxis& axis) {
    return axis.values.size() != 1 && std::ranges::find(keys, axis.key) != keys.end();
  });
}

bool changes_reference(std::string_view key) { return key.starts_with("light.") || key.starts_with("truth."); }

bool varies_reference(const std::vector<SweepAxis>& axes) {
  constexpr std::array<std::string_view, 3> keys = {"view.light", "view.camera", "view.scene"};
  return std::ranges::any_of(axes, [&](const SweepAxis& axis) {
    return axis.values.size() != 1 && (changes_reference(axis.key) || std::ranges::find(keys, axis.key) != keys.end());
  });
}

SweptQuantity choose_quantity(SweepMeasure given, const std::vector<SweepAxis>& axes) {
  if (given == SweepMeasure::visibility) return SweptQuantity::visibility;
  if (given == SweepMeasure::ao) return SweptQuantity::ao;
  if (given == SweepMeasure::image || varies_group(axes, "shading.")) return SweptQuantity::image;
  const bool ao = std::ranges::any_of(axes, [](const SweepAxis& axis) {
    return axis.key.starts_with("ao.") || is_engine_ao(axis.key) ||
           (axis.key.starts_with("truth.") && axis.key != "truth.shadow");
  });
  const bool shadows = std::ranges::any_of(axes, [](const SweepAxis& axis) {
    return axis.key.starts_with("shadow.") || axis.key.starts_with("light.") ||
           (axis.key.starts_with("engine.") && !is_engine_ao(axis.key));
  });
  if (ao && shadows) {
    throw Error(ExitCode::usage, "--vary", "the axes vary both shadows and ambient occlusion",
                "choose what to measure: --measure visibility, ao or image");
  }
  return ao ? SweptQuantity::ao : SweptQuantity::visibility;
}

Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values) {
  const Parameters parameters = describe(experiment);
  for (std::size_t a = 0; a < axes.size(); ++a) set_value(parameters, axes[a], values[a]);
  return experiment;
}

void for_each_technique(const Experiment& experiment, const std::vector<SweepAxis>& axes,
                        const std::function<void(const Experiment&)>& take) {
  for_each_technique_from(experiment, axes, take, 0);
}

bool is_ao_one_pass(const AoParams& params) {
  return blur_of(params).kind == AoBlur::none && params.resolution.kind == AoResolution::full &&
         !reads_surface(params.tone) && capabilities_of(make_technique(params)).flips_at_bias;
}

std::vector<MetricColumn> swept_metrics(const Experiment& experiment, const CellStatistics& statistics) {
  CellStatistics described = statistics;
  return metric_columns(experiment.run, quantity_of(statistics) == SweptQuantity::visibility, describe(described));
}

std::vector<Column> measured_columns(const Experiment& experiment, CellStatistics statistics) {
  std::vector<Column> columns = columns_of(describe(statistics));
  for (const MetricColumn& metric : swept_metrics(experiment, statistics)) {
    columns.push_back({metric.name, metric.unit, metric.meaning()});
  }
  return columns;
}

std::vector<Value> sample_row(const Experiment& experiment, CellStatistics statistics) {
  std::vector<Value> row = row_of(describe(statistics));
  row.resize(row.size() + swept_metrics(experiment, statistics).size(), 0.0);
  return row;
}

InnerKeys inner_keys(const Experiment& experiment, const std::vector<SweepAxis>& axes, SweptQuantity quantity) {
  if (quantity != SweptQuantity::ao) return {constant_bias_key, slope_bias_key};
  bool is_one_pass = true;
  bool is_prefix = true;
  for_each_technique(experiment, axes, [&](const Experiment& cell) {
    is_one_pass = is_one_pass && is_ao_one_pass(cell.ao);
    is_prefix = is_prefix && capabilities_of(make_technique(cell.ao)).samples_are_prefix;
  });
  if (!is_one_pass) return {};
  if (!is_prefix) return {ao_bias_key, ao_intensity_key, ao_power_key};
  return {ao_bias_key, ao_samples_key, ao_intensity_key, ao_power_key};
}

}  // namespace umbrameter
