#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "reports/figures/figure_parts.h"
#include "reports/figures/plot_parts.h"
#include "reports/figures/plot_ticks.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_panels_in_a_row = 3;
constexpr int panel_gap = 16;
constexpr int legend_margin = 60;  // of the colour bar, beside it
constexpr int row_height = 24;
constexpr int least_panel_height = 96;
constexpr int max_panel_height = 300;
// Its lightness rises evenly (van der Walt and Smith, A Better Default Colormap for Matplotlib, SciPy 2015).
constexpr const char* color_scheme = "viridis";

std::vector<double> different_numbers(const Table& table, std::size_t column, bool positive) {
  std::vector<double> values;
  for (const std::vector<Value>& row : table.rows) {
    const std::optional<double> value = number(row[column]);
    if (value && std::isfinite(*value) && (!positive || *value > 0.0)) values.push_back(*value);
  }
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Cells meet half way between the values, on the axis as it is drawn; a first value of 0 begins its cell.
std::vector<double> cell_edges(const std::vector<double>& values, bool logarithmic) {
  const auto middle = [&](double a, double b) { return logarithmic ? std::sqrt(a * b) : 0.5 * (a + b); };
  const auto mirrored = [&](double at, double other) { return logarithmic ? at * at / other : 2.0 * at - other; };
  std::vector<double> edges;
  if (values.size() < 2) {
    for (const double value : values) {
      edges.push_back(0.5 * value);
      edges.push_back(value == 0.0 ? 1.0 : 1.5 * value);
    }
    std::ranges::sort(edges);
    return edges;
  }
  const double first = middle(values[0], values[1]);
  edges.push_back(values[0] == 0.0 ? 0.0 : mirrored(values[0], first));
  for (std::size_t i = 0; i + 1 < values.size(); ++i) edges.push_back(middle(values[i], values[i + 1]));
  edges.push_back(mirrored(values.back(), edges.back()));
  return edges;
}

struct Cells {
  Json rows = Json::array();  ///< x and x2 the cell's edges, xm its value, y, p (panel), v (step), e (value), k (mark)
  std::vector<double> edges;
  std::size_t dropped = 0;
};

double rounded(double value, int digits) { return std::stod(fmt::format("{:.{}g}", value, digits)); }

// The values at these shares of all, rounded to so many significant digits.
std::vector<double> steps_at(const std::vector<double>& values, std::span<const double> shares, int digits) {
  std::vector<double> steps;
  for (const double share : shares) {
    const double step = rounded(values[static_cast<std::size_t>(share * static_cast<double>(values.size()))], digits);
    // The least value keeps a colour below the first step.
    if (step > values.front() && (steps.empty() || step > steps.back())) steps.push_back(step);
  }
  return steps;
}

// Where the next colour begins: at these shares of the cells.
std::vector<double> steps_of(const HeatMapFigure& figure) {
  constexpr std::array<double, 9> shares = {0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9};
  std::vector<double> values;
  const std::size_t column = column_of(figure.data, figure.stem, figure.value.column);
  for (const std::vector<Value>& row : figure.data.rows) {
    const std::optional<double> value = number(row[column]);
    if (value && std::isfinite(*value)) values.push_back(*value);
  }
  std::ranges::sort(values);
  if (values.empty()) return {1.0};
  // Two digits are easier to read, and their labels leave each other room.
  std::vector<double> steps = steps_at(values, shares, 2);
  if (std::vector<double> finer = steps_at(values, shares, 3); finer.size() > steps.size() + 1)
    steps = std::move(finer);
  if (steps.empty()) steps.push_back(values.back() <= 0.0 ? 1.0 : rounded(2.0 * values.back(), 3));
  return steps;
}

Cells collect_cells(const HeatMapFigure& figure, const std::vector<double>& steps) {
  const auto column = [&](const std::string& name) { return column_of(figure.data, figure.stem, name); };
  const std::size_t x = column(figure.x.column);
  const std::size_t y = column(figure.y.column);
  const std::size_t value = column(figure.value.column);
  const std::size_t panel = figure.panel ? column(*figure.panel) : 0;
  const std::size_t mark = figure.mark ? column(*figure.mark) : 0;
  const std::vector<double> values = different_numbers(figure.data, x, figure.x.logarithmic);
  Cells cells;
  cells.edges = cell_edges(values, figure.x.logarithmic);
  for (const std::vector<Value>& row : figure.data.rows) {
    const std::optional<double> at = number(row[x]);
    const std::optional<double> height = number(row[value]);
    const auto place = at ? std::lower_bound(values.begin(), values.end(), *at) : values.end();
    if (place == values.end() || *place != *at || !height || !std::isfinite(*height)) {
      ++cells.dropped;
      continue;
    }
    const auto i = static_cast<std::size_t>(place - values.begin());
    Json cell = {{"x", cells.edges[i]}, {"x2", cells.edges[i + 1]}, {"xm", *at}, {"y", to_string(row[y])}};
    cell["v"] = std::upper_bound(steps.begin(), steps.end(), *height) - steps.begin();  // reached
    cell["e"] = *height;
    if (figure.panel) cell["p"] = to_string(row[panel]);
    if (figure.mark) cell["k"] = std::get<bool>(row[mark]);
    cells.rows.push_back(std::move(cell));
  }
  return cells;
}

// A panel's width and that of all side by side [units].
struct PanelLayout {
  int width = 0;
  int all_width = 0;
};

Json x_axis(const HeatMapFigure& figure, const Cells& cells, const PanelLayout& layout) {
  Json axis = {{"title", fitting_label(figure.x.label, layout.width)},
               {"grid", false},
               {"tickCount", layout.width < layout.all_width / 2 ? 3 : 6}};
  // End labels of panels side by side stay within their panel.
  if (layout.width < layout.all_width) {
    axis["labelFlush"] = 16;  // of labels so near to an end
  }
  Json scale = {{"nice", false}};
  if (figure.x.logarithmic) {
    scale["type"] = "log";
    if (const std::vector<double> ticks =
            cells.edges.empty() ? std::vector<double>{} : log_ticks(cells.edges.front(), cells.edges.back());
        !ticks.empty()) {
      axis.erase("tickCount");  // it would leave out every second one
      axis["values"] = ticks;
      axis["labelExpr"] = log_tick_label(ticks);
    }
  } else {
    scale["zero"] = false;
  }
  // An axis without cells has no extent of its own.
  scale["domain"] = cells.edges.empty() ? Json{1.0, 10.0} : Json{cells.edges.front(), cells.edges.back()};
  return {{"field", "x"}, {"type", "quantitative"}, {"axis", axis}, {"scale", scale}};
}

// The legend gives every step the same room.
Json color_of(const HeatMapFigure& figure, const std::vector<double>& steps, const PanelLayout& layout) {
  std::vector<int> numbers(steps.size() + 1);
  std::iota(numbers.begin(), numbers.end(), 0);
  // Blanks keep labels apart: those that would touch are left out.
  const std::string label = fmt::format("' ' + ['', {:g}][datum.value] + ' '", fmt::join(steps, ", "));
  return {{"field", "v"},
          {"type", "quantitative"},
          {"scale",
           {{"type", "threshold"},
            {"domain", std::vector<int>(numbers.begin() + 1, numbers.end())},
            {"scheme", color_scheme}}},
          {"legend",
           {{"type", "gradient"},
            {"title", fitting_label(figure.value.label, layout.all_width)},
            {"gradientLength", layout.all_width - legend_margin},
            {"values", numbers},
            {"labelFontSize", 11},
            {"labelExpr", label}}}};
}

// Side by side, in rows of the same length where that can be.
int panel_columns(std::size_t panels) {
  for (std::size_t columns = std::min(panels, max_panels_in_a_row); columns > 1; --columns) {
    if (panels % columns == 0) return static_cast<int>(columns);
  }
  return static_cast<int>(std::clamp<std::size_t>(panels, 1, max_panels_in_a_row));
}

Json make_panel(const HeatMapFigure& figure, const Cells& cells, const std::vector<double>& steps,
                const PanelLayout& layout) {
  std::vector<std::string> rows = different_values(figure.data, column_of(figure.data, figure.stem, figure.y.column));
  if (is_numeric(figure.data, column_of(figure.data, figure.stem, figure.y.column))) {
    std::ranges::reverse(rows);
  }
  const int height = std::clamp(row_height * static_cast<int>(rows.size()), least_panel_height, max_panel_height);
  const Json y = {{"field", "y"},
                  {"type", "nominal"},
                  {"sort", nullptr},
                  {"scale", {{"domain", rows}}},
                  {"axis", {{"title", fitting_label(figure.y.label, height)}, {"labelExpr", short_labels}}}};
  // Cells are outlined in their own colour, which closes the seams between them.
  const Json mark = {{"type", "rect"}, {"strokeWidth", 0.7}, {"stroke", {{"expr", "scale('color', datum.v)"}}}};
  const Json rectangle = {{"mark", mark},
                          {"encoding",
                           {{"x", x_axis(figure, cells, layout)},
                            {"x2", {{"field", "x2"}}},
                            {"y", y},
                            {"color", color_of(figure, steps, layout)}}}};
  Json panel;
  panel["width"] = layout.width;
  panel["height"] = height;
  panel["layer"] = {rectangle};
  if (!figure.mark) return panel;
  Json middle = x_axis(figure, cells, layout);
  middle["field"] = "xm";
  for (const auto& [ink, stroke, size] : {std::tuple{"black", 4.5, 120}, {"white", 2.0, 120}}) {
    panel["layer"].push_back({{"transform", {{{"filter", "datum.k"}}}},
                              {"mark",
                               {{"type", "point"},
                                {"filled", false},
                                {"stroke", ink},
                                {"strokeWidth", stroke},
                                {"size", size},
                                {"opacity", 1}}},
                              {"encoding", {{"x", middle}, {"y", y}}}});
  }
  return panel;
}

}  // namespace

std::string to_plot_specification(const HeatMapFigure& figure, const FigureStyle& style) {
  const std::vector<double> steps = steps_of(figure);
  const Cells cells = collect_cells(figure, steps);
  Json spec;
  spec["$schema"] = "https://vega.github.io/schema/vega-lite/v6.json";
  spec["description"] = figure.title;
  std::vector<std::string> notes;
  if (cells.dropped > 0) {
    notes.push_back(fmt::format("Not shown: {} of {} cells {}.", cells.dropped, figure.data.rows.size(),
                                figure.x.logarithmic ? "at 0 or without a number" : "without a number"));
  }
  if (cells.rows.empty()) notes.emplace_back("No data.");
  add_title(spec, style, figure.title, figure.conditions, notes);
  const int all_width = plot_width(style);
  int columns = 1;
  std::size_t panel_count = 1;
  if (!figure.panel) {
    const Json panel = make_panel(figure, cells, steps, {all_width, all_width});
    spec.insert(panel.begin(), panel.end());
  } else {
    const std::vector<std::string> panels =
        different_values(figure.data, column_of(figure.data, figure.stem, *figure.panel));
    panel_count = panels.size();
    columns = panel_columns(panel_count);
    const int width = (all_width - panel_gap * (columns - 1)) / columns;
    spec["columns"] = columns;
    spec["spacing"] = panel_gap;
    spec["facet"] = {{"field", "p"},
                     {"type", "nominal"},
                     {"sort", panels},
                     {"header",
                      {{"title", figure.panel_label},
                       {"labelExpr", short_labels},
                       {"labelFontSize", 13},
                       {"titleFontSize", 13},
                       {"titleFontWeight", "normal"}}}};
    spec["spec"] = make_panel(figure, cells, steps, {width, all_width});
    // A shared axis would stand under places without a panel, too.
    if (panels.size() % static_cast<std::size_t>(columns) != 0) spec["resolve"]["axis"]["x"] = "independent";
  }
  std::vector<PlotField> fields = {{"xm", figure.x.column, figure.x.label}, {"y", figure.y.column, figure.y.label}};
  if (figure.panel) fields.push_back({"p", *figure.panel, figure.panel_label});
  fields.push_back({"e", figure.value.column, figure.value.label});
  spec["usermeta"] = plot_fields(fields, fields.size() - 1);
  const auto rows = (panel_count + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns);
  add_print_size(spec, style, columns, static_cast<int>(rows));
  spec["data"]["values"] = cells.rows;
  spec["config"] = plot_look(style);
  return spec.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace umbrameter
