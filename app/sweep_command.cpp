#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "app/dry_run.h"
#include "core/interrupt.h"
#include "experiments/sweep/sweep_progress.h"
#include "present/run_output.h"
#include "reports/files/output.h"
#include "store/stored_sweep.h"

namespace umbrameter {
namespace {

// One bar for all of it, tracing included.
void measure_missing(const SweepPlan& plan, ResultsStore& store, Stages& stages, const EvaluateGroup& evaluate,
                     const Console& console) {
  const std::size_t kept = store.count();
  if (store.discarded() > 0) {
    note(console, fmt::format("{} is damaged: {} cells do not match their checksum and are measured again",
                              store.path().string(), store.discarded()));
  }
  if (kept > 0) note(console, fmt::format("{} of {} cells are done; resuming", kept, plan.cells));
  ProgressBar bar(console, "cells");
  SweepProgress progress{count_references(plan)};
  const auto show = [&] {
    const auto done = static_cast<std::size_t>(std::llround(progress.cells * static_cast<double>(plan.cells)));
    bar.show(progress.share, fmt::format("{} of {}", done, plan.cells));
  };
  stages.report_tracing([&](double share) {
    advance_tracing(progress, share);
    show();
  });
  run_sweep(plan, store, evaluate, [&](double share) {
    advance_cells(progress, share);
    show();
  });
  stages.report_tracing({});
}

}  // namespace

ExitCode run_sweep_command(const CommandLine& line, const Console& console) {
  SweepRun sweep(line, make_experiment(line));
  std::optional<RunFolder> run_folder;
  if (!line.dry_run) {
    run_folder.emplace(line.output, RunPlan{line.command, experiment_text(sweep.given), run_files(true), true},
                       line.force);
  }
  sweep.load(console);
  Stages& stages = *sweep.stages;
  if (!sweep.metrics.empty() && is_one_pass(stages, sweep.experiment, sweep.axes, sweep.statistics)) {
    note(console, fmt::format("one pass measures the statistics of a group; the metrics draw each of the {} cells",
                              sweep.plan.cells));
  }
  if (line.dry_run) return show_sweep_plan(console, sweep);

  RunFolder& folder = *run_folder;
  folder.announce(ResultsStore::file_names());
  ResultsStore store = ResultsStore::open(line.output, sweep.description(), line.force);
  const auto measure_and_write = [&] {
    if (store.complete()) {
      note(console, fmt::format("all {} cells are done; --force recomputes them", sweep.plan.cells));
    } else {
      const EvaluateGroup evaluate = make_evaluator(stages, sweep.experiment, sweep.axes, sweep.statistics);
      const auto begin = [&] {
        folder.begin();
        write_text(folder.path() / "experiment.toml", experiment_text(sweep.given));
      };
      // What makes no sense shows before the first group is measured: only then earlier results give way.
      bool is_begun = store.count() > 0;
      if (is_begun) begin();
      measure_missing(
          sweep.plan, store, stages,
          [&](const CellGroup& group, const RowSink& keep) {
            evaluate(group, keep);
            if (!std::exchange(is_begun, true)) begin();
          },
          console);
    }
    return write_sweep(sweep, store, folder, console);
  };
  return resumable(measure_and_write, [&]() -> std::string {
    if (store.count() == 0) return "no cell is done; rerun the command to start over";
    return fmt::format("{} of {} cells are stored in {}; rerun the command to resume", store.count(), sweep.plan.cells,
                       store.path().string());
  });
}

}  // namespace umbrameter
