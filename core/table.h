// Plain rows with described columns: what sweeps produce and what reports print.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/parameters.h"

namespace umbrameter {

struct Column {
  std::string name;     ///< as in the CSV header: "mae", "shadow.resolution"
  std::string unit;     ///< "m", "texels", "1" for shares; never empty for a number
  std::string meaning;  ///< one sentence
};

struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Value>> rows;  ///< each as long as columns
};

/// Index of a column. Throws std::out_of_range when there is none of that name.
std::size_t column_index(const Table& table, std::string_view name);

/// A numeric value as double.
double to_number(const Value& value);

}  // namespace umbrameter
