#include "app/dry_run.h"

#include <fmt/format.h>

#include "app/print_json.h"
#include "core/lists.h"
#include "experiments/settings/shard_cuts.h"
#include "present/presentation_parts.h"
#include "reports/files/text_layout.h"
#include "scenes/view.h"

namespace umbrameter {
namespace {

using Row = std::pair<std::string, std::string>;

std::string light_text(const Stages& stages, const Experiment& experiment, std::uint32_t light) {
  return fmt::format("{} ({}{})", stages.title(light), kind_of(stages.light(experiment, light)),
                     is_area(stages.light(experiment, light)) ? ", area light" : "");
}

Row scene_row(const Stages& stages, const Experiment& experiment) {
  const SceneCounts counts = count(stages.scene());
  return {"scene", fmt::format("{}, {} triangles", scene_title(experiment), grouped(counts.triangles))};
}

Row view_row(const Console& console, const Stages& stages, const ViewParams& params) {
  std::vector<std::string> notes;
  const double aspect = static_cast<double>(params.size.width) / params.size.height;
  const Camera camera = select_camera(stages.scene(), params.camera, aspect, notes);
  for (const std::string& text : notes) note(console, text);
  return {"view", fmt::format("{}×{} pixels, {}", params.size.width, params.size.height,
                              camera.name.empty() ? "a camera without a name" : "camera " + camera.name)};
}

std::string value_of(Experiment experiment, const std::string& key) {
  return to_string(require(describe(experiment), key).value());
}

std::string shadow_text(const Experiment& experiment) {
  const std::string name = technique_name(experiment);
  if (!reads_map(experiment)) return name;
  const bool has_filter = std::holds_alternative<Pcf>(make_technique(experiment.shadow));
  return fmt::format("shadow maps of {}² texels, {}{}", experiment.shadow.map.resolution, name,
                     has_filter ? ", " + value_of(experiment, "shadow.filter") + " filter" : "");
}

// "256 rays per pixel for AO, the shadow of lamp; 1 ray per pixel for other shadows".
std::string reference_text(const Stages& stages, const Experiment& experiment) {
  const TruthParams& truth = experiment.truth;
  std::vector<std::string> sampled;
  std::string hard;
  if (measures_ao(experiment)) sampled.emplace_back("AO");
  for (const std::uint32_t light : stages.lights(experiment.view.light)) {
    if (!measures_shadows(experiment)) break;
    if (stages.is_sampled(experiment, light)) {
      sampled.push_back("the shadow of " + stages.title(light));
    } else {
      hard = "1 ray per pixel for ";
    }
  }
  if (!hard.empty()) hard += sampled.empty() || sampled == std::vector<std::string>{"AO"} ? "shadows" : "other shadows";
  if (sampled.empty()) return hard;
  const std::string rays =
      truth.tolerance > 0.0 ? fmt::format("{} to {}", truth.min_spp, truth.max_spp) : fmt::format("{}", truth.spp);
  return fmt::format("{} rays per pixel for {}{}{}", rays, joined(sampled, ", "), hard.empty() ? "" : "; ", hard);
}

ExitCode show(const Console& console, const std::vector<Row>& rows) {
  nlohmann::ordered_json json;
  for (const auto& [key, text] : rows) {
    print_line(console, fmt::format("{:<10} {}", key, text));
    json[key] = text;
  }
  print_json(console, json);
  return ExitCode::ok;
}

}  // namespace

ExitCode show_image_plan(const CommandLine& line, const Console& console, Stages& stages,
                         const Experiment& experiment) {
  std::vector<Row> rows = {scene_row(stages, experiment), view_row(console, stages, experiment.view)};
  const std::string lights = joined(stages.lights(experiment.view.light), ", ",
                                    [&](std::uint32_t light) { return light_text(stages, experiment, light); });
  const bool shadows = measures_shadows(experiment);
  const bool ao = measures_ao(experiment);
  if (shadows) rows.emplace_back("lights", lights);
  if (line.command != "trace") {
    const std::string maps = shadow_text(experiment);
    const std::string samples = fmt::format("{}, {} per pixel", title_of(make_technique(experiment.ao)),
                                            sampling_text(make_technique(experiment.ao)));
    rows.emplace_back("technique", !ao ? maps : !shadows ? samples : maps + "; " + samples);
  }
  if (line.command != "raster") rows.emplace_back("reference", reference_text(stages, experiment));
  rows.emplace_back("files", std::string("index.html, summary.json, images.exr, experiment.toml") +
                                 (line.no_figures ? "" : ", figures/") +
                                 (line.output.empty() ? std::string() : " in " + line.output.string()));
  return show(console, rows);
}

SweepCosts measure_costs(SweepRun& sweep) {
  Stages& stages = *sweep.stages;
  const EvaluateGroup evaluate = make_evaluator(stages, sweep.experiment, sweep.axes, sweep.statistics);
  const WorkClock work = stages.work_clock();
  const double begin = clock_seconds();
  const double work_begin = work();
  SweepCosts costs = measure_costs(sweep.plan, cost_budget, [&](const CellGroup& group) {
    return stages.time_stages([&] { evaluate(group, [](std::size_t, std::span<const Value>) {}); });
  });
  const double scale = (clock_seconds() - begin) / (work() - work_begin);
  costs.start_seconds *= scale;
  for (SweepCosts::Part& part : costs.parts) part.seconds *= scale;
  return costs;
}

ExitCode show_sweep_plan(const Console& console, SweepRun& sweep) {
  Stages& stages = *sweep.stages;
  const SweepPlan& plan = sweep.plan;
  std::vector<Row> rows = {scene_row(stages, sweep.experiment), view_row(console, stages, sweep.experiment.view)};
  const SweptQuantity quantity = quantity_of(sweep.statistics);
  if (quantity != SweptQuantity::ao) {
    const std::vector<std::uint32_t> lights = swept_lights(stages, sweep.experiment, sweep.axes, quantity);
    rows.emplace_back("light", joined(lights, ", ", [&](std::uint32_t light) {
                        return light_text(stages, sweep.experiment, light);
                      }));
  }
  rows.emplace_back("measures", quantity_title(quantity));
  rows.emplace_back("axes", joined(sweep.axes, "; ", [](const SweepAxis& axis) {
                      return fmt::format("{}, {} values ({})", axis.key, axis.values.size(), axis.text);
                    }));
  rows.emplace_back("cells", grouped(plan.cells));
  const std::size_t groups = count_groups(plan);
  rows.emplace_back("groups", fmt::format("{} of at most {} cell{}; {}", grouped(groups),
                                          grouped(group_at(plan, 0).size()), group_at(plan, 0).size() == 1 ? "" : "s",
                                          is_one_pass(stages, sweep.experiment, sweep.axes, sweep.statistics)
                                              ? "one pass measures all cells of a group"
                                              : "each cell is measured separately"));
  const SweepCosts costs = measure_costs(sweep);
  const double seconds = GroupCosts(costs, plan).seconds(0, groups);
  const std::string time = seconds < 1.0 ? "less than 1 s" : "about " + time_text(seconds);
  rows.emplace_back("time", fmt::format("{} to measure, plus the report; estimated from {} trial measurements", time,
                                        costs.measured));
  return show(console, rows);
}

}  // namespace umbrameter
