#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/figures/figure_parts.h"
#include "reports/figures/plot_parts.h"

namespace umbrameter {
namespace {

constexpr int screen_step_width = 74;
constexpr double bar_share = 0.6;    // of the width of a step
constexpr int bar_hatch_period = 6;  // [units]
// CIE L* 46, 72 and 36; besides, the bars differ in hatching, and the label of a step has its sign.
constexpr glm::u8vec3 below_color{0, 114, 178};
constexpr glm::u8vec3 above_color{230, 159, 0};
constexpr glm::u8vec3 sum_color{85, 85, 85};
constexpr const char* sum_name = "total";

std::string signed_text(double value, int decimals) {
  return fmt::format("{}{:.{}f}", value < 0.0 ? "−" : "+", std::abs(value), decimals);
}

// Under a step: its name and its note.
std::string category(const WaterfallStep& step) { return step.name + "|" + step.note; }

// Places each number (label_at) above its bar, and above the zero line and the lines to its neighbours where it would
// stand on one. `unit` is the height of a unit of the drawing. Returns the height that bars and numbers take.
double clear_labels(Json& rows, double unit, double highest) {
  constexpr double label_height = 18.0;  // with its distance from the bar [units]
  for (Json& row : rows) {
    double at = row.at("top").get<double>();
    std::array<double, 3> lines = {0.0, row.at("from").get<double>(), row.at("to").get<double>()};
    std::ranges::sort(lines);
    for (const double line : lines) {
      if (line > at && line < at + label_height * unit) at = line;
    }
    row["label_at"] = at;
    highest = std::max(highest, at);
  }
  return highest;
}

}  // namespace

std::string to_plot_specification(const WaterfallFigure& figure, const FigureStyle& style) {
  const int steps = static_cast<int>(figure.steps.size()) + 1;
  const int step_width = style.is_print() ? plot_width(style) / steps : screen_step_width;
  // In a column there is no room for the notes, and names are slanted.
  const bool is_narrow = step_width < screen_step_width - 10;
  Json rows = Json::array();
  Json links = Json::array();
  double sum = 0.0;
  double lowest = 0.0;
  double highest = 0.0;
  const auto add = [&](const WaterfallStep& step, double from, const std::string& kind) {
    const double to = from + step.value;
    Json row = {{"step", category(step)},
                {"from", from},
                {"to", to},
                {"kind", kind},
                {"top", std::max(from, to)},
                {"label", signed_text(step.value, is_narrow ? 1 : 2)}};
    if (step.upper > step.lower) {
      row["lo"] = from + step.lower;
      row["hi"] = from + step.upper;
      row["top"] = std::max(from, from + step.upper);
    }
    rows.push_back(std::move(row));
    lowest = std::min({lowest, to, from + step.lower});
    highest = std::max({highest, to, from + step.upper});
  };
  for (std::size_t i = 0; i < figure.steps.size(); ++i) {
    const WaterfallStep& step = figure.steps[i];
    add(step, sum, step.value < 0.0 ? figure.below : figure.above);
    sum += step.value;
    const WaterfallStep& next = i + 1 < figure.steps.size() ? figure.steps[i + 1] : figure.total;
    links.push_back({{"step", category(step)}, {"next", category(next)}, {"at", sum}});
  }
  add(figure.total, 0.0, sum_name);
  std::vector<std::string> order;
  for (const WaterfallStep& step : figure.steps) order.push_back(category(step));
  order.push_back(category(figure.total));
  const double margin = 0.08 * std::max(highest - lowest, 1e-6);
  highest = clear_labels(rows, (highest - lowest + 2.0 * margin) / height_of_plot(style), highest);

  const Json x = {{"field", "step"},
                  {"type", "nominal"},
                  {"sort", nullptr},
                  {"scale", {{"domain", order}}},
                  {"axis",
                   {{"title", nullptr},
                    {"labelAngle", is_narrow ? -40 : 0},
                    {"labelOverlap", false},
                    {"labelExpr", is_narrow ? "split(datum.label, '|')[0]" : "split(datum.label, '|')"},
                    {"labelFontSize", 11},
                    {"ticks", false}}}};
  const auto y = [&](const char* field) {
    return Json{{"field", field},
                {"type", "quantitative"},
                {"title", fitting_label(figure.label, height_of_plot(style))},
                {"scale", {{"domain", {lowest - margin, highest + margin}}, {"nice", false}}}};
  };
  const Json color = {
      {"field", "kind"},
      {"type", "nominal"},
      {"scale",
       {{"domain", {figure.below, figure.above, sum_name}}, {"range", {"url(#below)", "url(#above)", "url(#sum)"}}}},
      {"legend", {{"title", nullptr}, {"symbolType", "square"}, {"symbolSize", 160}}}};
  Json spec;
  spec["$schema"] = "https://vega.github.io/schema/vega-lite/v6.json";
  spec["description"] = figure.title;
  add_title(spec, style, figure.title, figure.conditions);
  spec["width"] = step_width * steps;
  spec["usermeta"]["patterns"] = hatch_pattern("below", Hatch::falling, below_color, bar_hatch_period) +
                                 hatch_pattern("above", Hatch::rising, above_color, bar_hatch_period) +
                                 hatch_pattern("sum", Hatch::none, sum_color, bar_hatch_period);
  add_print_size(spec, style);
  spec["height"] = plot_height;
  spec["data"]["values"] = rows;
  Json next = x;
  next["field"] = "step";
  const auto number_layer = [&](const char* ink, int outline) {
    const Json mark = {{"type", "text"},
                       {"dy", -8},
                       {"fontSize", is_narrow ? 9 : 12},
                       {"color", ink},
                       {"stroke", outline > 0 ? Json(ink) : Json()},
                       {"strokeWidth", outline}};
    return Json{{"mark", mark},
                {"encoding", {{"x", x}, {"y", y("label_at")}, {"text", {{"field", "label"}, {"type", "nominal"}}}}}};
  };
  spec["layer"] = {{{"mark", {{"type", "rule"}, {"color", "#666666"}}},
                    {"data", {{"values", Json::array({{{"zero", 0.0}}})}}},
                    {"encoding", {{"y", y("zero")}}}},
                   {{"mark", {{"type", "rule"}, {"color", "#999999"}, {"strokeDash", {2, 2}}}},
                    {"data", {{"values", links}}},
                    {"encoding", {{"x", next}, {"x2", {{"field", "next"}}}, {"y", y("at")}}}},
                   {{"mark", {{"type", "bar"}, {"size", std::lround(bar_share * step_width)}}},
                    {"encoding", {{"x", x}, {"y", y("from")}, {"y2", {{"field", "to"}}}, {"color", color}}}},
                   {{"mark", {{"type", "rule"}, {"color", "#1a1a1a"}, {"strokeWidth", 1.5}}},
                    {"transform", {{{"filter", "isValid(datum.lo)"}}}},
                    {"encoding", {{"x", x}, {"y", y("lo")}, {"y2", {{"field", "hi"}}}}}},
                   // A white outline keeps the numbers apart from lines behind them.
                   number_layer("#ffffff", 3),
                   number_layer("#1a1a1a", 0)};
  spec["config"] = plot_look(style);
  return spec.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace umbrameter
