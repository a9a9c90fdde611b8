#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/commands.h"
#include "app/run_output.h"
#include "compare/sweep.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "reports/output.h"
#include "scenes/builtin.h"
#include "scenes/emitter.h"

namespace umbrameter {
namespace {

// Soft: some cell's light has extent, and all cells are told in its columns.
enum class Measure { visibility, soft_visibility, ao };

// Cells that differ only in these share a shadow map and a truth.
constexpr std::array<std::string_view, 4> inner_keys = {"shadow.constant-bias", "shadow.slope-bias", "shadow.filter",
                                                        "shadow.filter-size"};
constexpr std::size_t most_plots = 12;

bool varies_group(const std::vector<SweepAxis>& axes, std::string_view group) {
  return std::any_of(axes.begin(), axes.end(), [&](const SweepAxis& axis) { return axis.key.rfind(group, 0) == 0; });
}

Measure choose_measure(const std::string& given, const std::vector<SweepAxis>& axes) {
  if (given == "visibility") return Measure::visibility;
  if (given == "ao") return Measure::ao;
  if (!given.empty()) {
    throw Error(ExitCode::usage, "--measure", "'" + given + "' is not allowed", "expected visibility or ao");
  }
  const bool ao = varies_group(axes, "ao.") || varies_group(axes, "truth.");
  if (ao && (varies_group(axes, "shadow.") || varies_group(axes, "light."))) {
    throw Error(ExitCode::usage, "sweep", "the axes belong to shadows and to ambient occlusion",
                "say which to measure: --measure visibility or --measure ao");
  }
  return ao ? Measure::ao : Measure::visibility;
}

std::vector<SweepAxis> make_axes(const CommandLine& line, Experiment& experiment) {
  const Parameters parameters = describe(experiment);
  std::vector<SweepAxis> axes;
  if (line.vary.empty()) {
    for (const auto& [key, text] : experiment.axes) axes.push_back(parse_axis(parameters, key, text));
  } else {
    for (const std::string& assignment : line.vary) axes.push_back(parse_axis(parameters, assignment));
  }
  if (axes.empty()) {
    throw Error(ExitCode::usage, "sweep", "nothing to vary",
                "add an axis, such as --vary shadow.constant-bias=0:0.2:65");
  }
  if (varies_group(axes, "view.scene")) {
    throw Error(ExitCode::usage, "--vary view.scene", "a sweep is about one scene",
                "run it once for each, with --scene");
  }
  experiment.axes.clear();
  for (const SweepAxis& axis : axes) experiment.axes.emplace_back(axis.key, axis.text);
  return axes;
}

Experiment at_cell(Experiment experiment, const std::vector<SweepAxis>& axes, const std::vector<Value>& values) {
  const Parameters parameters = describe(experiment);
  for (std::size_t a = 0; a < axes.size(); ++a) require(parameters, axes[a].key).set(values[a]);
  return experiment;
}

std::vector<Value> measure_cell(Workbench& workbench, const Experiment& experiment, Measure measure) {
  if (measure == Measure::ao) return to_row(*measure_ao(workbench, experiment, {}).statistics);
  const std::uint32_t light = workbench.lights(experiment.view.light).front();
  if (measure == Measure::soft_visibility) {
    workbench.require_sense_for(experiment, {light});
    const TracedVisibility& truth = workbench.truth(experiment, light);
    const RasterVisibility raster = workbench.draw(experiment, light, false);
    return to_row(analyze_soft_visibility(raster.visibility, sampled(truth), workbench.fit(experiment, light).counted));
  }
  const LightFit& fit = workbench.fit(experiment, light);
  const Image<float>& truth = workbench.truth(experiment, light).visibility;
  const RasterVisibility raster = workbench.draw(experiment, light, true);
  return to_row(analyze_visibility(raster.wrong, truth, fit.counted));
}

std::vector<Column> columns_of(Measure measure) {
  if (measure == Measure::ao) return ao_columns();
  return measure == Measure::soft_visibility ? soft_visibility_columns() : visibility_columns();
}

bool has_soft_cells(const Workbench& workbench, const Experiment& experiment, const std::vector<SweepAxis>& axes) {
  if (varies_group(axes, "light.")) return true;
  std::vector<std::string> names = {experiment.view.light};
  for (const SweepAxis& axis : axes) {
    if (axis.key != "view.light") continue;
    names.clear();
    for (const Value& value : axis.values) names.push_back(to_string(value));
  }
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return is_area(workbench.light(experiment, workbench.lights(name).front()));
  });
}

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
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
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

// "shadow.constant-bias" in metres is "constant bias [m]".
std::string label_of(const Parameters& parameters, const std::string& key) {
  const std::string& unit = require(parameters, key).description.unit;
  std::string label = key.substr(key.find('.') + 1);
  std::replace(label.begin(), label.end(), '-', ' ');
  return label + (unit.empty() ? "" : " [" + unit + "]");
}

// The rows of each combination of the remaining axes, under its text ("shadow.filter = box").
std::map<std::string, std::vector<std::size_t>> rows_by_rest(const Table& table, const Layout& layout) {
  std::map<std::string, std::vector<std::size_t>> groups;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::string text;
    for (const std::size_t a : layout.rest) {
      text += (text.empty() ? "" : ", ") + table.columns[a].name + " = " + to_string(table.rows[r][a]);
    }
    groups[text].push_back(r);
  }
  return groups;
}

// For each line of the plots, its row of least error.
std::vector<std::size_t> best_rows(const Table& table, const Layout& layout) {
  std::map<std::vector<Value>, std::size_t> best;
  const std::size_t mae = column_index(table, "mae");
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    std::vector<Value> key;
    if (layout.series) key.push_back(table.rows[r][*layout.series]);
    for (const std::size_t a : layout.rest) key.push_back(table.rows[r][a]);
    const auto [entry, is_new] = best.try_emplace(key, r);
    if (!is_new && to_number(table.rows[r][mae]) < to_number(table.rows[entry->second][mae])) entry->second = r;
  }
  std::vector<std::size_t> rows;
  for (const auto& [key, row] : best) rows.push_back(row);
  return rows;
}

struct Curve {
  const char* column;
  const char* title;
  const char* label;
  bool has_interval;
  bool logarithmic;
};
constexpr Curve visibility_curves[] = {
    {"mae", "Mean absolute error of visibility", "mean absolute error [% of counted pixels]", false, true},
    {"acne", "Acne", "acne [% of counted pixels]", false, false},
    {"peter_panning", "Peter-panning", "peter-panning [% of counted pixels]", false, false},
    {"false_occlusion", "False occlusion", "false occlusion [% of counted pixels]", false, false},
    {"leak", "Light leak", "light leak [% of counted pixels]", false, false}};
constexpr Curve soft_visibility_curves[] = {
    {"mae", "Mean absolute error of visibility", "mean absolute error [%], 95 % interval", true, false},
    {"false_blocked", "Too dark", "too dark [% of counted pixels], 95 % interval", true, false},
    {"false_lit", "Too bright", "too bright [% of counted pixels], 95 % interval", true, false}};
constexpr Curve ao_curves[] = {
    {"mae", "Mean absolute error of accessibility", "mean absolute error [%], 95 % interval", true, false},
    {"rmse", "RMS error of accessibility", "RMS error [%], 95 % interval", true, false},
    {"mean_error", "Mean error of accessibility", "raster − truth [%], 95 % interval", true, false}};

std::span<const Curve> curves_of(Measure measure) {
  if (measure == Measure::ao) return ao_curves;
  if (measure == Measure::soft_visibility) return soft_visibility_curves;
  return visibility_curves;
}

// The columns that a plot reads, shares as per cent.
Table plot_data(const Table& table, const std::vector<std::size_t>& rows, const std::vector<std::string>& names,
                std::size_t axes) {
  Table data;
  for (const std::string& name : names) data.columns.push_back(table.columns[column_index(table, name)]);
  for (const std::size_t r : rows) {
    std::vector<Value> row;
    for (const std::string& name : names) {
      const std::size_t c = column_index(table, name);
      row.push_back(c < axes ? table.rows[r][c] : Value(100.0 * to_number(table.rows[r][c])));
    }
    data.rows.push_back(std::move(row));
  }
  return data;
}

bool is_geometric(const SweepAxis& axis) { return axis.text.size() > 4 && axis.text.ends_with(":log"); }

std::vector<PlotFigure> make_plots(const Parameters& parameters, const std::vector<SweepAxis>& axes,
                                   const Layout& layout, const Table& table, Measure measure) {
  std::vector<PlotFigure> plots;
  const std::span<const Curve> curves = curves_of(measure);
  std::size_t part = 0;
  for (const auto& [text, rows] : rows_by_rest(table, layout)) {
    for (const Curve& curve : curves) {
      if (plots.size() >= most_plots) return plots;
      const std::string& x = axes[layout.x].key;
      PlotFigure plot;
      plot.stem = std::string(curve.column) + (layout.rest.empty() ? "" : fmt::format("_{}", part));
      plot.title = curve.title;
      plot.caption = text.empty() ? "" : "At " + text + ".";
      plot.x = {x, label_of(parameters, x), is_geometric(axes[layout.x])};
      plot.y = {curve.column, curve.label, curve.logarithmic};
      std::vector<std::string> names = {x, curve.column};
      if (layout.series) {
        plot.series = axes[*layout.series].key;
        plot.series_label = label_of(parameters, *plot.series);
        names.push_back(*plot.series);
      }
      if (curve.has_interval) {
        plot.lower = std::string(curve.column) + "_lo";
        plot.upper = std::string(curve.column) + "_hi";
        names.push_back(*plot.lower);
        names.push_back(*plot.upper);
      }
      plot.data = plot_data(table, rows, names, axes.size());
      plots.push_back(std::move(plot));
    }
    ++part;
  }
  return plots;
}

std::string row_text(const Table& table, std::size_t row, std::size_t axes) {
  std::string text;
  for (std::size_t a = 0; a < axes; ++a) {
    text += (a > 0 ? ", " : "") + table.columns[a].name + " " + to_string(table.rows[row][a]);
    if (!table.columns[a].unit.empty()) text += " " + table.columns[a].unit;
  }
  return text;
}

Presentation present_sweep(const Parameters& parameters, const std::vector<SweepAxis>& axes, const Table& table,
                           Measure measure, const std::vector<std::size_t>& best) {
  Presentation presentation;
  const Layout layout = lay_out(parameters, axes);
  ReportSection& section = presentation.section;
  section.title = measure == Measure::ao ? "Ambient occlusion over the grid" : "Shadow error over the grid";
  const std::size_t least = least_row(table, "mae");
  const double mae = to_number(table.rows[least][column_index(table, "mae")]);
  section.headlines = {{"least mean absolute error", percent(mae), row_text(table, least, axes.size())},
                       {"cells", std::to_string(table.rows.size()), "each measured on its own"}};
  for (PlotFigure& plot : make_plots(parameters, axes, layout, table, measure)) {
    add_figure(presentation, std::move(plot));
  }
  section.text = "The table holds the cell of least error for every line of the figures; all cells are in sweep.csv.";
  Table rows{table.columns, {}};
  for (const std::size_t row : best) rows.rows.push_back(table.rows[row]);
  section.tables = {std::move(rows)};
  presentation.lines.push_back(fmt::format("{} cells; least mean absolute error {} at {}", table.rows.size(),
                                           percent(mae), row_text(table, least, axes.size())));
  for (const std::size_t row : best) {
    if (row == least || presentation.lines.size() > 8) continue;
    presentation.lines.push_back(fmt::format("  {} at {}",
                                             percent(to_number(table.rows[row][column_index(table, "mae")])),
                                             row_text(table, row, axes.size())));
  }
  return presentation;
}

}  // namespace

ExitCode run_sweep_command(const CommandLine& line, const Console& console) {
  Experiment experiment = make_experiment(line);
  const std::vector<SweepAxis> axes = make_axes(line, experiment);
  Measure measure = choose_measure(line.measure, axes);
  const std::size_t cells = count_cells(axes);
  prepare_output_folder(line.output);
  const ThreadLimit threads(line.threads);
  Workbench workbench(load_scene(experiment.scene, experiment.view.scene),
                      {line.gl_device, line.threads, chosen_cache(line, console)}, console);
  const std::vector<std::uint32_t> lights = workbench.lights(experiment.view.light);
  const bool varies_light = varies_group(axes, "view.light");
  if (measure == Measure::visibility && !varies_light && lights.size() > 1) {
    // A sweep is about one light; which one is part of the stored experiment.
    experiment.view.light = std::to_string(lights.front());
    note(console, fmt::format("the scene has {} lights; sweeping light '{}'; choose with --light", lights.size(),
                              workbench.title(lights.front())));
  }

  if (measure == Measure::visibility && has_soft_cells(workbench, experiment, axes)) measure = Measure::soft_visibility;

  const Parameters parameters = describe(experiment);
  Table table;
  {
    ProgressBar bar(console, fmt::format("{} cells", cells));
    table = run_sweep(
        parameters, axes, inner_keys, columns_of(measure),
        [&](std::span<const SweepCell> group) {
          std::vector<std::vector<Value>> rows;
          for (const SweepCell& cell : group) {
            throw_if_interrupted();
            rows.push_back(measure_cell(workbench, at_cell(experiment, axes, cell.values), measure));
          }
          return rows;
        },
        bar.callback());
  }

  const std::size_t least = least_row(table, "mae");
  const Experiment best =
      at_cell(experiment, axes,
              {table.rows[least].begin(), table.rows[least].begin() + static_cast<std::ptrdiff_t>(axes.size())});
  Measurement measurement;
  measurement.surfels = workbench.surfels(best.view);
  RunOutput output;
  output.title = fmt::format("{}: sweep", scene_title(experiment));
  output.subtitle = subtitle_of(workbench, measurement.surfels.view);
  const std::vector<std::size_t> rows = best_rows(table, lay_out(parameters, axes));
  output.parts.push_back(present_sweep(parameters, axes, table, measure, rows));
  if (measure == Measure::ao) {
    measurement.ao = measure_ao(workbench, best, {});
    output.parts.push_back(present_ao(*measurement.ao, best));
  } else {
    measurement.shadows.push_back(measure_shadow(workbench, best, workbench.lights(best.view.light).front(), {}));
    output.parts.push_back(present_shadow(workbench, measurement.shadows.front(), best));
  }
  output.parts.back().section.title += ", at the cell of least error";
  output.parts.push_back(present_picture(workbench, measurement));
  output.summary = {
      line.command, experiment, &workbench, &measurement, &table, rows, workbench.context().device().renderer, {}, {}};
  return write_run(line, console, std::move(output));
}

}  // namespace umbrameter
