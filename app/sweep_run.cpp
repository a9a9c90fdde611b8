#include "app/sweep_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/lists.h"
#include "experiments/measure/engine_advice.h"
#include "experiments/measure/measure_biases.h"
#include "experiments/settings/stage_inputs.h"
#include "experiments/sweep/axis_effects.h"
#include "experiments/sweep/identity.h"
#include "experiments/sweep/page_cells.h"
#include "present/presentation_parts.h"
#include "present/run_output.h"
#include "present/sweep_report.h"
#include "results/layers.h"
#include "scenes/builtin.h"
#include "scenes/floor.h"
#include "scenes/view.h"
#include "store/read_bias_curves.h"
#include "store/stored_sweep.h"

namespace umbrameter {
namespace {

// Axes that a sweep cannot have.
void check_axes(const std::vector<SweepAxis>& axes, const Experiment& experiment) {
  if (axes.empty()) {
    throw Error(ExitCode::usage, "sweep", "nothing to vary",
                "add an axis, such as --vary shadow.constant-bias=0:0.2:65");
  }
  for (const auto& [group, flag] :
       {std::pair("view.scene", "--scene"), std::pair("scene.unit", "--scene.unit"),
        std::pair("scene.blend", "--scene.blend"), std::pair("scene.ground", "--scene.ground")}) {
    if (!varies_group(axes, group)) continue;
    throw Error(ExitCode::usage, std::string("--vary ") + group, "a sweep can use only one scene",
                std::string("run one sweep for each, with ") + flag);
  }
  if (!experiment.run.overlay.empty()) {
    throw Error(ExitCode::usage, "--overlay", "a sweep draws no views", "use compare or raster");
  }
  if (experiment.run.write_maps) {
    throw Error(ExitCode::usage, "--write-maps", "a sweep writes no maps", "use compare or raster");
  }
  if (experiment.run.write_ao_inputs) {
    throw Error(ExitCode::usage, "--write-ao-inputs", "a sweep writes no inputs", "use compare or raster");
  }
}

// Whatever the axes name in the scene, and every size of its lights: one slip must not show after hours.
void check_against_scene(const Stages& stages, const Experiment& experiment, const std::vector<SweepAxis>& axes,
                         SweptQuantity quantity) {
  const double aspect = static_cast<double>(experiment.view.size.width) / experiment.view.size.height;
  std::vector<const SweepAxis*> extents;
  std::size_t combinations = 1;
  for (const SweepAxis& axis : axes) {
    std::vector<std::string> ignored;
    for (const Value& value : axis.values) {
      if (axis.key == "view.camera") select_camera(stages.scene(), to_string(value), aspect, ignored);
      if (axis.key == "view.light") stages.lights(to_string(value));
    }
    if (!axis.key.starts_with("light.")) continue;
    extents.push_back(&axis);
    combinations *= axis.values.size();
  }
  if (quantity == SweptQuantity::ao && !extents.empty()) return;
  const std::vector<std::uint32_t> lights = swept_lights(stages, experiment, axes, quantity);
  Experiment cell = experiment;
  const Parameters parameters = describe(cell);
  for (std::size_t i = 0; i < combinations; ++i) {
    std::size_t rest = i;
    for (const SweepAxis* axis : extents) {
      set_value(parameters, *axis, axis->values[rest % axis->values.size()]);
      rest /= axis->values.size();
    }
    stages.check_is_meaningful(cell, lights);
  }
}

// With each value of shadow.technique; only the given one where it is not varied.
std::vector<Experiment> with_each_technique(const Experiment& experiment, const std::vector<SweepAxis>& axes) {
  const auto axis = std::ranges::find(axes, "shadow.technique", &SweepAxis::key);
  if (axis == axes.end()) return {experiment};
  return mapped(axis->values, [&](const Value& technique) {
    Experiment each = experiment;
    require(describe(each), "shadow.technique").set(technique);
    return each;
  });
}

std::vector<SweepAxis> checked_axes(Experiment& experiment) {
  std::vector<SweepAxis> axes = parse_axes(describe(experiment), experiment.axes);
  check_axes(axes, experiment);
  return axes;
}

}  // namespace

SweepRun::SweepRun(const CommandLine& given_line, Experiment of_line)
    : line(given_line),
      given(std::move(of_line)),
      axes(checked_axes(given)),
      quantity(choose_quantity(given.run.measure, axes)),
      parameters(describe(given)) {
  check_insets(make_figure_style(line.figures), given.view.size.width, given.view.size.height);
  require_effect(quantity, {given}, axes);
  check_bias_engines(given, quantity == SweptQuantity::visibility);
  plan = plan_sweep(parameters, axes, cost_of_change, inner_keys(given, axes, quantity));
}

void SweepRun::load(const Console& console) {
  threads.emplace(line.threads);
  stages.emplace(load_scene(given.scene, given.view.scene, given.scene_params,
                            load_options(line, quantity == SweptQuantity::image)),
                 stage_options(line, console, given), console);
  const std::vector<std::uint32_t> lights = stages->lights(given.view.light);
  if (quantity == SweptQuantity::visibility && !varies_group(axes, "view.light") && lights.size() > 1) {
    // A sweep is about one light; which one is part of the stored experiment.
    given.view.light = std::to_string(lights.front());
    note(console, fmt::format("the scene has {} lights; this sweep uses '{}'; select another with --light",
                              lights.size(), stages->title(lights.front())));
  }
  experiment = stages->in_metres(given);
  check_against_scene(*stages, experiment, axes, quantity);
  const std::vector<std::uint32_t> swept = swept_lights(*stages, experiment, axes, quantity);
  add_setting_notes(*stages, line, experiment, swept);
  if (!varies_group(axes, "light.")) {
    for (const Experiment& each : with_each_technique(experiment, axes)) add_technique_notes(*stages, each, swept);
  }
  statistics = choose_statistics(*stages, experiment, axes, quantity);
  metrics = swept_metrics(experiment, statistics);
}

StoreDescription SweepRun::description() {
  return {
      experiment_text(given),
      identity_of_sweep(*stages, given, quantity),
      given.axes,
      stored_columns(parameters, plan, measured_columns(experiment, statistics), sample_row(experiment, statistics)),
      plan.cells,
      maker_of(*stages)};
}

ExitCode write_sweep(SweepRun& sweep, const ResultsStore& store, RunFolder& folder, const Console& console) {
  const CommandLine& line = sweep.line;
  Stages& stages = *sweep.stages;
  const Experiment& given = sweep.given;
  const Experiment& experiment = sweep.experiment;
  const std::vector<SweepAxis>& axes = sweep.axes;
  if (const std::string text = makers_text("cells", store.makers()); !text.empty()) stages.add_notes({text});
  const auto measure_context = [&](const std::vector<Value>& values, bool with_facts) {
    BiasContext context;
    Experiment cell = cell_in_metres(stages, experiment, axes, values);
    const std::uint32_t light = stages.lights(cell.view.light).front();
    if (with_facts) context.facts = measure_bias_facts(stages, cell, light);
    if (!has_floor(stages.scene())) context.evidence = measure_bias_evidence(stages, cell, light);
    // The view does not move the map's range, and hardly its mean depth: with the view at hand nothing has to be drawn.
    cell.view = experiment.view;
    context.depth_unit = mean_depth_unit(stages, cell, light);
    context.texels_differ = texels_differ(*stages.layout(cell, light));
    return context;
  };
  const bool is_limit_fixed = sweep.quantity == SweptQuantity::ao && !varies_group(axes, "truth.ao-distance");
  const std::string ao_limit = is_limit_fixed ? ao_limit_text(experiment.truth) : "";
  const SweepResults rows{sweep.parameters, sweep.plan, store, sweep.statistics, ao_limit, sweep.metrics};
  RunResults results{"sweep", given, stages.facts(), embree_version()};
  set_renderer(results, stages);
  results.full_images = line.full_images;
  results.sweep = SweepFindings{ao_limit, best_rows(rows), read_bias_curves(rows, measure_context)};
  SweepFindings& found = *results.sweep;
  const std::vector<Value> least = least_row(rows);
  const BiasCurve* answer = found.curves ? curve_of_cell(*found.curves, rows.plan, least) : nullptr;
  const bool has_answer = answer != nullptr && answer->plateau;
  Experiment of_cells = experiment;
  if (has_answer) of_cells.run.for_engines.clear();  // else its numbers are those of each cell's own bias
  PageCells page_cells = choose_page_cells(stages, rows, of_cells, found.best, line.page_cells);
  found.cells = page_cells.cells;
  found.images.title = "Images of cells";
  {
    ProgressBar bar(console, "images of cells");
    const std::size_t count = line.no_figures ? 1 : found.cells.size();
    for (std::size_t i = 0; i < count; ++i) {
      bar.show(static_cast<double>(i) / static_cast<double>(count), fmt::format("{} of {}", i, count));
      Measurement measurement = page_cells.measure(found.cells[i]);
      move_to_layers(results.scene, measurement);
      if (!line.no_figures) {
        add_cell_images(found.images, results.scene, measurement, found.cells[i].cell, line.full_images);
      }
      if (i == 0) results.measurement = std::move(measurement);
    }
  }
  if (!given.run.for_engines.empty() && !results.measurement->shadows.front().advice) {
    const ShadowMeasurement& best = results.measurement->shadows.front();
    stages.add_notes({no_engines_text(stages, best.experiment, best.light)});
  } else if (!given.run.for_engines.empty() && has_answer && answer->withheld) {
    stages.add_notes({"--for: nothing to convert, as no bias is recommended"});
  } else if (has_answer && results.measurement->shadows.front().advice) {
    Experiment used = cell_in_metres(stages, experiment, axes, least);
    used.shadow.bias.constant.number = answer->plateau->recommended.constant;
    ShadowMeasurement& shadow = results.measurement->shadows.front();
    shadow.advice->engines = advise_engines(stages, used, shadow.light);
  }
  results.notes = stages.notes();
  RunOutput output;
  output.experiment_toml = experiment_text(given);
  output.rows = &rows;
  output.costs = costs_text(stages.costs(), peak_resident_bytes());
  output.page = {make_figure_style(line.figures), !line.no_figures};
  return write_run(folder, console, std::move(results), std::move(output));
}

}  // namespace umbrameter
