#include <fmt/format.h>

#include <deque>
#include <set>

#include "app/commands.h"
#include "core/interrupt.h"
#include "core/parallel.h"
#include "experiments/measure/engine_advice.h"
#include "experiments/stages/reference_key.h"
#include "experiments/sweep/axis_effects.h"
#include "experiments/sweep/identity.h"
#include "experiments/sweep/page_cells.h"
#include "experiments/tune/tune_cases.h"
#include "experiments/tune/tune_journal.h"
#include "experiments/tune/tune_judgement.h"
#include "present/run_output.h"
#include "present/tune_report.h"
#include "present/tune_text.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "results/layers.h"
#include "scenes/builtin.h"
#include "store/run_value.h"

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

// The scenes of a tuning, which share an OpenGL context.
class Scenes {
 public:
  Scenes(const CommandLine& line, const Console& console, bool materials)
      : line_(line), console_(console), materials_(materials) {}

  Stages& load(const Experiment& experiment) {
    if (!frames_ && line_.engine) frames_ = stage_options(line_, console_, experiment).frames;
    if (!cache_) cache_ = chosen_cache(line_, console_);
    if (!context_ && !frames_) {
      context_ = std::make_shared<gl::Context>(gl::Context::make({line_.gl_device, line_.threads}));
    }
    return all_.emplace_back(
        load_scene(experiment.scene, experiment.view.scene, experiment.scene_params, load_options(line_, materials_)),
        StageOptions{line_.gl_device, line_.threads, cache_, experiment.scene, context_, frames_}, console_);
  }

 private:
  const CommandLine& line_;
  const Console& console_;
  bool materials_;
  std::shared_ptr<gl::Context> context_;
  std::shared_ptr<const FrameSource> frames_;
  std::optional<CacheFolder> cache_;
  std::deque<Stages> all_;
};

struct Job {
  std::vector<Experiment> experiments;  ///< one for each scene
  std::vector<TuneAxis> axes;
  TuneGoal goal;
  TuneGoal shown;           ///< the goal, with the metrics that are only shown
  std::string metrics;      ///< these, as given
  std::string for_engines;  ///< run.for
  SweptQuantity quantity = SweptQuantity::visibility;
  CaseAxes over, held_out;
};

Job make_job(const CommandLine& line) {
  const TuneOptions& options = line.tune;
  Job job;
  for (const std::string& scene : options.scenes.empty() ? std::vector<std::string>{""} : options.scenes) {
    CommandLine of_scene = line;
    of_scene.scene = scene;
    job.experiments.push_back(make_experiment(of_scene));
  }
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
  for (Experiment& experiment : job.experiments) {
    fix_reference(experiment, job.axes);
    experiment.axes.clear();
    experiment.run.metrics.clear();
    experiment.run.for_engines.clear();
  }
  return job;
}

// The cases that --held-out names; by default, a camera of the first scene that has one left.
std::vector<TuneCase> held_out_cases(const Job& job, Scenes& scenes,
                                     const std::vector<std::vector<TuneCase>>& by_scene) {
  std::vector<TuneCase> cases;
  const auto add = [&](Stages& stages, const Experiment& experiment, const CaseAxes& over) {
    const std::vector<TuneCase> more = cases_of(stages, experiment, job.quantity, over);
    cases.insert(cases.end(), more.begin(), more.end());
  };
  CaseAxes over = job.over;
  for (const auto& [key, text] : job.held_out) {
    if (key == "scene") continue;
    std::erase_if(over, [&, &k = key](const auto& each) { return each.first == k; });
    over.emplace_back(key, text);
  }
  bool names_scenes = false;
  for (const auto& [key, text] : job.held_out) {
    if (key != "scene") continue;
    names_scenes = true;
    Experiment experiment = job.experiments.front();
    experiment.scene = text;
    CaseAxes without_names = job.held_out;  // cameras and lights of other scenes mean nothing here
    std::erase_if(without_names, [](const auto& each) { return each.first == "scene"; });
    add(scenes.load(experiment), experiment, without_names);
  }
  if (names_scenes) return cases;
  for (std::size_t s = 0; s < by_scene.size(); ++s) {
    if (!job.held_out.empty()) {
      add(*by_scene[s].front().stages, job.experiments[s], over);
      continue;
    }
    const std::string camera = unused_camera(by_scene[s]);
    if (camera.empty()) continue;
    std::erase_if(over, [](const auto& each) { return each.first == "view.camera"; });
    Experiment experiment = job.experiments[s];
    experiment.view.camera = camera;
    add(*by_scene[s].front().stages, experiment, over);
  }
  return cases;
}

// A case that the search sees proves nothing of the result.
void require_unseen(const Job& job, const std::vector<TuneCase>& cases, const std::vector<TuneCase>& held_out) {
  for (const TuneCase& unseen : held_out) {
    for (const TuneCase& each : cases) {
      if (each.title != unseen.title || each.experiment.scene != unseen.experiment.scene) continue;
      std::string given;
      for (const auto& [key, text] : job.held_out) given += fmt::format(" --held-out {}={}", key, text);
      throw Error(ExitCode::usage, given.empty() ? "held-out case" : given.substr(1),
                  fmt::format("the search uses this case, too: {}", each.title),
                  "hold out a camera or a scene that the search does not use");
    }
  }
}

// All that the evaluations depend on.
std::vector<std::pair<std::string, std::string>> settings_of(const Job& job, const CommandLine& line,
                                                             const std::vector<std::vector<TuneCase>>& by_scene) {
  std::vector<std::pair<std::string, std::string>> settings = measuring_identity(*by_scene.front().front().stages);
  settings.emplace_back("the cost", line.tune.minimize);
  const auto list = [&](const char* name, const auto& texts) {
    std::string all;
    for (const auto& text : texts) all += text + "\n";
    settings.emplace_back(name, all);
  };
  list("a constraint", line.tune.constraints);
  std::vector<std::string> axes;
  for (const TuneAxis& axis : job.axes) axes.push_back(axis.key() + "=" + axis.axis.text);
  list("an axis", axes);
  for (std::size_t s = 0; s < by_scene.size(); ++s) {
    Stages& stages = *by_scene[s].front().stages;
    std::string text = job.experiments[s].scene + " " + scene_content(stages.scene());
    for (const TuneCase& each : by_scene[s]) {
      Experiment experiment = each.experiment;
      text += "\n" + each.title + " " + surfel_content(stages.surfels(experiment)->gbuffer) + "\n" +
              umbrameter::key_of(describe(experiment));
    }
    settings.emplace_back(fmt::format("scene {}", s + 1), text);
  }
  return settings;
}

std::string experiment_of(const Job& job, const CommandLine& line) {
  std::string text = "# umbrameter tune\n";
  for (const Experiment& experiment : job.experiments) text += "#   " + experiment.scene + "\n";
  text += "#   --minimize '" + line.tune.minimize + "'" + (line.tune.worst_case ? " --worst-case" : "") +
          (line.tune.relative ? " --relative" : "") + "\n";
  for (const std::string& each : line.tune.constraints) text += "#   --constraint '" + each + "'\n";
  for (const std::string& each : line.tune.over) text += "#   --over " + each + "\n";
  if (!job.metrics.empty()) text += "#   --run.metrics " + job.metrics + "\n";
  for (const TuneAxis& axis : job.axes) text += "#   --vary " + axis.key() + "=" + axis.axis.text + "\n";
  return text + experiment_text(job.experiments.front());
}

// What compare runs: the given experiment with the best values, over all lights and the first camera.
std::string tuned_text(const Job& job, const TuneSummary& summary) {
  Experiment tuned = job.experiments.front();
  if (are_all_equal(summary.result)) {
    return "# `umbrameter tune` found no difference between the points: these are the given values.\n" +
           experiment_text(tuned);
  }
  for (std::size_t a = 0; a < job.axes.size(); ++a) {
    set_value(describe(tuned), job.axes[a].axis, summary.result.best.values[a]);
  }
  const std::size_t cases = summary.cases.size();
  const std::string over =
      cases > 1 ? fmt::format(", {} of {} cases", summary.goal.is_worst_case ? "the worst" : "the mean", cases) : "";
  return fmt::format("# The best point of `umbrameter tune`: {} = {}{}.\n", cost_name(summary.goal),
                     cost_text(summary.goal, summary.result.best.score.cost), over) +
         experiment_text(tuned);
}

TuneResult search(const Job& job, const std::vector<TuneCase>& cases, const TuneOptions& options, TuneJournal& journal,
                  const std::filesystem::path& folder, const Console& console) {
  if (journal.count() > 0) note(console, fmt::format("{} evaluations are done; resuming", journal.count()));
  TuneInput input{job.axes, cases, job.goal, {options.evaluations, options.minutes}, {}};
  Experiment given = job.experiments.front();
  for (const TuneAxis& axis : job.axes) input.given.push_back(present_value(describe(given), axis));
  for (const TuneCase& each : cases) each.stages->report_tracing([](double) {});
  try {
    ProgressBar bar(console, "evaluations");
    bar.show(0.0);
    TuneResult result = tune(input, journal, [&](std::size_t done, std::size_t all, const TuneScore& best) {
      bar.show(static_cast<double>(done) / static_cast<double>(all),
               fmt::format("{} of at most {}, {} {}", done, all, job.goal.text, cost_text(job.goal, best.cost)));
    });
    return result;
  } catch (const Error& error) {
    if (error.code() != ExitCode::interrupted && error.code() != ExitCode::terminated) throw;
    throw_if_interrupted(fmt::format("{} evaluations are stored in {}; rerun the command to resume", journal.count(),
                                     (folder / tune_journal_name).string()));
    throw;
  }
}

std::vector<TunePointImages> measure_points(const TuneCase& first, const TuneSummary& summary) {
  Stages& stages = *first.stages;
  const auto images = [&](const char* name, const Experiment& experiment, const TunePoint& point) {
    TunePointImages measured{name, point_text(summary.axes, point.values),
                             measure_swept(stages, experiment, first.quantity)};
    move_to_layers(stages.facts(), measured.measurement);
    return measured;
  };
  const TuneResult& result = summary.result;
  return {images("best", at_point(first, summary.axes, result.best.values), result.best),
          images("default", first.experiment, result.before)};
}

// Texels and depth ranges differ from case to case, and with them an engine's numbers.
std::vector<CaseEngines> engines_of(const Job& job, const std::vector<TuneCase>& cases, const TuneSummary& summary) {
  std::vector<CaseEngines> all;
  if (job.for_engines.empty()) return all;
  for (const TuneCase& each : cases) {
    Experiment best = at_point(each, summary.axes, summary.result.best.values);
    best.run.for_engines = job.for_engines;
    Stages& stages = *each.stages;
    if (stages.is_sampled(best, each.light) || !stages.capabilities(best).taps_independent_of_bias) {
      stages.add_notes({no_engines_text(each.title)});
      continue;
    }
    all.push_back({each.title, advise_engines(stages, best, each.light)});
  }
  return all;
}

std::vector<std::string> tune_files() {
  return {"experiment.toml", tuned_file,   "evaluations.csv", run_value_file,
          "summary.json",    "index.html", tune_journal_name};
}

}  // namespace

ExitCode run_tune_command(const CommandLine& line, const Console& console) {
  const Job job = make_job(line);
  RunFolder folder(line.output, RunPlan{line.command, experiment_of(job, line), tune_files()}, line.force);
  const std::filesystem::path journal_path = folder.path() / tune_journal_name;
  const ThreadLimit threads(line.threads);
  Scenes scenes(line, console, job.quantity == SweptQuantity::image);

  std::vector<std::vector<TuneCase>> by_scene;
  std::vector<TuneCase> cases;
  bool varies_map = false;
  for (const TuneAxis& axis : job.axes) varies_map = varies_map || depends_on(Stage::map, axis.key());
  for (const Experiment& experiment : job.experiments) {
    Stages& stages = scenes.load(experiment);
    by_scene.push_back(cases_of(stages, experiment, job.quantity, job.over));
    stages.keep_cases(by_scene.back().size(), !varies_map);
    cases.insert(cases.end(), by_scene.back().begin(), by_scene.back().end());
  }
  const std::vector<TuneCase> unseen = held_out_cases(job, scenes, by_scene);
  require_unseen(job, cases, unseen);
  for (const TuneCase& each : cases) require_statistics(each, job.shown);
  for (const TuneCase& each : cases) prepare(each);

  if (line.force) std::filesystem::remove(journal_path);
  folder.announce({tune_journal_name});
  TuneJournal journal(journal_path, settings_of(job, line, by_scene));
  folder.begin();
  write_text(folder.path() / "experiment.toml", experiment_of(job, line));
  const TuneResult result = search(job, cases, line.tune, journal, folder.path(), console);

  const TuneJudgement judgement = [&] {
    ProgressBar bar(console, "significance");
    return judge({job.axes, cases, unseen, result.goal, job.shown, result}, [&](double share) { bar.show(share); });
  }();
  RunResults results{line.command, job.experiments.front(), cases.front().stages->facts(), embree_version()};
  set_renderer(results, *cases.front().stages);
  for (const TuneAxis& axis : job.axes) results.experiment.axes.emplace_back(axis.key(), axis.axis.text);
  results.tune = TuneFindings{{job.axes, titles_of(cases), result.goal, job.shown, result, judgement}, by_scene.size()};
  const TuneSummary& summary = results.tune->summary;
  results.tune->engines = engines_of(job, cases, summary);
  if (!line.no_figures) results.tune->points = measure_points(cases.front(), summary);
  std::set<std::string> notes;
  for (const auto& of_scene : by_scene) {
    for (const std::string& text : of_scene.front().stages->notes()) {
      if (notes.insert(text).second) results.notes.push_back(text);
    }
  }
  RunOutput output;
  output.experiment_toml = experiment_of(job, line);
  output.texts = {{tuned_file, tuned_text(job, summary)}, {"evaluations.csv", to_csv(evaluation_table(summary))}};
  output.closing = {
      fmt::format("tuned: {0}; run it with 'umbrameter compare -c {0} -o DIR'", (folder.path() / tuned_file).string())};
  output.journal = journal_path;
  output.page = {make_figure_style(line.figures), !line.no_figures};
  return write_run(folder, console, std::move(results), std::move(output));
}

}  // namespace umbrameter
