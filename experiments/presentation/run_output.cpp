#include "experiments/presentation/run_output.h"

#include <fmt/format.h>

#include <cstdio>
#include <future>
#include <iterator>
#include <optional>
#include <utility>

#include "core/standard_streams.h"
#include "experiments/layers.h"
#include "experiments/presentation/ao_input_files.h"
#include "experiments/presentation/error_backdrop.h"
#include "experiments/presentation/map_files.h"
#include "experiments/presentation/page_viewer.h"
#include "reports/figures/error_image.h"
#include "reports/files/data.h"
#include "reports/files/markup.h"
#include "reports/files/output.h"

namespace umbrameter {
namespace {

constexpr const char* ao_stages_file = "ao_stages.csv";

Report make_report(const RunOutput& output) {
  Report report;
  report.title = output.title;
  report.subtitle = output.subtitle;
  report.command = fmt::format("umbrameter {} -c experiment.toml -o OUT", output.summary.command);
  report.notes = output.summary.stages->notes();
  for (const std::string& problem : output.summary.problems) report.notes.push_back(problem);
  if (!output.with_figures) {
    report.notes.emplace_back("This page has no pictures: the run used --no-figures. Rerun without it to draw them.");
  }
  ReportSection diagnostics;
  diagnostics.title = "Diagnostics";
  for (const Presentation& part : output.parts) {
    report.sections.push_back(part.section);
    report.answers.insert(report.answers.end(), part.answers.begin(), part.answers.end());
    for (const std::string& text : part.details) {
      diagnostics.text += (diagnostics.text.empty() ? "" : "\n\n") + text;
    }
  }
  if (!diagnostics.text.empty()) report.sections.push_back(std::move(diagnostics));
  Experiment experiment = output.summary.experiment;
  if (!output.summary.sweep) experiment.axes.clear();  // an experiment file may have some that this run does not use
  report.settings = settings_table(std::move(experiment));
  report.cells = output.rows;
  return report;
}

std::vector<std::string> figure_files(const std::vector<Presentation>& parts) {
  std::vector<std::string> files;
  for (const Presentation& part : parts) {
    for (const std::string& stem : part.section.figures) {
      for (const char* format : {".svg", ".pdf", ".png"}) files.push_back("figures/" + stem + format);
    }
  }
  return files;
}

// The page and the list of files then know of no figure, too.
void leave_out_figures(RunOutput& output) {
  for (Presentation& part : output.parts) {
    part.images.clear();
    part.plots.clear();
    part.heat_maps.clear();
    part.waterfalls.clear();
    part.section.figures.clear();
    part.section.figure_titles.clear();
    part.section.captions.clear();
  }
}

void print_answer(const Console& console, const RunOutput& output) {
  for (const Presentation& part : output.parts) {
    for (const std::string& text : part.answers) print_line(console, text);
  }
  for (const Presentation& part : output.parts) {
    for (const std::string& text : part.lines) add_line(console, text);
  }
  for (const Presentation& part : output.parts) {
    for (const std::string& text : part.details) diagnostic(console, text);
  }
  diagnostic(console, costs_text(output.summary.stages->costs()));
  std::fflush(stdout);  // a pipe or a file gets it now, too
}

// Captions of images as completed by complete_error_images().
void set_captions(ReportSection& section, const std::vector<ImageFigure>& images) {
  for (std::size_t i = 0; i < section.figures.size(); ++i) {
    for (const ImageFigure& image : images) {
      if (image.stem == section.figures[i]) section.captions[i] = image.caption;
    }
  }
}

void write_figures_of(const std::filesystem::path& folder, const Console& console, const LayeredImage& layers,
                      RunOutput& output) {
  Figures figures;
  for (Presentation& part : output.parts) {
    std::move(part.images.begin(), part.images.end(), std::back_inserter(figures.images));
    std::move(part.plots.begin(), part.plots.end(), std::back_inserter(figures.plots));
    std::move(part.heat_maps.begin(), part.heat_maps.end(), std::back_inserter(figures.heat_maps));
    std::move(part.waterfalls.begin(), part.waterfalls.end(), std::back_inserter(figures.waterfalls));
  }
  if (const Measurement* measurement = output.summary.measurement) {
    const View& view = measurement->surfels.view;
    output.figure_style.view = {view.width, view.height};
  }
  ErrorImages errors = error_images_of(figures.images, layers);
  complete_error_images(figures.images, errors, output.figure_style);
  for (Presentation& part : output.parts) set_captions(part.section, figures.images);
  ProgressBar bar(console, "figures");
  output.summary.problems =
      write_figures(folder / "figures", figures, errors, output.figure_style, [&](std::size_t done, std::size_t all) {
        bar.show(static_cast<double>(done) / static_cast<double>(all), fmt::format("{} of {}", done, all));
      }).problems;
}

LayeredImage run_layers(const SummaryInput& summary) {
  LayeredImage image = layers_of(*summary.stages, *summary.measurement);
  image.attributes["scene"] = scene_title(summary.experiment);
  image.attributes["version"] = UMBRAMETER_VERSION;
  return image;
}

// The error of AO by stage; null if the run did not measure it.
const AoStages* ao_stages_of(const RunOutput& output) {
  const Measurement* measurement = output.summary.measurement;
  return measurement != nullptr && measurement->ao && measurement->ao->stages ? &*measurement->ao->stages : nullptr;
}

std::vector<std::string> map_files(const RunOutput& output) {
  std::vector<std::string> files;
  for (const std::uint32_t light : output.maps) files.push_back(map_file_name(*output.summary.stages, light));
  return files;
}

void write_ao_inputs(const std::filesystem::path& folder, SummaryInput& summary) {
  const Experiment& experiment = summary.measurement->experiment;
  write_exr(folder / ao_input_image_file, ao_input_layers(*summary.stages, experiment));
  write_text(folder / ao_input_values_file, ao_input_values(*summary.stages, experiment));
  summary.files.insert(summary.files.end(), {ao_input_image_file, ao_input_values_file});
}

void write_rows(const std::filesystem::path& path, const ResultsStore& results) {
  std::vector<Column> columns;
  for (const StoredColumn& stored : results.description().columns) columns.push_back(stored.column);
  write_csv(path, columns, [&](const StoredRowSink& sink) { results.read({}, sink); });
}

// The page's images: those of the measurement and, in a sweep, of further cells, which are measured now.
ViewerPack pack_images(const RunOutput& output, const LayeredImage& image, const Console& console) {
  Stages& stages = *output.summary.stages;
  ViewerPack pack;
  ViewerData data = viewer_data(stages, *output.summary.measurement, image, output.with_full_images);
  const std::vector<PageCell>& cells = output.cells.cells;
  if (!cells.empty()) {
    data.cell = cells.front().cell;
    pack.title = "Images of cells";
  }
  add_set(pack, data);
  ProgressBar bar(console, "images of cells");
  for (std::size_t i = 1; i < cells.size(); ++i) {
    bar.show(static_cast<double>(i) / static_cast<double>(cells.size()), fmt::format("{} of {}", i, cells.size()));
    data = further_viewer_data(stages, output.cells.measure(cells[i]), output.with_full_images);
    data.cell = cells[i].cell;
    add_set(pack, data);
  }
  return pack;
}

}  // namespace

std::string subtitle_of(const Stages& stages, const View& view) {
  return fmt::format("{}×{} pixels, camera {}, {} triangles", view.width, view.height,
                     view.camera.name.empty() ? "without a name" : view.camera.name, count(stages.scene()).triangles);
}

std::string experiment_text(Experiment experiment) {
  return to_toml(experiment.scene, describe(experiment), experiment.axes);
}

std::vector<std::string> run_files(bool with_rows) {
  std::vector<std::string> files = {"experiment.toml", "images.exr", "summary.json", "index.html"};
  if (with_rows) files.push_back("sweep.csv");
  return files;
}

ExitCode write_run(RunFolder& run_folder, const Console& console, RunOutput output) {
  if (!output.with_figures) leave_out_figures(output);
  const std::filesystem::path& folder = run_folder.path();
  std::vector<std::string> further = figure_files(output.parts);
  const std::vector<std::string> maps = map_files(output);
  further.insert(further.end(), maps.begin(), maps.end());
  const AoStages* ao_stages = ao_stages_of(output);
  if (ao_stages != nullptr) further.emplace_back(ao_stages_file);
  if (output.with_ao_inputs) further.insert(further.end(), {ao_input_image_file, ao_input_values_file});
  run_folder.require_free(further);
  run_folder.begin();
  run_folder.announce(further);
  print_answer(console, output);
  SummaryInput& summary = output.summary;
  const Experiment& experiment = summary.experiment;
  write_text(folder / "experiment.toml", experiment_text(experiment));
  summary.files.push_back("experiment.toml");
  // Compresses on one thread, while others draw figures.
  LayeredImage image;
  std::future<void> layers;
  if (summary.measurement != nullptr) {
    image = run_layers(summary);
    layers = std::async(std::launch::async, [&] { write_exr(folder / "images.exr", image); });
    summary.files.push_back("images.exr");
  }
  if (ao_stages != nullptr) {
    write_text(folder / ao_stages_file, to_csv(ao_stage_table(ao_stages->statistics, ao_stages->bins)));
    summary.files.emplace_back(ao_stages_file);
  }
  if (output.results != nullptr) {
    write_rows(folder / "sweep.csv", *output.results);
    summary.files.push_back("results.sqlite");
    summary.files.push_back("sweep.csv");
  }
  for (std::size_t i = 0; i < maps.size(); ++i) {
    write_exr(folder / maps[i], map_layers(*summary.stages, summary.measurement->experiment, output.maps[i]));
    summary.files.push_back(maps[i]);
  }
  if (output.with_ao_inputs) write_ao_inputs(folder, summary);
  if (output.with_figures) write_figures_of(folder, console, image, output);
  if (layers.valid()) layers.get();
  summary.files.push_back("summary.json");
  summary.files.push_back("index.html");
  const std::string json = to_summary_json(summary);
  write_text(folder / "summary.json", json);
  ViewerPack viewer;
  if (output.with_figures && summary.measurement != nullptr) viewer = pack_images(output, image, console);
  write_page(folder, make_report(output), &viewer);
  add_line(console, fmt::format("report: {}", (folder / "index.html").string()));
  if (console.json) write_to(stdout, json);
  run_folder.finish(summary.problems.empty());
  for (const std::string& problem : summary.problems) write_to(stderr, "umbrameter: " + plain_text(problem) + "\n");
  return summary.problems.empty() ? ExitCode::ok : ExitCode::partial;
}

}  // namespace umbrameter
