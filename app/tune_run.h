// A tuning from the command line to its files: what `tune`, `plan`, `run` and `merge` share.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/tune_job.h"
#include "core/parallel.h"
#include "experiments/sweep/identity.h"
#include "experiments/tune/tune_rounds.h"
#include "store/run_folder.h"

namespace umbrameter {

/// First what the command line alone decides; then, after load(), the scenes and all that they decide. `line` must
/// outlive this.
struct TuneRun {
  TuneRun(const CommandLine& line, std::vector<Experiment> experiments);
  TuneRun(const TuneRun&) = delete;  // the cases point into `stages`
  TuneRun& operator=(const TuneRun&) = delete;

  /// Reads the scenes, finds the cases, and checks what the options name in them.
  void load(const Console& console);
  /// All that the evaluations depend on. The path of a scene is no part of it.
  Identity identity();
  /// Assumptions of all scenes so far, each once.
  std::vector<std::string> notes() const;
  /// What the evaluated points depend on, besides their values.
  SearchInput search_input(std::optional<std::size_t> exact) const;

  const CommandLine& line;
  TuneJob job;
  std::optional<ThreadLimit> threads{};
  std::shared_ptr<gl::Context> context{};
  std::shared_ptr<const FrameSource> frames{};
  std::optional<CacheFolder> cache{};
  std::deque<Stages> stages{};  ///< of the scenes and of those held out
  std::vector<std::vector<TuneCase>> by_scene{};
  std::vector<TuneCase> cases{};   ///< of all scenes
  std::vector<TuneCase> unseen{};  ///< held out

 private:
  Stages& load_stages(const Experiment& experiment, const Console& console);
  void hold_out(const Console& console);
};

/// What a tuning writes into the folder of its results.
RunPlan plan_of(const TuneRun& run);

/// What was measured elsewhere.
struct MeasuredPoints {
  KnownPoints points{};
  std::vector<std::string> notes{};  ///< of measuring
};

/// Evaluates the points that were not measured, compares the best one, and writes all files of a tuning.
ExitCode write_tune(TuneRun& run, RunFolder& folder, const MeasuredPoints& measured, const Console& console);

}  // namespace umbrameter
