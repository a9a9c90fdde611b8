// umbrameter_technique_table [--pictures DIR] [SCENE...]: every shadow technique on scenes that show failures, as the
// page docs/techniques/table.md. All settings but those in a row's name are the defaults. The time is that of map,
// filter and look-up together, in processor time of all threads, over that of the nearest tap in the same turn.
// --pictures writes the errors of each scene's techniques as techniques-SCENE.png and links them, so that the numbers
// can be checked by eye: umbrameter_technique_table --pictures docs/images > docs/techniques/table.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "experiments/measure/measure.h"
#include "raster/gl/timer.h"
#include "raster/shadow/technique_passes.h"
#include "reports/figures/drawing.h"
#include "scenes/builtin.h"
#include "scenes/emitter.h"
#include "tests/agreement/labelled_sheet.h"
#include "tests/agreement/technique_sheet.h"

namespace umbrameter {
namespace {

constexpr int turns = 3;
constexpr double biases[] = {0.0, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0};  // texels

struct Row {
  std::string name;
  std::vector<std::string> settings;  // "shadow.filter=box"; SCENE is the diagonal of the scene's bounds
};

EdgeStatistics edges_of(Stages& stages, const Experiment& experiment, const RasterVisibility& drawn) {
  return std::get<EdgeStatistics>(
      analyze_shadow(stages, experiment, 0, ShadowKind::by_edges, drawn, *stages.counted(experiment, 0)));
}

const std::vector<Row>& rows() {
  static const std::vector<Row> all = {
      {"nearest", {}},
      {"bilinear", {"shadow.filter=bilinear"}},
      {"box 3", {"shadow.filter=box"}},
      {"optimized 5", {"shadow.filter=optimized", "shadow.filter-size=5"}},
      {"area tent 5", {"shadow.filter=area-tent", "shadow.filter-size=5"}},
      {"Vogel 16", {"shadow.filter=vogel"}},
      {"nearest, 4 cascades", {"shadow.cascades=4"}},
      {"nearest, slope-scaled 1", {"shadow.slope-bias=1"}},
      {"nearest, normal offset 1", {"shadow.normal-offset=1"}},
      {"nearest, receiver plane", {"shadow.receiver-plane=true"}},
      {"adaptive depth bias", {"shadow.receiver-plane=true", "shadow.constant-bias=SCENE/10000"}},
      {"nearest, cone 1", {"shadow.cone-bias=1"}},
      {"back faces", {"shadow.faces=back"}},
      {"midpoint", {"shadow.surface=midpoint"}},
      {"second depth", {"shadow.surface=second"}},
      {"dual layers", {"shadow.surface=dual"}},
      {"16-bit depth", {"shadow.depth-format=16"}},
      {"ESM", {"shadow.technique=esm"}},
      {"VSM", {"shadow.technique=vsm"}},
      {"EVSM2", {"shadow.technique=evsm2"}},
      {"EVSM4", {"shadow.technique=evsm4"}},
      {"MSM, Hamburger", {"shadow.technique=msm"}},
      {"MSM, Hausdorff", {"shadow.technique=msm", "shadow.msm-bound=hausdorff"}},
      {"CSM", {"shadow.technique=csm"}},
      {"screen space", {"shadow.technique=screen-space"}},
      {"nearest + screen space", {"shadow.contact-shadows=true"}},
  };
  return all;
}

struct Cell {
  double bias = 0.0;  // texels, or NaN if the row has its own
  EdgeStatistics edges;
  std::optional<VisibilityStatistics> causes;  // of techniques that sum comparisons
  double time = 1.0;
};

Experiment experiment_of(const std::string& scene, const Row& row, const Bounds& bounds) {
  Experiment experiment;
  experiment.scene = scene;
  experiment.view.size = {480, 270};
  const Parameters parameters = describe(experiment);
  for (const std::string& setting : row.settings) {
    const std::size_t equals = setting.find('=');
    std::string value = setting.substr(equals + 1);
    if (value == "SCENE/10000") value = fmt::format("{}", 2.0 * bounds.radius() / 10000.0);
    require(parameters, setting.substr(0, equals)).set_text(value);
  }
  return experiment;
}

double seconds(Stages& stages, const Experiment& experiment) {
  const Light light = stages.light(experiment, 0);
  const auto layout = stages.layout(experiment, 0);
  const auto surfels = stages.gpu_surfels(experiment);
  const View view = stages.surfels(experiment)->view;
  const ShadowTechnique technique = make_technique(experiment.shadow, half_size(light.emitter));
  gl::PassTime time;
  gl::run_timed(&time, [&] {
    const ShadowMap map =
        draw_shadow_map(stages.context(), stages.uploaded(), light, *layout, experiment.shadow.map_depth);
    const TechniqueMap filtered =
        filter_map({stages.context(), stages.uploaded(), light, map, experiment.shadow.map_depth}, technique);
    draw_visibility(stages.context(), {stages.uploaded(), *surfels, map, light, experiment.shadow.bias, technique,
                                       nullptr, &filtered, &view});
  });
  return time.processor;
}

std::string per_cent(double share) { return fmt::format("{:.2f}", 100.0 * share); }

std::string line_of(const Row& row, const Cell& cell) {
  std::string bias = std::isnan(cell.bias) ? "own" : fmt::format("{}", cell.bias);
  if (cell.bias == *std::prev(std::end(biases))) bias = "≥ " + bias;  // the error may fall beyond the axis
  std::string line = fmt::format("| {} | {} |", row.name, bias);
  for (const double share : {cell.edges.mae, cell.edges.rmse, cell.edges.too_dark_away, cell.edges.too_dark_at_edge,
                             cell.edges.too_bright_at_edge, cell.edges.too_bright_away}) {
    line += fmt::format(" {} |", per_cent(share));
  }
  if (cell.causes) {
    line += fmt::format(" {} | {} | {} | {} |", per_cent(cell.causes->acne), per_cent(cell.causes->false_occlusion),
                        per_cent(cell.causes->peter_panning), per_cent(cell.causes->leak));
  } else {
    line += " – | – | – | – |";
  }
  return line + fmt::format(" {:.1f} |", cell.time);
}

// The experiment with the constant bias of least error among `biases`; the smallest of equals.
Experiment with_best_bias(Stages& stages, Experiment experiment, double& bias) {
  double least = 2.0;
  Length best;
  for (const double texels : biases) {
    experiment.shadow.bias.constant = {texels, LengthUnit::texels};
    const EdgeStatistics edges = edges_of(stages, experiment, stages.draw(experiment, 0, false));
    if (edges.mae >= least) continue;
    least = edges.mae;
    best = experiment.shadow.bias.constant;
    bias = texels;
  }
  experiment.shadow.bias.constant = best;
  return experiment;
}

void print_scene(const std::string& scene, const std::filesystem::path& pictures) {
  Stages stages(load_scene(scene), {}, Console{});
  fmt::print("\n## `{}`, light `{}`\n\n", scene, stages.title(0));
  if (!pictures.empty()) {
    fmt::print("![Every technique on {}: errors over the reference's shadow](../images/techniques-{}.png)\n\n", scene,
               scene);
  }
  fmt::print(
      "| technique | bias | error | RMSE | too dark away | too dark at edges | too bright at edges | too bright away | "
      "acne | "
      "false occlusion | peter-panning | leak | time |\n| --- |");
  for (int i = 0; i < 12; ++i) fmt::print(" --- |");
  fmt::print("\n");
  std::vector<SheetCell> cells;
  for (const Row& row : rows()) {
    const Experiment nearest = experiment_of(scene, rows().front(), stages.bounds());
    Experiment experiment = stages.in_metres(experiment_of(scene, row, stages.bounds()));
    Cell cell;
    cell.bias = std::numeric_limits<double>::quiet_NaN();
    if (experiment.shadow.bias.constant.unit == LengthUnit::texels) {
      experiment = with_best_bias(stages, experiment, cell.bias);
    }
    const ShadowMeasurement shadow = measure_shadow(stages, experiment, 0, {});
    cell.edges = edges_of(stages, experiment, *shadow.raster);
    if (const auto* causes = std::get_if<VisibilityStatistics>(&*shadow.statistics)) cell.causes = *causes;
    std::vector<double> ratios;
    for (int turn = 0; turn < turns; ++turn) {
      const double of_nearest = seconds(stages, nearest);
      ratios.push_back(seconds(stages, experiment) / of_nearest);
    }
    std::sort(ratios.begin(), ratios.end());
    cell.time = ratios[turns / 2];
    fmt::print("{}\n", line_of(row, cell));
    std::fflush(stdout);
    if (!pictures.empty()) {
      Image<float> truth = shadow.truth->visibility;
      for (std::size_t i = 0; i < truth.size(); ++i) {
        if (shadow.counted.exclusion[i] != PixelExclusion::none) truth[i] = -1.0f;
      }
      cells.push_back({fmt::format("{}: {} %", row.name, per_cent(cell.edges.mae)),
                       picture_of_errors(truth, shadow.raster->visibility)});
    }
  }
  if (!pictures.empty()) write_drawing(pictures / ("techniques-" + scene + ".png"), labelled_sheet(cells, 4));
}

int run(int argc, char** argv) {
  std::filesystem::path pictures;
  std::vector<std::string> scenes;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--pictures" && i + 1 < argc) {
      pictures = argv[++i];
      std::filesystem::create_directories(pictures);
    } else {
      scenes.emplace_back(argv[i]);
    }
  }
  if (scenes.empty()) {
    scenes = {"courtyard", "contact-box", "thin-leaf", "two-occluders", "ramp", "corner", "long-posts"};
  }
  fmt::print(
      "# Every shadow technique on seven scenes\n\n"
      "Made by `umbrameter_technique_table`: 480×270 pixels, first camera and first light, 1024² texels, each "
      "technique "
      "with the\nconstant bias of least error among 13 from 0 to 16 texels (column bias; adaptive depth bias has its "
      "own).\n\n"
      "The reference is a traced hard shadow, against which every blur is an error, most of all away from edges and at "
      "biases that\nfree a wide kernel of acne: compare the columns \"away from edges\" (acne, light bleeding), not "
      "the "
      "total, between filters.\nErrors are in % of the counted pixels; edges are within two texels of the reference's "
      "shadow edges. Causes exist for techniques\nthat sum depth comparisons. Time: map, filter and look-up over the "
      "nearest tap, processor time of a software rasteriser, ±20 %;\na GPU orders techniques differently.\n\n"
      "A bias of \"≥ 16\" is the end of the axis. Where hardly anything is too dark, the least error may be no shadow "
      "at all: `long-posts`\nhas posts thinner than a texel, of which a blur leaves nothing.\n\n"
      "PCSS and DPCF need a light with extent: without one they are the nearest tap. [Filters that sum "
      "comparisons](comparing-filters.md) measures it.\n");
  for (const std::string& scene : scenes) print_scene(scene, pictures);
  return 0;
}

}  // namespace
}  // namespace umbrameter

int main(int argc, char** argv) {
  try {
    return umbrameter::run(argc, argv);
  } catch (const umbrameter::Error& error) {
    fmt::print(stderr, "umbrameter_technique_table: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
