#include "core/statistics.h"

#include <limits>

namespace umbrameter {
namespace {

struct Cells {
  std::vector<Value>& row;
  double unmeasured;  ///< added to real numbers: 0, or NaN where no pixel was measured
  void operator()(const std::uint64_t* count) const { row.emplace_back(static_cast<std::int64_t>(*count)); }
  void operator()(const double* number) const { row.emplace_back(*number + unmeasured); }
  void operator()(const Estimate* estimate) const {
    for (const double number : {estimate->value, estimate->lower, estimate->upper}) row.emplace_back(number + unmeasured);
  }
};

bool counts_no_pixel(const Statistics& statistics) {
  for (const Statistic& statistic : statistics) {
    if (statistic.name == pixels_statistic) return *std::get<std::uint64_t*>(statistic.field) == 0;
  }
  return false;
}

void set_value(const Statistic& statistic, const std::string& column, const Value& value) {
  if (auto* const* count = std::get_if<std::uint64_t*>(&statistic.field)) {
    if (column == statistic.name) **count = static_cast<std::uint64_t>(std::get<std::int64_t>(value));
  } else if (auto* const* number = std::get_if<double*>(&statistic.field)) {
    if (column == statistic.name) **number = to_number(value);
  } else {
    Estimate& estimate = *std::get<Estimate*>(statistic.field);
    if (column == statistic.name) estimate.value = to_number(value);
    if (column == lower_name(statistic.name)) estimate.lower = to_number(value);
    if (column == upper_name(statistic.name)) estimate.upper = to_number(value);
  }
}

}  // namespace

std::string lower_name(std::string_view statistic) { return std::string(statistic) + "_lo"; }
std::string upper_name(std::string_view statistic) { return std::string(statistic) + "_hi"; }

std::vector<Column> columns_of(const Statistics& statistics) {
  std::vector<Column> columns;
  for (const Statistic& statistic : statistics) {
    columns.push_back({statistic.name, statistic.unit, statistic.meaning});
    if (!statistic.has_interval()) continue;
    columns.push_back({lower_name(statistic.name), statistic.unit, "lower end of its 95 % interval"});
    columns.push_back({upper_name(statistic.name), statistic.unit, "upper end of its 95 % interval"});
  }
  return columns;
}

std::vector<Value> row_of(const Statistics& statistics) {
  std::vector<Value> row;
  const double unmeasured = counts_no_pixel(statistics) ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  for (const Statistic& statistic : statistics) std::visit(Cells{row, unmeasured}, statistic.field);
  return row;
}

void read_row(const Statistics& statistics, std::span<const Column> columns, std::span<const Value> row) {
  for (const Statistic& statistic : statistics) {
    for (std::size_t c = 0; c < columns.size(); ++c) set_value(statistic, columns[c].name, row[c]);
  }
}

}  // namespace umbrameter
