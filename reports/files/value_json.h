// Values, parameters, rows and statistics as JSON.
#pragma once

#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/parameters.h"
#include "core/statistics.h"
#include "core/table.h"

namespace umbrameter {

/// The text of a value, in one line unless `indent` is given. Names come from files: bytes that are no UTF-8 are
/// replaced, never thrown on.
inline std::string json_text(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

inline nlohmann::ordered_json to_json(const Value& value) {
  return std::visit([](const auto& v) { return nlohmann::ordered_json(v); }, value);
}

/// Reads back what to_json() wrote. JSON has no NaN, so NaN is written as null.
inline Value to_value(const nlohmann::ordered_json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_string()) return json.get<std::string>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

/// A parameter's type, value (under the name `value_name`), unit, meaning and limits.
inline nlohmann::ordered_json to_json(const Parameter& parameter, const char* value_name) {
  constexpr const char* types[] = {"boolean", "integer", "number", "string", "size", "choice", "length"};
  static_assert(std::variant_size_v<decltype(parameter.field)> == std::size(types));
  const FieldDescription& description = parameter.description;
  nlohmann::ordered_json json = {
      {"name", parameter.key},    {"type", types[parameter.field.index()]}, {value_name, to_json(parameter.value())},
      {"unit", description.unit}, {"meaning", description.meaning},         {"limits", parameter.limits()}};
  if (std::isfinite(description.min)) json["minimum"] = description.min;
  if (std::isfinite(description.max)) json["maximum"] = description.max;
  if (const auto* choice = std::get_if<ChoiceRef>(&parameter.field)) json["choices"] = choice->names;
  for (const auto& [alias, name] : description.aliases) json["aliases"][alias] = name;
  return json;
}

/// A row by the names of its columns.
inline nlohmann::ordered_json row_json(const std::vector<Column>& columns, const std::vector<Value>& row) {
  nlohmann::ordered_json object = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < columns.size(); ++i) object[columns[i].name] = to_json(row[i]);
  return object;
}

/// The rows as a list.
inline nlohmann::ordered_json rows_json(const Table& table) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const std::vector<Value>& row : table.rows) list.push_back(row_json(table.columns, row));
  return list;
}

template <class Struct>
nlohmann::ordered_json statistics_json(const Struct& statistics) {
  return row_json(columns_of(statistics), row_of(statistics));
}

}  // namespace umbrameter
