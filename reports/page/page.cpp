#include "reports/page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/lists.h"
#include "reports/files/markup.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "reports/page/page_figure.h"
#include "reports/page/script_text.h"
#include "reports/page/template.h"
#include "reports/page/viewer_data.h"

namespace umbrameter {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t max_rows = 500;
// Longer texts are wrapped.
constexpr std::size_t longest_short_text = 24;

constexpr std::string_view minus = "−";

std::string cell_text(const Value& value) {
  const auto* number = std::get_if<double>(&value);
  std::string text = number != nullptr ? fmt::format("{:.6g}", *number) : to_string(value);
  if (!std::holds_alternative<std::string>(value) && text.starts_with('-')) text.replace(0, 1, minus);
  return text;
}

// Counts of pixels have thousands separators, as in the page's text.
std::string cell_text(const Table& table, std::size_t row, std::size_t column) {
  const Value& value = table.rows[row][column];
  const auto* count = std::get_if<std::int64_t>(&value);
  if (count == nullptr || *count < 0) return cell_text(value);
  const auto own = std::ranges::find(table.columns, "unit", &Column::name);
  const auto place = static_cast<std::size_t>(own - table.columns.begin());
  const bool is_of_row = own != table.columns.end() && place < table.rows[row].size();
  const std::string unit = is_of_row ? to_string(table.rows[row][place]) : table.columns[column].unit;
  return unit == "px" ? grouped(static_cast<std::uint64_t>(*count)) : cell_text(value);
}

// Numbers and what may stand with them: "−0.19", "+8.4 ± 0.7", "(0.05 ± 0.09)*", "11.2 to 11.4", "0.115 %".
bool is_number(const Value& value) {
  const auto* given = std::get_if<std::string>(&value);
  if (given == nullptr) return !std::holds_alternative<bool>(value);
  std::string text = replace_all(*given, minus, "-");
  for (const std::string_view each : {"±", " to ", " %", "(", ")", "*", "+"}) text = replace_all(text, each, " ");
  std::istringstream words(text);
  int count = 0;
  for (std::string word; words >> word; ++count) {
    if (!parsed<double>(word)) return false;
  }
  return count > 0;
}

// Name of a column that does not break within "95 %" or "1 texel".
std::string head_text(std::string name) {
  constexpr std::string_view no_break_space = "\u00a0";
  for (std::size_t i = 1; i < name.size(); ++i) {
    if (name[i] == ' ' && std::isdigit(static_cast<unsigned char>(name[i - 1])) != 0)
      name.replace(i, 1, no_break_space);
  }
  return name;
}

// Whether a column is set flush right: it has numbers, or dashes in their place, and nothing else but empty cells.
bool is_set_right(const Table& table, std::size_t column) {
  bool any = false;
  for (const std::vector<Value>& row : table.rows) {
    if (column >= row.size()) continue;
    const std::string text = cell_text(row[column]);
    if (text.empty()) continue;
    if (text != "—" && !is_number(row[column])) return false;
    any = true;
  }
  return any;
}

// Caption, columns and the texts of the first rows. Null for a table without columns.
Json table_data(const Table& table, const std::string& caption, const std::vector<std::string>& below = {},
                const std::vector<std::string>& remarks = {}) {
  if (table.columns.empty()) return {};
  const std::size_t shown = std::min(table.rows.size(), max_rows);
  const std::string rest =
      shown < table.rows.size() ? fmt::format(", the first {} of {} rows", shown, table.rows.size()) : "";
  Json columns = Json::array();
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& [name, unit, meaning] = table.columns[c];
    columns.push_back(
        {{"name", name}, {"unit", unit == "1" ? "" : unit}, {"meaning", meaning}, {"numeric", is_set_right(table, c)}});
    if (std::ranges::find(below, name) != below.end()) columns.back()["below"] = true;
  }
  Json rows = Json::array();
  for (std::size_t r = 0; r < shown; ++r) {
    Json& row = rows.emplace_back(Json::array());
    for (std::size_t c = 0; c < columns.size(); ++c) {
      row.push_back(c < table.rows[r].size() ? cell_text(table, r, c) : std::string());
    }
  }
  return {{"caption", caption + rest}, {"columns", columns}, {"rows", rows}, {"remarks", remarks}};
}

// The cell's text within an object whose one member is its kind.
Json cell_data(const Json& column, std::size_t c, const Json& text) {
  const std::size_t length = text.get_ref<const std::string&>().size();
  const bool is_short = length > 0 && length <= longest_short_text;
  const char* kind = column["numeric"] ? "number" : c == 0 ? "header" : is_short ? "short" : "text";
  return {{kind, {{"text", text}, {"below", Json::array()}}}};
}

// "extra error [%]"; without the unit where the name says it.
std::string label_below(const Json& column) {
  const std::string name = column["name"];
  const std::string unit = column["unit"];
  // Columns below others are narrow: the longest word of a unit may break.
  const std::string breakable = replace_all(unit, "percentage", "percent\u00adage");
  return unit.empty() || name.ends_with(unit) ? name : fmt::format("{} [{}]", name, breakable);
}

// Readies a table for its template: columns and cells that stand below others become their parts.
void classify_cells(Json& table) {
  const Json all = table["columns"];
  Json columns = Json::array();
  for (const Json& column : all) {
    if (column.contains("below") && !columns.empty()) {
      columns.back()["further"].push_back(column);
      columns.back()["further"].back()["label"] = label_below(column);
    } else {
      columns.push_back(column);
      columns.back()["further"] = Json::array();
    }
  }
  for (Json& row : table["rows"]) {
    Json cells = Json::array();
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (all[c].contains("below") && !cells.empty()) {
        if (row[c] != "") cells.back().begin().value()["below"].push_back(row[c]);
      } else {
        cells.push_back(cell_data(all[c], c, row[c]));
      }
    }
    row = std::move(cells);
  }
  // The labels of columns below stand in the row of units.
  const auto has_unit = [](const Json& column) { return column["unit"] != "" || column.contains("below"); };
  table["has_units"] = std::ranges::any_of(all, has_unit);
  table["column_count"] = columns.size();
  for (Json& column : columns) {
    column["name"] = head_text(column["name"]);
    for (Json& further : column["further"]) further["label"] = head_text(further["label"]);
  }
  table["columns"] = std::move(columns);
}

// Adds to the table of all settings that of those which differ from their defaults: name, value, default.
void ready_settings(Json& settings) {
  Json changed = settings;
  changed["caption"] = "Settings that differ from their defaults";
  changed["rows"] = Json::array();
  for (const Json& row : settings["rows"]) {
    if (row.size() > 2 && row[1] != row[2]) changed["rows"].push_back(row);
  }
  settings["row_count"] = settings["rows"].size();
  classify_cells(settings);
  if (changed["rows"].empty()) return;
  classify_cells(changed);
  settings["changed"] = std::move(changed);
}

constexpr std::pair<const char*, const char*> file_meanings[] = {
    {"images.exr", "all images as float layers"},      {"sweep.csv", "all cells of the sweep"},
    {"sweep.partial.csv", "all cells that are there"}, {"tuned.toml", "settings to use"},
    {"evaluations.csv", "the points of the search"},   {"experiment.toml", "settings of this run"},
    {"comparison.csv", "all values and differences"},  {"summary.json", "all numbers, for programs"}};

Json files_data(const fs::path& folder) {
  const std::vector<std::string> linked = linked_files(folder);
  Json list = Json::array();
  for (const auto& [name, meaning] : file_meanings) {
    if (std::ranges::find(linked, name) != linked.end()) {
      const bool is_of_cell = name == std::string_view("images.exr") && std::ranges::count(linked, "sweep.csv") > 0;
      list.push_back({{"name", name}, {"meaning", is_of_cell ? "float layers of the cell of least error" : meaning}});
    }
  }
  return list;
}

Json paragraphs_data(std::string_view text) {
  Json paragraphs = Json::array();
  while (!text.empty()) {
    const std::size_t end = text.find("\n\n");
    const std::string_view paragraph = text.substr(0, end);
    if (paragraph.find_first_not_of(" \n") != std::string_view::npos) paragraphs.push_back(paragraph);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 2);
  }
  return paragraphs;
}

Json headlines_data(const std::vector<Headline>& headlines) {
  Json list = Json::array();
  for (const Headline& headline : headlines) {
    list.push_back({{"label", headline.label}, {"value", headline.value}, {"note", headline.note}});
  }
  return list;
}

// Places and widths in per cent of the bar.
Json bar_data(const std::vector<BarShare>& bar) {
  Json list = Json::array();
  double begin = 0.0;
  for (const BarShare& part : bar) {
    const double end = std::min(100.0, begin + 100.0 * part.share);
    list.push_back(
        {{"kind", part.kind}, {"x", fmt::format("{:.2f}", begin)}, {"width", fmt::format("{:.2f}", end - begin)}});
    begin = end;
  }
  return list;
}

// What has been numbered so far, from the top of the page.
struct Numbers {
  std::size_t sections = 0;
  std::size_t figures = 0;
  std::size_t tables = 0;
};

// `report` numbers the figures of several runs: "error_ao_1", "error_ao_2", …
bool are_of_three_runs(const std::vector<FigureHead>& figures) {
  for (std::size_t i = 0; i < figures.size(); ++i) {
    if (!figures[i].stem.ends_with(fmt::format("_{}", i % 3 + 1))) return false;
  }
  return figures.size() % 3 == 0;
}

// In the order of the page: what the viewer shows, in `layers`, is folded after the rest.
Json figures_data(const fs::path& folder, const ReportSection& section, const std::set<std::string>& layers,
                  Numbers& numbers) {
  Json figures = Json::array();
  std::vector<FigureHead> heads = section.figures;
  std::ranges::stable_partition(heads, [&](const FigureHead& head) { return !layers.contains(head.stem); });
  for (const auto& [stem, title, conditions, caption] : heads) {
    figures.push_back({{"number", ++numbers.figures},
                       {"stem", stem},
                       {"title", title},
                       {"caption", caption},
                       {"files", figure_files(folder, stem)}});
    for (const ChartCells& cells : section.charts) {
      if (cells.stem == stem)
        figures.back()["cells"] = chart_cells_json(cells).dump(-1, ' ', true, Json::error_handler_t::replace);
    }
  }
  return figures;
}

Json section_data(const fs::path& folder, const ReportSection& section, const std::set<std::string>& layers,
                  Numbers& numbers) {
  Json tables = Json::array();
  for (const auto& [title, table, below, remarks] : section.tables) {
    if (table.columns.empty()) continue;
    tables.push_back(table_data(table, fmt::format("Table {}. {}", ++numbers.tables, title), below, remarks));
  }
  return {{"anchor", fmt::format("section-{}", ++numbers.sections)},
          {"title", section.title},
          {"bar", bar_data(section.bar)},
          {"headlines", headlines_data(section.headlines)},
          {"paragraphs", paragraphs_data(section.text)},
          {"in_threes", are_of_three_runs(section.figures)},
          {"figures", figures_data(folder, section, layers, numbers)},
          {"tables", tables}};
}

// All that the page shows but its pictures; numbers are texts with the digits that are shown.
Json page_data(const fs::path& folder, const Report& report, const std::set<std::string>& layers) {
  Json sections = Json::array();
  Json contents = Json::array();
  Numbers numbers;
  for (const ReportSection& section : report.sections) {
    sections.push_back(section_data(folder, section, layers, numbers));
    contents.push_back({{"anchor", sections.back()["anchor"]}, {"title", section.title}});
  }
  if (!report.settings.columns.empty()) contents.push_back({{"anchor", "settings"}, {"title", "Settings"}});
  return {{"title", report.title},
          {"subtitle", report.subtitle},
          {"command", report.command},
          {"command_title", report.command_title},
          {"files", files_data(folder)},
          {"contents", contents},
          {"warning_title", report.warning_title},
          {"warnings", report.warnings},
          {"answers", report.answers},
          {"notes", report.notes},
          {"sections", sections},
          {"settings", table_data(report.settings, "Every parameter of this run")}};
}

// Moves figures of what the viewer shows, in full, to a part that can be folded away.
void fold_figures(Json& section, const std::set<std::string>& layers) {
  Json shown = Json::array();
  Json folded = Json::array();
  for (Json& figure : section["figures"]) {
    const bool is_layer = layers.contains(figure["stem"].get_ref<const std::string&>());
    if (is_layer && figure.contains("drawing")) {
      figure["drawing"] = with_reduced_images(figure["drawing"].get_ref<const std::string&>());
    }
    (is_layer ? folded : shown).push_back(std::move(figure));
  }
  section["has_one_figure"] = shown.size() == 1;
  section["figures"] = std::move(shown);
  section["viewer_figure_count"] = folded.size();
  section["viewer_figures"] = std::move(folded);
  const auto is_empty = [&](const char* part) { return section[part].empty(); };
  static constexpr const char* parts[] = {"figures", "tables", "headlines", "paragraphs", "bar"};
  section["is_folded"] = !is_empty("viewer_figures") && std::ranges::all_of(parts, is_empty);
}

}  // namespace

std::vector<std::string> linked_files(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& [name, meaning] : file_meanings) {
    std::error_code error;
    if (fs::is_regular_file(folder / name, error)) files.emplace_back(name);
  }
  return files;
}

void write_page(const fs::path& folder, const Report& report, const ViewerPack* viewer) {
  write_page_to(folder / "index.html", report, viewer);
}

void write_page_to(const fs::path& file, const Report& report, const ViewerPack* viewer) {
  const fs::path folder = file.parent_path();
  const std::set<std::string> layers = viewer != nullptr ? viewer->layers : std::set<std::string>();
  Json page = page_data(folder, report, layers);
  page["data"] = script_text(page);
  if (report.cells) {
    page["cells"] = script_text(cells_json(*report.cells));
    if (!report.sections.empty()) page["sections"][0]["has_cells"] = true;
  }
  if (viewer != nullptr && !viewer->sets.empty()) {
    page["viewer"] = viewer_text(*viewer);
    if (!report.sections.empty()) page["sections"][0]["has_viewer"] = true;
  }
  if (const std::string_view script = page_script(); !script.empty()) {
    page["script"] = script;
    page["script_hash"] = to_base64(page_script_hash());
  }
  page["style"] = embedded_page_file("page.css");
  page["style_hash"] = to_base64(page_style_hash());
  for (Json& section : page["sections"]) {
    for (Json& figure : section["figures"]) add_picture(figure, folder);
    for (Json& table : section["tables"]) classify_cells(table);
    fold_figures(section, layers);
  }
  for (std::size_t s = 0; s < report.sections.size(); ++s) {
    Json& section = page["sections"][s];
    if (report.sections[s].tables_first) section["leading_tables"] = std::exchange(section["tables"], Json::array());
  }
  if (page["settings"].is_object()) ready_settings(page["settings"]);
  write_text(file, fill_template("page.html", page));
}

}  // namespace umbrameter
