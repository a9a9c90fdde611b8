// A sweep from the command line to its files: what `sweep`, `plan`, `run` and `merge` share.
#pragma once

#include <optional>
#include <vector>

#include "app/commands.h"
#include "core/parallel.h"
#include "experiments/sweep/sweep_evaluator.h"
#include "store/results_store.h"
#include "store/run_folder.h"

namespace umbrameter {

/// First what the command line alone decides; then, after load(), the scene and all that it decides. `line` must
/// outlive this.
struct SweepRun {
  /// Throws Error (usage) for axes that a sweep cannot have.
  SweepRun(const CommandLine& line, Experiment experiment);
  SweepRun(const SweepRun&) = delete;  // the parameters point into `given`
  SweepRun& operator=(const SweepRun&) = delete;

  /// Reads the scene, selects the light, and checks what the axes name in the scene.
  void load(const Console& console);
  /// What identifies the sweep, and the columns of its rows.
  StoreDescription description();

  const CommandLine& line;
  Experiment given;  ///< as the user wrote it, with the one light that is swept
  std::vector<SweepAxis> axes;
  SweptQuantity quantity;
  Parameters parameters;  ///< of `given`
  SweepPlan plan;
  std::optional<ThreadLimit> threads{};
  std::optional<Stages> stages{};
  Experiment experiment{};  ///< in metres
  CellStatistics statistics{};
  std::vector<MetricColumn> metrics{};
};

/// Measures what only the page needs and writes all files of a sweep whose rows are complete.
ExitCode write_sweep(SweepRun& sweep, const ResultsStore& store, RunFolder& folder, const Console& console);

}  // namespace umbrameter
