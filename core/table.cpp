#include "core/table.h"

#include <algorithm>
#include <stdexcept>

namespace umbrameter {

std::size_t column_index(const Table& table, std::string_view name) {
  const auto found = std::ranges::find(table.columns, name, &Column::name);
  if (found == table.columns.end()) throw std::out_of_range("no column " + std::string(name));
  return static_cast<std::size_t>(found - table.columns.begin());
}

double to_number(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  return std::get<double>(value);
}

}  // namespace umbrameter
