#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/lists.h"
#include "present/plot_axes.h"
#include "present/presentation_parts.h"
#include "present/sweep_report.h"
#include "techniques/ao/read_parameters.h"
#include "techniques/shadow/read_parameters.h"

namespace umbrameter {
namespace {

// Erases the axes of these parameters that change nothing in a cell: "shadow.filter-size", where its filter has none.
template <class Params>
void erase_unread(const SweepResults& sweep, const std::vector<Value>& row, std::vector<std::size_t>& axes) {
  Params params;
  const Parameters own = describe(params);
  const auto is_own = [&](std::size_t a) { return find(own, sweep.plan.axes[a].key) != nullptr; };
  if (std::ranges::none_of(axes, is_own)) return;
  for (const Parameter& parameter : own) parameter.set(require(sweep.parameters, parameter.key).value());
  for (std::size_t a = 0; a < sweep.plan.axes.size(); ++a) {
    if (is_own(a)) set_value(own, sweep.plan.axes[a], row[a]);
  }
  const Parameters read = read_parameters(params);
  std::erase_if(axes, [&](std::size_t a) { return is_own(a) && find(read, sweep.plan.axes[a].key) == nullptr; });
}

}  // namespace

std::vector<std::size_t> read_axes(const SweepResults& sweep, const std::vector<Value>& row,
                                   std::vector<std::size_t> axes) {
  erase_unread<ShadowParams>(sweep, row, axes);
  erase_unread<AoParams>(sweep, row, axes);
  return axes;
}

std::string value_text(const SweepAxis& axis, const Value& value) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return with_unit(short_text(value), axis.unit);
  std::vector<double> values = mapped(axis.values, [](const Value& each) { return to_number(each); });
  std::ranges::sort(values);
  const int digits = digits_on_axis(values, *number);
  if (axis.unit == "m") return metres_text(*number, digits);
  return with_unit(std::abs(*number) < 1e4 ? with_minus(fmt::format("{:.{}g}", *number, digits)) : short_text(value),
                   axis.unit);
}

std::string row_text(const SweepResults& sweep, const std::vector<Value>& row, const std::vector<std::size_t>& axes) {
  return joined(axes, ", ", [&](const std::size_t a) {
    const SweepAxis& axis = sweep.plan.axes[a];
    return axis.key + " " + value_text(axis, row[a]);
  });
}

std::string cell_text(const SweepResults& sweep, const std::vector<Value>& row) {
  std::vector<std::size_t> axes(sweep.plan.axes.size());
  std::iota(axes.begin(), axes.end(), std::size_t{0});
  const std::vector<std::size_t> read = read_axes(sweep, row, axes);
  return row_text(sweep, row, read.empty() ? axes : read);
}

}  // namespace umbrameter
