#include "present/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

#include "core/lists.h"
#include "present/plot_axes.h"
#include "present/presentation_parts.h"
#include "results/known_statistics.h"

namespace umbrameter {
namespace {

// What a reader can tell apart and a page can hold; all else is in the store.
constexpr std::size_t max_plots = 12;
constexpr std::size_t max_points = 16'000;  // of a plot
constexpr std::size_t max_points_of_line = 2'000;
constexpr std::size_t max_drawn_lines = 64;
constexpr std::size_t max_best_rows = 1'000;
constexpr std::size_t max_lines = 8;  // printed

// How the axes are laid out in figures: x is the numeric axis with the most values, lines are the next, and every
// combination of the rest gets a figure of its own.
struct Layout {
  std::size_t x = 0;
  std::optional<std::size_t> series;
  std::vector<std::size_t> rest;
};

Layout lay_out(const Parameters& parameters, const std::vector<SweepAxis>& axes) {
  std::vector<std::size_t> order;
  for (std::size_t a = 0; a < axes.size(); ++a) order.push_back(a);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    const bool number_a = require(parameters, axes[a].key).is_number();
    const bool number_b = require(parameters, axes[b].key).is_number();
    if (number_a != number_b) return number_a;
    return axes[a].values.size() > axes[b].values.size();
  });
  Layout layout;
  if (order.empty()) return layout;
  layout.x = order[0];
  if (order.size() > 1) layout.series = order[1];
  if (order.size() > 2) layout.rest.assign(order.begin() + 2, order.end());
  return layout;
}

// The cells of one plot: a combination of the axes that are neither x nor series.
struct PlotCells {
  std::vector<std::size_t> cells;  ///< in the order of rows
  std::string conditions;
  std::string caption;
};

std::size_t count_values(const SweepPlan& plan, std::size_t axis) { return plan.axes[axis].values.size(); }

PlotCells cells_of_plot(const SweepPlan& plan, const Layout& layout, std::size_t part) {
  PlotCells plot;
  std::size_t first = 0;
  std::size_t rest = part;
  for (auto a = layout.rest.rbegin(); a != layout.rest.rend(); ++a) {
    const std::size_t index = rest % count_values(plan, *a);
    rest /= count_values(plan, *a);
    first += index * plan.strides[*a];
    plot.conditions = plan.axes[*a].key + " = " + short_text(plan.axes[*a].values[index]) +
                      (plot.conditions.empty() ? "" : ", ") + plot.conditions;
  }
  const Thinned lines = thin(layout.series ? count_values(plan, *layout.series) : 1, max_drawn_lines);
  const Thinned points =
      thin(count_values(plan, layout.x), std::min(max_points_of_line, max_points / lines.indices.size()));
  for (const std::size_t line : lines.indices) {
    const std::size_t of_line = first + (layout.series ? line * plan.strides[*layout.series] : 0);
    for (const std::size_t point : points.indices) plot.cells.push_back(of_line + point * plan.strides[layout.x]);
  }
  std::ranges::sort(plot.cells);
  if (layout.series) plot.caption += thinning_text(lines, plan.axes[*layout.series].key);
  plot.caption += thinning_text(points, plan.axes[layout.x].key);
  return plot;
}

PlotFigure make_plot(const SweepResults& sweep, const Layout& layout, const PlotCells& cells,
                     const Statistic& statistic) {
  const SweepAxis& x = sweep.plan.axes[layout.x];
  PlotFigure plot;
  plot.title = statistic.curve.title;
  plot.conditions = cells.conditions;
  plot.caption = cells.caption;
  plot.x = {x.key, label_of(x), is_logarithmic(x)};
  plot.y = {statistic.name, statistic.curve.label, statistic.curve.logarithmic};
  std::vector<std::string> names = {x.key, statistic.name};
  if (layout.series) {
    plot.series = sweep.plan.axes[*layout.series].key;
    plot.series_label = label_of(sweep.plan.axes[*layout.series]);
    names.push_back(*plot.series);
  }
  if (statistic.has_interval()) {
    const bool has_line =
        std::holds_alternative<double>(x.values.front()) || std::holds_alternative<std::int64_t>(x.values.front());
    const char* shown = has_line ? "Band" : "Bars, where longer than a point";
    plot.caption += plot.y.label.ends_with("bounds")
                        ? fmt::format(
                              " The noise of the reference's rays puts the {} too high; {} the error without it, with "
                              "at least 95 % confidence.",
                              has_line ? "line" : "points", has_line ? "the band holds" : "the bars hold")
                        : fmt::format(" {}: 95 % interval.", shown);
    plot.lower = lower_name(statistic.name);
    plot.upper = upper_name(statistic.name);
    names.push_back(*plot.lower);
    names.push_back(*plot.upper);
  }
  plot.data = sweep.store.rows(cells.cells, names);
  const bool is_metric =
      std::ranges::any_of(sweep.metrics, [&](const MetricColumn& column) { return column.name == statistic.name; });
  if (is_metric) return plot;
  for (std::vector<Value>& row : plot.data.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      // The label says per cent.
      if (names[i] != x.key && names[i] != plot.series) row[i] = 100.0 * to_number(row[i]);
    }
  }
  return plot;
}

// The statistics that have a figure. Those of image metrics are in their own units.
std::vector<Statistic> drawn_metrics(const SweepResults& sweep) {
  std::vector<Statistic> drawn;
  for (const MetricColumn& column : sweep.metrics) {
    const std::string title(column.metric->title);
    const std::string unit = column.unit == "1" ? "" : " [" + column.unit + "]";
    drawn.push_back({column.name,
                     column.unit,
                     column.meaning(),
                     {static_cast<char>(std::toupper(title.front())) + title.substr(1) +
                          (column.other_unit > 0 ? ", " + column.unit : ""),
                      title + unit + ": " + std::string(column.metric->range)},
                     static_cast<double*>(nullptr)});
  }
  return drawn;
}

std::vector<Statistic> drawn_statistics(const SweepResults& sweep) {
  CellStatistics statistics = sweep.statistics;
  std::vector<Statistic> drawn = describe(statistics);
  std::erase_if(drawn, [](const Statistic& each) { return each.curve.title.empty(); });
  return drawn;
}

// Which cell each point of a plot shows.
ChartCells chart_cells(const SweepResults& sweep, const Layout& layout, const PlotCells& cells,
                       const std::string& stem) {
  const std::vector<SweepAxis>& axes = sweep.plan.axes;
  ChartCells chart{stem, {{axes[layout.x].key, axes[layout.x].key}}, {}};
  if (layout.series) chart.columns.emplace_back(axes[*layout.series].key, axes[*layout.series].key);
  const std::vector<Value> values = values_at(sweep.plan, cells.cells.front());
  for (const std::size_t a : layout.rest) chart.fixed.emplace_back(axes[a].key, values[a]);
  return chart;
}

std::vector<std::pair<PlotFigure, ChartCells>> make_plots(const SweepResults& sweep, const Layout& layout,
                                                          const std::vector<Statistic>& statistics) {
  std::size_t parts = 1;
  for (const std::size_t a : layout.rest) parts *= count_values(sweep.plan, a);
  std::vector<std::pair<PlotFigure, ChartCells>> plots;
  for (std::size_t part = 0; part < parts; ++part) {
    const PlotCells cells = cells_of_plot(sweep.plan, layout, part);
    for (const Statistic& statistic : statistics) {
      if (plots.size() >= max_plots) return plots;
      PlotFigure plot = make_plot(sweep, layout, cells, statistic);
      plot.stem = statistic.name + (layout.rest.empty() ? "" : fmt::format("_{}", part));
      ChartCells chart = chart_cells(sweep, layout, cells, plot.stem);
      plots.emplace_back(std::move(plot), std::move(chart));
    }
  }
  return plots;
}

// What is left out is returned as a sentence.
std::string add_plots(Presentation& presentation, const SweepResults& sweep, const Layout& layout,
                      const std::vector<Statistic>& statistics) {
  std::size_t all = statistics.size();
  for (const std::size_t a : layout.rest) all *= count_values(sweep.plan, a);
  for (auto& [plot, cells] : make_plots(sweep, layout, statistics)) {
    add_figure(presentation, std::move(plot));
    presentation.section.charts.push_back(std::move(cells));
  }
  return all > max_plots ? fmt::format(" Figures: the first {} of {}.", max_plots, all) : "";
}

// Rows of least error are listed for each value of these. Where biases are varied one bias is chosen for each
// combination of the rest, else one cell for each line of the figures.
std::vector<std::size_t> listed_axes(const SweepResults& sweep) {
  const SweepPlan& plan = sweep.plan;
  if (plan.constant_bias.axis || plan.slope_bias.axis) return outer_axes_as_given(plan);
  const Layout layout = lay_out(sweep.parameters, plan.axes);
  std::vector<std::size_t> axes;
  if (layout.series) axes.push_back(*layout.series);
  for (const std::size_t a : layout.rest) axes.push_back(a);
  return axes;
}

// The error of a row with the interval that a sampled reference gives it.
std::string error_text(const Table& table, const std::vector<Value>& row) {
  const double error = to_number(row[column_index(table, error_statistic)]);
  const auto end = [&](const std::string& name) {
    const auto found = std::ranges::find(table.columns, name, &Column::name);
    return found == table.columns.end() ? error
                                        : to_number(row[static_cast<std::size_t>(found - table.columns.begin())]);
  };
  return percent(Estimate{error, end(lower_name(error_statistic)), end(upper_name(error_statistic))});
}

// Whether the cells differ in their filter, and are measured against a hard shadow.
bool compares_filters(const SweepResults& sweep) {
  return sweep.quantity() == SweptQuantity::visibility &&
         !std::holds_alternative<SoftVisibilityStatistics>(sweep.statistics) &&
         varies_filter(sweep.plan.axes, sweep.parameters);
}

bool has_edges(const SweepResults& sweep) {
  return std::ranges::any_of(sweep.store.description().columns,
                             [](const StoredColumn& each) { return measures_edges(each.column.name); });
}

std::string equal_cells_text(const SweepResults& sweep, const std::string& error) {
  const std::string keys = joined(sweep.plan.axes, ", ", &SweepAxis::key);
  return fmt::format("all {} cells are equal: error {}; {} {} nothing here", sweep.plan.cells, error, keys,
                     sweep.plan.axes.size() > 1 ? "change" : "changes");
}

// With a dash for each value that the cell does not read.
Table best_as_read(const SweepResults& sweep, Table best) {
  std::vector<std::size_t> axes(sweep.plan.axes.size());
  std::iota(axes.begin(), axes.end(), std::size_t{0});
  for (std::vector<Value>& row : best.rows) {
    const std::vector<std::size_t> read = read_axes(sweep, row, axes);
    for (const std::size_t a : axes) {
      if (std::ranges::find(read, a) == read.end()) row[a] = std::string("—");
    }
  }
  return best;
}

}  // namespace

bool are_all_equal(const SweepResults& sweep) {
  if (sweep.plan.cells < 2) return false;
  std::vector<std::string> measured;
  const std::vector<StoredColumn>& columns = sweep.store.description().columns;
  for (std::size_t c = sweep.plan.axes.size(); c < columns.size(); ++c) measured.push_back(columns[c].column.name);
  const auto is_nan = [](const Value& value) {
    const auto* number = std::get_if<double>(&value);
    return number != nullptr && std::isnan(*number);
  };
  std::vector<Value> first;
  bool are_equal = true;
  sweep.store.read(measured, [&](std::span<const Value> values) {
    if (first.empty()) first.assign(values.begin(), values.end());
    are_equal = are_equal && std::ranges::equal(values, first, [&](const Value& a, const Value& b) {
                  return a == b || (is_nan(a) && is_nan(b));
                });
  });
  return are_equal;
}

Table best_rows(const SweepResults& sweep) {
  const std::vector<std::string> keys =
      mapped(listed_axes(sweep), [&](const std::size_t a) { return sweep.plan.axes[a].key; });
  return sweep.store.least(std::string(error_statistic), keys, max_best_rows);
}

// "; equal at shadow.technique pcss": other cells whose error is the same to the last digit.
std::string equal_text(const SweepResults& sweep, const std::vector<Value>& least, const Value& error) {
  constexpr std::size_t max_named = 3;
  const std::string cell = cell_text(sweep, least);
  std::set<std::string> equal;
  std::vector<std::string> columns = mapped(sweep.plan.axes, &SweepAxis::key);
  columns.emplace_back(error_statistic);
  sweep.store.read(columns, [&](std::span<const Value> row) {
    if (row.back() != error || equal.size() > max_named) return;
    if (std::string other = cell_text(sweep, {row.begin(), row.end()}); other != cell) equal.insert(std::move(other));
  });
  if (equal.size() > max_named) return "; equal in other cells of sweep.csv";
  return equal.empty() ? "" : "; equal at " + joined(equal, "; ");
}

std::vector<OpenEnd> open_ends(const SweepResults& sweep, const Table& best) {
  return find_open_ends(sweep, best, listed_axes(sweep));
}

Presentation present_sweep(const SweepResults& sweep, const Table& best, const std::optional<BiasCurves>& curves,
                           const std::vector<OpenEnd>& open_ends, bool is_flat) {
  Presentation presentation;
  const std::size_t axes = sweep.plan.axes.size();
  ReportSection& section = presentation.section;
  section.title = fmt::format("Error of {} in all cells", quantity_title(sweep.quantity()));
  section.tables_first = true;
  const std::vector<Value> least = least_row(sweep);
  const std::size_t mae = column_index(best, error_statistic);
  const std::string error = error_text(best, least);
  if (!std::isfinite(to_number(least[mae]))) {
    presentation.answers.emplace_back("nothing to measure: no cell of the sweep has counted pixels");
    section.text = "Nothing to measure: no cell of the sweep has counted pixels.";
    return presentation;
  }
  const bool is_ao = sweep.quantity() == SweptQuantity::ao;
  if (is_flat) presentation.answers.push_back(equal_cells_text(sweep, error));
  const char* headline = open_ends.empty() ? "least mean absolute error" : "least mean absolute error tested";
  section.headlines = {{headline, error, cell_text(sweep, least)},
                       {"cells", std::to_string(sweep.plan.cells), "one row each in sweep.csv"}};
  std::vector<std::string> warnings = to_lines(open_ends);
  if (varies_reference(sweep.plan.axes)) warnings.emplace_back(references_warning);
  if (sweep.quantity() == SweptQuantity::visibility && needs_biases(sweep.plan.axes))
    warnings.emplace_back(one_bias_warning);
  const Layout layout = lay_out(sweep.parameters, sweep.plan.axes);
  const std::vector<std::size_t> listed = listed_axes(sweep);
  std::string left_out;
  if (curves && curves->varies_constant) {
    add_bias_figures(presentation, sweep, *curves, max_plots);
  } else {
    left_out = add_plots(presentation, sweep, layout, drawn_statistics(sweep));
  }
  left_out += add_plots(presentation, sweep, layout, drawn_metrics(sweep));
  if (is_flat) section.text = "All cells are equal: what is varied changes nothing here. ";
  if (!sweep.ao_limit.empty())
    section.text += "The reference looks for occluders " + sweep.ao_limit + " in every cell.";
  const bool ranks_filters = compares_filters(sweep);
  if (ranks_filters) section.text += "\n\n" + std::string(filter_caution);
  if (is_flat) {
    section.headlines.front() = {"error of every cell", error, "all cells are equal"};
    return presentation;
  }
  for (const std::string& warning : warnings) section.text += "\n\nWarning: " + warning + ".";
  if (!curves) {
    std::size_t lines = 1;
    for (const std::size_t a : listed) lines *= count_values(sweep.plan, a);
    const std::string keys = joined(listed, " and ", [&](std::size_t a) { return sweep.plan.axes[a].key; });
    section.text +=
        fmt::format("\n\nThe table lists the cell of least error{}.",
                    keys.empty() ? ""
                    : best.rows.size() < lines
                        ? fmt::format(" of {} combinations of {}", best.rows.size(), keys)
                        : fmt::format(" of each {} of {}", listed.size() > 1 ? "combination" : "value", keys));
    section.tables.push_back(
        {"Cells of least error", in_percent(best_as_read(sweep, best), axes, kind_of(sweep.quantity()))});
  }
  if (!left_out.empty()) section.text += "\n\nsweep.csv has all cells." + left_out;
  if (curves) {
    present_bias(presentation, *curves);
  } else {
    presentation.answers.push_back(
        fmt::format("least error {} at {}{}{}", error, cell_text(sweep, least), equal_text(sweep, least, least[mae]),
                    sweep.ao_limit.empty() ? "" : " (reference rays " + sweep.ao_limit + ")"));
    if (is_ao) {
      const auto estimate_at = [&](std::size_t c) {
        return Estimate{to_number(least[c]), to_number(least[c + 1]), to_number(least[c + 2])};
      };
      add_without_ao(presentation, estimate_at(mae), estimate_at(column_index(best, "mean_truth")),
                     to_number(least[column_index(best, "mean_raster")]), "in the cell of least error, ");
    }
  }
  if (ranks_filters)
    presentation.answers.push_back(
        "warning: " + filter_warning(has_edges(sweep)
                                         ? fmt::format("the column {} of sweep.csv does", edge_roughness_metric.name)
                                         : filter_remedy("--run.metrics")));
  for (const std::string& warning : warnings) presentation.answers.push_back("warning: " + warning);
  if (curves) return presentation;
  std::vector<std::size_t> others;
  for (std::size_t a = 0; a < axes; ++a) {
    if (std::ranges::find(listed, a) == listed.end()) others.push_back(a);
  }
  std::vector<std::pair<double, std::string>> lines;
  for (const std::vector<Value>& row : best.rows) {
    if (std::equal(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(axes), least.begin())) continue;
    const double number = to_number(row[mae]);
    const std::vector<std::size_t> group = read_axes(sweep, row, listed);
    const std::string where = row_text(sweep, row, read_axes(sweep, row, others));
    std::string line = fmt::format("  {}: least error {}{}", row_text(sweep, row, group.empty() ? listed : group),
                                   error_text(best, row), where.empty() ? "" : " at " + where);
    // Cells that differ in what they do not read are the same.
    if (std::ranges::find(lines, line, &std::pair<double, std::string>::second) != lines.end()) continue;
    lines.emplace_back(std::isnan(number) ? std::numeric_limits<double>::infinity() : number, std::move(line));
  }
  const bool are_too_many = lines.size() > max_lines;
  if (are_too_many) std::ranges::stable_sort(lines, {}, &std::pair<double, std::string>::first);
  for (std::size_t i = 0; i < std::min(lines.size(), max_lines); ++i) presentation.lines.push_back(lines[i].second);
  if (are_too_many) {
    presentation.lines.push_back(fmt::format("  {} more have a larger error: table 'Cells of least error' of the page",
                                             lines.size() - max_lines));
  }
  return presentation;
}

}  // namespace umbrameter
