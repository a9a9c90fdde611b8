#include "reports/figures/plot_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/lists.h"
#include "reports/files/text_layout.h"

namespace umbrameter {
namespace {

constexpr int screen_width = 440;
constexpr double labels_width = 75.0;  // about what labels and title of the value axis take
constexpr double characters_per_unit = 72.0 / screen_width;

}  // namespace

int plot_width(const FigureStyle& style) {
  if (!style.is_print()) return screen_width;
  return std::max(80, static_cast<int>(style.width * plot_units_per_mm(style) - labels_width));
}

void add_title(Json& specification, const FigureStyle& style, const std::string& title, const std::string& conditions,
               const std::vector<std::string>& notes) {
  const auto characters = static_cast<std::size_t>(plot_width(style) * characters_per_unit);
  std::vector<std::string> lines;
  if (style.with_title) lines = wrap_lines(conditions, characters);
  for (const std::string& note : notes) {
    for (std::string& line : wrap_lines(note, characters)) lines.push_back(std::move(line));
  }
  if (style.with_title) {
    specification["title"]["text"] = title;
    if (!lines.empty()) specification["title"]["subtitle"] = lines;
  } else if (!lines.empty()) {
    // A subtitle without a title is not drawn.
    specification["title"] = {{"text", lines}, {"fontSize", 12}, {"fontWeight", "normal"}, {"color", "#444444"}};
  }
}

double height_of_plot(const FigureStyle& style) {
  if (!style.is_print() || style.height <= 0.0) return plot_height;
  constexpr double others_height = 110.0;  // about what the other axis and a legend of two lines take
  return std::max(80.0, style.height * plot_units_per_mm(style) - others_height);
}

Json fitting_label(const std::string& label, double units) {
  constexpr double units_of_a_character = 6.8;
  const std::vector<std::string> lines = wrap_lines(label, static_cast<std::size_t>(units / units_of_a_character));
  return lines.size() > 1 ? Json(lines) : Json(label);
}

void add_print_size(Json& specification, const FigureStyle& style, int columns, int rows) {
  if (!style.is_print()) return;
  const double units = plot_units_per_mm(style);
  specification["usermeta"]["print"] = {{"units_per_mm", units},
                                        {"width", style.width * units},
                                        {"height", style.height * units},
                                        {"columns", columns},
                                        {"rows", rows}};
}

std::optional<double> number(const Value& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

std::size_t column_of(const Table& table, const std::string& stem, const std::string& name) {
  const std::vector<Column>& columns = table.columns;
  const auto found = std::ranges::find(columns, name, &Column::name);
  if (found == columns.end()) {
    throw Error(ExitCode::partial, "figure " + stem, "its table has no column '" + name + "'");
  }
  return static_cast<std::size_t>(found - columns.begin());
}

bool is_numeric(const Table& table, std::size_t column) {
  return std::ranges::all_of(table.rows,
                             [&](const std::vector<Value>& row) { return number(row[column]).has_value(); });
}

std::vector<std::string> different_values(const Table& table, std::size_t column) {
  std::vector<Value> values;
  for (const std::vector<Value>& row : table.rows) {
    if (std::ranges::find(values, row[column]) == values.end()) values.push_back(row[column]);
  }
  if (is_numeric(table, column)) {
    std::ranges::sort(values, [](const Value& a, const Value& b) { return *number(a) < *number(b); });
  }
  return mapped(values, [](const Value& value) { return to_string(value); });
}

Json plot_fields(const std::vector<PlotField>& fields, std::size_t keys) {
  Json meta = {{"fields", Json::array()}, {"columns", Json::array()}, {"labels", Json::array()}, {"keys", keys}};
  for (const PlotField& each : fields) {
    meta["fields"].push_back(each.field);
    meta["columns"].push_back(each.column);
    meta["labels"].push_back(each.label.empty() ? each.column : each.label);
  }
  return meta;
}

Json plot_look(const FigureStyle& style) {
  const char* ink = "#1a1a1a";
  return {{"font", style.font},
          {"background", "white"},
          {"padding", style.is_print() ? 2 : 8},
          {"view", {{"stroke", nullptr}}},
          {"mark", {{"color", "#0072b2"}}},
          {"title",
           {{"anchor", "start"},
            {"frame", "group"},
            {"fontSize", 16},
            {"fontWeight", "bold"},
            {"color", ink},
            {"subtitleFontSize", 12},
            {"subtitleColor", "#444444"},
            {"subtitlePadding", 4},
            {"subtitleLineHeight", 15},
            {"offset", 12}}},
          {"axis",
           {{"labelFontSize", plot_font_size},
            {"titleFontSize", style.is_print() ? plot_font_size : 14},
            {"titleFontWeight", "normal"},
            {"titleColor", ink},
            {"labelColor", ink},
            {"titlePadding", 8},
            {"gridColor", "#e7e7e7"},
            {"domainColor", "#666666"},
            {"tickColor", "#666666"},
            {"labelFlush", false},
            {"labelOverlap", true},
            {"labelSeparation", 6}}},
          {"legend",
           {{"orient", "bottom"},
            {"direction", "horizontal"},
            {"labelFontSize", plot_font_size},
            {"titleFontSize", plot_font_size},
            {"titleFontWeight", "normal"},
            {"titleColor", ink},
            {"labelColor", ink},
            {"symbolType", "stroke"},
            {"symbolSize", 600},
            {"symbolStrokeWidth", 2.2},
            {"columnPadding", 16},
            {"titleLimit", 0},
            {"labelLimit", 240},
            {"layout", {{"bottom", {{"anchor", "start"}, {"direction", "vertical"}}}}},
            {"offset", 8}}}};
}

}  // namespace umbrameter
