// umbrameter_ao_table [SCENE...]: every ambient-occlusion method on scenes that show failures, its error by stage, as
// the page docs/ambient-occlusion/table.md. All settings but the method are the defaults. The time is that of the
// method with its blur, in processor time of all threads, over that of the G-buffer pass in the same turn.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "core/error.h"
#include "experiments/measure.h"
#include "raster/ao/ao_pass.h"
#include "raster/gbuffer/gbuffer_pass.h"
#include "raster/gl/timer.h"
#include "scenes/builtin.h"

namespace umbrameter {
namespace {

constexpr int turns = 5;

struct Row {
  const char* name;
  std::vector<std::string> settings;  // "ao.technique=gtao"
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"SSAO", {"ao.technique=ssao"}},
      {"full-sphere SSAO", {"ao.technique=crytek"}},
      {"Alchemy AO", {"ao.technique=alchemy", "ao.alchemy-estimator=alchemy"}},
      {"SAO", {"ao.technique=alchemy"}},
      {"HBAO", {"ao.technique=hbao"}},
      {"GTAO", {"ao.technique=gtao"}},
      {"GTAO, power 1", {"ao.technique=gtao", "ao.gtao-power=1", "ao.gtao-radius-multiplier=1"}},
  };
  return all;
}

Experiment experiment_of(const std::string& scene, const Row& row) {
  Experiment experiment;
  experiment.scene = scene;
  experiment.view.size = {480, 270};
  experiment.truth.spp = 32;
  const Parameters parameters = describe(experiment);
  for (const std::string& setting : row.settings) {
    const std::size_t equals = setting.find('=');
    require(parameters, setting.substr(0, equals)).set_text(setting.substr(equals + 1));
  }
  return experiment;
}

// Median over turns.
double time_ratio(Stages& stages, const Experiment& experiment) {
  const View view = stages.surfels(experiment).view;
  std::vector<double> ratios;
  for (int turn = 0; turn < turns; ++turn) {
    gl::PassTime of_gbuffer;
    gl::run_timed(&of_gbuffer, [&] { draw_gbuffer(stages.context(), stages.uploaded(), view); });
    gl::PassTime of_method;
    gl::run_timed(&of_method, [&] { stages.draw_ao(experiment); });
    ratios.push_back(of_method.processor / of_gbuffer.processor);
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios[turns / 2];
}

std::string signed_text(double value) { return fmt::format("{:+.4f}", value); }

void print_scene(const std::string& scene) {
  Stages stages(load_scene(scene), {}, Console{});
  const Experiment first = stages.in_metres(experiment_of(scene, rows().front()));
  fmt::print("\n## `{}`, camera `{}`, radius {:.2f} m\n\n| method |", scene, stages.surfels(first).view.camera.name,
             first.ao.sampling.radius.number);
  for (const std::string_view stage : ao_stage_titles) fmt::print(" {} |", stage);
  fmt::print(" mean error | ± | RMSE | MSE, sRGB | PSNR, sRGB | time |\n| --- |");
  for (std::size_t i = 0; i < ao_stage_count + 6; ++i) fmt::print(" --- |");
  fmt::print("\n");
  for (const Row& row : rows()) {
    const Experiment experiment = stages.in_metres(experiment_of(scene, row));
    const AoMeasurement ao = measure_ao(stages, experiment, {});
    const AoStages measured = measure_ao_stages(stages, experiment, *ao.truth, *ao.raster, Console{});
    const AoStageStatistics& s = measured.statistics;
    fmt::print("| {} |", row.name);
    for (const AoStageError& stage : s.stages) fmt::print(" {} |", signed_text(stage.mean.value));
    fmt::print(" {} | {:.4f} | {:.4f} | {:.5f} | {:.2f} | {:.1f} |\n", signed_text(s.total.mean_error.value),
               0.5 * (s.total.mean_error.upper - s.total.mean_error.lower), s.total.rmse.value, s.srgb_mse, s.srgb_psnr,
               time_ratio(stages, experiment));
    std::fflush(stdout);
  }
}

int run(int argc, char** argv) {
  std::vector<std::string> scenes(argv + 1, argv + argc);
  if (scenes.empty()) scenes = {"courtyard", "room", "corner", "trench", "foliage"};
  fmt::print(
      "# Every method of ambient occlusion on five scenes\n\n"
      "Made by `umbrameter_ao_table`: 480×270 pixels, first camera, default settings but for the method. The "
      "reference\n"
      "is traced with cosine weight up to the radius, 32 rays per pixel.\n\n"
      "The columns from model to blur are the signed means of the [stages](stages.md), in units of accessibility: "
      "below\n"
      "0 the stage darkens. They add up to the mean error, whose 95 % interval has the half width in the column ±. "
      "RMSE\n"
      "and MSE are corrected for the noise of the reference. Values of different signs cancel in a mean: the RMSE "
      "shows\n"
      "how far single pixels are off. Time: the method with its blur over the G-buffer pass, processor time of a\n"
      "software rasteriser, ±20 %; a GPU orders methods differently.\n");
  for (const std::string& scene : scenes) print_scene(scene);
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
