#include "present/run_output.h"

#include <fmt/format.h>

#include <cstdio>
#include <future>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/standard_streams.h"
#include "present/costs_text.h"
#include "present/error_backdrop.h"
#include "present/page_viewer.h"
#include "reports/figures/error_image.h"
#include "reports/files/data.h"
#include "reports/files/markup.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "results/layers.h"

namespace umbrameter {
namespace {

constexpr const char* ao_stages_file = "ao_stages.csv";

Report make_report(const RunOutput& output) {
  Report report;
  report.title = output.title;
  report.subtitle = output.subtitle;
  report.command = fmt::format("umbrameter {} -c experiment.toml -o OUT", output.summary.command);
  report.notes = output.summary.notes;
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
  diagnostic(console, costs_text(output.costs, output.peak_resident_bytes));
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

// Fills in summary.layers.
LayeredImage run_layers(SummaryInput& summary) {
  LayeredImage image = layers_of(summary.scene, *summary.measurement);
  image.attributes["scene"] = scene_title(summary.experiment);
  image.attributes["version"] = UMBRAMETER_VERSION;
  summary.layers = named_layers(image);
  image.attributes["layers"] = to_json(summary.layers).dump();
  return image;
}

// The error of AO by stage; null if the run did not measure it.
const AoStages* ao_stages_of(const RunOutput& output) {
  const Measurement* measurement = output.summary.measurement;
  return measurement != nullptr && measurement->ao && measurement->ao->stages ? &*measurement->ao->stages : nullptr;
}

void write_rows(const std::filesystem::path& path, const ResultsStore& results) {
  std::vector<Column> columns;
  for (const StoredColumn& stored : results.description().columns) columns.push_back(stored.column);
  write_csv(path, columns, [&](const StoredRowSink& sink) { results.read({}, sink); });
}

ViewerPack pack_images(const RunOutput& output, const LayeredImage& image) {
  ViewerPack pack;
  ViewerData data = viewer_data(output.summary.scene, *output.summary.measurement, image, output.with_full_images);
  if (output.cell) {
    data.cell = *output.cell;
    pack.title = "Images of cells";
  }
  add_set(pack, data);
  if (output.add_cells) output.add_cells(pack);
  return pack;
}

}  // namespace

std::string subtitle_of(const SceneFacts& scene, const View& view) {
  return fmt::format("{}×{} pixels, camera {}, {} triangles", view.width, view.height,
                     view.camera.name.empty() ? "without a name" : view.camera.name, grouped(scene.triangles));
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
  for (const auto& [name, file] : output.images) further.push_back(name);
  for (const auto& [name, file] : output.texts) further.push_back(name);
  const AoStages* ao_stages = ao_stages_of(output);
  if (ao_stages != nullptr) further.emplace_back(ao_stages_file);
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
  for (const auto& [name, file] : output.images) {
    write_exr(folder / name, file);
    summary.files.push_back(name);
  }
  for (const auto& [name, text] : output.texts) {
    write_text(folder / name, text);
    summary.files.push_back(name);
  }
  if (output.with_figures) write_figures_of(folder, console, image, output);
  if (layers.valid()) layers.get();
  summary.files.push_back("summary.json");
  summary.files.push_back("index.html");
  const std::string json = to_summary_json(summary);
  write_text(folder / "summary.json", json);
  ViewerPack viewer;
  if (output.with_figures && summary.measurement != nullptr) viewer = pack_images(output, image);
  write_page(folder, make_report(output), &viewer);
  add_line(console, fmt::format("report: {}", (folder / "index.html").string()));
  if (console.json) write_to(stdout, json);
  run_folder.finish(summary.problems.empty());
  for (const std::string& problem : summary.problems) write_to(stderr, "umbrameter: " + plain_text(problem) + "\n");
  return summary.problems.empty() ? ExitCode::ok : ExitCode::partial;
}

}  // namespace umbrameter
