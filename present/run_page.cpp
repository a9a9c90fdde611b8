#include "present/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/lists.h"
#include "present/bias_advice_report.h"
#include "present/plot_axes.h"
#include "present/presentation_parts.h"
#include "present/sweep_report.h"
#include "present/tune_report.h"
#include "reports/figures/error_image.h"
#include "reports/files/text_layout.h"
#include "results/known_statistics.h"
#include "store/read_bias_curves.h"
#include "store/run_value.h"

namespace umbrameter {
namespace {

constexpr std::size_t max_table_cells = 20'000;

struct ConvertedBiasText {
  std::string what;
  std::string bias;
};

// A sweep over biases converts the one that it recommends itself, any other sweep the one that compare recommends.
ConvertedBiasText converted_bias(const RunResults& results, const SweepResults& rows, const BiasAdvice& advice) {
  const std::optional<BiasCurves>& curves = results.sweep->curves;
  const BiasCurve* curve = curves ? curve_of_cell(*curves, rows.plan, least_row(rows)) : nullptr;
  if (curve == nullptr || !curve->plateau) {
    return {"cell of least error, with the bias that compare recommends there", named_bias_text(advice)};
  }
  const std::string setting = setting_text(curves->others, curve->others);
  return {"the bias to use" + (setting.empty() ? "" : " at " + setting),
          bias_text(*curves, *curve, curve->plateau->recommended)};
}

// The cell of least error, or the first of cells that are all equal.
Presentation present_cell(const RunResults& results, const SweepResults& rows, const std::string& cell, bool is_flat) {
  const Measurement& measurement = *results.measurement;
  const LayeredImage& layers = measurement.layers;
  Presentation part;
  std::vector<EngineAdvice> engines;
  ConvertedBiasText converted;
  bool has_advice = false;
  if (measurement.ao) {
    part = present_ao(layers, *measurement.ao);
  } else if (measurement.image) {
    part = present_image(results.scene, layers, *measurement.image);
  } else {
    // Without the advice that the page's bias slider needs: the sweep's own part has recommended a bias.
    ShadowMeasurement shadow = measurement.shadows.front();
    has_advice = shadow.advice.has_value();
    if (has_advice) {
      engines = std::exchange(shadow.advice->engines, {});
      converted = converted_bias(results, rows, *shadow.advice);
    }
    shadow.advice.reset();
    part = present_shadow(results.scene, layers, shadow);
  }
  // The sweep's own part has the answer: that of a bias names one for each combination of the other axes, any other the
  // cell itself.
  part.lines.clear();
  if (results.sweep->curves && !is_flat) part.lines.push_back("cell of least error: " + cell);
  for (const std::string& answer : std::exchange(part.answers, {})) part.lines.push_back("  " + answer);
  if (has_advice && !rows.is_by_cause() && rows.plan.constant_bias.values.size() > 1) {
    part.lines.emplace_back(
        "  no bias recommended: acne cannot be counted in every cell; sweep only pcf and lights without extent");
  }
  add_engines(part, engines, converted.what, converted.bias);
  part.section.title += is_flat ? " in one of the cells, which are all equal" : " in the cell of least error";
  part.section.text = fmt::format("This section shows the cell {}.\n\n", cell) + part.section.text;
  return part;
}

void present_rows(RunPage& page, const RunResults& results, const SweepResults& rows) {
  const SweepFindings& sweep = *results.sweep;
  const std::vector<Value> least = least_row(rows);
  page.sweep = SweepSummary{rows.plan.cells, {}, open_ends(rows, sweep.best)};
  for (std::size_t a = 0; a < rows.plan.axes.size(); ++a) {
    page.sweep->least.emplace_back(rows.plan.axes[a].key, least[a]);
  }
  const bool is_flat = are_all_equal(rows);
  page.parts.push_back(present_sweep(rows, sweep.best, sweep.curves, page.sweep->open_ends, is_flat));
  page.parts.push_back(present_cell(results, rows, cell_text(rows, least), is_flat));
  page.parts.push_back(present_picture(results.measurement->layers));
  page.viewer = sweep.images;
}

// "1280×720 pixels, camera overview, 95,204 triangles".
std::string subtitle_of(const SceneFacts& scene, const View& view) {
  return fmt::format("{}×{} pixels, camera {}, {} triangles", view.width, view.height,
                     view.camera.name.empty() ? "without a name" : view.camera.name, grouped(scene.triangles));
}

// "courtyard", "courtyard and room", "courtyard, room, sponza and 2 more".
std::string scenes_of(const TuneFindings& tune, const std::string& first) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names = {first};
  for (const std::string& title : tune.summary.cases) {
    const std::string name = title.substr(0, title.find(", camera "));
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  // Files of one name in different folders have one entry.
  names.resize(std::min({most, names.size(), tune.scenes}));
  const std::size_t more = tune.scenes - names.size();
  if (more > 0) return joined(names, ", ") + fmt::format(" and {} more", more);
  const std::string last = names.back();
  names.pop_back();
  return names.empty() ? last : joined(names, ", ") + " and " + last;
}

void add_head(Report& report, const RunResults& results) {
  const std::string scene = scene_title(results.experiment);
  if (results.tune) {
    const std::size_t cases = results.tune->summary.cases.size();
    report.title = scenes_of(*results.tune, scene) + ": tuning";
    report.subtitle = fmt::format("{}, {}×{} pixels", cases == 1 ? "1 case" : fmt::format("{} cases", cases),
                                  results.experiment.view.size.width, results.experiment.view.size.height);
    report.command_title = "Run compare with the values to use";
    report.command = fmt::format("umbrameter compare -c {} -o OUT", tuned_file);
    return;
  }
  const std::string what = results.sweep                   ? "sweep"
                           : results.command == "compare"  ? "technique against reference"
                           : results.command == "evaluate" ? "frame against reference"
                           : results.command == "trace"    ? "reference"
                                                           : "technique";
  report.title = scene + ": " + what;
  report.subtitle = subtitle_of(results.scene, results.measurement->surfels.view);
  report.command = fmt::format("umbrameter {} -c experiment.toml -o OUT", results.command);
}

std::string head_of(const std::string& name, std::string_view kind) {
  for (const auto& [end, words] : {std::pair{lower_name(""), ", lower end"}, {upper_name(""), ", upper end"}}) {
    if (name.ends_with(end)) return head_words(name.substr(0, name.size() - end.size()), kind) + words;
  }
  return head_words(name, kind);
}

// The rows of the sweep, at most max_table_cells at even steps and those of `shown`, and what repeats a cell with
// `compare`.
ReportCells report_cells(const SweepResults& sweep, const Experiment& experiment, const std::vector<PageCell>& shown) {
  ReportCells cells;
  cells.axes = sweep.plan.axes.size();
  cells.count = sweep.plan.cells;
  std::vector<std::size_t> numbers = thin(cells.count, max_table_cells).indices;
  if (numbers.size() < cells.count) {
    for (const PageCell& cell : shown) numbers.push_back(cell.cell.number);
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    cells.numbers = numbers;
  }
  std::vector<std::string> names;
  for (const StoredColumn& stored : sweep.store.description().columns) {
    cells.table.columns.push_back(stored.column);
    const bool is_axis = names.size() < cells.axes;
    cells.heads.push_back(is_axis ? stored.column.name : head_of(stored.column.name, kind_of(sweep.quantity())));
    names.push_back(stored.column.name);
  }
  cells.table.rows = sweep.store.rows(numbers, names).rows;
  cells.command = "umbrameter compare -c experiment.toml";
  cells.command_end = "-o CELL";
  if (sweep.quantity() == SweptQuantity::image && experiment.run.measure != SweepMeasure::image) {
    cells.command += " --run.measure image";
  }
  // A sweep keeps the reference's distance limit when the technique's radius varies; compare would follow the radius.
  const bool is_limit_fixed = !varies_group(sweep.plan.axes, "truth.ao-distance");
  if (varies_group(sweep.plan.axes, "ao.radius") && is_limit_fixed) {
    Experiment fixed = shown.front().experiment;
    const Parameters parameters = describe(fixed);
    cells.command += " --truth.ao-distance " + to_string(require(parameters, "truth.ao-distance").value());
  }
  for (const SweepAxis& axis : sweep.plan.axes) {
    const Parameter& parameter = require(sweep.parameters, axis.key);
    // As a command has it: "%", not "% of the scene's diagonal".
    cells.units.push_back(
        std::holds_alternative<Length*>(parameter.field) ? to_string(Length{1.0, axis.length_unit}).substr(1) : "");
  }
  return cells;
}

// A tuning measures each case with its own camera and light, whatever the experiment says.
void name_settings_of_cases(Table& settings) {
  for (std::vector<Value>& row : settings.rows) {
    if (row[0] == Value(std::string("view.camera")) || row[0] == Value(std::string("view.light")))
      row[1] = std::string("that of each case");
  }
}

}  // namespace

std::vector<Presentation> measured_parts(const SceneFacts& scene, const Measurement& measurement) {
  std::vector<Presentation> parts;
  const LayeredImage& layers = measurement.layers;
  if (!measurement.image) parts.push_back(present_picture(layers));
  for (const ShadowMeasurement& shadow : measurement.shadows) {
    parts.push_back(present_shadow(scene, layers, shadow));
    if (shadow.shape) present_shape(parts.back(), scene, shadow);
  }
  if (measurement.ao) parts.push_back(present_ao(layers, *measurement.ao));
  if (measurement.ao && measurement.ao->stages) parts.push_back(present_ao_stages(layers, *measurement.ao));
  if (measurement.image) parts.push_back(present_image(scene, layers, *measurement.image));
  if (!measurement.debug_views.empty()) parts.push_back(present_debug_views(measurement));
  return parts;
}

void leave_out_figures(RunPage& page) {
  page.viewer = {};
  for (Presentation& part : page.parts) {
    part.figures.clear();
    part.section.figures.clear();
  }
}

std::string stored_view(const std::filesystem::path& folder) {
  const std::optional<RunResults> results = read_run_value(folder, false);
  return results && results->measurement ? subtitle_of(results->scene, results->measurement->surfels.view) : "";
}

RunPage present_run(const RunResults& results, const SweepResults* rows, const PageOptions& options) {
  RunPage page;
  if (results.tune) {
    page.parts.push_back(present_tuning(results.tune->summary));
    for (const CaseEngines& each : results.tune->engines)
      add_engines(page.parts.back(), each.engines, each.title, each.bias);
    page.viewer = add_tune_images(page.parts.back(), results.scene, *results.tune);
  } else if (rows != nullptr) {
    present_rows(page, results, *rows);
  } else {
    page.parts = measured_parts(results.scene, *results.measurement);
  }
  say_engine_notes_once(page.parts);
  if (!options.with_figures) leave_out_figures(page);
  return page;
}

std::vector<std::string> figure_files(const std::vector<ReportSection>& sections) {
  std::vector<std::string> files;
  for (const ReportSection& section : sections) {
    for (const FigureHead& head : section.figures) {
      for (const char* format : {".svg", ".pdf", ".png"}) files.push_back("figures/" + head.stem + format);
    }
  }
  return files;
}

std::vector<std::string> figure_files(const RunPage& page) {
  std::vector<ReportSection> sections;
  for (const Presentation& part : page.parts) sections.push_back(part.section);
  return figure_files(sections);
}

std::vector<std::string> draw_figures(const std::filesystem::path& folder, const Console& console,
                                      const RunResults& results, RunPage& page, const PageOptions& options) {
  if (!options.with_figures) return {};
  std::vector<Figure> figures;
  for (Presentation& part : page.parts) std::ranges::move(part.figures, std::back_inserter(figures));
  FigureStyle style = options.style;
  ErrorImages errors;
  const Measurement* const shown = results.measurement ? &*results.measurement
                                   : results.tune && !results.tune->points.empty()
                                       ? &results.tune->points.front().measurement
                                       : nullptr;
  if (shown != nullptr) {
    const View& view = shown->surfels.view;
    style.view = {view.width, view.height};
    errors = error_images_of(figures, results);
    complete_error_images(figures, errors, style);
  }
  auto figure = figures.cbegin();
  for (Presentation& part : page.parts) {
    for (FigureHead& head : part.section.figures) {
      // complete_error_images() adds to captions of images; those of plots have their conditions already.
      if (std::holds_alternative<ImageFigure>(*figure)) head.caption = head_of(*figure).caption;
      ++figure;
    }
  }
  ProgressBar bar(console, "figures");
  return write_figures(folder / "figures", figures, style, errors, [&](std::size_t done, std::size_t all) {
    bar.show(static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {}", done, all));
  });
}

void write_run_page(const std::filesystem::path& folder, const RunResults& results, const SweepResults* rows,
                    const RunPage& page, const std::vector<std::string>& problems, const PageOptions& options) {
  Report report;
  add_head(report, results);
  report.notes = results.notes;
  report.notes.insert(report.notes.end(), problems.begin(), problems.end());
  if (!options.with_figures) {
    report.notes.emplace_back("This page has no pictures: the run used --no-figures. Rerun without it to draw them.");
  }
  ReportSection diagnostics;
  diagnostics.title = "Diagnostics";
  for (const Presentation& part : page.parts) {
    report.sections.push_back(part.section);
    report.answers.insert(report.answers.end(), part.answers.begin(), part.answers.end());
    for (const std::string& text : part.details) {
      diagnostics.text += (diagnostics.text.empty() ? "" : "\n\n") + text;
    }
  }
  if (!diagnostics.text.empty()) report.sections.push_back(std::move(diagnostics));
  Experiment experiment = results.experiment;
  // An experiment file may have axes that this run does not use.
  if (!results.sweep && !results.tune) experiment.axes.clear();
  report.settings = settings_table(std::move(experiment));
  if (results.tune) name_settings_of_cases(report.settings);
  if (rows != nullptr) report.cells = report_cells(*rows, results.experiment, results.sweep->cells);
  ViewerPack packed;
  const bool is_packed = !page.viewer.sets.empty();
  if (options.with_figures && !is_packed && results.measurement) {
    add_set(packed, viewer_data(results.scene, *results.measurement, results.full_images));
  }
  write_page(folder, report, is_packed ? &page.viewer : &packed);
}

}  // namespace umbrameter
