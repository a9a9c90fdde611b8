#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "reports/figures/figure_parts.h"
#include "reports/figures/plot_parts.h"
#include "reports/figures/plot_ticks.h"
#include "reports/files/markup.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_points_with_markers = 12;

// Okabe and Ito, Color universal design, 2008; without yellow, which is too light for a line on white, black last.
constexpr std::array<const char*, 7> distinct_colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                        "#56b4e9", "#e69f00", "#000000"};
// Dark blue over teal to ochre: lightness rises by near-even steps, CIE L* 17 to 72, so that grey print keeps the
// order.
constexpr std::array<dvec3, 5> ordered_colors = {dvec3{46, 28, 96}, dvec3{45, 74, 139}, dvec3{31, 122, 140},
                                                 dvec3{70, 165, 110}, dvec3{202, 176, 46}};
constexpr std::array<const char*, 7> shapes = {"circle",        "square",        "triangle-up", "diamond",
                                               "triangle-down", "triangle-left", "cross"};
const std::array<std::vector<int>, 6> dashes = {std::vector<int>{1, 0}, std::vector<int>{8, 3},
                                                std::vector<int>{2, 2}, std::vector<int>{9, 3, 2, 3},
                                                std::vector<int>{4, 4}, std::vector<int>{10, 3, 1, 3, 1, 3}};

std::string hex(const glm::u8vec3& color) { return fmt::format("#{:02x}{:02x}{:02x}", color.x, color.y, color.z); }

std::string ordered_color(std::size_t i, std::size_t count) {
  const double t = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
  const double place = t * (ordered_colors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), ordered_colors.size() - 2);
  const dvec3 color = glm::mix(ordered_colors[below], ordered_colors[below + 1], place - static_cast<double>(below));
  return hex(glm::u8vec3(glm::round(color)));
}

// The place of a value among those that have a colour of their own; past the last one if it has none.
std::size_t own_place(const PlotFigure& figure, const std::string& name) {
  const auto& all = figure.series_colors;
  const auto found = std::ranges::find(all, name, &CategoryColor::name);
  return static_cast<std::size_t>(found - all.begin());
}

// The rows under the short names x, y, s (series), d (style), k (mark), lo, hi, without points that the axes cannot
// show.
struct Points {
  Json rows = Json::array();
  std::size_t dropped = 0;
  std::size_t longest_line = 0;
};

std::optional<std::size_t> optional_column(const PlotFigure& figure, const std::optional<std::string>& name) {
  if (!name) return std::nullopt;
  return column_of(figure.data, figure.stem, *name);
}

// Where dashes tell something else, markers at a few points of each line (q) tell the series apart in grey; those of
// different series stand at different points.
void select_marked(Json& rows, const std::vector<std::string>& series) {
  constexpr std::size_t markers_of_a_line = 5;
  const auto line_of = [](const Json& row) {
    return row.at("s").get<std::string>() + '\n' + row.at("d").get<std::string>();
  };
  std::map<std::string, std::size_t> lengths;
  for (const Json& row : rows) ++lengths[line_of(row)];
  std::map<std::string, std::size_t> places;
  for (Json& row : rows) {
    const std::string line = line_of(row);
    const std::size_t step = std::max<std::size_t>(1, lengths[line] / markers_of_a_line);
    const auto index =
        static_cast<std::size_t>(std::ranges::find(series, row.at("s").get<std::string>()) - series.begin());
    const std::size_t first = step * (2 * index + 1) / (2 * series.size());
    row["q"] = places[line]++ % step == first;
  }
}

Points collect_points(const PlotFigure& figure, bool has_numeric_x) {
  const std::size_t x = column_of(figure.data, figure.stem, figure.x.column);
  const std::size_t y = column_of(figure.data, figure.stem, figure.y.column);
  const bool has_series = figure.series.has_value();
  const std::size_t series = has_series ? column_of(figure.data, figure.stem, *figure.series) : 0;
  const bool has_band = figure.lower && figure.upper;
  const std::size_t lower = has_band ? column_of(figure.data, figure.stem, *figure.lower) : 0;
  const std::size_t upper = has_band ? column_of(figure.data, figure.stem, *figure.upper) : 0;
  const std::optional<std::size_t> style = optional_column(figure, figure.style);
  const std::optional<std::size_t> mark = optional_column(figure, figure.mark);
  const auto fits = [](const std::optional<double>& value, const Axis& axis) {
    return value && std::isfinite(*value) && (!axis.logarithmic || *value > 0.0);
  };
  Points points;
  std::map<std::string, std::size_t> lengths;
  for (const std::vector<Value>& row : figure.data.rows) {
    const std::optional<double> y_value = number(row[y]);
    if ((has_numeric_x && !fits(number(row[x]), figure.x)) || !fits(y_value, figure.y)) {
      ++points.dropped;
      continue;
    }
    Json point;
    if (has_numeric_x) {
      point["x"] = *number(row[x]);
    } else {
      point["x"] = to_string(row[x]);
    }
    point["y"] = *y_value;
    const std::string line = has_series ? to_string(row[series]) : "";
    if (has_series) point["s"] = line;
    if (style) point["d"] = to_string(row[*style]);
    if (mark) point["k"] = std::get<bool>(row[*mark]);
    if (has_band && fits(number(row[lower]), figure.y) && fits(number(row[upper]), figure.y)) {
      point["lo"] = *number(row[lower]);
      point["hi"] = *number(row[upper]);
    }
    const std::string styled = style ? line + '\n' + to_string(row[*style]) : line;
    points.longest_line = std::max(points.longest_line, ++lengths[styled]);
    points.rows.push_back(std::move(point));
  }
  if (style && has_series) select_marked(points.rows, different_values(figure.data, series));
  return points;
}

// A scale that ends at ticks.
void set_range(Json& axis, const TickedRange& range) {
  axis["scale"]["nice"] = false;
  axis["scale"]["domain"] = {range.first, range.last};
  axis["axis"]["values"] = range.ticks;
  axis["axis"].erase("tickCount");  // it would leave out every second one
}

// The x axis of few values has its ticks at these, if they were given.
void set_log_scale(Json& axis, bool is_x, bool has_given_values, const Json& rows) {
  axis["scale"]["type"] = "log";
  std::set<double> values;
  for (const Json& row : rows) {
    for (const char* field : {is_x ? "x" : "y", is_x ? "x" : "lo", is_x ? "x" : "hi"}) {
      if (row.contains(field)) values.insert(row.at(field).get<double>());
    }
  }
  if (values.size() < 2) return;
  constexpr std::size_t most_values = 8;
  if (is_x && has_given_values && values.size() <= most_values) {
    axis["axis"].erase("tickCount");
    axis["axis"]["values"] = values;
  } else {
    set_range(axis, log_range(*values.begin(), *values.rbegin()));
  }
  axis["axis"]["labelExpr"] = log_tick_label(axis["axis"]["values"].get<std::vector<double>>());
}

void set_square_root_scale(Json& axis, bool is_x, const Json& rows, double length) {
  axis["scale"]["type"] = "sqrt";
  axis["axis"]["labelOverlap"] = "greedy";  // not every second one: small numbers stand closely, large ones do not
  axis["scale"]["zero"] = true;
  double highest = 0.0;
  for (const Json& row : rows) highest = std::max(highest, row.at(is_x ? "x" : "y").get<double>());
  if (highest <= 0.0) return;
  set_range(axis, square_root_range(highest, length, is_x));
  axis["axis"]["format"] = ".6~g";
}

Json axis_of(const char* field, const Axis& axis, bool is_numeric_axis, const Json& rows, const FigureStyle& style) {
  Json result;
  result["field"] = field;
  result["type"] = is_numeric_axis ? "quantitative" : "nominal";
  const bool is_x = std::string_view(field) == "x";
  const double length = is_x ? plot_width(style) : height_of_plot(style);
  result["axis"]["title"] = fitting_label(axis.label, length);
  if (!is_numeric_axis) {
    result["sort"] = nullptr;
    // Every name is drawn: where they do not fit beside each other, they are slanted.
    std::set<std::string> names;
    std::size_t characters = 0;
    for (const Json& row : rows) {
      const std::string name = row.at(field).get<std::string>();
      if (names.insert(name).second) characters += name.size() + 2;
    }
    constexpr int units_of_a_character = 10;
    const bool fits_in_a_row = static_cast<int>(characters) <= plot_width(style) / units_of_a_character;
    result["axis"]["labelAngle"] = fits_in_a_row ? 0 : -40;
    if (!fits_in_a_row) result["axis"]["labelOverlap"] = false;
    return result;
  }
  result["axis"]["tickCount"] = axis.logarithmic ? 5 : 6;
  result["scale"] = {{"nice", !is_x}};
  if (axis.logarithmic) {
    set_log_scale(result, is_x, !axis.round_ticks, rows);
  } else if (axis.square_root) {
    set_square_root_scale(result, is_x, rows, length);
  } else {
    result["scale"]["zero"] = !is_x;
  }
  const auto differs = [&](const Json& row) { return row.at(field) != rows.front().at(field); };
  if (rows.empty()) {
    result["scale"]["domain"] = axis.logarithmic ? Json{1, 10} : Json{0, 1};
  } else if (is_x && std::ranges::none_of(rows, differs)) {
    result["axis"]["values"] = {rows.front().at(field)};
    result["axis"]["format"] = ".6~g";
  }
  return result;
}

// As many legend entries side by side as fit below the plot.
int legend_columns(const std::vector<std::string>& names, const FigureStyle& style) {
  constexpr double sample = 30.0;   // the drawn line, and the space before its name
  constexpr double padding = 16.0;  // between columns, see plot_look()
  double longest = 0.0;
  for (const std::string& name : names) longest = std::max(longest, plot_font_size * text_width(name));
  return std::max(1, static_cast<int>((plot_width(style) + padding) / (sample + longest + padding)));
}

// How the values of the series column are told apart.
struct Series {
  Json color;
  Json dash;
  Json shape;
};

// Colour and dash tell lines apart, and colour and shape the markers, each alone enough. Markers that stand on lines
// leave the legend to these.
Series make_series(const PlotFigure& figure, const FigureStyle& style, bool has_lines) {
  const std::size_t column = column_of(figure.data, figure.stem, *figure.series);
  const std::vector<std::string> domain = different_values(figure.data, column);
  const bool is_ordered = is_numeric(figure.data, column);
  Json colors = Json::array();
  Json patterns = Json::array();
  Json markers = Json::array();
  for (std::size_t i = 0; i < domain.size(); ++i) {
    const std::size_t own = own_place(figure, domain[i]);
    const bool has_own = own < figure.series_colors.size();
    const std::size_t look = has_own ? own : i;  // the same in every figure, whichever values it lacks
    std::string color = is_ordered ? ordered_color(i, domain.size()) : distinct_colors[i % distinct_colors.size()];
    if (has_own) color = hex(figure.series_colors[own].color);
    colors.push_back(color);
    patterns.push_back(dashes[look % dashes.size()]);
    markers.push_back(shapes[look % shapes.size()]);
  }
  Json legend = {
      {"title", fitting_label(figure.series_label.empty() ? *figure.series : figure.series_label, plot_width(style))},
      {"columns", legend_columns(domain, style)},
      {"labelExpr", short_labels}};
  if (!has_lines) legend["symbolSize"] = 110;
  const auto channel = [&](const Json& range) {
    return Json{{"field", "s"},
                {"type", "nominal"},
                {"scale", {{"domain", domain}, {"range", range}}},
                {"sort", nullptr},
                {"legend", legend}};
  };
  Series series{channel(colors), channel(patterns), channel(markers)};
  if (has_lines && figure.style) {
    for (Json* each : {&series.color, &series.shape}) (*each)["legend"]["symbolSize"] = 90;
  } else if (has_lines) {
    // Under its own field name: Vega-Lite joins the legends of one field.
    series.shape["field"] = "m";
    series.shape["legend"] = nullptr;
  }
  return series;
}

// Solid and dashed by the style column.
Json make_dashes(const PlotFigure& figure, const FigureStyle& style) {
  Json patterns = Json::array();
  const std::vector<std::string> domain =
      different_values(figure.data, column_of(figure.data, figure.stem, *figure.style));
  for (std::size_t i = 0; i < domain.size(); ++i) patterns.push_back(dashes[i % dashes.size()]);
  return {
      {"field", "d"},
      {"type", "nominal"},
      {"scale", {{"domain", domain}, {"range", patterns}}},
      {"sort", nullptr},
      {"legend",
       {{"title", fitting_label(figure.style_label, plot_width(style))}, {"columns", legend_columns(domain, style)}}}};
}

// The layers from back to front: zero line, intervals, lines, markers. Categories on the x axis get no lines, since
// there is nothing between them, and their series stand side by side.
Json make_layers(const PlotFigure& figure, const FigureStyle& style, const Points& points, bool has_numeric_x) {
  const bool has_some_markers = figure.style && figure.series && !figure.mark && has_numeric_x;
  const bool has_markers = !figure.style && !figure.mark &&
                           (!has_numeric_x || figure.is_scatter || points.longest_line <= max_points_with_markers);
  const bool has_lines = has_numeric_x && !figure.is_scatter;
  const bool has_band = has_numeric_x && points.longest_line > 1;
  std::optional<Series> series;
  if (figure.series) series = make_series(figure, style, has_lines);
  const Json y = axis_of("y", figure.y, true, points.rows, style);
  const auto layer = [&](Json mark) {
    Json result = {{"mark", std::move(mark)}, {"encoding", {{"y", y}}}};
    if (series) result["encoding"]["color"] = series->color;
    if (series && !has_numeric_x) result["encoding"]["xOffset"] = {{"field", "s"}, {"sort", nullptr}};
    return result;
  };

  Json layers = Json::array();
  const auto is_negative = [](const Json& row) { return row.at("y").get<double>() < 0.0; };
  if (std::ranges::any_of(points.rows, is_negative)) {
    Json zero = y;
    zero.erase("field");
    zero["datum"] = 0;
    zero["axis"]["grid"] = true;
    layers.push_back({{"mark", {{"type", "rule"}, {"color", "#888888"}}}, {"encoding", {{"x", nullptr}, {"y", zero}}}});
  }
  if (figure.lower && figure.upper) {
    Json interval = layer(has_band ? Json{{"type", "area"}, {"fillOpacity", 0.2}}
                                   : Json{{"type", "rule"}, {"strokeWidth", 6}, {"strokeOpacity", 0.3}});
    interval["transform"] = {{{"filter", "isValid(datum.lo) && isValid(datum.hi)"}}};
    interval["encoding"]["y"]["field"] = "lo";
    interval["encoding"]["y2"] = {{"field", "hi"}};
    layers.push_back(std::move(interval));
  }
  const Json is_joined = {{{"filter", "!datum.k"}}};
  const auto is_of_line = [](const Json& row) { return !row.contains("k") || !row.at("k").get<bool>(); };
  const bool has_line = points.rows.empty() || std::ranges::any_of(points.rows, is_of_line);
  if (has_lines && has_line) {
    Json line = layer({{"type", "line"}, {"strokeWidth", 2.2}});
    if (series && !figure.style) line["encoding"]["strokeDash"] = series->dash;
    if (figure.style) line["encoding"]["strokeDash"] = make_dashes(figure, style);
    if (figure.mark) line["transform"] = is_joined;
    layers.push_back(std::move(line));
  }
  if (has_markers) {
    Json mark = {{"type", "point"}, {"filled", true}, {"size", has_numeric_x ? 55 : 80}, {"opacity", 1}};
    // Outlines, so that points on each other can be told.
    if (figure.is_scatter) mark.update({{"filled", false}, {"strokeWidth", 1.6}});
    Json marker = layer(std::move(mark));
    if (series) {
      marker["transform"] = {{{"calculate", "datum.s"}, {"as", "m"}}};
      marker["encoding"]["shape"] = series->shape;
    }
    if (figure.mark) marker["transform"].push_back(is_joined.front());
    layers.push_back(std::move(marker));
  }
  if (has_some_markers) {
    Json marker = layer({{"type", "point"}, {"filled", true}, {"size", 45}, {"opacity", 1}});
    marker["transform"] = {{{"filter", "datum.q"}}};
    marker["encoding"]["shape"] = series->shape;
    layers.push_back(std::move(marker));
  }
  // A layer without points would have no extent, which the drawer calls a mistake.
  const auto is_marked = [](const Json& row) { return row.contains("k") && row.at("k").get<bool>(); };
  if (std::ranges::any_of(points.rows, is_marked)) {
    Json ring = layer({{"type", "point"}, {"size", 130}, {"strokeWidth", 2.4}, {"fill", "white"}, {"opacity", 1}});
    ring["transform"] = {{{"filter", "datum.k"}}};
    layers.push_back(std::move(ring));
  }
  return layers;
}

Json fields_of(const PlotFigure& figure) {
  std::vector<PlotField> fields = {{"x", figure.x.column, figure.x.label}};
  if (figure.series) fields.push_back({"s", *figure.series, figure.series_label});
  const std::size_t keys = fields.size();
  if (figure.style) fields.push_back({"d", *figure.style, figure.style_label});
  fields.push_back({"y", figure.y.column, figure.y.label});
  if (figure.lower && figure.upper) {
    fields.push_back({"lo", *figure.lower, "lower bound"});
    fields.push_back({"hi", *figure.upper, "upper bound"});
  }
  return plot_fields(fields, keys);
}

}  // namespace

std::string to_plot_specification(const PlotFigure& figure, const FigureStyle& style) {
  const bool has_numeric_x = is_numeric(figure.data, column_of(figure.data, figure.stem, figure.x.column));
  Points points = collect_points(figure, has_numeric_x);
  Json spec;
  spec["$schema"] = "https://vega.github.io/schema/vega-lite/v6.json";
  spec["description"] = figure.title;
  spec["width"] = plot_width(style);
  spec["height"] = plot_height;
  std::vector<std::string> notes;
  if (points.dropped > 0) {
    const bool has_log = figure.x.logarithmic || figure.y.logarithmic;
    notes.push_back(
        fmt::format("Not shown: {} of {} points {}.", points.dropped, figure.data.rows.size(),
                    has_log ? "that are 0, negative or no number (logarithmic axis)" : "that are no number"));
  }
  if (points.rows.empty()) notes.emplace_back("No data.");
  add_title(spec, style, figure.title, figure.conditions, notes);

  spec["encoding"]["x"] = axis_of("x", figure.x, has_numeric_x, points.rows, style);
  spec["layer"] = make_layers(figure, style, points, has_numeric_x);
  spec["usermeta"] = fields_of(figure);
  add_print_size(spec, style);
  spec["data"]["values"] = std::move(points.rows);
  spec["config"] = plot_look(style);
  return spec.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace umbrameter
