#include "app/tune_job.h"

#include <set>
#include <utility>

#include "experiments/measure/engine_advice.h"
#include "experiments/sweep/axis_effects.h"
#include "present/run_output.h"

namespace umbrameter {
namespace {

std::vector<std::pair<std::string, std::string>> split_all(const std::vector<std::string>& assignments,
                                                           const std::string& option) {
  std::vector<std::pair<std::string, std::string>> result;
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos) {
      throw Error(ExitCode::usage, option + " " + assignment, "no '='", "write it like " + option + " view.camera=all");
    }
    result.emplace_back(assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  return result;
}

std::vector<TuneAxis> parse_tune_axes(Experiment experiment) {
  if (experiment.axes.empty()) {
    throw Error(ExitCode::usage, "tune", "nothing to vary",
                "add an axis, such as --vary shadow.constant-bias=0:8texels");
  }
  const Parameters parameters = describe(experiment);
  std::vector<TuneAxis> axes;
  std::set<std::string> keys;
  for (const auto& [key, text] : experiment.axes) {
    axes.push_back(parse_tune_axis(parameters, key, text));
    if (!keys.insert(key).second) throw Error(ExitCode::usage, "--vary " + key, "the axis is given twice");
    const std::string group = key.substr(0, key.find('.'));
    if (group != "shadow" && group != "ao" && group != "shading" && group != "engine") {
      throw Error(ExitCode::usage, "--vary " + key,
                  "only the technique can be tuned: shadow.*, ao.* and shading.*, or an engine's engine.*",
                  group == "view" || group == "light" ? "use --over to take the mean over several" : "");
    }
  }
  return axes;
}

void check_over(const std::vector<TuneAxis>& axes, const CaseAxes& over, const std::string& option) {
  std::set<std::string> keys;
  for (const auto& [key, text] : over) {
    if (!keys.insert(key).second) throw Error(ExitCode::usage, option + " " + key, "it is given twice");
    for (const TuneAxis& axis : axes) {
      if (axis.key() == key) throw Error(ExitCode::usage, option + " " + key, "the parameter is varied, too");
    }
    if (key.starts_with("scene.") || key == "view.scene") {
      throw Error(ExitCode::usage, option + " " + key, "a scene is loaded only once", "name several SCENEs");
    }
  }
}

// The reference must not follow a radius that is tuned.
void fix_reference(Experiment& experiment, const std::vector<TuneAxis>& axes) {
  for (const TuneAxis& axis : axes) {
    if (axis.key() != "ao.radius" || experiment.truth.ao_distance.unit != LengthUnit::automatic) continue;
    experiment.truth.ao_distance = experiment.ao.sampling.radius;
  }
}

}  // namespace

std::vector<std::pair<std::string, std::string>> pairs_of(const TuneOptions& options) {
  std::vector<std::pair<std::string, std::string>> pairs;
  const auto add = [&](const char* name, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) pairs.emplace_back(name, text);
  };
  add("scene", options.scenes);
  add("minimize", {options.minimize});
  add("constraint", options.constraints);
  add("over", options.over);
  add("held-out", options.held_out);
  if (options.worst_case) add("worst-case", {"true"});
  if (options.relative) add("relative", {"true"});
  add("evaluations", {std::to_string(options.evaluations)});
  return pairs;
}

TuneOptions tune_options(const std::vector<std::pair<std::string, std::string>>& pairs) {
  TuneOptions options;
  for (const auto& [name, text] : pairs) {
    if (name == "scene") options.scenes.push_back(text);
    if (name == "minimize") options.minimize = text;
    if (name == "constraint") options.constraints.push_back(text);
    if (name == "over") options.over.push_back(text);
    if (name == "held-out") options.held_out.push_back(text);
    if (name == "worst-case") options.worst_case = true;
    if (name == "relative") options.relative = true;
    if (name == "evaluations") options.evaluations = std::stoull(text);
  }
  return options;
}

std::vector<Experiment> tuned_experiments(const CommandLine& line) {
  std::vector<Experiment> experiments;
  for (const std::string& scene : line.tune.scenes.empty() ? std::vector<std::string>{""} : line.tune.scenes) {
    CommandLine of_scene = line;
    of_scene.scene = scene;
    experiments.push_back(make_experiment(of_scene));
  }
  return experiments;
}

TuneJob make_tune_job(const TuneOptions& options, std::vector<Experiment> experiments) {
  TuneJob job;
  job.experiments = std::move(experiments);
  Experiment& first = job.experiments.front();
  job.axes = parse_tune_axes(first);
  job.over = split_all(options.over, "--over");
  job.held_out = split_all(options.held_out, "--held-out");
  check_over(job.axes, job.over, "--over");
  check_over(job.axes, job.held_out, "--held-out");
  std::vector<SweepAxis> axes;
  for (const TuneAxis& axis : job.axes) axes.push_back(axis.axis);
  job.quantity = choose_quantity(first.run.measure, axes);
  std::vector<SweepAxis> over;
  for (const auto& [key, text] : job.over) {
    // Names of cameras and lights mean nothing before a scene is loaded, and no technique reads them.
    if (!key.starts_with("view.")) over.push_back(parse_axis(describe(first), key, text));
  }
  require_effect(job.quantity, job.experiments, axes, over);
  for (const Experiment& experiment : job.experiments) {
    check_bias_engines(experiment, job.quantity == SweptQuantity::visibility);
  }
  const std::string kind = job.quantity == SweptQuantity::ao      ? "ao"
                           : job.quantity == SweptQuantity::image ? "image"
                                                                  : "shadow";
  job.goal = make_goal(options.minimize, options.constraints, kind, job.axes, options.worst_case);
  job.goal.is_relative = options.relative;
  job.shown = with_metrics(job.goal, first.run, kind);
  job.metrics = first.run.metrics;
  job.for_engines = first.run.for_engines;
  for (const TuneAxis& axis : job.axes) job.given.push_back(present_value(describe(first), axis));
  for (Experiment& experiment : job.experiments) {
    fix_reference(experiment, job.axes);
    experiment.axes.clear();
    experiment.run.metrics.clear();
    experiment.run.for_engines.clear();
  }
  return job;
}

std::string experiment_of(const TuneJob& job, const TuneOptions& options) {
  std::string text = "# umbrameter tune\n";
  for (const Experiment& experiment : job.experiments) text += "#   " + experiment.scene + "\n";
  text += "#   --minimize '" + options.minimize + "'" + (options.worst_case ? " --worst-case" : "") +
          (options.relative ? " --relative" : "") + "\n";
  for (const std::string& each : options.constraints) text += "#   --constraint '" + each + "'\n";
  for (const std::string& each : options.over) text += "#   --over " + each + "\n";
  if (!job.metrics.empty()) text += "#   --run.metrics " + job.metrics + "\n";
  for (const TuneAxis& axis : job.axes) text += "#   --vary " + axis.key() + "=" + axis.axis.text + "\n";
  return text + experiment_text(job.experiments.front());
}

}  // namespace umbrameter
