#include "reports/page/page_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "reports/files/markup.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_rows = 500;

std::string cell_text(const Value& value) {
  const auto* number = std::get_if<double>(&value);
  return number != nullptr ? fmt::format("{:.6g}", *number) : to_string(value);
}

bool is_number(const Value& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return !std::holds_alternative<bool>(value);
  double number = 0.0;
  const auto result = std::from_chars(text->data(), text->data() + text->size(), number);
  return !text->empty() && result.ec == std::errc{} && result.ptr == text->data() + text->size();
}

// Whether a column is set flush right: it has a number and nothing else but empty cells.
bool is_numeric(const Table& table, std::size_t column) {
  bool any = false;
  for (const std::vector<Value>& row : table.rows) {
    if (column >= row.size() || cell_text(row[column]).empty()) continue;
    if (!is_number(row[column])) return false;
    any = true;
  }
  return any;
}

constexpr std::size_t longest_short_text = 40;

const char* number_class(bool numeric) { return numeric ? " class=\"number\"" : ""; }

std::string header_markup(const Table& table, const std::vector<bool>& numeric) {
  std::string names;
  std::string units;
  bool any_unit = false;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const Column& column = table.columns[c];
    const std::string title = column.meaning.empty() ? "" : " title=\"" + escape_markup(column.meaning) + "\"";
    names += fmt::format("<th scope=\"col\"{}{}>{}</th>", number_class(numeric[c]), title, escape_markup(column.name));
    units += fmt::format("<td class=\"unit{}\">{}</td>", numeric[c] ? " number" : "", escape_markup(column.unit));
    any_unit = any_unit || !column.unit.empty();
  }
  return "<thead>\n<tr>" + names + "</tr>\n" + (any_unit ? "<tr>" + units + "</tr>\n" : "") + "</thead>\n";
}

std::string row_markup(const std::vector<Value>& row, const std::vector<bool>& numeric) {
  std::string cells;
  for (std::size_t c = 0; c < numeric.size(); ++c) {
    const std::string text = c < row.size() ? escape_markup(cell_text(row[c])) : std::string();
    const bool is_header = c == 0 && !numeric[c];
    // Short words stay on one line: a wide table scrolls.
    const bool is_short = !numeric[c] && !text.empty() && text.size() <= longest_short_text;
    cells += is_header ? "<th scope=\"row\">" + text + "</th>"
                       : fmt::format("<td{}>{}</td>", is_short ? " class=\"short\"" : number_class(numeric[c]), text);
  }
  return "<tr>" + cells + "</tr>\n";
}

}  // namespace

std::string table_markup(const Table& table, const std::string& caption) {
  if (table.columns.empty()) return {};
  std::vector<bool> numeric;
  for (std::size_t c = 0; c < table.columns.size(); ++c) numeric.push_back(is_numeric(table, c));
  const std::size_t shown = std::min(table.rows.size(), max_rows);
  std::string rows;
  for (std::size_t r = 0; r < shown; ++r) rows += row_markup(table.rows[r], numeric);
  if (rows.empty()) {
    rows = fmt::format("<tr><td class=\"empty\" colspan=\"{}\">no rows</td></tr>\n", table.columns.size());
  }
  const std::string rest =
      shown < table.rows.size() ? fmt::format(", the first {} of {} rows", shown, table.rows.size()) : "";
  const std::string text = escape_markup(caption) + rest;
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n<table>\n<caption>{0}</caption>\n"
      "{1}<tbody>\n{2}</tbody>\n</table>\n</div>\n",
      text, header_markup(table, numeric), rows);
}

}  // namespace umbrameter
