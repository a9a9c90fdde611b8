// A tuning as the command line says it, before any scene is loaded.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "experiments/tune/tune_cases.h"
#include "experiments/tune/tune_search.h"

namespace umbrameter {

struct TuneJob {
  std::vector<Experiment> experiments;  ///< one for each scene
  std::vector<TuneAxis> axes;
  std::vector<Value> given;  ///< TuneInput::given
  TuneGoal goal;
  TuneGoal shown;           ///< the goal, with the metrics that are only shown
  std::string metrics;      ///< these, as given
  std::string for_engines;  ///< run.for
  SweptQuantity quantity = SweptQuantity::visibility;
  CaseAxes over, held_out;
};

/// How an option --held-out begins that names a scene.
inline constexpr std::string_view held_out_scene = "scene=";

/// The options by name, in order, and back.
std::vector<std::pair<std::string, std::string>> pairs_of(const TuneOptions& options);
TuneOptions tune_options(const std::vector<std::pair<std::string, std::string>>& pairs);

/// The experiment of each SCENE.
std::vector<Experiment> tuned_experiments(const CommandLine& line);

/// `experiments` has one for each scene. Throws Error (usage) for what cannot be tuned.
TuneJob make_tune_job(const TuneOptions& options, std::vector<Experiment> experiments);

/// The experiment.toml of the results.
std::string experiment_of(const TuneJob& job, const TuneOptions& options);

}  // namespace umbrameter
