#include "reports/page/cells.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace umbrameter {
namespace {

using Json = nlohmann::ordered_json;

// Null for a value that is no number.
Json value_json(const Value& value, bool is_exact) {
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) return std::visit([](const auto& each) { return Json(each); }, value);
  if (!std::isfinite(*number)) return nullptr;
  return is_exact ? *number : eight_digits(*number);
}

}  // namespace

double eight_digits(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.8g", value);
  return std::strtod(digits, nullptr);
}

Json cells_json(const ReportCells& cells) {
  Json json = {{"axes", cells.axes},       {"count", cells.count}, {"numbers", cells.numbers},
               {"command", cells.command}, {"units", cells.units}, {"command_end", cells.command_end},
               {"columns", Json::array()}, {"rows", Json::array()}};
  for (std::size_t c = 0; c < cells.table.columns.size(); ++c) {
    const auto& [name, unit, meaning] = cells.table.columns[c];
    const std::string& head = c < cells.heads.size() ? cells.heads[c] : name;
    json["columns"].push_back({{"name", name}, {"head", head}, {"unit", unit}, {"meaning", meaning}});
  }
  for (const std::vector<Value>& row : cells.table.rows) {
    Json& values = json["rows"].emplace_back(Json::array());
    for (std::size_t c = 0; c < row.size(); ++c) values.push_back(value_json(row[c], c < cells.axes));
  }
  return json;
}

Json chart_cells_json(const ChartCells& cells) {
  Json json = {{"columns", Json::object()}, {"fixed", Json::object()}};
  for (const auto& [of_chart, of_cells] : cells.columns) json["columns"][of_chart] = of_cells;
  for (const auto& [name, value] : cells.fixed) json["fixed"][name] = value_json(value, true);
  return json;
}

}  // namespace umbrameter
