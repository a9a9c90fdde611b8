#include "experiments/settings/sweep_plan.h"

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

// A group that is too large is split along its last axes: the cost of a pass grows with the number of slope-scaled
// biases, hardly with that of constant ones.
void split_large_groups(SweepPlan& plan) {
  std::size_t room = max_group_cells;
  for (InnerAxis& axis : plan.inner) {
    axis.parts = divide_up(axis.values.size(), std::max<std::size_t>(room, 1));
    room /= divide_up(axis.values.size(), axis.parts);
  }
}

// Reduces an inner axis to one of its parts, whose sizes differ by at most one. Returns the number of cells before it.
std::size_t take_part(InnerAxis& inner, std::size_t part) {
  const std::size_t begin = divide_up(part * inner.values.size(), inner.parts);
  const std::size_t end = divide_up((part + 1) * inner.values.size(), inner.parts);
  const auto at = [&](std::size_t i) { return inner.values.begin() + static_cast<std::ptrdiff_t>(i); };
  inner.values = std::vector<double>(at(begin), at(end));
  inner.parts = 1;
  return begin * inner.stride;
}

bool differ_only_in(std::size_t axis, const CellGroup& group, const CellGroup& next) {
  for (std::size_t i = 0; i < group.inner.size(); ++i) {
    if (i != axis && group.inner[i].values != next.inner[i].values) return false;
  }
  return true;
}

// Adds the cells of the next group if both together are a grid: they differ in neighbouring parts of one inner axis.
bool join(CellGroup& group, const CellGroup& next) {
  if (group.size() + next.size() > max_group_cells) return false;
  for (std::size_t i = 0; i < group.inner.size(); ++i) {
    InnerAxis& axis = group.inner[i];
    if (next.first_cell != group.first_cell + axis.values.size() * axis.stride) continue;
    if (!differ_only_in(i, group, next)) continue;
    axis.values.insert(axis.values.end(), next.inner[i].values.begin(), next.inner[i].values.end());
    return true;
  }
  return false;
}

}  // namespace

SweepPlan plan_sweep(const Parameters& parameters, std::vector<SweepAxis> axes, const CostOfChange& cost,
                     const InnerKeys& inner) {
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
    if (std::ranges::find(inner, key) == inner.end()) plan.outer.push_back(a);
  }
  std::ranges::stable_sort(
      plan.outer, [&](std::size_t a, std::size_t b) { return cost(plan.axes[a].key) > cost(plan.axes[b].key); });
  for (const std::string_view key : inner) plan.inner.push_back(make_inner(parameters, plan, key));
  plan.constant_bias = make_inner(parameters, plan, constant_bias_key);
  plan.slope_bias = make_inner(parameters, plan, slope_bias_key);
  plan.constant_unit = unit_of_constants(parameters, plan);
  split_large_groups(plan);
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
  std::ranges::sort(axes);
  return axes;
}

std::size_t CellGroup::size() const {
  std::size_t cells = 1;
  for (const InnerAxis& axis : inner) cells *= axis.values.size();
  return cells;
}

std::size_t CellGroup::cell(std::size_t place) const {
  std::size_t cell = first_cell;
  for (auto axis = inner.rbegin(); axis != inner.rend(); ++axis) {
    cell += place % axis->values.size() * axis->stride;
    place /= axis->values.size();
  }
  return cell;
}

std::size_t parts_of_group(const SweepPlan& plan) {
  std::size_t parts = 1;
  for (const InnerAxis& axis : plan.inner) parts *= axis.parts;
  return parts;
}

void cut_groups(SweepPlan& plan, std::size_t parts) {
  for (auto axis = plan.inner.rbegin(); axis != plan.inner.rend(); ++axis) {
    axis->parts = std::max(axis->parts, std::min(axis->values.size(), parts));
    parts = divide_up(parts, axis->parts);
  }
}

std::size_t count_groups(const SweepPlan& plan) {
  std::size_t groups = plan.cells;
  for (const InnerAxis& axis : plan.inner) groups = groups / axis.values.size() * axis.parts;
  return groups;
}

CellGroup group_at(const SweepPlan& plan, std::size_t index) {
  assert(index < count_groups(plan));
  CellGroup group{0, {}, plan.inner};
  for (InnerAxis& axis : group.inner) {
    const std::size_t parts = axis.parts;
    group.first_cell += take_part(axis, index % parts);
    index /= parts;
  }
  for (auto a = plan.outer.rbegin(); a != plan.outer.rend(); ++a) {
    const std::size_t count = plan.axes[*a].values.size();
    group.first_cell += index % count * plan.strides[*a];
    index /= count;
  }
  group.values = values_at(plan, group.first_cell);
  return group;
}

void for_each_joined_group(const SweepPlan& plan, std::size_t first, std::size_t count,
                           const std::function<void(const CellGroup&)>& take) {
  const std::size_t parts = parts_of_group(plan);
  std::vector<CellGroup> open;  // of the same outer values; each may still grow
  const auto flush = [&] {
    for (const CellGroup& group : open) take(group);
    open.clear();
  };
  for (std::size_t index = first; index < first + count; ++index) {
    if (index % parts == 0) flush();
    open.push_back(group_at(plan, index));
    while (open.size() > 1 && join(open[open.size() - 2], open.back())) open.pop_back();
  }
  flush();
}

std::vector<Value> values_at(const CellGroup& group, std::size_t place) {
  std::vector<Value> values = group.values;
  for (auto inner = group.inner.rbegin(); inner != group.inner.rend(); ++inner) {
    const double number = inner->values[place % inner->values.size()];
    place /= inner->values.size();
    if (!inner->axis) continue;
    Value& value = values[*inner->axis];
    if (std::holds_alternative<std::int64_t>(value)) {
      value = static_cast<std::int64_t>(number);
    } else {
      value = number;
    }
  }
  return values;
}

}  // namespace umbrameter
