#include "core/statistics.h"

#include <limits>

namespace umbrameter {
namespace {

struct Cells {
  std::vector<Value>& row;
  bool is_measured;
  Value number(double value) const { return is_measured ? value : std::numeric_limits<double>::quiet_NaN(); }
  void operator()(const std::uint64_t* count) const { row.emplace_back(static_cast<std::int64_t>(*count)); }
  void operator()(const double* value) const { row.push_back(this->number(*value)); }
  void operator()(const Estimate* estimate) const {
    for (const double end : {estimate->value, estimate->lower, estimate->upper}) row.push_back(number(end));
  }
};

bool counts_no_pixel(const Statistics& statistics) {
  for (const Statistic& statistic : statistics) {
    if (statistic.name == pixels_statistic) return *std::get<std::uint64_t*>(statistic.field) == 0;
  }
  return false;
}

// The object's value that a column holds.
RowReader::Target target_of(const Statistic& statistic, std::string_view column) {
  if (auto* const* count = std::get_if<std::uint64_t*>(&statistic.field)) {
    if (column == statistic.name) return *count;
  } else if (auto* const* number = std::get_if<double*>(&statistic.field)) {
    if (column == statistic.name) return *number;
  } else {
    Estimate& estimate = *std::get<Estimate*>(statistic.field);
    if (column == statistic.name) return &estimate.value;
    if (column == lower_name(statistic.name)) return &estimate.lower;
    if (column == upper_name(statistic.name)) return &estimate.upper;
  }
  return std::monostate{};
}

}  // namespace

std::string lower_name(std::string_view statistic) { return std::string(statistic) + "_lo"; }
std::string upper_name(std::string_view statistic) { return std::string(statistic) + "_hi"; }

std::vector<Column> columns_of(const Statistics& statistics) {
  std::vector<Column> columns;
  for (const Statistic& statistic : statistics) {
    columns.push_back({statistic.name, statistic.unit, statistic.meaning});
    if (!statistic.has_interval()) continue;
    columns.push_back(
        {lower_name(statistic.name), statistic.unit, "lower end of its 95 % interval over the rays of the reference"});
    columns.push_back(
        {upper_name(statistic.name), statistic.unit, "upper end of its 95 % interval over the rays of the reference"});
  }
  return columns;
}

std::vector<std::string> names_of(const Statistics& statistics, std::initializer_list<const void*> members) {
  std::vector<std::string> names;
  for (const void* member : members) {
    for (const Statistic& statistic : statistics) {
      const bool is_it =
          std::visit([&](auto* field) { return static_cast<const void*>(field) == member; }, statistic.field);
      if (is_it) names.push_back(statistic.name);
    }
  }
  return names;
}

std::vector<Value> row_of(const Statistics& statistics) {
  std::vector<Value> row;
  const Cells cells{row, !counts_no_pixel(statistics)};
  for (const Statistic& statistic : statistics) std::visit(cells, statistic.field);
  return row;
}

RowReader::RowReader(const Statistics& statistics, std::span<const std::string> columns) {
  for (const std::string& column : columns) {
    Target& target = targets_.emplace_back();
    for (const Statistic& statistic : statistics) {
      if (std::holds_alternative<std::monostate>(target)) target = target_of(statistic, column);
    }
  }
}

void RowReader::read(std::span<const Value> row) const {
  for (std::size_t c = 0; c < targets_.size(); ++c) {
    if (double* const* number = std::get_if<double*>(&targets_[c])) **number = to_number(row[c]);
    if (std::uint64_t* const* count = std::get_if<std::uint64_t*>(&targets_[c])) {
      **count = static_cast<std::uint64_t>(std::get<std::int64_t>(row[c]));
    }
  }
}

}  // namespace umbrameter
