#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/lists.h"
#include "present/plot_axes.h"
#include "present/presentation_parts.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_biases = 500;  // of a line
constexpr std::size_t max_lines = 24;
constexpr std::size_t max_columns = 150;  // of a heat map
constexpr std::size_t max_slopes = 24;
constexpr std::size_t max_panels = 9;
constexpr std::size_t least_resolutions = 3;  // that make a heat map of their own

constexpr const char* error_label = "mean absolute error [% of counted pixels]";
constexpr const char* no_zero = " A bias of 0 is not on this log axis.";

// The cells of one set of figures: they differ along the line axis, which separates lines and panels; the other axes
// are fixed.
struct Part {
  std::optional<std::size_t> line_axis;
  std::size_t first_cell = 0;
  std::vector<Value> values;  ///< of all axes at the first cell
  std::string conditions;     ///< "shadow.filter = box" or nothing
  std::string suffix;         ///< of file names
};

struct Drawing {
  const SweepResults& sweep;
  const BiasCurves& curves;
  const Part& part;
  std::string constant_key = std::string(constant_bias_key);
  std::string slope_key = std::string(slope_bias_key);
  std::string line_key{};
  std::size_t slope = 0;     ///< the index of the slope-scaled bias that lines are drawn at
  std::string conditions{};  ///< of the part and the slope

  const SweepPlan& plan() const { return sweep.plan; }
  std::size_t lines() const { return part.line_axis ? plan().axes[*part.line_axis].values.size() : 1; }
  std::size_t cell(std::size_t line, std::size_t constant, std::size_t slope_index) const {
    return part.first_cell + (part.line_axis ? line * plan().strides[*part.line_axis] : 0) +
           constant * plan().constant_bias.stride + slope_index * plan().slope_bias.stride;
  }
  Value line_value(std::size_t line) const {
    return part.line_axis ? plan().axes[*part.line_axis].values[line] : Value(std::string());
  }
};

const BiasCurve* curve_at(const Drawing& drawing, std::size_t line) {
  const std::vector<Value> wanted = mapped(outer_axes_as_given(drawing.plan()), [&](const std::size_t a) {
    return a == drawing.part.line_axis ? drawing.line_value(line) : drawing.part.values[a];
  });
  for (const BiasCurve& curve : drawing.curves.curves) {
    if (curve.others == wanted) return &curve;
  }
  return nullptr;
}

PlotFigure make_plot(const Drawing& drawing, const char* stem, const char* title, Axis x, Axis y) {
  PlotFigure plot;
  plot.stem = stem + drawing.part.suffix;
  plot.title = title;
  plot.conditions = drawing.conditions;
  plot.x = std::move(x);
  plot.y = std::move(y);
  if (drawing.part.line_axis) {
    plot.series = "line";
    plot.series_label = label_of(drawing.plan().axes[*drawing.part.line_axis]);
  }
  return plot;
}

// A bias below 0 would have no place.
bool suits_logarithm(const std::vector<double>& values) {
  return std::ranges::none_of(values, [](double v) { return v < 0.0; }) &&
         std::ranges::count_if(values, [](double v) { return v > 0.0; }) > 1;
}

Axis constant_axis(const Drawing& drawing) {
  return {"bias", label_of(drawing.plan().axes[*drawing.plan().constant_bias.axis]),
          suits_logarithm(drawing.plan().constant_bias.values)};
}

// Which cell each point of a figure shows. `columns` are those of the figure besides the line.
ChartCells cells_of(const Drawing& drawing, const std::string& stem,
                    std::vector<std::pair<std::string, std::string>> columns) {
  ChartCells cells{stem, std::move(columns), {}};
  const SweepPlan& plan = drawing.plan();
  const bool has_slope =
      std::ranges::any_of(cells.columns, [&](const auto& each) { return each.second == drawing.slope_key; });
  const bool is_front = cells.columns.front().second == cause_names[static_cast<std::size_t>(Cause::acne)];
  for (const std::size_t a : outer_axes_as_given(plan)) {
    if (a == drawing.part.line_axis) continue;
    cells.fixed.emplace_back(plan.axes[a].key, drawing.part.values[a]);
  }
  if (plan.slope_bias.axis && !has_slope && !is_front) {
    cells.fixed.emplace_back(drawing.slope_key, plan.slope_bias.values[drawing.slope]);
  }
  return cells;
}

// Rows of lines of y against the constant bias; columns as asked.
Table read_lines(const Drawing& drawing, const std::vector<std::string>& columns, std::vector<Value>& lines,
                 std::string& caption) {
  const Thinned biases = thin(drawing.plan().constant_bias.values.size(), max_biases);
  const Thinned series = thin(drawing.lines(), max_lines);
  std::vector<std::size_t> cells;
  for (const std::size_t line : series.indices) {
    for (const std::size_t bias : biases.indices) {
      cells.push_back(drawing.cell(line, bias, drawing.slope));
      lines.push_back(drawing.line_value(line));
    }
  }
  caption += thinning_text(biases, drawing.constant_key);
  if (drawing.part.line_axis) caption += thinning_text(series, drawing.line_key);
  return drawing.sweep.store.rows(cells, columns);
}

bool has_zero(const Drawing& drawing) {
  const std::vector<double>& values = drawing.plan().constant_bias.values;
  return std::ranges::find(values, 0.0) != values.end();
}

// Two causes in one figure, the first solid, the second dashed.
PlotFigure causes_plot(const Drawing& drawing, const char* stem, const char* title,
                       const std::array<Cause, 2>& causes) {
  PlotFigure plot =
      make_plot(drawing, stem, title, constant_axis(drawing), {"share", "share [%], square-root scale", false, true});
  plot.style = "cause";
  plot.style_label = "cause";
  plot.data.columns = plain_columns({"bias", "share", "line", "cause"});
  plot.caption = fmt::format("Solid: {}; dashed: {}. Shares of the counted pixels.", cause_title(causes[0]),
                             cause_title(causes[1]));
  if (plot.x.logarithmic && has_zero(drawing)) plot.caption += no_zero;
  std::vector<Value> lines;
  const auto column = [&](std::size_t c) { return std::string(cause_names[static_cast<std::size_t>(causes[c])]); };
  const Table rows = read_lines(drawing, {drawing.constant_key, column(0), column(1)}, lines, plot.caption);
  for (std::size_t c = 0; c < causes.size(); ++c) {
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
      const double bias = to_number(rows.rows[i][0]);
      if (plot.x.logarithmic && bias <= 0.0) continue;
      plot.data.rows.push_back(
          {bias, 100.0 * to_number(rows.rows[i][c + 1]), lines[i], std::string(cause_title(causes[c]))});
    }
  }
  return plot;
}

PlotFigure error_plot(const Drawing& drawing) {
  PlotFigure plot = make_plot(drawing, "mae", "Mean absolute error of visibility", constant_axis(drawing),
                              {"mae", error_label, true});
  plot.caption = "Mean over the counted pixels. Rings mark the bias of least error.";
  if (plot.x.logarithmic && has_zero(drawing)) plot.caption += no_zero;
  plot.mark = "least";
  plot.data.columns = plain_columns({"bias", "mae", "line", "least"});
  std::vector<Value> lines;
  const Table rows = read_lines(drawing, {drawing.constant_key, "mae"}, lines, plot.caption);
  for (std::size_t i = 0; i < rows.rows.size(); ++i) {
    const double bias = to_number(rows.rows[i][0]);
    if (plot.x.logarithmic && bias <= 0.0) continue;
    plot.data.rows.push_back({bias, 100.0 * to_number(rows.rows[i][1]), lines[i], false});
  }
  for (const std::size_t line : thin(drawing.lines(), max_lines).indices) {
    const BiasCurve* curve = curve_at(drawing, line);
    if (curve == nullptr) continue;
    const std::optional<BiasCell>& least = curve->optima.lines[drawing.slope].least_error;
    if (!least || (plot.x.logarithmic && least->constant <= 0.0)) continue;
    plot.data.rows.push_back({least->constant, 100.0 * least->mae, drawing.line_value(line), true});
  }
  return plot;
}

// What a heat map has for rows, and in which panel.
enum class HeatRows { slopes, lines };

HeatMapFigure heat_map(const Drawing& drawing, HeatRows kind) {
  const SweepPlan& plan = drawing.plan();
  const bool by_slope = kind == HeatRows::slopes;
  HeatMapFigure figure;
  figure.title = by_slope
                     ? "Mean absolute error over both biases"
                     : "Mean absolute error over bias and " + drawing.line_key.substr(drawing.line_key.find('.') + 1);
  figure.stem = (by_slope ? "mae_biases" : "mae_lines") + drawing.part.suffix;
  figure.conditions = by_slope ? drawing.part.conditions : drawing.conditions;
  figure.caption = "Rings mark the cells of least error. Colour steps are closer near the least error.";
  const SweepAxis& constant = plan.axes[*plan.constant_bias.axis];
  figure.x = {"bias", label_of(constant), is_logarithmic(constant)};
  figure.y = {"row", label_of(plan.axes[by_slope ? *plan.slope_bias.axis : *drawing.part.line_axis])};
  figure.value = {"mae", error_label};
  figure.mark = "least";
  figure.data.columns = plain_columns({"bias", "row", "mae", "least", "panel"});
  if (by_slope && drawing.part.line_axis) {
    figure.panel = "panel";
    figure.panel_label = label_of(drawing.plan().axes[*drawing.part.line_axis]);
  }
  const Thinned lines = thin(drawing.lines(), by_slope ? max_panels : max_lines);
  const Thinned slopes = by_slope ? thin(plan.slope_bias.values.size(), max_slopes) : Thinned{{drawing.slope}, 1};
  const Thinned biases = thin(constant.values.size(), max_columns);
  figure.caption += thinning_text(biases, drawing.constant_key) + thinning_text(slopes, drawing.slope_key);
  if (drawing.part.line_axis) figure.caption += thinning_text(lines, drawing.line_key);
  const auto least_of = [&](std::size_t line) -> std::optional<BiasCell> {
    const BiasCurve* curve = curve_at(drawing, line);
    if (curve == nullptr) return std::nullopt;
    return by_slope ? least_error(curve->optima) : curve->optima.lines[drawing.slope].least_error;
  };
  // The cells of least error are drawn whatever else is left out.
  std::set<std::size_t> shown(biases.indices.begin(), biases.indices.end());
  std::set<std::size_t> shown_slopes(slopes.indices.begin(), slopes.indices.end());
  const auto index_in = [](const std::vector<double>& values, double value) {
    return static_cast<std::size_t>(std::ranges::find(values, value) - values.begin());
  };
  for (const std::size_t line : lines.indices) {
    const std::optional<BiasCell> least = least_of(line);
    if (!least) continue;
    shown.insert(index_in(plan.constant_bias.values, least->constant));
    if (by_slope) shown_slopes.insert(index_in(plan.slope_bias.values, least->slope));
  }
  for (const std::size_t line : lines.indices) {
    const std::optional<BiasCell> least = least_of(line);
    std::vector<std::size_t> cells;
    for (const std::size_t slope : shown_slopes) {
      for (const std::size_t bias : shown) cells.push_back(drawing.cell(line, bias, slope));
    }
    const Table rows = drawing.sweep.store.rows(cells, {"mae"});
    std::size_t next = 0;
    for (const std::size_t slope : shown_slopes) {
      for (const std::size_t bias : shown) {
        const double at = plan.constant_bias.values[bias];
        const double slope_value = plan.slope_bias.values[slope];
        const bool is_least = least && least->constant == at && least->slope == slope_value;
        figure.data.rows.push_back({at, by_slope ? Value(slope_value) : drawing.line_value(line),
                                    100.0 * to_number(rows.rows[next++][0]), is_least, drawing.line_value(line)});
      }
    }
  }
  return figure;
}

PlotFigure front_plot(const Drawing& drawing) {
  PlotFigure plot = make_plot(drawing, "pareto_front", "Pareto fronts: peter-panning against acne",
                              {"acne", "acne [%], square-root scale", false, true},
                              {"peter_panning", "peter-panning [%], square-root scale", false, true});
  plot.conditions = drawing.part.conditions;
  plot.caption =
      "A front shows the biases that no other bias beats in both acne and peter-panning. Rings mark the knee: the "
      "point farthest below the chord between the ends of the front, on linear axes. A front with only one bias is "
      "drawn as one ring. "
      "Shares of the counted pixels.";
  plot.mark = "knee";
  plot.data.columns = plain_columns({"acne", "peter_panning", "line", "knee"});
  const Thinned lines = thin(drawing.lines(), max_lines);
  if (drawing.part.line_axis) plot.caption += thinning_text(lines, drawing.line_key);
  bool is_thinned = false;
  for (const std::size_t line : lines.indices) {
    const BiasCurve* curve = curve_at(drawing, line);
    if (curve == nullptr) continue;
    const auto add_row = [&](const BiasCell& cell, bool is_knee) {
      plot.data.rows.push_back({100.0 * cell.acne, 100.0 * cell.peter_panning, drawing.line_value(line), is_knee});
    };
    std::vector<const BiasCell*> cells;
    for (const auto& [acne, cell] : curve->optima.front.by_acne) cells.push_back(&cell);
    const Thinned drawn = thin(cells.size(), max_biases);
    is_thinned = is_thinned || drawn.step > 1 || curve->optima.front.thinned;
    for (const std::size_t i : drawn.indices) add_row(*cells[i], false);
    const std::optional<BiasCell> found = knee(curve->optima.front);
    if (found || cells.size() == 1) add_row(found ? *found : *cells.front(), true);
  }
  if (is_thinned) plot.caption += " The figure omits some cells of long fronts.";
  return plot;
}

// The axes that figures show none of: each combination has figures of its own.
std::vector<std::size_t> still_axes(const SweepPlan& plan, std::optional<std::size_t> line_axis) {
  std::vector<std::size_t> axes = outer_axes_as_given(plan);
  std::erase_if(axes, [&](std::size_t a) { return a == line_axis; });
  return axes;
}

std::optional<std::size_t> choose_line_axis(const SweepPlan& plan) {
  std::optional<std::size_t> chosen;
  for (const std::size_t a : outer_axes_as_given(plan)) {
    if (plan.axes[a].key == "shadow.resolution") return a;
    if (!chosen || plan.axes[a].values.size() > plan.axes[*chosen].values.size()) chosen = a;
  }
  return chosen;
}

Part make_part(const SweepPlan& plan, std::optional<std::size_t> line_axis, std::size_t index) {
  Part part;
  part.line_axis = line_axis;
  const std::vector<std::size_t> still = still_axes(plan, line_axis);
  if (!still.empty()) part.suffix = fmt::format("_{}", index);
  for (auto a = still.rbegin(); a != still.rend(); ++a) {
    const std::size_t count = plan.axes[*a].values.size();
    part.first_cell += index % count * plan.strides[*a];
    index /= count;
  }
  part.values = values_at(plan, part.first_cell);
  for (const std::size_t a : still) {
    part.conditions += (part.conditions.empty() ? "" : ", ") + plan.axes[a].key + " = " + short_text(part.values[a]);
  }
  return part;
}

}  // namespace

void add_bias_figures(Presentation& presentation, const SweepResults& sweep, const BiasCurves& curves,
                      std::size_t most) {
  const SweepPlan& plan = sweep.plan;
  const std::optional<std::size_t> line_axis = choose_line_axis(plan);
  std::size_t parts = 1;
  for (const std::size_t a : still_axes(plan, line_axis)) parts *= plan.axes[a].values.size();
  const std::vector<double>& slopes = plan.slope_bias.values;
  const auto flattest_slope =
      std::ranges::min_element(slopes, [](double a, double b) { return std::abs(a) < std::abs(b); });
  const std::size_t before = presentation.figures.size();
  const auto is_room = [&] { return presentation.figures.size() < before + most; };
  for (std::size_t i = 0; i < parts && is_room(); ++i) {
    const Part part = make_part(plan, line_axis, i);
    Drawing drawing{sweep, curves, part};
    if (line_axis) drawing.line_key = plan.axes[*line_axis].key;
    drawing.slope = static_cast<std::size_t>(flattest_slope - slopes.begin());
    drawing.conditions = part.conditions;
    if (curves.varies_slope) {
      drawing.conditions += fmt::format("{}{} = {}", part.conditions.empty() ? "" : ", ", drawing.slope_key,
                                        with_unit(fmt::format("{:g}", slopes[drawing.slope]), "texels"));
    }
    const auto chart = [&](const char* stem, std::vector<std::pair<std::string, std::string>> columns,
                           const char* line_column) {
      if (line_axis) columns.emplace_back(line_column, drawing.line_key);
      presentation.section.charts.push_back(cells_of(drawing, stem + part.suffix, std::move(columns)));
    };
    add_figure(presentation, causes_plot(drawing, "causes", "Acne and peter-panning against bias",
                                         {Cause::acne, Cause::peter_panning}));
    chart("causes", {{"bias", drawing.constant_key}}, "line");
    if (is_room()) add_figure(presentation, error_plot(drawing));
    chart("mae", {{"bias", drawing.constant_key}}, "line");
    if (is_room() && curves.varies_slope) add_figure(presentation, heat_map(drawing, HeatRows::slopes));
    chart("mae_biases", {{"bias", drawing.constant_key}, {"row", drawing.slope_key}}, "panel");
    if (is_room() && drawing.lines() >= least_resolutions) add_figure(presentation, heat_map(drawing, HeatRows::lines));
    chart("mae_lines", {{"bias", drawing.constant_key}}, "row");
    if (is_room()) add_figure(presentation, front_plot(drawing));
    chart("pareto_front", {{"acne", "acne"}, {"peter_panning", "peter_panning"}}, "line");
    if (is_room()) {
      add_figure(presentation, causes_plot(drawing, "other_causes", "False occlusion and light leak against bias",
                                           {Cause::false_occlusion, Cause::light_leak}));
    }
    chart("other_causes", {{"bias", drawing.constant_key}}, "line");
  }
}

}  // namespace umbrameter
