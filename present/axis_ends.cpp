#include "present/axis_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/lists.h"
#include "present/sweep_report.h"
#include "results/number_text.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_rows = 200;

std::vector<double> numbers_of(const SweepAxis& axis) {
  return mapped(axis.values, [](const Value& value) { return to_number(value); });
}

std::size_t index_in(const SweepAxis& axis, const Value& value) {
  return static_cast<std::size_t>(std::ranges::find(axis.values, value) - axis.values.begin());
}

// The value next to an end of the axis, towards its middle.
std::size_t neighbour_of_end(const std::vector<double>& numbers, std::size_t end) {
  std::vector<std::size_t> order(numbers.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; });
  return order.front() == end ? order[1] : order[order.size() - 2];
}

std::optional<double> error_at(const SweepResults& sweep, std::size_t cell) {
  const std::vector<std::size_t> cells = {cell};
  const Table rows = sweep.store.rows(cells, {std::string(error_statistic)});
  if (rows.rows.empty()) return std::nullopt;
  return to_number(rows.rows[0][0]);
}

}  // namespace

AxisEnd end_of(std::span<const double> values, double value, const Parameter& parameter) {
  if (values.size() < 2 || (value == 0.0 && parameter.key != constant_bias_key)) return AxisEnd::none;
  const auto [least, largest] = std::ranges::minmax_element(values);
  if (value == *least && value > parameter.description.min) return AxisEnd::lower;
  if (value == *largest && value < parameter.description.max) return AxisEnd::upper;
  return AxisEnd::none;
}

std::vector<OpenEnd> find_open_ends(const SweepResults& sweep, const Table& best,
                                    std::span<const std::size_t> listed_axes) {
  const SweepPlan& plan = sweep.plan;
  const std::size_t mae = column_index(best, error_statistic);
  std::vector<OpenEnd> ends;
  const auto add_end = [&](const std::vector<Value>& row, std::size_t a, const std::string& setting) {
    const SweepAxis& axis = plan.axes[a];
    const Parameter& parameter = require(sweep.parameters, axis.key);
    if (!parameter.is_number() || changes_reference(axis.key)) return;
    const std::vector<double> numbers = numbers_of(axis);
    const AxisEnd end = end_of(numbers, to_number(row[a]), parameter);
    if (end == AxisEnd::none) return;
    std::size_t cell = 0;
    for (std::size_t b = 0; b < plan.axes.size(); ++b) cell += index_in(plan.axes[b], row[b]) * plan.strides[b];
    const std::size_t index = index_in(axis, row[a]);
    const std::size_t next = cell - index * plan.strides[a] + neighbour_of_end(numbers, index) * plan.strides[a];
    const std::optional<double> beside = error_at(sweep, next);
    if (beside && *beside > to_number(row[mae])) ends.push_back({axis.key, end, to_number(row[a]), axis.unit, setting});
  };
  const auto is_listed = [&](std::size_t a) { return std::ranges::find(listed_axes, a) != listed_axes.end(); };
  for (std::size_t r = 0; r < std::min(best.rows.size(), max_rows); ++r) {
    std::string setting;
    for (const std::size_t t : listed_axes) {
      const std::string& key = plan.axes[t].key;
      setting += (setting.empty() ? "" : ", ") + key.substr(key.find('.') + 1) + " " +
                 value_text(plan.axes[t], best.rows[r][t]);
    }
    for (std::size_t a = 0; a < plan.axes.size(); ++a) {
      if (!is_listed(a)) add_end(best.rows[r], a, setting);
    }
  }
  // Each listed value has its own best cell; the best of these may lie at an end, too. Not where each has a bias of its
  // own: there the listed axes, such as the resolution, are what a user compares.
  const bool has_curves =
      sweep.quantity() == SweptQuantity::visibility && (sweep.plan.constant_bias.axis || sweep.plan.slope_bias.axis);
  if (best.rows.empty() || has_curves) return ends;
  const auto error = [&](const std::vector<Value>& row) {
    const double value = to_number(row[mae]);
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  };
  const std::vector<Value>& least = *std::ranges::min_element(best.rows, {}, error);
  for (std::size_t a = 0; a < plan.axes.size(); ++a) {
    if (is_listed(a)) add_end(least, a, "");
  }
  return ends;
}

std::vector<std::string> to_lines(const std::vector<OpenEnd>& ends) {
  std::vector<std::string> lines;
  std::vector<OpenEnd> seen;
  for (const OpenEnd& first : ends) {
    const auto is_same = [&](const OpenEnd& e) { return e.axis == first.axis && e.end == first.end; };
    if (std::ranges::any_of(seen, is_same)) continue;
    seen.push_back(first);
    const auto count = std::ranges::count_if(ends, is_same);
    const bool has_setting = !first.setting.empty();
    const std::string where = !has_setting ? ""
                              : count == 1 ? " for " + first.setting
                                           : fmt::format(" for {} combinations, one of them {}", count, first.setting);
    lines.push_back(fmt::format(
        "{}: the least error is at the {} end of the axis ({}){}; extend it, or add values next to this end",
        first.axis, first.end == AxisEnd::upper ? "upper" : "lower",
        with_unit(fmt::format("{:.6g}", first.value), first.unit), where));
  }
  return lines;
}

nlohmann::ordered_json to_json(const std::vector<OpenEnd>& ends) {
  auto list = nlohmann::ordered_json::array();
  for (const OpenEnd& end : ends) {
    list.push_back({{"axis", end.axis},
                    {"end", end.end == AxisEnd::upper ? "upper" : "lower"},
                    {"value", end.value},
                    {"unit", end.unit},
                    {"at", end.setting}});
  }
  return list;
}

}  // namespace umbrameter
