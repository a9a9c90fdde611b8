#include "store/read_bias_curves.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "store/fit_bias_formulas.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_curves = 200;
constexpr std::size_t max_stored_slopes = 4096;
constexpr std::size_t max_stored_lines = 16'384;

std::size_t index_of(std::size_t cell, std::size_t stride, std::size_t count) {
  return stride == 0 ? 0 : cell / stride % count;
}

std::size_t curve_of(const SweepPlan& plan, const std::vector<std::size_t>& others, std::size_t cell) {
  std::size_t curve = 0;
  for (const std::size_t a : others) {
    const std::size_t count = plan.axes[a].values.size();
    curve = curve * count + index_of(cell, plan.strides[a], count);
  }
  return curve;
}

BiasEvidence evidence_of(const VisibilityStatistics& statistics) {
  const auto count = [&](double share) {
    return static_cast<std::uint64_t>(std::llround(share * static_cast<double>(statistics.pixels)));
  };
  return {statistics.pixels, count(statistics.lit), count(statistics.blocked)};
}

void fill(BiasCurves& curves, const SweepResults& sweep, const MeasureBiasContext& measure,
          const std::vector<std::size_t>& others) {
  const SweepPlan& plan = sweep.plan;
  VisibilityStatistics statistics;
  const Statistics described = describe(statistics);
  const std::vector<std::string> names = names_of(
      described, {&statistics.pixels, &statistics.lit, &statistics.blocked, &statistics.mae, &statistics.acne,
                  &statistics.false_occlusion, &statistics.peter_panning, &statistics.leak, &statistics.mean_texel});
  const RowReader reader(described, names);
  std::size_t cell = 0;
  sweep.store.read(names, [&](std::span<const Value> row) {
    const std::size_t at = cell++;
    const std::size_t place = curve_of(plan, others, at);
    if (place >= curves.curves.size()) return;
    reader.read(row);
    if (statistics.pixels == 0) return;
    BiasCurve& curve = curves.curves[place];
    if (curve.others.empty() && !others.empty()) {
      const std::vector<Value> values = values_at(plan, at);
      for (const std::size_t a : others) curve.others.push_back(values[a]);
    }
    if (curve.optima.mean_texel == 0.0) {
      curve.optima.mean_texel = statistics.mean_texel;
      curve.first_cell =
          at - index_of(at, plan.constant_bias.stride, plan.constant_bias.values.size()) * plan.constant_bias.stride -
          index_of(at, plan.slope_bias.stride, plan.slope_bias.values.size()) * plan.slope_bias.stride;
      const bool needs_facts = curves.varies_constant && !others.empty();
      const BiasContext context = measure ? measure(values_at(plan, at), needs_facts) : BiasContext{};
      curve.evidence = context.evidence.value_or(evidence_of(statistics));
      curve.depth_unit = context.depth_unit;
      curve.texels_differ = context.texels_differ;
      curve.facts = context.facts;
    }
    const InnerAxis& constant = plan.constant_bias;
    const InnerAxis& slope = plan.slope_bias;
    const std::size_t line = index_of(at, slope.stride, slope.values.size());
    const BiasCell read{constant.values[index_of(at, constant.stride, constant.values.size())],
                        slope.values[line],
                        statistics.mae,
                        statistics.acne,
                        statistics.false_occlusion,
                        statistics.peter_panning,
                        statistics.leak};
    add(curve.optima.lines[line], read);
    add(curve.optima.front, read);
  });
  // A curve whose cells count no pixel has no error.
  std::erase_if(curves.curves, [](const BiasCurve& curve) { return !least_error(curve.optima); });
}

// Reads one line of cells after the other, so that memory does not grow with the number of curves.
void add_plateaus(BiasCurves& curves, const SweepResults& sweep) {
  const InnerAxis& constant = sweep.plan.constant_bias;
  const InnerAxis& slope = sweep.plan.slope_bias;
  std::map<double, std::size_t> by_bias;
  for (std::size_t i = 0; i < constant.values.size(); ++i) by_bias.emplace(constant.values[i], i);
  for (BiasCurve& curve : curves.curves) {
    const double at_slope = least_error(curve.optima)->slope;
    const auto line = std::ranges::find(slope.values, at_slope) - slope.values.begin();
    std::vector<std::size_t> numbers;
    for (const auto& [bias, index] : by_bias) {
      numbers.push_back(curve.first_cell + index * constant.stride + static_cast<std::size_t>(line) * slope.stride);
    }
    const std::vector<std::string> names = {"mae", "acne", "false_occlusion", "peter_panning", "leak"};
    const Table rows = sweep.store.rows(numbers, names);
    std::vector<BiasCell> cells;
    for (const auto& [bias, index] : by_bias) {
      const std::vector<Value>& row = rows.rows[cells.size()];
      cells.push_back({bias, at_slope, to_number(row[0]), to_number(row[1]), to_number(row[2]), to_number(row[3]),
                       to_number(row[4])});
    }
    curve.plateau = plateau_of(cells, {}, curve.evidence.pixels);
    curve.withheld = reason_against_on_axis(*curve.plateau, curve.evidence);
    const std::vector<std::size_t> gaps = intervals_below(cells, 0.5 * curve.plateau->least.mae);
    if (!gaps.empty()) curve.coarse = {cells[gaps.front()].constant, cells[gaps.back() + 1].constant};
  }
}

}  // namespace

std::optional<BiasCurves> read_bias_curves(const SweepResults& sweep, const MeasureBiasContext& measure) {
  const SweepPlan& plan = sweep.plan;
  BiasCurves curves;
  curves.varies_constant = plan.constant_bias.values.size() > 1;
  curves.varies_slope = plan.slope_bias.values.size() > 1;
  const std::size_t slopes = plan.slope_bias.values.size();
  if (!sweep.is_by_cause() || slopes > max_stored_slopes) return std::nullopt;
  if (!curves.varies_constant && !curves.varies_slope) return std::nullopt;

  const std::vector<std::size_t> others = outer_axes_as_given(plan);
  curves.combinations = 1;
  for (const std::size_t a : others) {
    const std::string& key = plan.axes[a].key;
    curves.others.push_back({key, plan.axes[a].unit, require(sweep.parameters, key).description.meaning});
    curves.combinations *= plan.axes[a].values.size();
  }
  BiasCurve empty;
  for (const double slope : plan.slope_bias.values) {
    empty.optima.lines.emplace_back();
    empty.optima.lines.back().slope = slope;
  }
  curves.curves.assign(std::min({curves.combinations, max_curves, max_stored_lines / slopes}), empty);
  fill(curves, sweep, measure, others);
  if (curves.curves.empty()) return std::nullopt;
  curves.constants = plan.constant_bias.values;
  curves.unit = plan.constant_unit;
  std::ranges::sort(curves.constants);
  if (curves.varies_constant) add_plateaus(curves, sweep);
  if (measure && curves.varies_constant) add_formulas(curves);
  return curves;
}

const BiasCurve* curve_of_cell(const BiasCurves& curves, const SweepPlan& plan, const std::vector<Value>& values) {
  std::vector<Value> others;
  for (const std::size_t a : outer_axes_as_given(plan)) others.push_back(values[a]);
  const auto found = std::ranges::find(curves.curves, others, &BiasCurve::others);
  return found == curves.curves.end() ? nullptr : &*found;
}

}  // namespace umbrameter
