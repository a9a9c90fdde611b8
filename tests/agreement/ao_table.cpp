// umbrameter_ao_table [SCENE...]: every ambient-occlusion method on scenes that show failures, its error by stage, as
// the page docs/ambient-occlusion/table.md. SCENE: a file or a built-in scene. All settings but the method are the
// defaults. The time is that of the method with its blur, in processor time of all threads, over that of the G-buffer
// pass in the same turn.
// umbrameter_ao_table --pictures DIR [PAGE...]: instead one sheet of pictures per method, DIR/ao-METHOD.png, on the
// scenes that its page names: reference, result, error and the stage of largest RMS.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "experiments/measure/measure.h"
#include "experiments/measure/measure_ao_stages.h"
#include "raster/ao/ao_pass.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/timer.h"
#include "reports/figures/drawing.h"
#include "results/layer_description.h"
#include "scenes/builtin.h"
#include "techniques/ao/integral.h"
#include "tests/agreement/labelled_sheet.h"

namespace umbrameter {
namespace {

constexpr int turns = 5;
constexpr int width = 240;
constexpr int height = 135;

using Settings = std::vector<std::string>;  // "ao.technique=gtao"

// `reads`: settings with which a pixel reads the depth buffer 64 times.
struct Row {
  const char* name;
  Settings settings;
  Settings reads;
  bool can_have_64_reads = true;
};

const std::vector<Row>& rows() {
  const Settings slices = {"ao.slices=4", "ao.steps=8"};
  static const std::vector<Row> all = {
      {"SSAO", {"ao.technique=ssao"}, {}},
      {"full-sphere SSAO", {"ao.technique=crytek"}, {}},
      {"Alchemy AO", {"ao.technique=alchemy", "ao.alchemy-estimator=alchemy"}, {}},
      {"SAO", {"ao.technique=alchemy"}, {}},
      {"SAO, mip chain", {"ao.technique=alchemy", "ao.alchemy-mip-chain=true"}, {}},
      {"HBAO", {"ao.technique=hbao"}, {"ao.hbao-directions=8", "ao.hbao-steps=8"}},
      {"GTAO", {"ao.technique=gtao"}, slices},
      {"GTAO, power 1", {"ao.technique=gtao", "ao.gtao-power=1", "ao.gtao-radius-multiplier=1"}, slices},
      {"bitmask", {"ao.technique=bitmask"}, slices},
      {"bitmask, cosine weight", {"ao.technique=bitmask", "ao.bitmask-weight=cosine"}, slices},
      {"ray-marched SSAO", {"ao.technique=ray-marched"}, {}, false},
  };
  return all;
}

struct Pictured {
  const char* scene;
  Settings settings;  // of the view
};

// One sheet: a method on scenes that show its known failures.
struct Sheet {
  const char* page;
  Settings settings;
  std::vector<Pictured> scenes;
};

const std::vector<Sheet>& sheets() {
  const Pictured arcade = {"courtyard", {"view.camera=arcade"}};
  static const std::vector<Sheet> all = {
      {"ssao", {"ao.technique=ssao"}, {{"room", {}}, {"trench", {}}}},
      {"full-sphere-ssao", {"ao.technique=crytek"}, {{"corner", {}}, {"room", {}}}},
      {"alchemy", {"ao.technique=alchemy"}, {{"room", {}}, {"courtyard", {}}}},
      {"hbao", {"ao.technique=hbao"}, {{"corner", {}}, {"room", {}}}},
      {"gtao", {"ao.technique=gtao"}, {{"room", {}}, arcade}},
      {"bitmask", {"ao.technique=bitmask", "ao.bitmask-weight=cosine"}, {{"trench", {}}, {"foliage", {}}}},
      {"ray-marched", {"ao.technique=ray-marched"}, {arcade, {"foliage", {}}}},
  };
  return all;
}

Experiment experiment_of(const std::string& scene, const Settings& settings) {
  Experiment experiment;
  experiment.scene = scene;
  experiment.view.size = {width, height};
  experiment.truth.spp = 32;
  const Parameters parameters = describe(experiment);
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    require(parameters, setting.substr(0, equals)).set_text(setting.substr(equals + 1));
  }
  return experiment;
}

// Median over turns.
double time_ratio(Stages& stages, const Experiment& experiment) {
  const View view = stages.surfels(experiment)->view;
  std::vector<double> ratios;
  for (int turn = 0; turn < turns; ++turn) {
    gl::PassTime of_gbuffer;
    gl::run_timed(&of_gbuffer, [&] { draw_gbuffer(stages.context(), stages.uploaded(), view); });
    gl::PassTime of_method;
    gl::run_timed(&of_method, [&] { stages.draw_ao_of(*stages.gpu_surfels(experiment), experiment); });
    ratios.push_back(of_method.processor / of_gbuffer.processor);
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios[turns / 2];
}

std::string signed_text(double value) { return fmt::format("{:+.4f}", value); }

// RMSE by row and scene.
using Errors = std::vector<std::vector<double>>;

struct Ranking {
  const char* title;
  Errors errors;
};

Settings together(const Settings& a, const Settings& b) {
  Settings all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

double rmse_of(Stages& stages, const std::string& scene, const Settings& settings) {
  const Experiment experiment = stages.in_metres(experiment_of(scene, settings));
  return measure_ao(stages, experiment, {}).statistics->error.rmse.value;
}

void print_scene(const std::string& scene, std::vector<Ranking>& rankings) {
  Stages stages(load_scene(scene), {}, Console{});
  const Experiment first = stages.in_metres(experiment_of(scene, rows().front().settings));
  fmt::print("\n## `{}`, camera `{}`, radius {:.2f} m\n\n| method |", scene, stages.surfels(first)->view.camera.name,
             first.ao.sampling.radius.number);
  for (const std::string_view stage : ao_stage_titles) fmt::print(" {} |", stage);
  fmt::print(" mean error | ± | RMSE | MSE, sRGB | PSNR, sRGB | time |\n| --- |");
  for (std::size_t i = 0; i < ao_stage_count + 6; ++i) fmt::print(" --- |");
  fmt::print("\n");
  for (std::size_t r = 0; r < rows().size(); ++r) {
    const Row& row = rows()[r];
    const Experiment experiment = stages.in_metres(experiment_of(scene, row.settings));
    const AoMeasurement ao = measure_ao(stages, experiment, {});
    const SampledError& error = ao.statistics->error;
    const std::string totals = fmt::format("{} | {:.4f} | {:.4f}", signed_text(error.mean_error.value),
                                           0.5 * (error.mean_error.upper - error.mean_error.lower), error.rmse.value);
    fmt::print("| {} |", row.name);
    if (find_integral(make_technique(experiment.ao))) {
      const AoStageStatistics s = measure_ao_stages(stages, experiment, *ao.truth, *ao.raster, Console{}).statistics;
      for (const AoStageError& stage : s.stages) fmt::print(" {} |", signed_text(stage.mean.value));
      fmt::print(" {} | {:.5f} | {:.2f} |", totals, s.srgb_mse, s.srgb_psnr);
    } else {
      for (std::size_t i = 0; i < ao_stage_count; ++i) fmt::print(" – |");
      fmt::print(" {} | – | – |", totals);
    }
    fmt::print(" {:.1f} |\n", time_ratio(stages, experiment));
    std::fflush(stdout);
    rankings[0].errors[r].push_back(error.rmse.value);
    rankings[1].errors[r].push_back(rmse_of(stages, scene, together(row.settings, {"ao.blur=box"})));
    if (row.can_have_64_reads) {
      rankings[2].errors[r].push_back(rmse_of(stages, scene, together(row.settings, row.reads)));
    }
  }
}

double mean_of(const std::vector<double>& errors) {
  return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

void print_ranking(const Ranking& ranking, const std::vector<std::string>& scenes) {
  fmt::print("\n### {}\n\n| method |", ranking.title);
  for (const std::string& scene : scenes) fmt::print(" `{}` |", scene);
  fmt::print(" mean |\n| --- |");
  for (std::size_t i = 0; i <= scenes.size(); ++i) fmt::print(" --- |");
  fmt::print("\n");
  std::vector<std::size_t> order;
  for (std::size_t r = 0; r < rows().size(); ++r) {
    if (!ranking.errors[r].empty()) order.push_back(r);
  }
  std::ranges::sort(order, {}, [&](std::size_t r) { return mean_of(ranking.errors[r]); });
  for (const std::size_t r : order) {
    fmt::print("| {} |", rows()[r].name);
    for (const double error : ranking.errors[r]) fmt::print(" {:.3f} |", error);
    fmt::print(" {:.3f} |\n", mean_of(ranking.errors[r]));
  }
}

// The mean of each square of four pixels.
Image<float> half(const Image<float>& image) {
  Image<float> small(image.width / 2, image.height / 2);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      small.at(x, y) = 0.25f * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) + image.at(2 * x, 2 * y + 1) +
                                image.at(2 * x + 1, 2 * y + 1));
    }
  }
  return small;
}

Image<float> difference(const Image<float>& a, const Image<float>& b) {
  Image<float> result = a;
  for (std::size_t i = 0; i < a.size(); ++i) result[i] -= b[i];
  return result;
}

void add_cells(std::vector<SheetCell>& cells, const Sheet& sheet, const Pictured& pictured) {
  Stages stages(load_scene(pictured.scene), {}, Console{});
  Experiment experiment = experiment_of(pictured.scene, together(sheet.settings, pictured.settings));
  experiment.view.size = {2 * width, 2 * height};
  experiment = stages.in_metres(experiment);
  const AoMeasurement ao = measure_ao(stages, experiment, {});
  const AoStages measured = measure_ao_stages(stages, experiment, *ao.truth, *ao.raster, Console{});
  const AoStageStatistics& s = measured.statistics;
  const auto largest = static_cast<std::size_t>(
      std::ranges::max_element(s.stages, {}, [](const AoStageError& stage) { return stage.rms.value; }) -
      s.stages.begin());
  const Image<float>& reference = ao.truth->ao;
  const Image<float>& drawn = *ao.raster;
  cells.push_back(
      {fmt::format("{}: reference", pictured.scene), colorize(half(reference), color_scale(Layer::truth_ao))});
  cells.push_back({"result", colorize(half(drawn), color_scale(Layer::truth_ao))});
  cells.push_back({fmt::format("error: RMS {:.3f}, mean {:+.3f}", s.total.rmse.value, s.total.mean_error.value),
                   colorize(half(difference(drawn, reference)), color_scale(Layer::error_ao))});
  cells.push_back(
      {fmt::format("{}: RMS {:.3f}", ao_stage_titles[largest], s.stages[largest].rms.value),
       colorize(half(stage_difference(measured.images, static_cast<AoStage>(largest))), color_scale(Layer::error_ao))});
}

void draw_sheets(const std::filesystem::path& folder, const std::vector<std::string>& pages) {
  std::filesystem::create_directories(folder);
  for (const Sheet& sheet : sheets()) {
    if (!pages.empty() && std::ranges::find(pages, sheet.page) == pages.end()) continue;
    std::vector<SheetCell> cells;
    for (const Pictured& pictured : sheet.scenes) add_cells(cells, sheet, pictured);
    write_drawing(folder / fmt::format("ao-{}.png", sheet.page), labelled_sheet(cells, 4));
  }
}

int run(int argc, char** argv) {
  if (argc >= 3 && std::string_view(argv[1]) == "--pictures") {
    draw_sheets(argv[2], {argv + 3, argv + argc});
    return 0;
  }
  std::vector<std::string> scenes(argv + 1, argv + argc);
  if (scenes.empty()) scenes = {"courtyard", "room", "corner", "trench", "foliage"};
  fmt::print(
      "# Every method of ambient occlusion on five scenes\n\n"
      "Made by `umbrameter_ao_table`: {}×{} pixels, first camera, default settings but for the method: each has the\n"
      "[denoiser of its publication](blur.md). The reference is traced with cosine weight up to the radius, 32 rays "
      "per\n"
      "pixel. The [ranking](#ranking) at the end compares with one blur for all and with equal numbers of samples.\n\n"
      "`–`: the method's stages are not measured, because its integral is not known ([bitmask](bitmask.md)).\n\n"
      "The columns from model to blur are the signed means of the [stages](stages.md), in units of accessibility: "
      "below\n"
      "0 the stage darkens. They add up to the mean error, whose 95 % interval has the half width in the column ±. "
      "RMSE\n"
      "and MSE are corrected for the noise of the reference. Values of different signs cancel in a mean: the RMSE "
      "shows\n"
      "how far single pixels are off. Time: the method with its blur over the G-buffer pass, processor time of a\n"
      "software rasteriser, ±20 %; a GPU orders methods differently.\n",
      width, height);
  const Errors none(rows().size());
  std::vector<Ranking> rankings = {{"Default: published denoisers", none},
                                   {"4×4 box blur for all", none},
                                   {"64 reads per pixel, published denoisers", none}};
  for (const std::string& scene : scenes) print_scene(scene, rankings);
  fmt::print(
      "\n## Ranking\n\n"
      "RMSE on each scene, and its mean, the least first. A pixel reads the depth buffer 64 times by default with "
      "SSAO,\n"
      "full-sphere SSAO, Alchemy AO and SAO, 36 times with HBAO, and 18 times with GTAO and the bitmask. For 64 reads\n"
      "HBAO has 8 directions of 8 steps, GTAO and the bitmask 4 slices of 8 steps on each side. Ray-marched SSAO "
      "reads\n"
      "every pixel of 64 rays.\n");
  for (const Ranking& ranking : rankings) print_ranking(ranking, scenes);
  return 0;
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  try {
    return umbrameter::run(argc, argv);
  } catch (const umbrameter::Error& error) {
    fmt::print(stderr, "umbrameter_ao_table: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
