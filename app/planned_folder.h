// A plan's folder: what `run`, `merge` and `status` need of it whether it divides a sweep or a tuning.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "experiments/sweep/identity.h"
#include "store/merge_shards.h"
#include "store/shard_plan.h"

namespace umbrameter {

struct PlannedFolder {
  std::filesystem::path folder;
  ShardPlan plan;
  CommandLine line;  ///< of the command that is divided
  Experiment given;  ///< its scene as an absolute path
};

/// Reads the plan. If it is of an engine, starts that engine. Throws as read_plan() and load_experiment() do.
PlannedFolder open_plan(const CommandLine& line);

/// A sweep or a tuning that is loaded to measure shards.
struct ShardMeasurer {
  Identity measured_by{};
  std::string maker{};                                    ///< maker_of()
  std::function<std::vector<std::string>()> notes{};      ///< assumptions since it was loaded
  std::function<void(const Progress&)> report_tracing{};  ///< Stages::report_tracing()
  /// Appends the measured values of all cells of a shard and reports, after some of them, the number so far and their
  /// share.
  std::function<void(const PlannedShard&, std::string& rows, const std::function<void(std::size_t, double)>& report)>
      measure{};
};

/// `planned` must outlive the result. Throws Error (usage) if what is loaded here is not what was planned: another
/// scene, device or build.
ShardMeasurer load_sweep_measurer(const PlannedFolder& planned, const Console& console);
ShardMeasurer load_tune_measurer(const PlannedFolder& planned, const Console& console);

/// Plans the first round of a tuning. The folder is free. Throws Error as `tune` does, and (usage) for what a divided
/// tuning cannot do.
ExitCode plan_tune(const CommandLine& line, const Console& console);

/// Merges a tuning, or plans its next round. Throws Error (partial) where points are left to measure.
ExitCode merge_tune(const PlannedFolder& planned, const CommandLine& line, const Console& console);

/// Prints these shards in the forms that engines take, and a line for each problem.
void show_shards(const Console& console, const PlannedFolder& planned, const std::vector<std::size_t>& shards,
                 const std::vector<std::string>& problems);

/// What is thrown after show_shards(). `remedy` says what to do besides running the shards.
Error missing_shards(const PlannedFolder& planned, const CollectedShards& collected, const char* remedy);

/// A path as one word for a shell.
std::string shell_word(const std::filesystem::path& path);

/// "umbrameter run PLAN --shard 3,7-9", for a shell.
std::string command_of(const std::filesystem::path& folder, const std::string& shards);

}  // namespace umbrameter
