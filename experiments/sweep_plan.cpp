#include "experiments/sweep_plan.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "core/error.h"

namespace umbrameter {
namespace {

void require_axis(const Parameters& parameters, const SweepAxis& axis, std::set<std::string>& keys) {
  require(parameters, axis.key);
  if (axis.values.empty()) throw Error(ExitCode::usage, "--vary " + axis.key, "the axis has no value");
  if (!keys.insert(axis.key).second) throw Error(ExitCode::usage, "--vary " + axis.key, "the axis is given twice");
}

InnerAxis make_inner(const Parameters& parameters, const SweepPlan& plan, std::string_view key) {
  InnerAxis inner;
  for (std::size_t a = 0; a < plan.axes.size(); ++a) {
    if (plan.axes[a].key != key) continue;
    inner.axis = a;
    inner.stride = plan.strides[a];
    for (const Value& value : plan.axes[a].values) inner.values.push_back(to_number(value));
    return inner;
  }
  const Parameter* parameter = find(parameters, key);
  if (parameter == nullptr) {
    inner.values.push_back(0.0);
  } else if (const auto* const* length = std::get_if<Length*>(&parameter->field)) {
    inner.values.push_back((*length)->number);
  } else {
    inner.values.push_back(to_number(parameter->value()));
  }
  return inner;
}

// The unit of the constant biases: that of their axis or, if they are not varied, that of the parameter's value.
LengthUnit unit_of_constants(const Parameters& parameters, const SweepPlan& plan) {
  if (plan.constant_bias.axis) return plan.axes[*plan.constant_bias.axis].length_unit;
  const Parameter* parameter = find(parameters, constant_bias_key);
  const auto* length = parameter != nullptr ? std::get_if<Length*>(&parameter->field) : nullptr;
  return length != nullptr ? (*length)->unit : LengthUnit::metres;
}

// The numbers of biases in one group. The cost of a pass grows with the number of slope-scaled biases, hardly with that
// of constant ones, so a group that is too large is split along the slope-scaled biases first.
std::size_t constants_in_group(const SweepPlan& plan) {
  return std::min(plan.constant_bias.values.size(), max_group_cells);
}
std::size_t slopes_in_group(const SweepPlan& plan) {
  return std::min(plan.slope_bias.values.size(), max_group_cells / constants_in_group(plan));
}

std::size_t divide_up(std::size_t number, std::size_t by) { return (number + by - 1) / by; }

// Reduces an inner axis to its part-th run of `size` values. Returns the number of cells before that run.
std::size_t take_part(InnerAxis& inner, std::size_t part, std::size_t size) {
  const std::size_t begin = part * size;
  const std::size_t end = std::min(begin + size, inner.values.size());
  const auto at = [&](std::size_t i) { return inner.values.begin() + static_cast<std::ptrdiff_t>(i); };
  inner.values = std::vector<double>(at(begin), at(end));
  return begin * inner.stride;
}

}  // namespace

SweepPlan plan_sweep(const Parameters& parameters, std::vector<SweepAxis> axes, const CostOfChange& cost) {
  SweepPlan plan;
  std::set<std::string> keys;
  for (const SweepAxis& axis : axes) require_axis(parameters, axis, keys);
  plan.cells = count_cells(axes);
  plan.axes = std::move(axes);
  plan.strides.resize(plan.axes.size());
  std::size_t stride = 1;
  for (std::size_t a = plan.axes.size(); a-- > 0;) {
    plan.strides[a] = stride;
    stride *= plan.axes[a].values.size();
  }
  for (std::size_t a = 0; a < plan.axes.size(); ++a) {
    const std::string& key = plan.axes[a].key;
    if (key != constant_bias_key && key != slope_bias_key) plan.outer.push_back(a);
  }
  std::stable_sort(plan.outer.begin(), plan.outer.end(),
                   [&](std::size_t a, std::size_t b) { return cost(plan.axes[a].key) > cost(plan.axes[b].key); });
  plan.constant_bias = make_inner(parameters, plan, constant_bias_key);
  plan.slope_bias = make_inner(parameters, plan, slope_bias_key);
  plan.constant_unit = unit_of_constants(parameters, plan);
  return plan;
}

std::vector<Value> values_at(const SweepPlan& plan, std::size_t cell) {
  std::vector<Value> values;
  for (std::size_t a = 0; a < plan.axes.size(); ++a) {
    const std::vector<Value>& of_axis = plan.axes[a].values;
    values.push_back(of_axis[cell / plan.strides[a] % of_axis.size()]);
  }
  return values;
}

std::vector<std::size_t> outer_axes_as_given(const SweepPlan& plan) {
  std::vector<std::size_t> axes = plan.outer;
  std::sort(axes.begin(), axes.end());
  return axes;
}

std::size_t count_groups(const SweepPlan& plan) {
  const std::size_t inner = plan.constant_bias.values.size() * plan.slope_bias.values.size();
  return plan.cells / inner * divide_up(plan.constant_bias.values.size(), constants_in_group(plan)) *
         divide_up(plan.slope_bias.values.size(), slopes_in_group(plan));
}

CellGroup group_at(const SweepPlan& plan, std::size_t index) {
  assert(index < count_groups(plan));
  CellGroup group{0, {}, plan.constant_bias, plan.slope_bias};
  const std::size_t constants = constants_in_group(plan);
  const std::size_t slopes = slopes_in_group(plan);
  const std::size_t constant_parts = divide_up(plan.constant_bias.values.size(), constants);
  const std::size_t slope_parts = divide_up(plan.slope_bias.values.size(), slopes);
  group.first_cell += take_part(group.constant_bias, index % constant_parts, constants);
  index /= constant_parts;
  group.first_cell += take_part(group.slope_bias, index % slope_parts, slopes);
  index /= slope_parts;
  for (auto a = plan.outer.rbegin(); a != plan.outer.rend(); ++a) {
    const std::size_t count = plan.axes[*a].values.size();
    group.first_cell += index % count * plan.strides[*a];
    index /= count;
  }
  group.values = values_at(plan, group.first_cell);
  return group;
}

std::vector<Value> values_at(const CellGroup& group, std::size_t constant, std::size_t slope) {
  std::vector<Value> values = group.values;
  if (group.constant_bias.axis) values[*group.constant_bias.axis] = group.constant_bias.values[constant];
  if (group.slope_bias.axis) values[*group.slope_bias.axis] = group.slope_bias.values[slope];
  return values;
}

}  // namespace umbrameter
