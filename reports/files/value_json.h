// Values, rows and statistics as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/statistics.h"
#include "core/table.h"

namespace umbrameter {

inline nlohmann::ordered_json to_json(const Value& value) {
  return std::visit([](const auto& v) { return nlohmann::ordered_json(v); }, value);
}

/// A row by the names of its columns.
inline nlohmann::ordered_json row_json(const std::vector<Column>& columns, const std::vector<Value>& row) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < columns.size(); ++i) object[columns[i].name] = to_json(row[i]);
  return object;
}

template <class Struct>
nlohmann::ordered_json statistics_json(const Struct& statistics) {
  return row_json(columns_of(statistics), row_of(statistics));
}

}  // namespace umbrameter
