#include <fmt/format.h>

#include <algorithm>

#include "app/tune_run.h"
#include "core/interrupt.h"
#include "core/lists.h"
#include "experiments/measure/bias_advice.h"
#include "experiments/measure/engine_advice.h"
#include "experiments/measure/measure.h"
#include "experiments/sweep/page_cells.h"
#include "experiments/tune/tune_judgement.h"
#include "present/bias_advice_report.h"
#include "present/plateau_text.h"
#include "present/run_output.h"
#include "present/tune_report.h"
#include "present/tune_text.h"
#include "reports/files/data.h"
#include "reports/files/output.h"
#include "results/layers.h"
#include "store/run_value.h"

namespace umbrameter {
namespace {

// Which bias the file has, where it is not that of the best point.
std::string bias_comment(const TuneSummary& summary) {
  const TuneResult& result = summary.result;
  if (result.withheld) {
    return "# shadow.constant-bias is the given one; no bias recommended: " +
           withheld_text(*result.withheld, result.evidence) + ".\n";
  }
  if (!result.recommended) return {};
  return "# Its constant bias is the smallest with a cost within the range of the least and acne of at most 0.1 %.\n"
         "# The best point: " +
         point_text(summary.axes, result.best.values, digits_of_best(summary)) + ".\n";
}

// What compare runs: the given experiment with the values to use, over all lights and the first camera.
std::string tuned_text(const TuneJob& job, const TuneSummary& summary) {
  Experiment tuned = job.experiments.front();
  if (are_all_equal(summary.result)) {
    return "# `umbrameter tune` found no difference between the points: these are the given values.\n" +
           experiment_text(tuned);
  }
  const TunePoint& point = point_to_use(summary.result);
  for (std::size_t a = 0; a < job.axes.size(); ++a) {
    if (summary.result.withheld && job.axes[a].key() == constant_bias_key) continue;
    set_value(describe(tuned), job.axes[a].axis, point.values[a]);
  }
  const std::size_t cases = summary.cases.size();
  const std::string over =
      cases > 1 ? fmt::format(", {} of {} cases", summary.goal.is_worst_case ? "the worst" : "the mean", cases) : "";
  return fmt::format("# The {} point of `umbrameter tune`{}: {} = {}{}.\n",
                     summary.result.recommended ? "recommended" : "best",
                     summary.result.withheld ? ", with its own constant bias" : "", cost_name(summary.goal),
                     cost_text(summary.goal, point.score.cost), over) +
         bias_comment(summary) + experiment_text(tuned);
}

TuneResult search(TuneRun& run, TuneJournal& journal, const Console& console) {
  const TuneJob& job = run.job;
  const TuneInput input{job.axes, run.cases, job.goal, {run.line.tune.evaluations, run.line.tune.minutes}, job.given};
  for (const TuneCase& each : run.cases) each.stages->report_tracing([](double) {});
  ProgressBar bar(console, "evaluations");
  bar.show(0.0);
  return tune(input, journal, [&](std::size_t done, std::size_t all, const TuneScore& best) {
    bar.show(static_cast<double>(done) / static_cast<double>(all),
             fmt::format("{} of at most {}, {} {}", done, all, job.goal.text, cost_text(job.goal, best.cost)));
  });
}

std::vector<TunePointImages> measure_points(const TuneCase& first, const TuneSummary& summary) {
  Stages& stages = *first.stages;
  const TuneResult& result = summary.result;
  const auto at = [&](const TunePoint& point) { return at_point(first, summary.axes, point.values); };
  const Length best_bias = at(result.best).shadow.bias.constant;
  const auto images = [&](const char* name, const Experiment& experiment, const TunePoint& point) {
    // The slider of each point stops at the best one's bias, too.
    std::vector<double> stops;
    if (experiment.shadow.bias.constant.unit == best_bias.unit) stops.push_back(best_bias.number);
    TunePointImages measured{name, point_text(summary.axes, point.values),
                             measure_swept(stages, experiment, first.quantity, stops)};
    move_to_layers(stages.facts(), measured.measurement);
    return measured;
  };
  std::vector<TunePointImages> all;
  if (result.recommended) all.push_back(images("recommended", at(*result.recommended), *result.recommended));
  all.push_back(images("best", at(result.best), result.best));
  all.push_back(images("default", first.experiment, result.before));
  return all;
}

// The errors of an engine's numbers differ from case to case, the numbers from light to light.
std::vector<CaseEngines> engines_of(const TuneJob& job, const std::vector<TuneCase>& cases,
                                    const TuneSummary& summary) {
  std::vector<CaseEngines> all;
  if (job.for_engines.empty()) return all;
  if (summary.result.withheld) {
    cases.front().stages->add_notes({"--for: nothing to convert, as no bias is recommended"});
    return all;
  }
  std::vector<EngineCase> converted;
  for (const TuneCase& each : cases) {
    Experiment tuned = at_point(each, summary.axes, point_to_use(summary.result).values);
    tuned.run.for_engines = job.for_engines;
    Stages& stages = *each.stages;
    if (stages.is_sampled(tuned, each.light) || !stages.capabilities(tuned).taps_independent_of_bias) {
      stages.add_notes({no_engines_text(stages, tuned, each.light)});
      continue;
    }
    CaseEngines& of_case = all.emplace_back(CaseEngines{each.title});
    std::optional<double> recommended;
    if (std::ranges::find(job.axes, constant_bias_key, &TuneAxis::key) == job.axes.end()) {
      Experiment at_point = tuned;
      at_point.run.for_engines.clear();
      const BiasAdvice advice = advise_bias(stages, at_point, each.light);
      if (!advice.withheld) {
        recommended = named_bias(advice).constant;
        of_case.bias = "the bias that compare recommends at this point, " + named_bias_text(advice);
      }
    }
    converted.push_back({stages, std::move(tuned), recommended, each.light});
  }
  std::vector<std::vector<EngineAdvice>> advice = advise_engines(converted);
  for (std::size_t c = 0; c < all.size(); ++c) all[c].engines = std::move(advice[c]);
  return all;
}

void add_warnings(const TuneRun& run, TuneSummary& summary) {
  const TuneCase& first = run.cases.front();
  const std::vector<SweepAxis> axes = mapped(run.job.axes, [](const TuneAxis& each) { return each.axis; });
  std::vector<std::string>& warnings = summary.warnings;
  if (summary.result.allowed_evaluations < summary.result.usual_evaluations) {
    std::string words;
    for (const TuneAxis& axis : summary.axes) {
      if (axis.is_word()) words += (words.empty() ? "" : ", ") + axis.key();
    }
    warnings.push_back(fmt::format(
        "{}: with at most {} evaluations, {} by default, a value that is not the best may do better than shown", words,
        summary.result.allowed_evaluations, summary.result.usual_evaluations));
  }
  if (first.quantity == SweptQuantity::visibility) {
    std::vector<std::string> hard;
    for (const TuneCase& each : run.cases) {
      if (!each.stages->is_sampled(each.experiment, each.light)) hard.push_back(each.title);
    }
    const std::size_t others = hard.empty() ? 0 : hard.size() - 1;
    const bool minimizes_edges = measures_edges(joined(run.job.goal.columns, ",", &Column::name));
    Experiment experiment = first.experiment;
    if (!hard.empty() && varies_filter(axes, describe(experiment)) && !minimizes_edges) {
      const std::string more = others == 0 ? "" : fmt::format(" and {} more case{}", others, others == 1 ? "" : "s");
      const bool is_some = hard.size() < run.cases.size();
      warnings.push_back(filter_warning(filter_remedy("--minimize"),
                                        is_some ? fmt::format(", here of {}{},", hard.front(), more) : ""));
    }
    if (needs_biases(axes)) warnings.emplace_back(one_bias_warning);
  }
  // It is of the mean absolute error: another cost may rank no AO otherwise.
  if (first.quantity == SweptQuantity::ao && not_relative(run.job.goal).text == error_statistic) {
    for (const TuneCase& each : run.cases) {
      const Experiment used = at_point(each, summary.axes, point_to_use(summary.result).values);
      const SampledError error = measure_ao(*each.stages, used, {}).statistics->error;
      const std::string warning = no_ao_text(error.mae, error.mean_truth, error.mean_raster);
      if (!warning.empty()) {
        warnings.push_back(fmt::format("{}, at the {} point: {}", each.title,
                                       summary.result.recommended ? "recommended" : "best", warning));
      }
    }
  }
}

// What a tuning calls the default is the point as given, which presets and flags decide.
void note_given(const TuneRun& run) {
  const TuneCase& first = run.cases.front();
  std::vector<std::uint32_t> lights;
  if (first.quantity == SweptQuantity::visibility) {
    for (const TuneCase& each : run.cases) {
      if (each.stages == first.stages) lights.push_back(each.light);
    }
  }
  add_setting_notes(*first.stages, run.line, first.experiment, lights);
  Experiment usual;
  std::string given;
  for (std::size_t a = 0; a < run.job.axes.size(); ++a) {
    const TuneAxis& axis = run.job.axes[a];
    const std::string text = value_text(axis, run.job.given[a]);
    if (text == value_text(axis, require(describe(usual), axis.key()).value())) continue;
    given += fmt::format("{}{} {}", given.empty() ? "" : ", ", axis.key(), text);
  }
  if (!given.empty()) first.stages->add_notes({"the default of this tuning is the point as given: " + given});
}

void note_limits_of_rays(const TuneRun& run) {
  const TuneCase& first = run.cases.front();
  const std::vector<SweepAxis> axes = mapped(run.job.axes, [](const TuneAxis& each) { return each.axis; });
  if (first.quantity == SweptQuantity::ao && !varies_group(axes, "truth.ao-distance")) {
    std::string limits;  // a share of a scene's size differs from scene to scene
    for (const std::vector<TuneCase>& cases : run.by_scene) {
      const std::string limit = ao_limit_text(cases.front().experiment.truth);
      limits += (limits.empty() ? "" : ", ") + limit +
                (run.by_scene.size() > 1 ? " (" + scene_title(cases.front().experiment) + ")" : "");
    }
    first.stages->add_notes({"the reference is the same at every point: rays " + limits});
  }
}

std::vector<std::string> tune_files() {
  return {"experiment.toml", tuned_file,   "evaluations.csv", run_value_file,
          "summary.json",    "index.html", tune_journal_name};
}

ExitCode search_and_write(TuneRun& run, TuneJournal& journal, RunFolder& folder, const MeasuredPoints& measured,
                          const Console& console) {
  const CommandLine& line = run.line;
  const TuneJob& job = run.job;
  const TuneResult result = search(run, journal, console);

  const TuneJudgement judgement = [&] {
    ProgressBar bar(console, "significance");
    return judge({job.axes, run.cases, run.unseen, result.goal, job.shown, result},
                 [&](double share) { bar.show(share); });
  }();
  Stages& first = *run.cases.front().stages;
  RunResults results{"tune", job.experiments.front(), first.facts(), embree_version()};
  set_renderer(results, first);
  for (const TuneAxis& axis : job.axes) results.experiment.axes.emplace_back(axis.key(), axis.axis.text);
  results.tune =
      TuneFindings{{job.axes, titles_of(run.cases), result.goal, job.shown, result, judgement}, run.by_scene.size()};
  const TuneSummary& summary = results.tune->summary;
  results.tune->engines = engines_of(job, run.cases, summary);
  if (!line.no_figures) results.tune->points = measure_points(run.cases.front(), summary);
  add_warnings(run, results.tune->summary);
  note_given(run);
  note_limits_of_rays(run);
  results.notes = run.notes();
  for (const std::string& text : measured.notes) {
    if (std::ranges::find(results.notes, text) == results.notes.end()) {
      results.notes.push_back(text);
    }
  }
  const bool is_of_one_view = std::ranges::all_of(run.cases, [&](const TuneCase& each) {
    return each.stages == &first && each.experiment.view.camera == run.cases.front().experiment.view.camera;
  });
  RunOutput output;
  output.experiment_toml = experiment_of(job, line.tune);
  output.texts = {{tuned_file, tuned_text(job, summary)}, {"evaluations.csv", to_csv(evaluation_table(summary))}};
  output.closing = {fmt::format(
      "tuned: {0}{1}; run it with 'umbrameter compare -c {0} -o DIR'{2}", (folder.path() / tuned_file).string(),
      summary.result.withheld      ? " with constant-bias unchanged"
      : summary.result.recommended ? " with " + point_text(summary.axes, summary.result.recommended->values)
                                   : "",
      is_of_one_view ? "" : ", which measures one scene and camera: SCENE and --camera choose another")};
  output.journal = folder.path() / tune_journal_name;
  output.page = {make_figure_style(line.figures), !line.no_figures};
  return write_run(folder, console, std::move(results), std::move(output));
}

}  // namespace

RunPlan plan_of(const TuneRun& run) { return {"tune", experiment_of(run.job, run.line.tune), tune_files()}; }

ExitCode write_tune(TuneRun& run, RunFolder& folder, const MeasuredPoints& measured, const Console& console) {
  const CommandLine& line = run.line;
  const TuneJob& job = run.job;
  for (const TuneCase& each : run.cases) prepare(each);
  const std::filesystem::path journal_path = folder.path() / tune_journal_name;
  if (line.force) std::filesystem::remove(journal_path);
  folder.announce({tune_journal_name});
  TuneJournal journal(journal_path, run.identity());
  folder.begin();
  write_text(folder.path() / "experiment.toml", experiment_of(job, line.tune));
  if (journal.count() > 0) note(console, fmt::format("{} evaluations are done; resuming", journal.count()));
  for (const auto& [key, record] : measured.points) {
    if (journal.find(key) == nullptr) journal.add(key, record);
  }
  return resumable([&] { return search_and_write(run, journal, folder, measured, console); },
                   [&] {
                     return fmt::format("{} evaluation{} stored in {}; rerun the command to resume", journal.count(),
                                        journal.count() == 1 ? " is" : "s are", journal_path.string());
                   });
}

}  // namespace umbrameter
