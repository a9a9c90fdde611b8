#include "present/run_output.h"

#include <fmt/format.h>

#include <cstdio>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "core/standard_streams.h"
#include "reports/files/data.h"
#include "reports/files/markup.h"
#include "reports/files/output.h"
#include "reports/files/text_layout.h"
#include "results/layers.h"
#include "results/number_text.h"
#include "store/run_value.h"

namespace umbrameter {
namespace {

constexpr const char* ao_stages_file = "ao_stages.csv";

void print_answer(const Console& console, const RunPage& page, const std::string& costs) {
  for (const Presentation& part : page.parts) {
    for (const std::string& text : part.answers) print_line(console, text);
  }
  for (const Presentation& part : page.parts) {
    for (const std::string& text : part.lines) add_line(console, text);
  }
  for (const Presentation& part : page.parts) {
    for (const std::string& text : part.details) diagnostic(console, text);
  }
  if (!costs.empty()) diagnostic(console, costs);
  std::fflush(stdout);  // a pipe or a file gets it now, too
}

void describe_layers(const RunResults& results, LayeredImage& image) {
  image.attributes["scene"] = scene_title(results.experiment);
  image.attributes["version"] = UMBRAMETER_VERSION;
  image.attributes["layers"] = to_json(named_layers(image)).dump();
}

void write_rows(const std::filesystem::path& path, const ResultsStore& results) {
  std::vector<Column> columns;
  for (const StoredColumn& stored : results.description().columns) columns.push_back(stored.column);
  write_csv(path, columns, [&](const StoredRowSink& sink) { results.read({}, sink); });
}

std::string rays_text(const char* kind, const RayCosts& costs) {
  if (costs.rays == 0) return {};
  return fmt::format("; {} {} rays in {:.2g} s, {:.2g} Mray/s", grouped(costs.rays), kind, costs.seconds,
                     1e-6 * static_cast<double>(costs.rays) / costs.seconds);
}

}  // namespace

std::string costs_text(const Costs& costs, std::uint64_t peak_resident_bytes) {
  if (costs.build.triangles == 0) return {};
  std::string text = fmt::format("traced {} triangles; built in {:.2g} s, {}", grouped(costs.build.triangles),
                                 costs.build.seconds, bytes_text(costs.build.bytes));
  text += rays_text("shadow", costs.shadow) + rays_text("hemisphere", costs.hemisphere);
  if (costs.largest_offset > 0.0) text += "; offset at most " + metres_text(costs.largest_offset);
  return text + "; peak memory " + bytes_text(peak_resident_bytes);
}

std::string experiment_text(Experiment experiment) {
  return to_toml(experiment.scene, describe(experiment), experiment.axes);
}

std::vector<std::string> run_files(bool with_rows) {
  std::vector<std::string> files = {"experiment.toml", "images.exr", run_value_file, "summary.json", "index.html"};
  if (with_rows) files.push_back("sweep.csv");
  return files;
}

ExitCode finish_run(RunFolder& folder, const Console& console, const std::vector<std::string>& problems) {
  add_line(console, fmt::format("report: {}", (folder.path() / "index.html").string()));
  folder.finish(problems.empty());
  for (const std::string& problem : problems) write_to(stderr, "umbrameter: " + plain_text(problem) + "\n");
  return problems.empty() ? ExitCode::ok : ExitCode::partial;
}

ExitCode write_run(RunFolder& run_folder, const Console& console, RunResults results, RunOutput output) {
  RunPage page = present_run(results, output.rows, output.page);
  const std::filesystem::path& folder = run_folder.path();
  if (results.measurement && results.measurement->ao && results.measurement->ao->stages) {
    const AoStages& stages = *results.measurement->ao->stages;
    output.texts.emplace_back(ao_stages_file, to_csv(ao_stage_table(stages.statistics, stages.bins)));
  }
  std::vector<std::string> further = figure_files(page);
  for (const auto& [name, file] : output.images) further.push_back(name);
  for (const auto& [name, file] : output.texts) further.push_back(name);
  run_folder.require_free(further);
  run_folder.begin();
  run_folder.announce(further);
  print_answer(console, page, output.costs);
  std::vector<std::string> files;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_text(folder / name, text);
    files.push_back(name);
  };
  write("experiment.toml", output.experiment_toml);
  write_run_value(folder, results);
  files.emplace_back(run_value_file);
  // Compresses on one thread, while others draw figures.
  std::future<void> layers;
  if (results.measurement) {
    LayeredImage& image = results.measurement->layers;
    describe_layers(results, image);
    layers = std::async(std::launch::async, [&] { write_exr(folder / "images.exr", image); });
    files.emplace_back("images.exr");
  }
  if (output.rows != nullptr) {
    write_rows(folder / "sweep.csv", output.rows->store);
    files.emplace_back("results.sqlite");
    files.emplace_back("sweep.csv");
  }
  for (const auto& [name, file] : output.images) {
    write_exr(folder / name, file);
    files.push_back(name);
  }
  for (const auto& [name, text] : output.texts) write(name, text);
  const std::vector<std::string> problems = draw_figures(folder, console, results, page, output.page);
  if (layers.valid()) layers.get();
  files.emplace_back("summary.json");
  files.emplace_back("index.html");
  const std::string json = to_summary_json(results, page.sweep, files, problems);
  write_text(folder / "summary.json", json);
  write_run_page(folder, results, output.rows, page, problems, output.page);
  if (!output.journal.empty()) std::filesystem::remove(output.journal);
  for (const std::string& text : output.closing) add_line(console, text);
  if (console.json) write_to(stdout, json);
  return finish_run(run_folder, console, problems);
}

}  // namespace umbrameter
