#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "app/commands.h"
#include "app/dry_run.h"
#include "core/lists.h"
#include "core/parallel.h"
#include "experiments/engine/frame_files.h"
#include "experiments/measure/ao_input_files.h"
#include "experiments/measure/bias_advice.h"
#include "experiments/measure/debug_views.h"
#include "experiments/measure/engine_advice.h"
#include "experiments/measure/map_files.h"
#include "experiments/measure/measure.h"
#include "experiments/measure/measure_ao_stages.h"
#include "experiments/measure/measure_image.h"
#include "experiments/measure/shadow_shape.h"
#include "experiments/settings/sweep.h"
#include "experiments/stages/reference_cache.h"
#include "experiments/sweep/sweep_evaluator.h"
#include "present/presentation_parts.h"
#include "present/run_output.h"
#include "reports/files/data.h"
#include "reports/files/markup.h"
#include "reports/files/text_layout.h"
#include "results/known_statistics.h"
#include "results/layers.h"
#include "results/metric_columns.h"
#include "results/number_text.h"
#include "scenes/builtin.h"
#include "scenes/emitter.h"
#include "store/experiment_file.h"
#include "store/gate.h"
#include "store/preset.h"

namespace umbrameter {
namespace {

Sides sides_of(const std::string& command) {
  if (command == "trace") return {false, true};
  if (command == "raster") return {true, false};
  return {true, true};
}

// TOML is UTF-8: another path could not be read back from experiment.toml.
void require_utf8(const std::string& path) {
  if (is_utf8(path)) return;
  throw Error(ExitCode::usage, path, "the path is not UTF-8 and cannot be stored in experiment.toml",
              "rename the file or its folder");
}

// run.measure selects what is measured, and other settings refer to parts of it.
void require_measured(const Experiment& experiment, const std::vector<BudgetEntry>& conditions) {
  const bool shadows = measures_shadows(experiment);
  const bool ao = measures_ao(experiment);
  if (shadows && ao) return;
  const std::string chosen = shadows ? "--measure visibility" : "--measure ao";
  const auto require = [&](bool is_given, bool is_measured, const std::string& option, const std::string& part) {
    if (!is_given || is_measured) return;
    throw Error(ExitCode::usage, option, "it needs " + part + ", which " + chosen + " leaves out", "omit one of them");
  };
  const RunParams& run = experiment.run;
  require(run.shimmer, shadows, "--shimmer", "shadows");
  require(run.write_maps, shadows, "--write-maps", "shadows");
  require(run.ao_stages, ao, "--ao-stages", "ambient occlusion");
  require(run.write_ao_inputs, ao, "--write-ao-inputs", "ambient occlusion");
  require(!run.overlay.empty(), false, "--overlay", "the shaded image");
  for (const BudgetEntry& condition : conditions) {
    const std::vector<KnownStatistic> known =
        require_statistic(parse_statistic_name(condition.statistic), condition.place);
    const bool is_measured = std::ranges::any_of(
        known, [&](const KnownStatistic& each) { return each.kind == (shadows ? "shadow" : "ao"); });
    const bool is_of_image =
        std::ranges::all_of(known, [](const KnownStatistic& each) { return each.kind == "image"; });
    require(true, is_measured, condition.place,
            is_of_image ? "the shaded image"
            : shadows   ? "ambient occlusion"
                        : "shadows");
  }
}

// Which statistics a shadow has is known before it is measured: against a sampled reference none has causes, and
// filtered maps never have.
void require_in_shadows(const Stages& stages, const Experiment& experiment, const std::vector<std::uint32_t>& lights,
                        const std::vector<BudgetEntry>& conditions) {
  std::set<std::string> measured;
  for (const std::uint32_t light : lights) {
    Experiment of_light = experiment;
    of_light.view.light = std::to_string(light);
    CellStatistics statistics = choose_statistics(stages, of_light, {}, SweptQuantity::visibility);
    for (const MetricColumn& column : swept_metrics(experiment, statistics)) measured.insert(column.name);
    for (const Statistic& each : describe(statistics)) measured.insert(each.name);
  }
  for (const BudgetEntry& condition : conditions) {
    const std::vector<KnownStatistic> known =
        require_statistic(parse_statistic_name(condition.statistic), condition.place);
    const bool is_of_shadows =
        std::ranges::all_of(known, [](const KnownStatistic& each) { return each.kind == "shadow"; });
    if (!is_of_shadows || measured.contains(known.front().name)) continue;
    const bool is_cause = std::ranges::find(cause_names, known.front().name) != cause_names.end();
    throw Error(
        ExitCode::usage, condition.place,
        std::string("no shadow of this run has this statistic") +
            (is_cause ? "; it needs a technique whose acne can be counted, and a hard reference: a light without "
                        "extent, and --truth.shadow point"
                      : ""),
        "choose one of: " + joined(measured, ", "));
  }
}

// What an engine's frames do not hold.
void require_engine_can(const Experiment& experiment) {
  if (renderer_title(experiment).empty()) return;
  const RunParams& run = experiment.run;
  const std::pair<bool, const char*> ours[] = {
      {run.shimmer, "--shimmer"},          {run.ao_stages, "--ao-stages"},
      {run.write_maps, "--write-maps"},    {run.write_ao_inputs, "--write-ao-inputs"},
      {!run.overlay.empty(), "--overlay"}, {run.measure == SweepMeasure::image, "--measure image"}};
  for (const auto& [is_given, option] : ours) {
    if (!is_given) continue;
    throw Error(ExitCode::usage, option, "it looks into our own techniques, not into an engine", "leave it out");
  }
}

// Of an engine or a frame: what it has to show.
void choose_measured(const CommandLine& line, Experiment& given) {
  const FrameParams& frame = given.frame;
  const bool has_frame = has_files(frame);
  if (line.command == "evaluate" && (!has_frame || line.engine)) {
    throw Error(ExitCode::usage, "evaluate", has_frame ? "it reads files, not an engine" : "no frame given",
                has_frame ? "leave --engine out" : "add --visibility FILE, --ao FILE, or --lit FILE --unshadowed FILE");
  }
  if (line.command != "evaluate" && has_frame) {
    throw Error(ExitCode::usage, "--frame.visibility", line.command + " draws its own frames",
                "use umbrameter evaluate");
  }
  if (given.run.measure != SweepMeasure::automatic || (!line.engine && !has_frame)) return;
  const bool shadows = line.engine ? shows_shadows(line.engine->description()) : shows_shadows(frame);
  const bool ao = line.engine ? shows_ao(line.engine->description()) : shows_ao(frame);
  if (!ao) given.run.measure = SweepMeasure::visibility;
  if (!shadows) given.run.measure = SweepMeasure::ao;
}

// Image metrics are measured only if run.metrics names them.
void add_metrics(Experiment& experiment, const std::vector<BudgetEntry>& conditions) {
  for (const BudgetEntry& condition : conditions) {
    const std::string metric = metric_to_measure(condition.statistic);
    if (metric.empty() || ("," + experiment.run.metrics + ",").find("," + metric + ",") != std::string::npos) continue;
    experiment.run.metrics += (experiment.run.metrics.empty() ? "" : ",") + metric;
  }
}

}  // namespace

void add_setting_notes(Stages& stages, const CommandLine& line, const Experiment& experiment,
                       const std::vector<std::uint32_t>& lights) {
  const std::string& factors = experiment.shadow.fit.cascade_bias;
  if (!factors.empty() && factors != own_range) {
    stages.add_notes(
        {fmt::format("constant biases are stated for the factor 1; shadow.cascade-bias multiplies them by {}",
                     shortened(factors, 60))});
  }
  for (const std::string& name : line.presets) {
    const Preset preset = require_preset(name);
    std::string text = fmt::format("preset {}: {}, {}", name, preset.engine, preset.meaning);
    if (!preset.differs.empty()) text += "; what differs: " + preset.differs;
    if (text.ends_with('.')) text.pop_back();
    std::string others;
    for (const std::uint32_t light : lights) {
      if (preset.kind == "ao" || kind_of(stages.scene().lights[light]) == preset.kind) continue;
      others += (others.empty() ? "" : ", ") + stages.title(light);
    }
    if (!others.empty()) {
      text += fmt::format("; it is meant for {} lights, but is used for {}, too: choose the light with --light",
                          preset.kind, others);
    }
    stages.add_notes({text});
  }
}

namespace {

// Whether the technique needs the light's extent, and the light has none.
bool lacks_extent(const Stages& stages, const Experiment& experiment, std::uint32_t light) {
  return stages.capabilities(experiment).reads_light_extent &&
         !is_area(with_extent(stages.scene().lights[light], experiment.light));
}

// PCSS and DPCF of a light without extent read one texel. As PCF, which reads the same, their errors have causes and a
// bias can be recommended.
Experiment as_pcf(Experiment experiment) {
  experiment.shadow.technique = ShadowTechniques::choice<Pcf>;
  experiment.shadow.pcf.filter = ShadowFilter::nearest;
  experiment.shadow.pcf.taps = FilterTaps::nearest;
  return experiment;
}

}  // namespace

void add_technique_notes(Stages& stages, const Experiment& experiment, const std::vector<std::uint32_t>& lights) {
  for (const std::uint32_t light : lights) {
    if (!lacks_extent(stages, experiment, light)) continue;
    const bool is_sun = std::holds_alternative<DirectionalLight>(stages.scene().lights[light].shape);
    stages.add_notes(
        {fmt::format("{} has no extent, so that {} reads its map like pcf with filter nearest; set --light.{}",
                     stages.title(light), value_text(experiment, "shadow.technique"), is_sun ? "angle" : "radius")});
  }
}

void check_bias_engines(const Experiment& experiment, bool measures_shadows) {
  if (experiment.run.for_engines.empty()) return;
  if (!renderer_title(experiment).empty()) {
    throw Error(ExitCode::usage, "--for", "it converts the bias of our own techniques, which are not used here",
                "leave it out");
  }
  if (!measures_shadows) {
    throw Error(ExitCode::usage, "--for", "it needs shadows, which are not measured here", "leave it out");
  }
}

Experiment make_experiment(const CommandLine& line) {
  Experiment experiment;
  for (const std::string& preset : line.presets) apply_preset(require_preset(preset), describe(experiment));
  if (!line.experiment_file.empty()) experiment = load_experiment(line.experiment_file, std::move(experiment));
  const Parameters parameters = describe(experiment);
  if (!line.vary.empty()) experiment.axes.clear();
  for (const std::string& assignment : line.vary) experiment.axes.push_back(split_assignment(assignment));
  for (const auto& [key, text] : line.settings) require(parameters, key).set_text(text);
  if (!line.scene.empty()) experiment.scene = line.scene;
  if (experiment.scene.empty()) {
    throw Error(ExitCode::usage, "SCENE", "no scene given",
                "name a .gltf or .glb file or a built-in scene ('umbrameter scenes' lists them)");
  }
  for (const Parameter& parameter : file_parameters(experiment.frame)) {
    std::string& file = *std::get<std::string*>(parameter.field);
    if (file.empty()) continue;
    file = std::filesystem::absolute(file).lexically_normal().string();
    if (std::filesystem::exists(parse_frame_path(file).file)) continue;
    throw Error(ExitCode::unreadable_input, "cannot read " + file, "there is no such file");
  }
  // A stored experiment must find its file from any folder.
  if (std::filesystem::is_regular_file(experiment.scene)) {
    experiment.scene = std::filesystem::absolute(experiment.scene).lexically_normal().string();
    require_utf8(experiment.scene);
  }
  // An unknown name is refused before any work.
  metric_columns(experiment.run, true);
  if (!experiment.run.for_engines.empty()) parse_bias_targets(experiment.run.for_engines);
  // A side that works alone makes its own surfels.
  if (line.command == "trace") experiment.view.surfels = SurfelSource::traced;
  if (line.command == "raster") experiment.view.surfels = SurfelSource::raster;
  return experiment;
}

StageOptions stage_options(const CommandLine& line, const Console& console, const Experiment& experiment,
                           const dvec3& origin) {
  StageOptions options{line.gl_device, line.threads, chosen_cache(line, console), experiment.scene};
  if (line.engine) options.frames = std::make_shared<const FrameSource>(frames_of(line.engine));
  if (has_files(experiment.frame)) {
    options.frames = std::make_shared<const FrameSource>(frames_of(experiment.frame, origin));
  }
  return options;
}

void set_renderer(RunResults& results, Stages& stages) {
  (stages.has_engine() ? results.engine : results.opengl) = stages.renderer();
}

std::optional<CacheFolder> chosen_cache(const CommandLine& line, const Console& console) {
  if (line.no_cache || line.command == "raster") return {};
  return user_cache(console);
}

ExitCode run_image_command(const CommandLine& line, const Console& console) {
  Experiment given = make_experiment(line);
  const FigureStyle style = make_figure_style(line.figures);
  check_insets(style, given.view.size.width, given.view.size.height);
  const std::vector<BudgetEntry> conditions = budgets_of(line.fail_if);
  choose_measured(line, given);
  require_engine_can(given);
  check_bias_engines(given, measures_shadows(given));
  require_measured(given, conditions);
  add_metrics(given, conditions);
  std::optional<RunFolder> run_folder;
  if (!line.dry_run) {
    run_folder.emplace(line.output, RunPlan{line.command, experiment_text(given), run_files(false)}, line.force);
  }
  const ThreadLimit threads(line.threads);
  Scene scene =
      load_scene(given.scene, given.view.scene, given.scene_params, load_options(line, measures_image(given)));
  given.view.camera = add_frame_camera(scene, given.frame, given.view.camera);
  const StageOptions options = stage_options(line, console, given, scene.origin);
  Stages stages(std::move(scene), options, console);
  Experiment experiment = stages.in_metres(given);
  experiment.axes.clear();  // of a file that a sweep reads as well
  const Sides sides = sides_of(line.command);
  const bool has_ao = measures_ao(experiment);
  std::vector<std::uint32_t> lights = stages.lights(experiment.view.light);
  if (measures_shadows(experiment)) {
    stages.check_is_meaningful(experiment, lights);
  } else {
    lights.clear();
  }
  if (has_files(experiment.frame) && lights.size() > 1) {
    throw Error(ExitCode::usage, "evaluate",
                fmt::format("the scene has {} lights, and a frame shows the shadow of one", lights.size()),
                fmt::format("add --light NAME, such as --light '{}'", stages.title(lights.front())));
  }
  if (!lights.empty()) require_in_shadows(stages, experiment, lights, conditions);
  add_setting_notes(stages, line, experiment, lights);
  add_technique_notes(stages, experiment, lights);
  if (has_ao && stages.has_engine() && given.truth.ao_distance.unit == LengthUnit::automatic) {
    stages.add_notes(
        {fmt::format("the reference of AO reaches {}, as our ao.radius does; set --truth.ao-distance to the "
                     "reach of {}",
                     metres_text(experiment.truth.ao_distance.number), stages.renderer())});
  }
  const bool has_image = measures_image(experiment);
  if (has_image) check_shading(stages, experiment);
  if (sides.raster) {
    check_debug_views(stages, experiment);
  } else if (!experiment.run.overlay.empty()) {
    throw Error(ExitCode::usage, "--overlay", "trace draws none of these views", "use compare or raster");
  }
  if (line.dry_run) return show_image_plan(line, console, stages, experiment);
  RunFolder& folder = *run_folder;

  Measurement measurement;
  measurement.experiment = experiment;
  measurement.surfels = *stages.surfels(experiment);
  // Tracing fills the cores while one of them compiles shaders.
  if (line.command == "compare" && has_ao) stages.begin_ao_truth(experiment);
  for (const std::uint32_t light : lights) {
    const Experiment drawn = lacks_extent(stages, experiment, light) ? as_pcf(experiment) : experiment;
    ShadowMeasurement shadow = measure_shadow(stages, drawn, light, sides);
    if (sides.raster && sides.truth) shadow.shape = measure_shape(stages, shadow);
    const VisibilityStatistics* causes = by_cause(shadow);
    const bool has_bias_curve = causes != nullptr && causes->pixels > 0;
    if (has_bias_curve && stages.capabilities(drawn).taps_independent_of_bias) {
      shadow.advice = advise_bias(stages, drawn, light);
    }
    if (!experiment.run.for_engines.empty() && !shadow.advice) {
      stages.add_notes({no_engines_text(stages, experiment, light)});
    } else if (shadow.advice && shadow.advice->withheld && !experiment.run.for_engines.empty()) {
      stages.add_notes({"--for: " + stages.title(light) + ": nothing to convert, as no bias is recommended"});
    }
    if (shadow.shape && experiment.run.shimmer) shadow.shape->shimmer = measure_shimmer(stages, shadow);
    measurement.shadows.push_back(std::move(shadow));
  }
  if (has_ao) measurement.ao = measure_ao(stages, experiment, sides);
  if (line.command == "compare" && experiment.run.ao_stages) {
    measurement.ao->stages =
        measure_ao_stages(stages, experiment, *measurement.ao->truth, *measurement.ao->raster, console);
  }
  if (has_image) measurement.image = measure_image(stages, experiment, lights, sides);
  measurement.picture = picture_of(stages, measurement);
  if (sides.raster && !experiment.run.overlay.empty()) {
    measurement.debug_views = make_debug_views(stages, measurement);
  }
  move_to_layers(stages.facts(), measurement);

  RunOutput output;
  output.experiment_toml = experiment_text(given);
  if (sides.raster && experiment.run.write_maps) {
    for (const std::uint32_t light : lights) {
      output.images.emplace_back(map_file_name(stages, light), map_layers(stages, experiment, light));
    }
  }
  if (sides.raster && experiment.run.write_ao_inputs) {
    output.images.emplace_back(ao_input_image_file, ao_input_layers(stages, experiment));
    output.texts.emplace_back(ao_input_values_file, ao_input_values(stages, experiment));
  }
  output.costs = costs_text(stages.costs(), peak_resident_bytes());
  output.page = {style, !line.no_figures};
  RunResults results{line.command, given, stages.facts(), embree_version()};
  results.notes = stages.notes();
  results.full_images = line.full_images;
  results.measurement = std::move(measurement);
  if (sides.raster) set_renderer(results, stages);
  const ExitCode code = write_run(folder, console, std::move(results), std::move(output));
  if (code != ExitCode::ok || conditions.empty()) return code;
  return show_checks(console, check_budget(conditions, read_run(line.output)));
}

}  // namespace umbrameter
