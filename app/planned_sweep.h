// A plan's folder as a sweep: what `run` and `merge` share.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/sweep_run.h"
#include "store/shard_plan.h"

namespace umbrameter {

struct PlannedSweepFolder {
  std::filesystem::path folder;
  ShardPlan plan;
  CommandLine line;  ///< of the sweep
  Experiment given;  ///< its scene as an absolute path
};

/// Reads the plan. If it is of an engine, starts that engine. Throws as read_plan() and load_experiment() do.
PlannedSweepFolder open_plan(const CommandLine& line);

/// Loads the sweep and identifies it. Throws Error (usage) if it is not the planned one: another scene, device or
/// build.
StoreDescription load_planned(const PlannedSweepFolder& planned, SweepRun& sweep, const Console& console);

/// The identity of a sweep without the path of its scene, which differs between machines.
std::vector<std::pair<std::string, std::string>> portable_identity(const StoreDescription& description);

/// The kinds of a sweep's measured columns.
std::vector<ValueKind> measured_kinds(const StoreDescription& description, const SweepPlan& plan);

/// A path as one word for a shell.
std::string shell_word(const std::filesystem::path& path);

/// "umbrameter run PLAN --shard 3,7-9", for a shell.
std::string command_of(const std::filesystem::path& folder, const std::string& shards);

}  // namespace umbrameter
